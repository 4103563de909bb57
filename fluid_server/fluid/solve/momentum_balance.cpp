#include "fluid/solve/momentum_balance.hpp"

#include <cmath>

#include "fluid/base/disjoint_sets.hpp"
#include "fluid/discretisation/arc_points.hpp"
#include "fluid/solve/history.hpp"

namespace fpi::fluid {
namespace {

/// Number of the part that each cell belongs to; −1: none of its nodes moves.
struct Partition {
  std::vector<Index> of_cell;
  Index n = 0;
};

/// A body whose place is kept for a while, as it has hardly left it, moves too: the fluid passes its surface.
bool moves(const Interface& interface) {
  const bool turns = interface.rigid.spin != 0 && !interface.surface.disc();
  return turns || !interface.rigid.translation.isZero(0);
}

/// 1 for each node that moves or lies at the surface of a body that does.
std::vector<std::uint8_t> moving_nodes(const System& system, const Vector& displacement,
                                       const State& accepted) {
  const Mesh& mesh = system.space().mesh;
  std::vector<std::uint8_t> out(mesh.n_nodes());
  for (Index node = 0; node < mesh.n_nodes(); ++node) out[node] = !stays(displacement, accepted, node);
  for (const ArcPiece& piece : system.cut().pieces)
    if (moves(system.interfaces()[piece.interface]))
      for (const Index node : mesh.cell_nodes(piece.cell)) out[node] = 1;
  return out;
}

Partition partition(const Mesh& mesh, const std::vector<std::uint8_t>& moves) {
  DisjointSets sets(mesh.n_nodes());
  std::vector<Index> mover(mesh.n_cells(), -1);  // a node of the cell that moves
  for (Index c = 0; c < mesh.n_cells(); ++c)
    for (const Index node : mesh.cell_nodes(c)) {
      if (moves[node] == 0) continue;
      if (mover[c] >= 0) sets.join(mover[c], node);
      mover[c] = node;
    }
  Partition out{std::vector<Index>(mesh.n_cells(), -1)};
  std::vector<Index> number(mesh.n_nodes(), -1);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    if (mover[c] < 0) continue;
    Index& part = number[sets.find(mover[c])];
    if (part < 0) part = out.n++;
    out.of_cell[c] = part;
  }
  return out;
}

/// Area, ∫u_x, ∫u_y of each part.
using Contents = Eigen::Matrix3Xd;
Contents contents(const Partition& parts, const Vector& in_cells) {
  Contents sum = Contents::Zero(3, parts.n);
  for (std::size_t c = 0; c < parts.of_cell.size(); ++c)
    if (parts.of_cell[c] >= 0)
      sum.col(parts.of_cell[c]) += in_cells.segment<3>(3 * static_cast<Eigen::Index>(c));
  return sum;
}

MovingPart::Cell integrals(const std::array<Index, 6>& nodes, const Quadrature& rule, const Vector& w) {
  MovingPart::Cell cell{nodes, Padded::Zero(), Padded::Zero(), {}};
  for (auto& slopes : cell.slopes) slopes.setZero();
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const Shape& shape = rule.points[q].shape;
    const Metric<double>& metric = rule.metric(q);
    const Padded n = rule.weight(q) * shape.n;
    const std::array<const std::array<double, 3>*, 2> gradients{&metric.gx, &metric.gy};
    cell.shape += n;
    for (int c = 0; c < 2; ++c) {
      const auto& g = *gradients[c];
      const Padded slope = g[0] * shape.dn[0] + g[1] * shape.dn[1] + g[2] * shape.dn[2];
      cell.slopes[c].noalias() += n.head<6>() * slope.head<6>().transpose();
    }
  }
  for (int c = 0; c < 2; ++c)
    for (int i = 0; i < 6; ++i) cell.growth.head<6>() += w[2 * nodes[i] + c] * cell.slopes[c].col(i);
  return cell;
}

