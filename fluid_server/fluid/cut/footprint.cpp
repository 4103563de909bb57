#include "fluid/cut/footprint.hpp"

#include <algorithm>

#include "fluid/cut/cut.hpp"

namespace fpi::fluid {
namespace {

std::vector<Index> cells_near(const Locator& locator, const Outline& outline) {
  return locator.near(outline.lower(), outline.upper());
}

Footprint footprint(const Mesh& mesh, const Locator& locator, Outline outline) {
  Footprint out{std::move(outline), {}, {}, {}};
  for (const Index c : cells_near(locator, out.outline)) {
    const Position where = position(mesh.corners(c), out.outline);
    if (where == Position::inside) out.inside.push_back(c);
    if (where == Position::cut) out.cut.push_back(c);
    for (const Index node : mesh.cell_nodes(c))
      if (out.outline.contains(mesh.node_position(node))) out.covered.push_back(node);
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
    const Outline& outline = interfaces[i].outline;
    const auto old = std::ranges::equal_range(before, i, {}, &Image::interface);
    for (const Vec2& shift : mesh.period.shifts(outline.lower(), outline.upper())) {
      Outline moved = outline.moved(shift);
      const auto same = std::ranges::find(old, moved, &Image::outline);
      out.push_back({i, shift,
                     same != old.end() ? same->footprint
                                       : std::make_shared<Footprint>(footprint(mesh, locator, moved))});
    }
  }
  return out;
}

std::vector<Outline> outlines(std::span<const Image> images) {
  std::vector<Outline> out;
  for (const Image& image : images) out.push_back(image.outline());
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
