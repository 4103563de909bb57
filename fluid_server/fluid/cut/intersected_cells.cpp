#include "fluid/cut/intersected_cells.hpp"

#include <algorithm>

#include "fluid/cut/cut.hpp"

namespace fpi::fluid {
namespace {

std::vector<Index> cells_near(const Locator& locator, const Surface& surface) {
  return locator.near(surface.lower(), surface.upper());
}

IntersectedCells intersected_cells(const Mesh& mesh, const Locator& locator, Surface surface) {
  IntersectedCells out{std::move(surface), {}, {}, {}};
  for (const Index c : cells_near(locator, out.surface)) {
    const Position where = position(mesh.corners(c), out.surface);
    if (where == Position::inside) out.inside.push_back(c);
    if (where == Position::cut) out.cut.push_back(c);
    for (const Index node : mesh.cell_nodes(c))
      if (out.surface.contains(mesh.node_position(node))) out.covered.push_back(node);
  }
  std::sort(out.covered.begin(), out.covered.end());
  out.covered.erase(std::unique(out.covered.begin(), out.covered.end()), out.covered.end());
  return out;
}

}  // namespace

std::vector<Image> images(const Mesh& mesh, const Locator& locator, std::span<const Interface> interfaces,
                          std::span<const Image> before) {
  std::vector<Image> out;
  for (Index i = 0; i < static_cast<Index>(interfaces.size()); ++i) {
    const Surface& surface = interfaces[i].surface;
    const auto old = std::ranges::equal_range(before, i, {}, &Image::interface);
    for (const Vec2& shift : mesh.period.shifts(surface.lower(), surface.upper())) {
      Surface moved = surface.moved(shift);
      const auto same = std::ranges::find(old, moved, &Image::surface);
      out.push_back({i, shift,
                     same != old.end()
                         ? same->intersected_cells
                         : std::make_shared<IntersectedCells>(intersected_cells(mesh, locator, moved))});
    }
  }
  return out;
}

std::vector<Surface> surfaces(std::span<const Image> images) {
  std::vector<Surface> out;
  for (const Image& image : images) out.push_back(image.surface());
  return out;
}

double wanted_arc_length(const Mesh& mesh, const Locator& locator, const Surface& surface, double ratio) {
  double sum = 0;
  int n = 0;
  for (const Vec2& shift : mesh.period.shifts(surface.lower(), surface.upper())) {
    const Surface image = surface.moved(shift);
    for (Index c : cells_near(locator, image)) {
      if (position(mesh.corners(c), image) != Position::cut) continue;
      sum += mesh.size(c);
      ++n;
    }
  }
  return n == 0 ? 0 : ratio * sum / n;
}

}  // namespace fpi::fluid
