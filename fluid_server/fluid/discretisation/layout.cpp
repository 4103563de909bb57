#include "fluid/discretisation/layout.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace fpi::fluid {
namespace {

constexpr Index absent = -1;

/// Place of each body of `after` in the list of `before`, or −1.
std::vector<Index> places_before(const Layout& before, const Layout& after) {
  std::unordered_map<Index, Index> place;
  for (std::size_t i = 0; i < before.interfaces.size(); ++i)
    place.emplace(before.interfaces[i].body, static_cast<Index>(i));
  std::vector<Index> out;
  for (const Interface& interface : after.interfaces) {
    const auto found = place.find(interface.body);
    out.push_back(found == place.end() ? absent : found->second);
  }
  return out;
}

/// Which bodies of either are not in the same place in both.
struct Moved {
  std::vector<std::uint8_t> before, after;

  Moved(const Layout& from, const Layout& to)
      : before(from.interfaces.size(), 1), after(to.interfaces.size(), 1) {
    const std::vector<Index> place = places_before(from, to);
    for (std::size_t i = 0; i < place.size(); ++i)
      if (place[i] != absent && to.interfaces[i].same_geometry(from.interfaces[place[i]]))
        after[i] = before[place[i]] = 0;
  }
};

/// Cells with their nodes, and further nodes, as a set that grows.
class Zone {
 public:
  explicit Zone(const Mesh& mesh) : mesh_(mesh), has_cell_(mesh.n_cells(), 0), has_node_(mesh.n_nodes(), 0) {}

  void add_cell(Index cell) {
    if (std::exchange(has_cell_[cell], 1) != 0) return;
    for (const Index node : mesh_.cell_nodes(cell)) add_node(node);
  }
  void add_node(Index node) { has_node_[node] = 1; }
  void add_cut_cells(const Layout& layout, const std::vector<std::uint8_t>& of_interface) {
    for (const Image& image : layout.cut.images)
      if (of_interface[image.interface])
        for (const Index cell : image.intersected_cells->cut) add_cell(cell);
  }
  /// By the cells that have a vertex in it.
  void grow() {
    std::vector<Index> around;
    for (Index cell = 0; cell < mesh_.n_cells(); ++cell)
      if (std::ranges::any_of(mesh_.cell_vertices(cell), [&](Index v) { return has_node(v); }))
        around.push_back(cell);
    for (const Index cell : around) add_cell(cell);
  }
  bool has_cell(Index cell) const { return has_cell_[cell] != 0; }
  bool has_node(Index node) const { return has_node_[node] != 0; }

 private:
  const Mesh& mesh_;
  std::vector<std::uint8_t> has_cell_, has_node_;
};

/// Where the ghost penalty's inertial part is another one: at bodies that rest in one of the two and move in
/// the other, though they are in the same place.
void add_nodes_of_other_penalty(const Layout& before, const Layout& after, Zone& zone) {
  if (before.inertia == 0 || after.inertia == 0) return;
  constexpr double much = 0.1;  // of the scheme's inertia
  auto old = before.cut.ghost_faces.begin();
  for (const auto& face : after.cut.ghost_faces) {
    while (old != before.cut.ghost_faces.end() && (*old)->edge < face->edge) ++old;
    if (old == before.cut.ghost_faces.end()) return;
    if ((*old)->edge != face->edge) continue;
    const double share = ghost_inertia(*face, after.mesh_velocity, after.inertia).rate / after.inertia,
                 old_share = ghost_inertia(*face, before.mesh_velocity, before.inertia).rate / before.inertia;
    if (std::abs(share - old_share) > much)
      for (const Index node : face->nodes) zone.add_node(node);
  }
}

/// Of the unknowns at nodes in the zone, of multipliers that reach into it and of the bodies that moved.
std::vector<Index> equations_in(const Zone& zone, const Layout& layout,
                                const std::vector<std::uint8_t>& moved) {
  const Numbering& numbering = layout.numbering;
  std::vector<std::uint8_t> is_in(numbering.n_equations, 0);
  const auto include = [&](Index equation) {
    if (equation != absent) is_in[equation] = 1;
  };
  for (Index i = 0; i < static_cast<Index>(numbering.velocity.size()); ++i)
    if (zone.has_node(i / 2)) include(numbering.velocity[i]);
  for (Index v = 0; v < static_cast<Index>(numbering.pressure.size()); ++v)
    if (zone.has_node(v)) include(numbering.pressure[v]);
  for (const ArcPiece& piece : layout.cut.pieces)
    if (zone.has_cell(piece.cell))
      for (const Index m : piece.multipliers)
        for (const Index i : {2 * m, 2 * m + 1}) include(numbering.multiplier[i]);
  for (std::size_t i = 0; i < moved.size(); ++i)
    if (moved[i])
      for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) include(numbering.rigid[k]);
  std::vector<Index> out;
  for (Index equation = 0; equation < numbering.n_equations; ++equation)
    if (is_in[equation]) out.push_back(equation);
  return out;
}

}  // namespace

std::vector<Index> shared_equations(const Layout& before, const Layout& after) {
  std::vector<Index> shared(after.numbering.n_equations, absent);
  const auto match = [&](const std::vector<Index>& old_ones, std::size_t from,
                         const std::vector<Index>& new_ones, std::size_t to, std::size_t n) {
    for (std::size_t k = 0; k < n; ++k)
      if (new_ones[to + k] != absent) shared[new_ones[to + k]] = old_ones[from + k];
  };
  const Numbering &old = before.numbering, &now = after.numbering;
  match(old.velocity, 0, now.velocity, 0, now.velocity.size());
  match(old.pressure, 0, now.pressure, 0, now.pressure.size());
  const std::vector<Index> place = places_before(before, after);
  for (std::size_t i = 0; i < place.size(); ++i) {
    if (place[i] == absent) continue;
    const std::size_t j = place[i];
    match(old.rigid, 3 * j, now.rigid, 3 * i, 3);
    const Index n = after.cut.multiplier_nodes[i].size();
    if (before.cut.multiplier_nodes[j].size() == n)
      match(old.multiplier, 2 * before.cut.first_multiplier[j], now.multiplier,
            2 * after.cut.first_multiplier[i], 2 * static_cast<std::size_t>(n));
  }
  return shared;
}

std::vector<Index> changed_zone(const Mesh& mesh, const Layout& before, const Layout& after, int layers) {
  const Moved moved(before, after);
  Zone zone(mesh);
  zone.add_cut_cells(before, moved.before);
  zone.add_cut_cells(after, moved.after);
  for (Index cell = 0; cell < mesh.n_cells(); ++cell)
    if (before.cut.state[cell] != after.cut.state[cell]) zone.add_cell(cell);
  add_nodes_of_other_penalty(before, after, zone);
  for (int layer = 0; layer < layers; ++layer) zone.grow();
  return equations_in(zone, after, moved.after);
}

}  // namespace fpi::fluid
