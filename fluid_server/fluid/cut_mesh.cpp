#include "fluid/cut_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace fpi::fluid {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

std::vector<Index> cells_near(const Locator& locator, const Disc& disc) {
  const Vec2 r = Vec2::Constant(disc.radius);
  return locator.near(disc.centre - r, disc.centre + r);
}

/// (cell, interface) for every cell that a circle cuts, sorted by cell; solid cells are marked on the way.
std::vector<std::pair<Index, Index>> classify(const Mesh& mesh, const Locator& locator,
                                              std::span<const Interface> interfaces,
                                              std::vector<CellState>& state) {
  std::vector<std::pair<Index, Index>> cuts;
  for (std::size_t i = 0; i < interfaces.size(); ++i) {
    const Disc disc = interfaces[i].disc();
    for (Index c : cells_near(locator, disc)) {
      const Position where = position(mesh.corners(c), disc);
      if (where == Position::inside) state[c] = CellState::solid;
      if (where == Position::cut) cuts.emplace_back(c, static_cast<Index>(i));
    }
  }
  std::erase_if(cuts, [&](const auto& pair) { return state[pair.first] == CellState::solid; });
  std::sort(cuts.begin(), cuts.end());
  for (const auto& [c, i] : cuts) state[c] = CellState::cut;
  return cuts;
}

std::vector<ElementPoint> element_points(const Corners& corners, std::span<const Disc> discs) {
  std::vector<PlanePoint> plane;
  cut_quadrature(corners, discs, plane);
  const Triangle triangle(corners);
  std::vector<ElementPoint> points;
  points.reserve(plane.size());
  for (const PlanePoint& p : plane) points.push_back({shape_at(triangle.barycentric(p.x)), p.weight});
  return points;
}

/// Angles in [0, 2π) at which the circle crosses the edges of a cell. Edges are taken in their own direction,
/// so that both neighbours find bitwise the same angle.
std::vector<double> crossing_angles(const Mesh& mesh, Index cell, const Disc& disc) {
  std::vector<double> angles;
  for (Index e : mesh.cell_edges[cell]) {
    const Vec2 a = mesh.vertices[mesh.edges[e][0]], b = mesh.vertices[mesh.edges[e][1]];
    const Crossings found = crossings(a, b, disc);
    for (int k = 0; k < found.count; ++k) {
      const double angle = disc.angle(a + found.t[k] * (b - a));
      angles.push_back(angle < 0 ? angle + two_pi : angle);
    }
  }
  return angles;
}

/// Angles at which another circle crosses this one.
void add_circle_crossings(const Disc& disc, const Disc& other, std::vector<double>& angles) {
  const Vec2 d = other.centre - disc.centre;
  const double distance = d.norm();
  if (distance == 0 || distance >= disc.radius + other.radius ||
      distance <= std::abs(disc.radius - other.radius))
    return;
  const double cosine = (distance * distance + disc.radius * disc.radius - other.radius * other.radius) /
                        (2 * distance * disc.radius);
  const double middle = std::atan2(d.y(), d.x()), half = std::acos(std::clamp(cosine, -1.0, 1.0));
  for (double angle : {middle - half, middle + half})
    angles.push_back(angle - two_pi * std::floor(angle / two_pi));
}

struct Interval {
  double start, end;
};

/// Stretches of the circle inside one cell and outside all other discs.
std::vector<Interval> stretches(const Mesh& mesh, Index cell, const Disc& disc,
                                std::span<const Disc> others) {
  std::vector<double> angles = crossing_angles(mesh, cell, disc);
  for (const Disc& other : others) add_circle_crossings(disc, other, angles);
  std::sort(angles.begin(), angles.end());
  if (angles.empty()) angles.push_back(0);
  angles.push_back(angles.front() + two_pi);

  const Triangle triangle(mesh.corners(cell));
  std::vector<Interval> out;
  for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
    if (angles[i + 1] - angles[i] < 1e-14) continue;
    const Vec2 middle = disc.at(0.5 * (angles[i] + angles[i + 1]));
    const auto l = triangle.barycentric(middle);
    const bool in_cell = std::min({l[0], l[1], l[2]}) > 0;
    const bool in_fluid =
        std::none_of(others.begin(), others.end(), [&](const Disc& d) { return d.contains(middle); });
    if (in_cell && in_fluid) out.push_back({angles[i], angles[i + 1]});
  }
  return out;
}

