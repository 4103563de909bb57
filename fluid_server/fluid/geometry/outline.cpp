#include "fluid/geometry/outline.hpp"

#include <algorithm>

namespace fpi::fluid {

Vec2 Outline::beside(double parameter) const {
  const Polygon* p = polygon();
  return p ? p->at(parameter) + hair_ * p->normal(parameter) : at(parameter);
}

void Outline::add_crossings(const Vec2& a, const Vec2& b, std::vector<double>& parameters) const {
  visit([&](const auto& s) { fluid::add_crossings(s, a, b, parameters); });
}

void Outline::add_crossings(const Outline& other, std::vector<double>& parameters) const {
  if (const Disc* d = other.disc()) {
    visit([&](const auto& s) { fluid::add_crossings(s, *d, parameters); });
  } else {
    for (int k = 0; k < other.polygon()->size(); ++k) {
      const auto [from, to] = other.polygon()->side(k);
      add_crossings(from, to, parameters);
    }
  }
}

std::vector<Stretch> uncovered(const Vec2& a, const Vec2& b, std::span<const Outline> outlines) {
  const Vec2 low = a.cwiseMin(b), high = a.cwiseMax(b);
  std::vector<const Outline*> near;
  std::vector<double> met, t{0, 1};
  for (const Outline& outline : outlines) {
    if ((outline.lower().array() > high.array()).any() || (outline.upper().array() < low.array()).any())
      continue;
    near.push_back(&outline);
    met.clear();
    outline.add_crossings(a, b, met);
    for (const double parameter : met)
      t.push_back(std::clamp(nearest(a, b, outline.at(parameter)), 0.0, 1.0));
    // Corners on the segment, where a side may run along it.
    for (int corner = 0; corner < outline.n_corners(); ++corner) {
      const Vec2 x = outline.at(corner);
      if (distance_to_segment(a, b, x) < 2 * outline.hair())
        t.push_back(std::clamp(nearest(a, b, x), 0.0, 1.0));
    }
  }
  std::sort(t.begin(), t.end());
  std::vector<Stretch> out;
  for (std::size_t k = 0; k + 1 < t.size(); ++k) {
    const Vec2 middle = a + 0.5 * (t[k] + t[k + 1]) * (b - a);
    const bool free =
        std::none_of(near.begin(), near.end(), [&](const Outline* o) { return o->covers(middle); });
    if (free && t[k + 1] - t[k] > 1e-9) out.push_back({t[k], t[k + 1]});
  }
  return out;
}

}  // namespace fpi::fluid
