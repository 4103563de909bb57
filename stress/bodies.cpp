#include "bodies.hpp"

#include "fluid_case.hpp"

namespace fpi::fluid::testing {

Shape random_shape(Random& random, double diameter) {
  constexpr double pi = std::numbers::pi;
  const auto regular = [](int n) {
    std::vector<Vec2> corners;
    for (int k = 0; k < n; ++k)
      corners.emplace_back(0.5 * std::cos(2 * pi * k / n), 0.5 * std::sin(2 * pi * k / n));
    return corners;
  };
  const std::vector<std::vector<Vec2>> polygons{
      regular(3),
      regular(4),
      regular(6),
      {{-0.48, -0.1}, {0.48, -0.1}, {0.48, 0.1}, {-0.48, 0.1}},                                   // a blade
      {{-0.3, -0.3}, {0.35, -0.3}, {0.35, -0.05}, {-0.05, -0.05}, {-0.05, 0.35}, {-0.3, 0.35}}};  // an L
  Shape shape{diameter, {}};
  if (random.below(2) == 0) return shape;
  shape.corners = polygons[random.below(polygons.size())];
  for (Vec2& corner : shape.corners) corner *= diameter;
  return shape;
}

/// 3s² − 2s³ of s = t/rise.
double SmoothStart::speed(double t) const {
  const double s = std::min(1.0, t / rise);
  return s * s * (3 - 2 * s);
}

double SmoothStart::way(double t) const {
  const double s = std::min(1.0, t / rise);
  return rise * (s * s * s * (1 - 0.5 * s)) + std::max(0.0, t - rise);
}

Bodies moving_together(std::vector<MovingBody> bodies, SmoothStart start) {
  return [bodies = std::move(bodies), start](double t, const NavierStokes& solver) {
    std::vector<Interface> out;
    for (const MovingBody& body : bodies) {
      const Vec2 centre = body.start + start.way(t) * body.velocity;
      const double angle = body.angle + start.way(t) * body.spin;
      const Disc disc{centre, body.shape.diameter / 2};
      const double length = solver.arc_length(disc);
      out.push_back(body.shape.corners.empty() ? circle(0, centre, disc.radius, length)
                                               : polygon(centre, body.shape.corners, length, angle));
      out.back().body = static_cast<Index>(out.size()) - 1;
      out.back().rigid.translation = start.speed(t) * body.velocity;
      out.back().rigid.spin = start.speed(t) * body.spin;
    }
    return out;
  };
}

}  // namespace fpi::fluid::testing