void add_surface(const System& system, const ArcPiece& piece, const Vector& w, MovingPart& part) {
  const Interface& interface = system.interfaces()[piece.interface];
  const auto nodes = system.space().mesh.cell_nodes(piece.cell);
  for (const ArcPoint& point : arc_points(system.space(), interface, piece)) {
    Vec2 given = value_at(nodes, point.shape, w);
    if (!interface.sampled.empty())
      given += interface.velocity(piece.arc, point.parameter) - interface.rigid(point.x);
    const Vec2 normal = -point.weight * interface.surface.normal(point.parameter);
    part.surface.push_back({nodes, point.shape, normal, normal.dot(given)});
  }
}

}  // namespace

Vector fluid_in_cells(const System& system, const Vector& u) {
  const Mesh& mesh = system.space().mesh;
  Vector out = Vector::Zero(3 * static_cast<Eigen::Index>(mesh.n_cells()));
  for (std::size_t k = 0; k < system.active_cells().size(); ++k) {
    const Index c = system.active_cells()[k];
    const auto nodes = mesh.cell_nodes(c);
    const Quadrature rule = system.quadrature(k);
    auto of_cell = out.segment<3>(3 * static_cast<Eigen::Index>(c));
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const double weight = rule.weight(q);
      of_cell[0] += weight;
      for (int i = 0; i < 6; ++i)
        of_cell.tail<2>() += weight * rule.points[q].shape.n[i] * u.segment<2>(2 * nodes[i]);
    }
  }
  return out;
}

std::vector<MovingPart> moving_parts(const System& system, const Vector& displacement, const State& accepted,
                                     const Scheme& scheme, const TimeTerms& time) {
  if (accepted.fluid_in_cells.size() == 0) return {};
  const Mesh& mesh = system.space().mesh;
  const Partition of = partition(mesh, moving_nodes(system, displacement, accepted));
  const Vector at_rest = Vector::Zero(time.moves() ? 0 : 2 * static_cast<Eigen::Index>(mesh.n_nodes()));
  const Vector& mesh_velocity = time.moves() ? time.mesh_velocity : at_rest;
  std::vector<MovingPart> parts(of.n);
  for (std::size_t k = 0; k < system.active_cells().size(); ++k) {
    const Index c = system.active_cells()[k];
    if (of.of_cell[c] < 0) continue;
    MovingPart& part = parts[of.of_cell[c]];
    const MovingPart::Cell& cell =
        part.cells.emplace_back(integrals(mesh.cell_nodes(c), system.quadrature(k), mesh_velocity));
    part.area += cell.shape.sum();
    if (time.follows_path(c))
      part.made -= time.carried.segment<2>(2 * c);
    else
      for (int i = 0; i < 6; ++i) part.made -= cell.shape[i] * time.history.segment<2>(2 * cell.nodes[i]);
  }
  for (const ArcPiece& piece : system.cut().pieces) {
    const Index part = of.of_cell[piece.cell];
    if (part >= 0) add_surface(system, piece, mesh_velocity, parts[part]);
  }
  const Contents now = contents(of, accepted.fluid_in_cells);
  const bool has_past = accepted.previous_fluid_in_cells.size() > 0;
  const Contents before = has_past ? contents(of, accepted.previous_fluid_in_cells) : now;
  std::vector<MovingPart> kept;
  for (Index i = 0; i < of.n; ++i) {
    MovingPart& part = parts[i];
    constexpr double same_area = 1e-4;
    const auto is_same = [&](double area) { return std::abs(area - part.area) <= same_area * part.area; };
    if (part.cells.empty() || !is_same(now(0, i)) || (scheme.is_bdf2() && !has_past)) continue;
    const Vec2 momentum = part.area / now(0, i) * now.col(i).tail<2>();
    part.made += scheme.inertia * momentum;
    if (scheme.is_bdf2()) {
      if (!is_same(before(0, i))) continue;
      part.made += scheme.before * (momentum - part.area / before(0, i) * before.col(i).tail<2>());
    }
    kept.push_back(std::move(part));
  }
  return kept;
}

}  // namespace fpi::fluid
