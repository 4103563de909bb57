#include "fluid/base/quadrature.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.hpp"

namespace fpi::fluid {
namespace {

constexpr int most_points = 8;

/// Newton's iteration on the roots of the Legendre polynomial P_n.
std::vector<LinePoint> make_rule(int n) {
  std::vector<LinePoint> rule(n);
  for (int i = 0; i < n; ++i) {
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), derivative = 1;
    for (int iteration = 0; iteration < 50; ++iteration) {
      double p = 1, previous = 0;
      for (int k = 1; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * p - (k - 1) * previous) / k;
        previous = p;
        p = next;
      }
      derivative = n * (x * p - previous) / (x * x - 1);
      const double dx = p / derivative;
      x -= dx;
      if (std::abs(dx) < 1e-16) break;
    }
    rule[i] = {0.5 * (1 + x), 1 / ((1 - x * x) * derivative * derivative)};
  }
  return rule;
}

}  // namespace

std::span<const LinePoint> gauss_legendre(int n) {
  static const std::vector<std::vector<LinePoint>> rules = [] {
    std::vector<std::vector<LinePoint>> all(most_points + 1);
    for (int k = 1; k <= most_points; ++k) all[k] = make_rule(k);
    return all;
  }();
  require(n >= 1 && n <= most_points, "1 to {} Gauss points are offered; got {}", most_points, n);
  return rules[n];
}

}  // namespace fpi::fluid
