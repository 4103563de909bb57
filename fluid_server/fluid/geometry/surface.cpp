#include "fluid/geometry/surface.hpp"

#include <algorithm>

namespace fpi::fluid {

Vec2 Surface::beside(double parameter) const {
  const Polygon* p = polygon();
  return p ? p->at(parameter) + tolerance_ * p->normal(parameter) : at(parameter);
}

void Surface::add_crossings(const Vec2& a, const Vec2& b, std::vector<double>& parameters) const {
  visit([&](const auto& s) { fluid::add_crossings(s, a, b, parameters); });
}

void Surface::add_crossings(const Surface& other, std::vector<double>& parameters) const {
  if (const Disc* d = other.disc()) {
    visit([&](const auto& s) { fluid::add_crossings(s, *d, parameters); });
  } else {
    for (int k = 0; k < other.polygon()->size(); ++k) {
      const auto [from, to] = other.polygon()->side(k);
      add_crossings(from, to, parameters);
    }
  }
}

std::vector<Stretch> uncovered(const Vec2& a, const Vec2& b, std::span<const Surface> surfaces) {
  const Vec2 low = a.cwiseMin(b), high = a.cwiseMax(b);
  std::vector<const Surface*> near;
  std::vector<double> met, t{0, 1};
  for (const Surface& surface : surfaces) {
    if ((surface.lower().array() > high.array()).any() || (surface.upper().array() < low.array()).any())
      continue;
    near.push_back(&surface);
    met.clear();
    surface.add_crossings(a, b, met);
    for (const double parameter : met)
      t.push_back(std::clamp(nearest(a, b, surface.at(parameter)), 0.0, 1.0));
    // Corners on the segment, where a side may run along it.
    for (int corner = 0; corner < surface.n_corners(); ++corner) {
      const Vec2 x = surface.at(corner);
      if (distance_to_segment(a, b, x) < 2 * surface.tolerance())
        t.push_back(std::clamp(nearest(a, b, x), 0.0, 1.0));
    }
  }
  std::sort(t.begin(), t.end());
  std::vector<Stretch> out;
  for (std::size_t k = 0; k + 1 < t.size(); ++k) {
    const Vec2 middle = a + 0.5 * (t[k] + t[k + 1]) * (b - a);
    const bool free =
        std::none_of(near.begin(), near.end(), [&](const Surface* o) { return o->covers(middle); });
    if (free && t[k + 1] - t[k] > 1e-9) out.push_back({t[k], t[k + 1]});
  }
  return out;
}

}  // namespace fpi::fluid
