#include "fluid/cut_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "fluid/cut.hpp"

namespace fpi::fluid {
namespace {

constexpr double shortest = 1e-14;  ///< stretch that counts, of a parameter near 1

std::vector<Index> cells_near(const Locator& locator, const Outline& outline) {
  return locator.near(outline.lower(), outline.upper());
}

/// (cell, image) for every cell that an outline cuts or touches, sorted by cell; solid cells are marked on
/// the way.
std::vector<std::pair<Index, Index>> classify(const Mesh& mesh, const Locator& locator,
                                              std::span<const Image> images, std::vector<CellState>& state) {
  std::vector<std::pair<Index, Index>> cuts;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const Outline& outline = images[i].outline;
    for (Index c : cells_near(locator, outline)) {
      const Position where = position(mesh.corners(c), outline);
      if (where == Position::inside) state[c] = CellState::solid;
      if (where == Position::cut) cuts.emplace_back(c, static_cast<Index>(i));
    }
  }
  std::erase_if(cuts, [&](const auto& pair) { return state[pair.first] == CellState::solid; });
  std::sort(cuts.begin(), cuts.end());
  for (const auto& [c, i] : cuts) state[c] = CellState::cut;
  return cuts;
}

std::vector<ElementPoint> element_points(const Corners& corners, std::span<const Outline* const> outlines) {
  std::vector<PlanePoint> plane;
  cut_quadrature(corners, outlines, plane);
  const Triangle triangle(corners);
  std::vector<ElementPoint> points;
  points.reserve(plane.size());
  for (const PlanePoint& p : plane) points.push_back({shape_at(triangle.barycentric(p.x)), p.weight});
  return points;
}

struct Interval {
  double start, end;
};

/// Stretches of an outline inside one cell and outside all other bodies. The cell's edges are taken in their
/// own direction, so that both neighbours split at the same places to the bit.
std::vector<Interval> stretches(const Mesh& mesh, Index cell, const Outline& outline,
                                std::span<const Outline* const> others) {
  std::vector<double> splits;
  for (Index e : mesh.cell_edges[cell])
    outline.add_crossings(mesh.vertices[mesh.edges[e][0]], mesh.vertices[mesh.edges[e][1]], splits);
  for (const Outline* other : others) outline.add_crossings(*other, splits);
  for (int corner = 0; corner < outline.n_corners(); ++corner) splits.push_back(corner);
  std::sort(splits.begin(), splits.end());
  if (splits.empty()) splits.push_back(0);
  splits.push_back(splits.front() + outline.period());

  const Triangle triangle(mesh.corners(cell));
  std::vector<Interval> out;
  for (std::size_t i = 0; i + 1 < splits.size(); ++i) {
    if (splits[i + 1] - splits[i] < shortest) continue;
    const Vec2 place = outline.beside(0.5 * (splits[i] + splits[i + 1]));
    const auto l = triangle.barycentric(place);
    const bool in_cell = std::min({l[0], l[1], l[2]}) > 0;
    const bool in_fluid = std::none_of(others.begin(), others.end(),
                                       [&](const Outline* other) { return other->contains(place); });
    if (in_cell && in_fluid) out.push_back({splits[i], splits[i + 1]});
  }
  return out;
}

/// Cuts a stretch at the ends of the arcs and appends the pieces.
void add_pieces(const Interface& interface, const Image& image, Index cell, const Interval& stretch,
                CutMesh& out) {
  const double period = interface.outline.period();
  for (Index a = 0; a < interface.n_arcs(); ++a) {
    const auto [left, right] = out.knots[image.interface].values(a);
    const Index first = out.first_multiplier[image.interface];
    const double arc_start = interface.start[a], arc_end = interface.end[a];
    const double first_turn = std::floor((arc_start - stretch.end) / period);
    for (double turn = first_turn; stretch.start + turn * period < arc_end; ++turn) {
      const double start = std::max(stretch.start + turn * period, arc_start);
      const double end = std::min(stretch.end + turn * period, arc_end);
      if (end - start > shortest)
        out.pieces.push_back(
            {cell, image.interface, a, {first + left, first + right}, start, end, image.shift});
    }
  }
}

/// Cuts one element by the images that meet it, each with its number. A touch that takes nothing of it and
/// leaves no arc with it makes it fluid; one whose rest is nothing is solid.
void cut_cell(const Mesh& mesh, Index cell, std::span<const std::pair<Index, Index>> cuts,
              std::span<const Interface> interfaces, CutMesh& out) {
  constexpr double negligible = 1e-11;  // of the element's area
  std::vector<const Outline*> here;
  for (const auto& [c, i] : cuts) here.push_back(&out.images[i].outline);
  const std::size_t before = out.pieces.size();
  for (std::size_t own = 0; own < here.size(); ++own) {
    std::vector<const Outline*> others = here;
    others.erase(others.begin() + own);
    const Image& image = out.images[cuts[own].second];
    for (const Interval& stretch : stretches(mesh, cell, *here[own], others))
      add_pieces(interfaces[image.interface], image, cell, stretch, out);
  }
  CutCell cut{cell, element_points(mesh.corners(cell), here), metric_of(Triangle(mesh.corners(cell)))};
  cut.metric.area = 1;
  const bool holds_an_arc = out.pieces.size() > before;
  double left = 0;
  for (const ElementPoint& point : cut.points) left += point.weight / mesh.area(cell);
  if (!holds_an_arc && left < negligible)
    out.state[cell] = CellState::solid;
  else if (!holds_an_arc && left > 1 - negligible)
    out.state[cell] = CellState::fluid;
  else
    out.cut_cells.push_back(std::move(cut));
}

void collect_ghost_edges(const Mesh& mesh, CutMesh& out) {
  std::vector<Index> edges;
  for (const CutCell& cut : out.cut_cells)
    for (Index e : mesh.cell_edges[cut.cell]) {
      const auto [c1, c2] = mesh.edge_cells[e];
      if (c2 != -1 && out.is_active(c1) && out.is_active(c2)) edges.push_back(mesh.owner_of_edge(e));
    }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  out.ghost_edges = std::move(edges);
}

void collect_covered_nodes(const Mesh& mesh, const Locator& locator, CutMesh& out) {
  for (const auto& [interface, shift, outline] : out.images)
    for (Index c : cells_near(locator, outline))
      for (Index node : mesh.cell_nodes(c))
        if (outline.contains(mesh.node_position(node))) out.covered.push_back({node, interface, shift});
  const auto by_node = [](const CoveredNode& a, const CoveredNode& b) { return a.node < b.node; };
  std::stable_sort(out.covered.begin(), out.covered.end(), by_node);
  const auto same = [](const CoveredNode& a, const CoveredNode& b) { return a.node == b.node; };
  out.covered.erase(std::unique(out.covered.begin(), out.covered.end(), same), out.covered.end());
}

}  // namespace

