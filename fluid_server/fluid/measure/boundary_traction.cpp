#include "fluid/measure/boundary_traction.hpp"

#include <algorithm>
#include <map>
#include <numbers>

#include "core/error.hpp"
#include "fluid/base/quadrature.hpp"
#include "fluid/mesh/isoparametric.hpp"

namespace fpi::fluid {
namespace {

using Vectors3 = Eigen::Matrix<double, 2, 3>;  // at both ends and the middle of a line

/// Integrals over a boundary, of which the last two are worth something where it is closed: length, ∫ x,
/// area inside and ∫ x over it (Green).
struct Measures {
  double length = 0, area = 0;
  Vec2 along = Vec2::Zero(), inside = Vec2::Zero();
  bool is_closed = false;

  Vec2 centroid() const { return is_closed ? Vec2(inside / area) : Vec2(along / length); }
};

void add(const EdgeNodes& x, double direction, Measures& m) {
  for (const LinePoint& point : gauss_legendre(6)) {
    const Vec2 at = edge_point(x, point.s), tangent = edge_tangent(x, point.s);
    const double w = point.weight * direction;
    m.length += point.weight * tangent.norm();
    m.along += point.weight * tangent.norm() * at;
    m.area += 0.5 * w * cross(at, tangent);
    m.inside += 0.5 * w * Vec2(at.x() * at.x() * tangent.y(), -at.y() * at.y() * tangent.x());
  }
}

/// +1 where the fluid lies to the left of an edge from its first vertex to its second, else −1.
double direction_of(const Mesh& mesh, const BoundaryEdge& b) {
  const auto& [start, end] = mesh.edges[b.edge];
  for (int k = 0; k < 3; ++k)
    if (mesh.cells[b.cell][k] == start && mesh.cells[b.cell][(k + 1) % 3] == end) return 1;
  return -1;
}

}  // namespace

BoundaryTractions::BoundaryTractions(const Mesh& mesh, const Boundary& boundary) : mesh_(mesh) {
  find_curves(boundary);
  number_points();
  integrate();
  factor();
}

void BoundaryTractions::find_curves(const Boundary& boundary) {
  const auto n_parts = static_cast<Index>(mesh_.boundary_names.size());
  std::vector<Index> curve_of(n_parts, -1);
  for (Index part = 0; part < n_parts; ++part) {
    if (boundary.is_open(part)) continue;
    curve_of[part] = static_cast<Index>(curves_.size());
    curves_.push_back({.name = mesh_.boundary_names[part], .centre = Vec2::Zero(), .nodes = {}, .lines = {}});
  }
  std::vector<Measures> measures(curves_.size());
  std::vector<std::map<Index, int>> lines_at(curves_.size());  // each vertex
  for (const BoundaryEdge& b : mesh_.boundary) {
    const Index curve = curve_of[b.boundary];
    if (curve < 0) continue;
    Line& line = lines_.emplace_back();
    line.curve = curve;
    line.nodes = mesh_.edge_nodes(b.edge);
    add(mesh_.places(line.nodes), direction_of(mesh_, b), measures[curve]);
    for (int end = 0; end < 2; ++end) ++lines_at[curve][line.nodes[end]];
  }
  for (std::size_t i = 0; i < curves_.size(); ++i) {
    measures[i].is_closed = std::all_of(lines_at[i].begin(), lines_at[i].end(),
                                        [](const auto& vertex) { return vertex.second == 2; });
    curves_[i].centre = measures[i].centroid();
  }
}

bool BoundaryTractions::is_corner(const std::vector<End>& ends) const {
  if (ends.size() == 1) return false;  // beside an open boundary, whose traction is known
  if (ends.size() > 2 || lines_[ends[0].line].curve != lines_[ends[1].line].curve) return true;
  const auto inwards = [&](const End& end) -> Vec2 {
    const Vec2 tangent = edge_tangent(mesh_.places(lines_[end.line].nodes), end.end);
    return (end.end == 0 ? 1 : -1) * tangent.normalized();
  };
  return -inwards(ends[0]).dot(inwards(ends[1])) < 0.5 * std::numbers::sqrt3;
}

/// Points of the curves, and an equation for each but those at corners.
void BoundaryTractions::number_points() {
  std::map<Index, std::vector<End>> ends_at;
  for (Index k = 0; k < static_cast<Index>(lines_.size()); ++k)
    for (int end = 0; end < 2; ++end) ends_at[mesh_.owner[lines_[k].nodes[end]]].push_back({k, end});
  const auto add_point = [this](const End& at, Index equation) {
    Line& line = lines_[at.line];
    BoundaryCurve& curve = curves_[line.curve];
    line.points[at.end] = static_cast<Index>(curve.nodes.size());
    line.equations[at.end] = equation;
    curve.nodes.push_back(line.nodes[at.end]);
  };
  const auto add_equation = [this](Index placed_node) {
    equation_node_.push_back(mesh_.owner[placed_node]);
    return static_cast<Index>(equation_node_.size()) - 1;
  };
  for (const auto& [vertex, ends] : ends_at) {
    if (is_corner(ends)) {
      for (const End& end : ends) add_point(end, -1);
      corners_.push_back(ends);
      continue;
    }
    const Index equation = add_equation(vertex);
    for (const End& end : ends) {
      Line& line = lines_[end.line];
      const Line& first = lines_[ends[0].line];
      if (&end == &ends[0] || line.nodes[end.end] != first.nodes[ends[0].end]) {
        add_point(end, equation);  // the second one is a period away
        continue;
      }
      line.points[end.end] = first.points[ends[0].end];
      line.equations[end.end] = equation;
    }
  }
  for (Index k = 0; k < static_cast<Index>(lines_.size()); ++k) {
    add_point({k, 2}, add_equation(lines_[k].nodes[2]));
    curves_[lines_[k].curve].lines.push_back(lines_[k].points);
  }
}

void BoundaryTractions::integrate() {
  for (Line& line : lines_) {
    const EdgeNodes x = mesh_.places(line.nodes);
    line.mass.setZero();
    line.moment.setZero();
    for (const LinePoint& point : gauss_legendre(6)) {
      const Eigen::Vector3d n(edge_shape(point.s).data());
      const double w = point.weight * edge_tangent(x, point.s).norm();
      line.mass += w * n * n.transpose();
      line.moment += w * (edge_point(x, point.s) - curves_[line.curve].centre) * n.transpose();
    }
    line.expansion.setIdentity();
    const bool corner[2] = {line.equations[0] < 0, line.equations[1] < 0};
    for (int end = 0; end < 2; ++end) {
      if (!corner[end]) continue;
      const Eigen::Vector3d extrapolated = 2 * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::Unit(1 - end);
      line.expansion.row(end) = (corner[1 - end] ? Eigen::Vector3d::UnitZ() : extrapolated).transpose();
    }
  }
}

void BoundaryTractions::factor() {
  std::vector<Eigen::Triplet<double>> entries;
  for (const Line& line : lines_) {
    const Eigen::Matrix3d block = line.mass * line.expansion;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (line.equations[i] >= 0 && line.equations[j] >= 0)
          entries.emplace_back(line.equations[i], line.equations[j], block(i, j));
  }
  const auto n = static_cast<Index>(equation_node_.size());
  if (n == 0) return;  // every boundary is open
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  mass_.compute(matrix);
  require(
      mass_.info() == Eigen::Success,
      "the boundaries must have edges of positive length; the mass matrix of their tractions is singular: "
      "check the mesh");
}

std::vector<BoundaryTraction> BoundaryTractions::recover(const Vector& reaction) const {
  std::vector<BoundaryTraction> out(curves_.size());
  if (lines_.empty()) return out;
  for (std::size_t i = 0; i < out.size(); ++i) out[i].values.resize(curves_[i].nodes.size());

  Eigen::MatrixX2d right(equation_node_.size(), 2);
  for (Eigen::Index e = 0; e < right.rows(); ++e) right.row(e) = reaction.segment<2>(2 * equation_node_[e]);
  const Eigen::MatrixX2d solved = mass_.solve(right);

  std::vector<Vectors3> weighted(lines_.size());  // ∫ t N_i of each line
  for (std::size_t k = 0; k < lines_.size(); ++k) {
    const Line& line = lines_[k];
    Vectors3 unknowns = Vectors3::Zero();
    for (int i = 0; i < 3; ++i)
      if (line.equations[i] >= 0) unknowns.col(i) = solved.row(line.equations[i]);
    const Vectors3 values = unknowns * line.expansion.transpose();
    weighted[k] = values * line.mass;
    BoundaryTraction& traction = out[line.curve];
    traction.force += weighted[k].rowwise().sum();
    for (int i = 0; i < 3; ++i) {
      traction.values[line.points[i]] = values.col(i);
      traction.torque += cross(line.moment.col(i), values.col(i));
    }
  }
  for (const std::vector<End>& ends : corners_) {
    const Index node = mesh_.owner[lines_[ends[0].line].nodes[ends[0].end]];
    Vec2 left = reaction.segment<2>(2 * node);
    for (const End& end : ends) left -= weighted[end.line].col(end.end);
    const Vec2 share = left / static_cast<double>(ends.size());
    for (const End& end : ends) {
      const Line& line = lines_[end.line];
      out[line.curve].force += share;
      const Vec2 arm = mesh_.vertices[line.nodes[end.end]] - curves_[line.curve].centre;
      out[line.curve].torque += cross(arm, share);
    }
  }
  return out;
}

}  // namespace fpi::fluid
