#include "dem/lubrication/lubrication_law.hpp"

#include <cmath>
#include <numbers>

namespace fpi::dem {

using std::numbers::pi, std::numbers::sqrt2;

namespace {

/// At which gap a film resists as much as a mesh lets it.
struct MeshView {
  double share, power;  ///< s, m
  double gap(double open, double resolved) const {
    return open + share * resolved * std::pow(1 - open / resolved, power);
  }
};
struct MeshViews {
  MeshView normal, sliding, rolling;
};
constexpr MeshViews beside_wall{{0.13, 5}, {0.02, 0.25}, {0.02, 0.25}},
    between_discs{{0.21, 3.5}, {0.02, 5}, {0.25, 2.5}};

}  // namespace

GapShape gap_shape(double radius_a, double radius_b) {
  return {1 / (1 / radius_a + 1 / radius_b), radius_a + radius_b};
}

Resistance disc_film(double viscosity, const GapShape& shape, double gap) {
  const double epsilon = gap / shape.radius, along = sqrt2 * pi * viscosity / std::sqrt(epsilon);
  const double next_order = 21.0 / 20 - 0.75 * shape.radius / shape.sum;
  return {3 * along * (1 / epsilon + next_order), along, along};
}

Resistance sphere_film(double viscosity, const GapShape& shape, double gap) {
  const double epsilon = gap / shape.radius, unit = pi * viscosity * shape.radius;
  const double log = -std::log(epsilon);
  return {6 * unit * (1 / epsilon + (0.2 + shape.radius / shape.sum) * log), 2 * unit * log,
          1.2 * unit * log};
}

Resistance unresolved(LubricationFilm law, double viscosity, const GapShape& shape, double gap,
                      double resolved) {
  if (gap >= (resolved > 0 ? resolved : shape.radius)) return {};
  const MeshViews& views = std::isinf(shape.sum) ? beside_wall : between_discs;
  const auto seen = [&](const MeshView& view) {
    return law(viscosity, shape, resolved > 0 ? view.gap(gap, resolved) : shape.radius);
  };
  const Resistance whole = law(viscosity, shape, gap);
  return {whole.normal - seen(views.normal).normal, whole.sliding - seen(views.sliding).sliding,
          whole.rolling - seen(views.rolling).rolling};
}

}  // namespace fpi::dem