std::vector<Image> images(const Period& period, std::span<const Interface> interfaces) {
  std::vector<Image> out;
  for (std::size_t i = 0; i < interfaces.size(); ++i) {
    const Outline& outline = interfaces[i].outline;
    for (const Vec2& shift : period.shifts(outline.lower(), outline.upper()))
      out.push_back({static_cast<Index>(i), shift, outline.moved(shift)});
  }
  return out;
}

std::vector<Outline> outlines(std::span<const Image> images) {
  std::vector<Outline> out;
  for (const Image& image : images) out.push_back(image.outline);
  return out;
}

void measure_multipliers(std::span<const Interface> interfaces, CutMesh& cut) {
  cut.active_length.assign(cut.n_multipliers(), 0);
  for (const ArcPiece& piece : cut.pieces) {
    const Interface& interface = interfaces[piece.interface];
    const auto hats = cut.knots[piece.interface].hats(piece.arc, 0.5 * (piece.start + piece.end));
    for (int k = 0; k < 2; ++k)
      cut.active_length[piece.multipliers[k]] += hats[k] * interface.outline.length(piece.start, piece.end);
  }
}

CutMesh cut_mesh(const Mesh& mesh, const Locator& locator, std::span<const Interface> interfaces) {
  CutMesh out;
  out.images = images(mesh.period, interfaces);
  out.state.assign(mesh.n_cells(), CellState::fluid);
  out.first_multiplier.push_back(0);
  for (const Interface& interface : interfaces) {
    out.knots.emplace_back(interface, [&](const Vec2& x) {
      const auto place = locator.find(x);
      return place ? mesh.size(place->cell) : 0;
    });
    out.first_multiplier.push_back(out.first_multiplier.back() + out.knots.back().size());
  }
  const auto cuts = classify(mesh, locator, out.images, out.state);
  for (auto it = cuts.begin(); it != cuts.end();) {
    const Index cell = it->first;
    const auto end = std::find_if(it, cuts.end(), [&](const auto& pair) { return pair.first != cell; });
    cut_cell(mesh, cell, {it, end}, interfaces, out);
    it = end;
  }
  measure_multipliers(interfaces, out);
  collect_ghost_edges(mesh, out);
  collect_covered_nodes(mesh, locator, out);
  return out;
}

double wanted_arc_length(const Mesh& mesh, const Locator& locator, const Outline& outline, double ratio) {
  double sum = 0;
  int n = 0;
  for (const Vec2& shift : mesh.period.shifts(outline.lower(), outline.upper())) {
    const Outline image = outline.moved(shift);
    for (Index c : cells_near(locator, image)) {
      if (position(mesh.corners(c), image) != Position::cut) continue;
      sum += mesh.size(c);
      ++n;
    }
  }
  return n == 0 ? 0 : ratio * sum / n;
}

}  // namespace fpi::fluid
