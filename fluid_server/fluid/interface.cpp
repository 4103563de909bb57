#include "fluid/interface.hpp"

#include "fluid/quadrature.hpp"

namespace fpi::fluid {

Vec2 Interface::velocity(Index arc, double angle) const {
  if (sampled.empty()) return rigid(disc().at(angle));
  const int n = static_cast<int>(sampled.size()) / n_arcs();
  const auto points = gauss_legendre(n);
  const double s = (angle - start[arc]) / (end[arc] - start[arc]);
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
  return radius == other.radius && rigid.centre == other.rigid.centre && start == other.start &&
         end == other.end;
}

}  // namespace fpi::fluid
