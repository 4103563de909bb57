#include "fluid/mesh/periodic_mesh.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace fpi::fluid {
namespace {

constexpr double round_off = 1e-8;  ///< of the mesh: mesh files are written to some ten digits

/// Joins the two sides across one axis.
class Joint {
 public:
  Joint(Mesh& mesh, int axis)
      : mesh_(mesh), axis_(axis), place_{mesh.period.lower[axis], mesh.period.upper[axis]} {
    Vec2 low = mesh.vertices.front(), high = low;
    for (const Vec2& x : mesh.vertices) {
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
    }
    close_ = round_off * (high - low).norm();
    require(
        std::abs(low[axis] - place_[0]) < close_ && std::abs(high[axis] - place_[1]) < close_,
        "a mesh that is periodic along {} must reach from {:g} to {:g} m; it reaches from {:g} to {:g} m: "
        "correct [periodic] or the mesh",
        name(), place_[0], place_[1], low[axis], high[axis]);
  }

  void join() {
    const std::array<std::vector<Index>, 2> sides{edges_on(0), edges_on(1)};
    const std::size_t n = std::min(sides[0].size(), sides[1].size());
    for (std::size_t i = 0; i < n; ++i) join_edges(sides[0][i], sides[1][i]);
    for (int side : {0, 1})
      if (sides[side].size() > n) refuse(mesh_.middles[sides[side][n]], 1 - side);
  }

 private:
  const char* name() const { return axis_ == 0 ? "x" : "y"; }
  bool is_on(int side, const Vec2& x) const { return std::abs(x[axis_] - place_[side]) < close_; }

  /// Outer edges in the plane of a side, ascending.
  std::vector<Index> edges_on(int side) const {
    std::vector<Index> edges;
    for (const BoundaryEdge& b : mesh_.boundary) {
      const auto& [from, to] = mesh_.edges[b.edge];
      if (is_on(side, mesh_.vertices[from]) && is_on(side, mesh_.vertices[to])) edges.push_back(b.edge);
    }
    std::ranges::sort(edges, {}, [this](Index e) { return mesh_.middles[e][1 - axis_]; });
    return edges;
  }

  /// Vertices of an edge, ascending.
  std::array<Index, 2> ends(Index edge) const {
    auto [from, to] = mesh_.edges[edge];
    if (mesh_.vertices[from][1 - axis_] > mesh_.vertices[to][1 - axis_]) std::swap(from, to);
    return {from, to};
  }

  void join_edges(Index lower, Index upper) {
    const auto from = ends(lower), to = ends(upper);
    for (int end : {0, 1}) join_nodes(from[end], to[end]);
    join_nodes(mesh_.n_vertices() + lower, mesh_.n_vertices() + upper);
    mesh_.edge_cells[lower][1] = mesh_.edge_cells[upper][0];
    mesh_.edge_cells[upper][1] = mesh_.edge_cells[lower][0];
  }

  /// Corners join along x, then along y, and so come to the one owner of all four.
  void join_nodes(Index lower, Index upper) {
    const Vec2 a = mesh_.node_position(lower), b = mesh_.node_position(upper);
    const double apart = b[1 - axis_] - a[1 - axis_];
    if (std::abs(apart) > close_) refuse(apart > 0 ? a : b, apart > 0 ? 1 : 0);
    mesh_.owner[upper] = mesh_.owner[lower];
  }

  [[noreturn]] void refuse(const Vec2& x, int missing_on) const {
    Vec2 missing = x;
    missing[axis_] = place_[missing_on];
    fail(
        "the sides of a mesh that is periodic along {} must match node by node; the node at ({:g}, {:g}) m "
        "has "
        "none at ({:g}, {:g}) m: mesh the two sides alike",
        name(), x.x(), x.y(), missing.x(), missing.y());
  }

  Mesh& mesh_;
  int axis_;
  std::array<double, 2> place_;  // of the two sides [m]
  double close_ = 0;
};

/// Takes joined edges off the boundary, and names that no edge has any more.
void remove_from_boundary(Mesh& mesh) {
  std::erase_if(mesh.boundary, [&](const BoundaryEdge& b) { return mesh.edge_cells[b.edge][1] != -1; });
  std::vector<std::string> names;
  std::vector<Index> number(mesh.boundary_names.size(), -1);
  for (Index part = 0; part < static_cast<Index>(number.size()); ++part) {
    if (std::ranges::find(mesh.boundary, part, &BoundaryEdge::boundary) == mesh.boundary.end()) continue;
    number[part] = static_cast<Index>(names.size());
    names.push_back(mesh.boundary_names[part]);
  }
  for (BoundaryEdge& b : mesh.boundary) b.boundary = number[b.boundary];
  mesh.boundary_names = std::move(names);
}

}  // namespace

void make_periodic(Mesh& mesh, const Period& period) {
  mesh.period = period;
  for (int axis : {0, 1})
    if (period.along[axis]) Joint(mesh, axis).join();
  remove_from_boundary(mesh);
}

void spread_to_copies(const Mesh& mesh, int components, Vector& values) {
  for (Eigen::Index node = 0; node < values.size() / components; ++node)
    values.segment(components * node, components) = values.segment(components * mesh.owner[node], components);
}

}  // namespace fpi::fluid
