#include "fluid/geometry/interface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/polygon.hpp"
#include "fluid/base/quadrature.hpp"

namespace fpi::fluid {
namespace {

constexpr double round_off = 1e-9;
constexpr double farthest = 1e9;  ///< [m], [m/s], [rad/s]: beyond it squares lose what matters
constexpr int most_samples = 8;

void check_arcs(const Interface& f) {
  const Index n = f.n_arcs();
  require(n > 0 && f.end.size() == f.start.size(), "body {}: at least one arc is required; got {}", f.body,
          n);
  for (Index a = 0; a < n; ++a)
    require(f.end[a] > f.start[a] && std::abs(f.start[a]) < 16 * f.surface.period() &&
                (a == 0 || std::abs(f.start[a] - f.end[a - 1]) < round_off),
            "body {}: each arc must start where the one before ends, less than 16 turns from 0; arc {} runs "
            "from {} to {}",
            f.body, a, f.start[a], f.end[a]);
  const double turn = f.end.back() - f.start.front();
  require(std::abs(turn - f.surface.period()) < round_off * n,
          "body {}: the arcs must go once around the surface, from 0 to {}; they cover {}", f.body,
          f.surface.period(), turn);
}

void check_balance(const Interface& f) {
  if (!f.balance) return;
  const auto& [mass_rate, inertia_rate, load, torque] = *f.balance;
  require(
      mass_rate >= 0 && inertia_rate >= 0 && load.allFinite() && std::isfinite(torque) &&
          std::isfinite(mass_rate + inertia_rate),
      "body {}: a mass and an inertia ≥ 0 and a finite load are required; got m/Δt {} kg/(m s), J/Δt {} kg "
      "m/s, load ({}, {}) N/m, torque {} N",
      f.body, mass_rate, inertia_rate, load.x(), load.y(), torque);
}

void check_size(const Interface& f) {
  const Vec2 low = f.surface.lower(), high = f.surface.upper();
  const double largest = std::max({low.lpNorm<Eigen::Infinity>(), high.lpNorm<Eigen::Infinity>(),
                                   f.rigid.centre.lpNorm<Eigen::Infinity>(), std::abs(f.rigid.spin),
                                   f.rigid.translation.lpNorm<Eigen::Infinity>()});
  require(f.surface.area() > 0 && (high - low).minCoeff() > 0 && largest < farthest,
          "body {}: a surface that encloses an area counter-clockwise is required, and places and velocities "
          "below {:g} in SI units; got an area of {:g} m² and {:g}: did the coupling diverge?",
          f.body, farthest, f.surface.area(), largest);
  const std::size_t n = f.sampled.size() / f.start.size();
  require(n * f.start.size() == f.sampled.size() && n <= most_samples,
          "body {}: at most {} velocities an arc, the same number on each, are taken; got {} on {} arcs",
          f.body, most_samples, f.sampled.size(), f.start.size());
}

}  // namespace

void set_edges(Interface& f, const std::vector<Vec2>& vertices) {
  auto [polygon, parameters] = merge_collinear(vertices);
  require(polygon.size() >= 3,
          "body {}: a surface with three corners or more is required; got {} from {} vertices", f.body,
          polygon.size(), vertices.size());
  std::vector<double> corners;
  double shortest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < polygon.size(); ++k) {
    const auto [from, to] = polygon.side(k);
    corners.insert(corners.end(), {from.x(), from.y()});
    shortest = std::min(shortest, (to - from).norm());
  }
  const std::string problem = polygon_problem(corners);
  require(problem.empty(), "body {}: its surface {}", f.body, problem);
  require(shortest > 10 * polygon.tolerance(),
          "body {}: its surface must have sides longer than round-off; one is {:g} m", f.body, shortest);
  f.start = std::move(parameters);
  f.end.assign(f.start.begin() + 1, f.start.end());
  f.end.push_back(f.start.front() + polygon.period());
  f.surface = std::move(polygon);
}

void check(std::span<const Interface> interfaces) {
  for (std::size_t i = 0; i < interfaces.size(); ++i) {
    const Interface& f = interfaces[i];
    check_arcs(f);
    check_size(f);
    check_balance(f);
    for (const Interface& other : interfaces.first(i)) {
      require(other.body != f.body, "each body must come once; body {} comes twice", f.body);
      const Vec2 low = f.surface.lower(), high = f.surface.upper();
      const double apart = (other.surface.lower() - low).norm() + (other.surface.upper() - high).norm();
      require(apart > 1e-6 * (high - low).norm(),
              "bodies {} and {} lie on top of each other at ({:g}, {:g}) m: move one", other.body, f.body,
              f.rigid.centre.x(), f.rigid.centre.y());
    }
  }
}

Vec2 Interface::velocity(Index arc, double parameter) const {
  if (sampled.empty()) return rigid(surface.at(parameter));
  const int n = static_cast<int>(sampled.size()) / n_arcs();
  const auto points = gauss_legendre(n);
  const double s = (parameter - start[arc]) / (end[arc] - start[arc]);
  Vec2 value = Vec2::Zero();
  for (int i = 0; i < n; ++i) {  // Lagrange's form
    double basis = 1;
    for (int j = 0; j < n; ++j)
      if (j != i) basis *= (s - points[j].s) / (points[i].s - points[j].s);
    value += basis * sampled[arc * n + i];
  }
  return value;
}

bool Interface::same_geometry(const Interface& other) const {
  return surface == other.surface && rigid.centre == other.rigid.centre && start == other.start &&
         end == other.end && balance.has_value() == other.balance.has_value();
}

}  // namespace fpi::fluid
