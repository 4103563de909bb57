#include "fluid/cut/cut_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "fluid/cut/cut.hpp"

namespace fpi::fluid {
namespace {

constexpr double shortest = 1e-14;  ///< stretch that counts, of a parameter near 1

/// A cell and an image that cuts it.
struct Meeting {
  Index cell, image;
  auto operator<=>(const Meeting&) const = default;
};

/// Every cell that a surface cuts or touches, with its images, sorted; solid cells are marked on the way.
std::vector<Meeting> classify(std::span<const Image> images, std::vector<CellState>& state) {
  std::vector<Meeting> meetings;
  for (Index i = 0; i < static_cast<Index>(images.size()); ++i) {
    for (const Index c : images[i].intersected_cells->inside) state[c] = CellState::solid;
    for (const Index c : images[i].intersected_cells->cut) meetings.push_back({c, i});
  }
  std::erase_if(meetings, [&](const Meeting& m) { return state[m.cell] == CellState::solid; });
  std::sort(meetings.begin(), meetings.end());
  for (const Meeting& m : meetings) state[m.cell] = CellState::cut;
  return meetings;
}

std::vector<ElementPoint> element_points(const Triangle& triangle, std::span<const Surface* const> surfaces) {
  std::vector<PlanePoint> plane;
  cut_quadrature(triangle.corner, surfaces, plane);
  std::vector<ElementPoint> points;
  points.reserve(plane.size());
  for (const PlanePoint& p : plane) points.push_back({shape_at(triangle.barycentric(p.x)), p.weight});
  return points;
}

/// Appends the stretches of one of the surfaces at a cell. The cell's edges are taken in their own direction,
/// so that both neighbours split at the same places to the bit.
void add_stretches(const Mesh& mesh, Index cell, std::span<const Surface* const> surfaces, Index own,
                   std::vector<CutCell::Stretch>& out) {
  const Surface& surface = *surfaces[own];
  std::vector<const Surface*> others(surfaces.begin(), surfaces.end());
  others.erase(others.begin() + own);
  std::vector<double> splits;
  for (Index e : mesh.cell_edges[cell])
    surface.add_crossings(mesh.vertices[mesh.edges[e][0]], mesh.vertices[mesh.edges[e][1]], splits);
  for (const Surface* other : others) surface.add_crossings(*other, splits);
  for (int corner = 0; corner < surface.n_corners(); ++corner) splits.push_back(corner);
  std::sort(splits.begin(), splits.end());
  if (splits.empty()) splits.push_back(0);
  splits.push_back(splits.front() + surface.period());

  const Triangle triangle(mesh.corners(cell));
  for (std::size_t i = 0; i + 1 < splits.size(); ++i) {
    if (splits[i + 1] - splits[i] < shortest) continue;
    const Vec2 place = surface.beside(0.5 * (splits[i] + splits[i + 1]));
    const auto l = triangle.barycentric(place);
    const bool in_cell = std::min({l[0], l[1], l[2]}) > 0;
    const bool in_fluid = std::none_of(others.begin(), others.end(),
                                       [&](const Surface* other) { return other->contains(place); });
    if (in_cell && in_fluid) out.push_back({own, splits[i], splits[i + 1]});
  }
}

/// Cuts a stretch at the ends of the arcs and appends the pieces.
void add_pieces(const Interface& interface, const Image& image, Index cell, const CutCell::Stretch& stretch,
                CutMesh& out) {
  const double period = interface.surface.period();
  for (Index a = 0; a < interface.n_arcs(); ++a) {
    const auto [left, right] = out.multiplier_nodes[image.interface].values(a);
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

std::shared_ptr<const CutCell> cut_cell(
    const Mesh& mesh, Index cell, std::vector<std::shared_ptr<const IntersectedCells>> intersected_cells_of) {
  std::vector<const Surface*> surfaces;
  for (const auto& intersected_cells : intersected_cells_of) surfaces.push_back(&intersected_cells->surface);
  const Triangle triangle(mesh.corners(cell));
  auto cut = std::make_shared<CutCell>(CutCell{
      cell, std::move(intersected_cells_of), {}, element_points(triangle, surfaces), metric_of(triangle), 0});
  cut->metric.area = 1;
  for (const ElementPoint& point : cut->points) cut->share += point.weight / triangle.area;
  for (Index own = 0; own < static_cast<Index>(surfaces.size()); ++own)
    add_stretches(mesh, cell, surfaces, own, cut->stretches);
  return cut;
}

/// Enters a cell that some images cut, with the pieces of their arcs. A touch that takes nothing of it and
/// leaves no arc with it makes it fluid; one whose rest is nothing is solid.
void add_cell(std::shared_ptr<const CutCell> cut, std::span<const Meeting> meetings,
              std::span<const Interface> interfaces, CutMesh& out) {
  constexpr double negligible = 1e-11;  // of the element's area
  const std::size_t before = out.pieces.size();
  for (const CutCell::Stretch& stretch : cut->stretches) {
    const Image& image = out.images[meetings[stretch.own].image];
    add_pieces(interfaces[image.interface], image, cut->cell, stretch, out);
  }
  const bool holds_an_arc = out.pieces.size() > before;
  if (!holds_an_arc && cut->share < negligible)
    out.state[cut->cell] = CellState::solid;
  else if (!holds_an_arc && cut->share > 1 - negligible)
    out.state[cut->cell] = CellState::fluid;
  else
    out.cut_cells.push_back(std::move(cut));
}

/// The item of that number in a list sorted by it, or null.
template <class Item>
std::shared_ptr<const Item> find(const std::vector<std::shared_ptr<const Item>>& items, Index Item::*number,
                                 Index wanted) {
  const auto number_of = [&](const auto& item) { return (*item).*number; };
  const auto found = std::ranges::lower_bound(items, wanted, {}, number_of);
  return found != items.end() && number_of(*found) == wanted ? *found : nullptr;
}

void cut_cells(const Mesh& mesh, std::span<const Interface> interfaces, const CutMesh& before, CutMesh& out) {
  const std::vector<Meeting> meetings = classify(out.images, out.state);
  for (auto it = meetings.begin(); it != meetings.end();) {
    const Index cell = it->cell;
    const auto end = std::find_if(it, meetings.end(), [&](const Meeting& m) { return m.cell != cell; });
    std::vector<std::shared_ptr<const IntersectedCells>> intersected_cells_of;
    for (const Meeting& m : std::span(it, end))
      intersected_cells_of.push_back(out.images[m.image].intersected_cells);
    auto cut = find(before.cut_cells, &CutCell::cell, cell);
    if (!cut || cut->intersected_cells_of != intersected_cells_of)
      cut = cut_cell(mesh, cell, std::move(intersected_cells_of));
    add_cell(std::move(cut), {it, end}, interfaces, out);
    it = end;
  }
}

void collect_ghost_faces(const Mesh& mesh, const CutMesh& before, CutMesh& out) {
  std::vector<Index> edges;
  for (const auto& cut : out.cut_cells)
    for (Index e : mesh.cell_edges[cut->cell]) {
      const auto [c1, c2] = mesh.edge_cells[e];
      if (c2 != -1 && out.is_active(c1) && out.is_active(c2)) edges.push_back(mesh.owner_of_edge(e));
    }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (const Index e : edges) {
    auto face = find(before.ghost_faces, &GhostFace::edge, e);
    out.ghost_faces.push_back(face ? std::move(face) : std::make_shared<GhostFace>(ghost_face(mesh, e)));
  }
}

void collect_covered_nodes(CutMesh& out) {
  for (const Image& image : out.images)
    for (const Index node : image.intersected_cells->covered)
      out.covered.push_back({node, image.interface, image.shift});
  const auto by_node = [](const CoveredNode& a, const CoveredNode& b) { return a.node < b.node; };
  std::stable_sort(out.covered.begin(), out.covered.end(), by_node);
  const auto same = [](const CoveredNode& a, const CoveredNode& b) { return a.node == b.node; };
  out.covered.erase(std::unique(out.covered.begin(), out.covered.end(), same), out.covered.end());
}

}  // namespace

void measure_multipliers(std::span<const Interface> interfaces, CutMesh& cut) {
  cut.active_length.assign(cut.n_multipliers(), 0);
  for (const ArcPiece& piece : cut.pieces) {
    const Interface& interface = interfaces[piece.interface];
    const auto hats = cut.multiplier_nodes[piece.interface].hats(piece.arc, 0.5 * (piece.start + piece.end));
    for (int k = 0; k < 2; ++k)
      cut.active_length[piece.multipliers[k]] += hats[k] * interface.surface.length(piece.start, piece.end);
  }
}

CutMesh cut_mesh(const Mesh& mesh, const Locator& locator, std::span<const Interface> interfaces,
                 const CutMesh& before) {
  CutMesh out;
  out.images = images(mesh, locator, interfaces, before.images);
  out.state.assign(mesh.n_cells(), CellState::fluid);
  out.first_multiplier.push_back(0);
  for (const Interface& interface : interfaces) {
    out.multiplier_nodes.emplace_back(interface, [&](const Vec2& x) {
      const auto place = locator.find(x);
      return place ? mesh.size(place->cell) : 0;
    });
    out.first_multiplier.push_back(out.first_multiplier.back() + out.multiplier_nodes.back().size());
  }
  cut_cells(mesh, interfaces, before, out);
  measure_multipliers(interfaces, out);
  collect_ghost_faces(mesh, before, out);
  collect_covered_nodes(out);
  return out;
}

}  // namespace fpi::fluid