/// Cuts a stretch at the ends of the arcs and appends the pieces.
void add_pieces(const Interface& interface, Index i, Index first_multiplier, Index cell,
                const Interval& stretch, std::vector<ArcPiece>& pieces) {
  for (Index a = 0; a < interface.n_arcs(); ++a) {
    const double arc_start = interface.start[a], arc_end = interface.end[a];
    const double first_turn = std::floor((arc_start - stretch.end) / two_pi);
    for (double turn = first_turn; stretch.start + turn * two_pi < arc_end; ++turn) {
      const double start = std::max(stretch.start + turn * two_pi, arc_start);
      const double end = std::min(stretch.end + turn * two_pi, arc_end);
      if (end - start > 1e-14) pieces.push_back({cell, i, a, first_multiplier + a, start, end});
    }
  }
}

void collect_ghost_edges(const Mesh& mesh, CutMesh& out) {
  std::vector<Index> edges;
  for (const CutCell& cut : out.cut_cells)
    for (Index e : mesh.cell_edges[cut.cell]) {
      const auto [c1, c2] = mesh.edge_cells[e];
      if (c2 != -1 && out.is_active(c1) && out.is_active(c2)) edges.push_back(e);
    }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  out.ghost_edges = std::move(edges);
}

void collect_covered_nodes(const Mesh& mesh, const Locator& locator, std::span<const Interface> interfaces,
                           CutMesh& out) {
  for (std::size_t i = 0; i < interfaces.size(); ++i) {
    const Disc disc = interfaces[i].disc();
    for (Index c : cells_near(locator, disc))
      for (Index node : mesh.cell_nodes(c))
        if (disc.contains(mesh.node_position(node))) out.covered.push_back({node, static_cast<Index>(i)});
  }
  const auto by_node = [](const CoveredNode& a, const CoveredNode& b) { return a.node < b.node; };
  std::stable_sort(out.covered.begin(), out.covered.end(), by_node);
  const auto same = [](const CoveredNode& a, const CoveredNode& b) { return a.node == b.node; };
  out.covered.erase(std::unique(out.covered.begin(), out.covered.end(), same), out.covered.end());
}

}  // namespace

CutMesh cut_mesh(const Mesh& mesh, const Locator& locator, std::span<const Interface> interfaces) {
  CutMesh out;
  out.state.assign(mesh.n_cells(), CellState::fluid);
  out.first_multiplier.push_back(0);
  std::vector<Disc> discs;
  for (const Interface& interface : interfaces) {
    out.first_multiplier.push_back(out.first_multiplier.back() + interface.n_arcs());
    discs.push_back(interface.disc());
  }
  const auto cuts = classify(mesh, locator, interfaces, out.state);
  for (auto it = cuts.begin(); it != cuts.end();) {
    const Index cell = it->first;
    const auto end = std::find_if(it, cuts.end(), [&](const auto& pair) { return pair.first != cell; });
    std::vector<Disc> here;
    for (auto k = it; k != end; ++k) here.push_back(discs[k->second]);
    for (auto k = it; k != end; ++k) {
      const std::size_t own = k - it;
      std::vector<Disc> others = here;
      others.erase(others.begin() + own);
      for (const Interval& stretch : stretches(mesh, cell, here[own], others))
        add_pieces(interfaces[k->second], k->second, out.first_multiplier[k->second], cell, stretch,
                   out.pieces);
    }
    CutCell cut{cell, element_points(mesh.corners(cell), here), metric_of(Triangle(mesh.corners(cell)))};
    cut.metric.area = 1;
    const bool holds_an_arc = !out.pieces.empty() && out.pieces.back().cell == cell;
    if (cut.points.empty() && !holds_an_arc)
      out.state[cell] = CellState::solid;  // covered by several discs together
    else
      out.cut_cells.push_back(std::move(cut));
    it = end;
  }
  out.active_length.assign(out.n_multipliers(), 0);
  for (const ArcPiece& piece : out.pieces)
    out.active_length[piece.multiplier] += (piece.end - piece.start) * interfaces[piece.interface].radius;
  collect_ghost_edges(mesh, out);
  collect_covered_nodes(mesh, locator, interfaces, out);
  return out;
}

double wanted_arc_length(const Mesh& mesh, const Locator& locator, const Disc& disc, double ratio) {
  double sum = 0;
  int n = 0;
  for (Index c : cells_near(locator, disc)) {
    if (position(mesh.corners(c), disc) != Position::cut) continue;
    sum += mesh.size(c);
    ++n;
  }
  return n == 0 ? 0 : ratio * sum / n;
}

}  // namespace fpi::fluid
