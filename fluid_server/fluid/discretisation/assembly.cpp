/// Residual and Jacobian of eq. (20): elements, then the ghost penalty, then the multipliers.
#include "core/parallel.hpp"
#include "fluid/base/quadrature.hpp"
#include "fluid/discretisation/system.hpp"

namespace fpi::fluid {
namespace {

constexpr std::size_t most_curved_points = triangle_degree_6.size();

/// Writes the nodal values of a cell into one lane of the state.
template <class T>
void take_values(const Mesh& mesh, Index cell, const Fields& fields, const TimeTerms& time,
                 const Vector& acceleration, int lane, ElementState<T>& state) {
  const auto nodes = mesh.cell_nodes(cell);
  const auto vertices = mesh.cell_vertices(cell);
  const bool follows = time.follows_path(cell);
  state.inertia = time.inertia;
  for (int i = 0; i < 6; ++i) {
    const Index n = nodes[i];
    part(state.ux[i], lane) = fields.u[2 * n];
    part(state.uy[i], lane) = fields.u[2 * n + 1];
    part(state.ax[i], lane) = follows ? time.inertia * fields.u[2 * n] : acceleration[2 * n];
    part(state.ay[i], lane) = follows ? time.inertia * fields.u[2 * n + 1] : acceleration[2 * n + 1];
    part(state.wx[i], lane) = time.moves() ? time.mesh_velocity[2 * n] : 0;
    part(state.wy[i], lane) = time.moves() ? time.mesh_velocity[2 * n + 1] : 0;
  }
  for (int k = 0; k < 3; ++k) part(state.p[k], lane) = fields.p[vertices[k]];
}

/// Adds the residual in one lane to the nodes of a cell.
template <class T>
void add_values(const Mesh& mesh, Index cell, std::array<T, element_unknowns>& element, int lane,
                Residual& residual) {
  const auto nodes = mesh.cell_nodes(cell);
  const auto vertices = mesh.cell_vertices(cell);
  for (int i = 0; i < 6; ++i) {
    residual.u[2 * nodes[i]] += part(element[i], lane);
    residual.u[2 * nodes[i] + 1] += part(element[6 + i], lane);
  }
  for (int k = 0; k < 3; ++k) residual.p[vertices[k]] += part(element[12 + k], lane);
}

}  // namespace

Residual System::assemble(const Flow& flow, const Fields& fields, const TimeTerms& time, bool with_jacobian) {
  Residual residual = no_residual();
  drives_.add(-fields.drive, residual.u, residual.rigid);
  residual.drive = drives_.excess(fields.u, motions(fields.rigid));
  residual.u -= load_;
  if (time.load.size() > 0) residual.u -= flow.density * time.load;
  if (with_jacobian) matrix_.set_zero();
  const Vector acceleration = time.acceleration(fields.u);
  assemble_cells({flow, fields, time, acceleration, residual, with_jacobian});
  assemble_ghost(flow, fields, time, acceleration, residual, with_jacobian);
  assemble_arcs(fields, residual, with_jacobian);
  keep_momentum(flow.density, time.parts, fields.u, residual.u);
  free_bodies_.add_residual(interfaces_, fields.rigid, fields.lambda, residual.lambda, residual.rigid);
  if (with_jacobian) free_bodies_.add_jacobian(interfaces_, matrix_);
  return residual;
}

/// Even colours, then odd ones: two of the same kind share nothing.
void System::assemble_cells(const Assembly& what) {
  const int n = static_cast<int>(stretches_.size());
  for (const int first : {0, 1}) {
    parallel_for((n - first + 1) / 2, [&](int i) {
      const Stretch& stretch = stretches_[2 * i + first];
      for (Index k = stretch.begin; k < stretch.curved; k += n_lanes)
        assemble_several(what, k, std::min(k + n_lanes, stretch.curved));
      for (Index k = stretch.curved; k < stretch.single; k += n_lanes)
        assemble_several(what, k, std::min(k + n_lanes, stretch.single));
      for (Index k = stretch.single; k < stretch.end; ++k) assemble_single(what, k);
    });
  }
}

/// A few straight or a few curved cells at once, one a lane; lanes that are left over repeat the first cell.
void System::assemble_several(const Assembly& what, Index begin, Index end) {
  ElementState<Lanes> state;
  std::array<Metric<Lanes>, most_curved_points> metrics;
  ElementSystem<Lanes> systems;
  const auto points = space_.quadrature(active_cells_[begin]).points;
  std::size_t n_metrics = 0;
  for (int lane = 0; lane < n_lanes; ++lane) {
    const Index c = active_cells_[begin + lane < end ? begin + lane : begin];
    take_values(space_.mesh, c, what.fields, what.time, what.acceleration, lane, state);
    const auto own = space_.quadrature(c).metrics;
    n_metrics = own.size();
    for (std::size_t q = 0; q < n_metrics; ++q) {
      for (int k = 0; k < 3; ++k) {
        part(metrics[q].gx[k], lane) = own[q].gx[k];
        part(metrics[q].gy[k], lane) = own[q].gy[k];
      }
      part(metrics[q].area, lane) = own[q].area;
    }
  }
  element_system<Lanes>(what.flow, points, {metrics.data(), n_metrics}, state, systems, what.with_jacobian);
  for (Index k = begin; k < end; ++k) {
    const int lane = static_cast<int>(k - begin);
    add_values(space_.mesh, active_cells_[k], systems.residual, lane, what.residual);
    if (what.with_jacobian) matrix_.add(k, &part(systems.jacobian[0], lane), n_lanes);
  }
}

/// A cut cell, or one with a slip node.
void System::assemble_single(const Assembly& what, Index k) {
  const Index c = active_cells_[k];
  ElementState<double> state;
  ElementSystem<double> block;
  take_values(space_.mesh, c, what.fields, what.time, what.acceleration, 0, state);
  const Quadrature rule = quadrature(k);
  element_system<double>(what.flow, rule.points, rule.metrics, state, block, what.with_jacobian);
  add_values(space_.mesh, c, block.residual, 0, what.residual);
  if (!what.with_jacobian) return;
  rotate_slip(space_.mesh.cell_nodes(c), 0, 6, block_size::cell, block.jacobian.data());
  matrix_.add(k, block.jacobian.data());
}

void System::assemble_ghost(const Flow& flow, const Fields& fields, const TimeTerms& time,
                            const Vector& acceleration, Residual& residual, bool with_jacobian) {
  const double mu = flow.viscosity, rho = flow.density;
  std::array<double, block_size::ghost * block_size::ghost> dense{};
  Eigen::Map<Eigen::Matrix<double, block_size::ghost, block_size::ghost>> block(dense.data());
  Index number = first_ghost_;
  for (const auto& shared : cut_.ghost_faces) {
    const GhostFace& face = *shared;
    const double viscous = embedding_.ghost_viscous * mu / face.h2;
    const double pressure = -embedding_.ghost_pressure / mu;  // the continuity equation carries −s_p
    const auto [of_acceleration, rate] = ghost_inertia(face, time.mesh_velocity, time.inertia);
    const double inertial = embedding_.ghost_inertia * rho;
    Eigen::Matrix<double, 9, 2> z;
    for (int i = 0; i < 9; ++i)
      for (int c = 0; c < 2; ++c) {
        const Index k = 2 * face.nodes[i] + c;
        z(i, c) = viscous * fields.u[k] + inertial * (of_acceleration ? acceleration[k] : rate * fields.u[k]);
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
      block.topLeftCorner<9, 9>() = (viscous + inertial * rate) * face.velocity;
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
    for (int end = 0; end < 2; ++end) {
      const Padded& shape = pieces_[k].shape[end];
      const auto lambda = fields.lambda.segment<2>(2 * piece.multipliers[end]);
      auto slip = residual.lambda.segment<2>(2 * piece.multipliers[end]);
      slip -= pieces_[k].velocity[end];
      for (int i = 0; i < 6; ++i) {
        residual.u.segment<2>(2 * nodes[i]) += shape[i] * lambda;
        slip += shape[i] * fields.u.segment<2>(2 * nodes[i]);
      }
    }
    if (!with_jacobian) continue;
    dense.fill(0);
    for (int end = 0; end < 2; ++end)
      for (int c = 0; c < 2; ++c)
        for (int i = 0; i < 6; ++i) {
          const int velocity = 4 + 6 * c + i, multiplier = 2 * end + c;
          dense[velocity + block_size::arc * multiplier] = dense[multiplier + block_size::arc * velocity] =
              pieces_[k].shape[end][i];
        }
    if (has_slip_node(nodes)) rotate_slip(nodes, 4, 10, block_size::arc, dense.data());
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
