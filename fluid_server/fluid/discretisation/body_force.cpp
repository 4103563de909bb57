#include "fluid/discretisation/body_force.hpp"

#include <algorithm>

namespace fpi::fluid {

BodyForce::BodyForce(const scene::Fluid& parameters)
    : formulas_{Expression(parameters.body_force[0], "fluid.body_force.0"),
                Expression(parameters.body_force[1], "fluid.body_force.1"),
                Expression(parameters.pressure_drop[0], "fluid.pressure_drop.0"),
                Expression(parameters.pressure_drop[1], "fluid.pressure_drop.1")} {}

Vec2 BodyForce::operator()(const Vec2& x, double t) const {
  return Vec2(formulas_[0](x.x(), x.y(), t), formulas_[1](x.x(), x.y(), t)) + pressure_drop(t);
}

Vec2 BodyForce::pressure_drop(double t) const { return {formulas_[2](0, 0, t), formulas_[3](0, 0, t)}; }

bool BodyForce::is_zero() const { return std::ranges::all_of(formulas_, &Expression::is_zero); }

bool BodyForce::depends_on_time() const {
  return std::ranges::any_of(formulas_, &Expression::depends_on_time);
}

}  // namespace fpi::fluid
