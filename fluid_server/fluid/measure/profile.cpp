#include "fluid/measure/profile.hpp"

#include <algorithm>

namespace fpi::fluid {
namespace {

/// Stretches shorter than this fraction of the segment are round-off.
constexpr double shortest = 1e-9;

/// Where a segment enters and leaves cells, as fractions of it, ascending, from 0 to 1.
std::vector<double> crossings(const Mesh& mesh, const Locator& locator, const Vec2& from, const Vec2& to) {
  std::vector<double> found{0, 1};
  const Vec2 low = from.cwiseMin(to), high = from.cwiseMax(to);
  for (const Vec2& shift : mesh.period.shifts(low, high))
    for (const Index c : locator.near(low + shift, high + shift)) {
      const Triangle triangle(mesh.corners(c));
      const auto start = triangle.barycentric(from + shift), end = triangle.barycentric(to + shift);
      double enters = 0, leaves = 1;
      for (int k = 0; k < 3; ++k) {  // inside where start + s (end − start) ≥ 0
        const double slope = end[k] - start[k];
        if (slope > 0) enters = std::max(enters, -start[k] / slope);
        if (slope < 0) leaves = std::min(leaves, -start[k] / slope);
      }
      if (enters < leaves) found.insert(found.end(), {enters, leaves});
    }
  std::sort(found.begin(), found.end());
  const auto same = [](double a, double b) { return b - a < shortest; };
  found.erase(std::unique(found.begin(), found.end(), same), found.end());
  return found;
}

/// Where in [0, 1] the parabola through values at 0, ½ and 1 has its vertex; ½ for a straight line.
double vertex(double a, double middle, double b) {
  const double curvature = 2 * (a - 2 * middle + b);
  return curvature == 0 ? 0.5 : std::clamp((3 * a - 4 * middle + b) / (2 * curvature), 0.0, 1.0);
}

}  // namespace

std::optional<Profile> measure_profile(const Mesh& mesh, const Locator& locator, const Vec2& from,
                                       const Vec2& to, const Sampler& value) {
  std::optional<Profile> out;
  const auto look_at = [&](double s) {
    const Vec2 place = from + s * (to - from);
    const auto v = value(place);
    if (v) {
      const ProfilePoint point{place, *v};
      if (!out) out = Profile{{}, point, point};
      if (*v < out->smallest.value) out->smallest = point;
      if (*v > out->largest.value) out->largest = point;
    }
    return v;
  };
  const auto keep = [&](double s, const std::optional<double>& v) {
    if (v) out->points.push_back({from + s * (to - from), *v});
  };
  const std::vector<double> s = crossings(mesh, locator, from, to);
  auto at_start = look_at(0);
  keep(0, at_start);
  for (std::size_t i = 1; i < s.size(); ++i) {
    const double length = s[i] - s[i - 1], half = s[i - 1] + 0.5 * length;
    const auto at_half = look_at(half), at_end = look_at(s[i]);
    if (at_start && at_half && at_end) look_at(s[i - 1] + vertex(*at_start, *at_half, *at_end) * length);
    keep(half, at_half);
    keep(s[i], at_end);
    at_start = at_end;
  }
  return out;
}

}  // namespace fpi::fluid
