/// The force density on the fluid besides gravity: that of the scene, and the fall of the mean pressure that
/// drives a periodic flow.
#pragma once

#include <array>

#include "core/expression.hpp"
#include "fluid/base/types.hpp"
#include "scene/fluid.hpp"

namespace fpi::fluid {

class BodyForce {
 public:
  explicit BodyForce(const scene::Fluid& parameters);

  Vec2 operator()(const Vec2& x, double t) const;  ///< [N/m³]
  /// −∇ of the mean pressure [Pa/m], which acts on bodies too.
  Vec2 pressure_drop(double t) const;
  bool is_zero() const;
  bool depends_on_time() const;

 private:
  std::array<Expression, 4> formulas_;  // x, y of the force, x, y of the pressure drop
};

}  // namespace fpi::fluid
