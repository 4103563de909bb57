/// Residual and Jacobian of eq. (20): elements, then the ghost penalty, then the multipliers.
#include "fluid/system.hpp"

namespace fpi::fluid {
namespace {

template <class Nodes>
auto gather_nodes(const Vector& values, const Nodes& nodes, int component) {
  Padded out = Padded::Zero();
  for (std::size_t i = 0; i < nodes.size(); ++i) out[i] = values[2 * nodes[i] + component];
  return out;
}

}  // namespace

Residual System::assemble(const Flow& flow, const Fields& fields, const TimeTerms& time, bool with_jacobian) {
  Residual residual{-load_, Vector::Zero(fields.p.size()), Vector::Zero(fields.lambda.size())};
  if (with_jacobian) matrix_.set_zero();
  const Vector acceleration = time.acceleration(fields.u);
  assemble_cells(flow, fields, time, acceleration, residual, with_jacobian);
  assemble_ghost(flow, fields, time, acceleration, residual, with_jacobian);
  assemble_arcs(fields, residual, with_jacobian);
  return residual;
}

void System::assemble_cells(const Flow& flow, const Fields& fields, const TimeTerms& time,
                            const Vector& acceleration, Residual& residual, bool with_jacobian) {
  ElementState state;
  ElementResidual element;
  ElementJacobian jacobian;
  std::array<double, block_size::cell * block_size::cell> dense{};
  for (std::size_t k = 0; k < active_cells_.size(); ++k) {
    const Index c = active_cells_[k];
    const auto nodes = space_.mesh.cell_nodes(c);
    const auto& vertices = space_.mesh.cells[c];
    state.ux = gather_nodes(fields.u, nodes, 0);
    state.uy = gather_nodes(fields.u, nodes, 1);
    state.ax = gather_nodes(acceleration, nodes, 0);
    state.ay = gather_nodes(acceleration, nodes, 1);
    state.inertia.setZero();
    for (int i = 0; i < 6; ++i) state.inertia[i] = time.inertia[nodes[i]];
    for (int i = 0; i < 3; ++i) state.p[i] = fields.p[vertices[i]];

    const auto [points, scale] = quadrature(k);
    element_system(flow, space_.triangles[c], points, scale, state, element,
                   with_jacobian ? &jacobian : nullptr);

    for (int i = 0; i < 6; ++i) {
      residual.u[2 * nodes[i]] += element.x[i];
      residual.u[2 * nodes[i] + 1] += element.y[i];
    }
    for (int i = 0; i < 3; ++i) residual.p[vertices[i]] += element.q[i];
    if (!with_jacobian) continue;

    for (int j = 0; j < 6; ++j) {
      double* column_x = dense.data() + block_size::cell * j;
      double* column_y = dense.data() + block_size::cell * (6 + j);
      for (int i = 0; i < 6; ++i) {
        column_x[i] = jacobian.xx(i, j);
        column_x[6 + i] = jacobian.yx(i, j);
        column_y[i] = jacobian.xy(i, j);
        column_y[6 + i] = jacobian.yy(i, j);
      }
      for (int l = 0; l < 3; ++l) {
        column_x[12 + l] = jacobian.xp[l][j];
        column_y[12 + l] = jacobian.yp[l][j];
        dense[block_size::cell * (12 + l) + j] = jacobian.xp[l][j];
        dense[block_size::cell * (12 + l) + 6 + j] = jacobian.yp[l][j];
      }
    }
    if (has_slip_node(nodes)) rotate_slip(nodes, 0, 6, block_size::cell, dense.data());
    matrix_.add(static_cast<Index>(k), dense.data());
  }
}

void System::assemble_ghost(const Flow& flow, const Fields& fields, const TimeTerms& time,
                            const Vector& acceleration, Residual& residual, bool with_jacobian) {
  const double mu = flow.viscosity, rho = flow.density;
  std::array<double, block_size::ghost * block_size::ghost> dense{};
  Eigen::Map<Eigen::Matrix<double, block_size::ghost, block_size::ghost>> block(dense.data());
  Index number = first_ghost_;
  for (const GhostFace& face : ghosts_) {
    const double viscous = embedding_.ghost_viscous * mu / face.h2;
    const double inertial = embedding_.ghost_inertia * rho;
    const double pressure = -embedding_.ghost_pressure / mu;  // the continuity equation carries −s_p

    // γ_m acts on inertia · u where bodies move, since the history of uncovered nodes is a guess; on the
    // acceleration where they do not, so that it vanishes with Δt as the scheme's own error does.
    Eigen::Matrix<double, 9, 2> z;
    Eigen::Matrix<double, 9, 1> slope;
    for (int i = 0; i < 9; ++i) {
      const Index n = face.nodes[i];
      slope[i] = viscous + inertial * time.inertia[n];
      for (int c = 0; c < 2; ++c) {
        const double u = fields.u[2 * n + c];
        z(i, c) = viscous * u + inertial * (bodies_move_ ? time.inertia[n] * u : acceleration[2 * n + c]);
      }
    }
    const Eigen::Matrix<double, 9, 2> r = face.velocity * z;
    for (int i = 0; i < 9; ++i)
      for (int c = 0; c < 2; ++c) residual.u[2 * face.nodes[i] + c] += r(i, c);
    Eigen::Vector4d p;
    for (int i = 0; i < 4; ++i) p[i] = fields.p[face.vertices[i]];
    const Eigen::Vector4d rp = pressure * face.pressure * p;
    for (int i = 0; i < 4; ++i) residual.p[face.vertices[i]] += rp[i];

    if (with_jacobian) {
      block.setZero();
      block.topLeftCorner<9, 9>() = face.velocity * slope.asDiagonal();
      block.bottomRightCorner<9, 9>() = block.topLeftCorner<9, 9>();
      if (has_slip_node(face.nodes)) rotate_slip(face.nodes, 0, 9, block_size::ghost, dense.data());
      matrix_.add(number, dense.data());
      const Eigen::Matrix4d pressure_block = pressure * face.pressure;
      matrix_.add(number + 1, pressure_block.data());
    }
    number += 2;
  }
}

void System::assemble_arcs(const Fields& fields, Residual& residual, bool with_jacobian) {
  std::array<double, block_size::arc * block_size::arc> dense{};
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    const ArcPiece& piece = cut_.pieces[k];
    const auto nodes = space_.mesh.cell_nodes(piece.cell);
    const Padded& shape = pieces_[k].shape;
    const auto lambda = fields.lambda.segment<2>(2 * piece.multiplier);
    auto slip = residual.lambda.segment<2>(2 * piece.multiplier);
    slip -= pieces_[k].velocity;
    for (int i = 0; i < 6; ++i) {
      residual.u.segment<2>(2 * nodes[i]) += shape[i] * lambda;
      slip += shape[i] * fields.u.segment<2>(2 * nodes[i]);
    }
    if (!with_jacobian) continue;
    dense.fill(0);
    for (int c = 0; c < 2; ++c)
      for (int i = 0; i < 6; ++i) {
        const int velocity = 2 + 6 * c + i;
        dense[velocity + block_size::arc * c] = dense[c + block_size::arc * velocity] = shape[i];
      }
    if (has_slip_node(nodes)) rotate_slip(nodes, 2, 8, block_size::arc, dense.data());
    matrix_.add(first_piece_ + static_cast<Index>(k), dense.data());
  }
}

/// Turns rows and columns of slip nodes into normal and tangential ones.
void System::rotate_slip(std::span<const Index> nodes, int first_x, int first_y, int n, double* dense) const {
  Eigen::Map<Eigen::MatrixXd> block(dense, n, n);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (space_.boundary.constraint(nodes[k]) != Constraint::normal) continue;
    const Vec2& normal = space_.boundary.normal(nodes[k]);
    const int x = first_x + static_cast<int>(k), y = first_y + static_cast<int>(k);
    const Eigen::VectorXd row_x = block.row(x), row_y = block.row(y);
    block.row(x) = normal.x() * row_x + normal.y() * row_y;
    block.row(y) = -normal.y() * row_x + normal.x() * row_y;
    const Eigen::VectorXd column_x = block.col(x), column_y = block.col(y);
    block.col(x) = normal.x() * column_x + normal.y() * column_y;
    block.col(y) = -normal.y() * column_x + normal.x() * column_y;
  }
}

}  // namespace fpi::fluid
