/// Names used throughout the fluid library: plane vectors, indices, and the largest sizes of an element.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <vector>

namespace fpi::fluid {

using Vec2 = Eigen::Vector2d;
using Index = std::int32_t;  ///< of vertices, nodes, cells, edges, equations; -1 where there is none
using Vector = Eigen::VectorXd;

/// z component of a × b.
inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }
/// ω × r for a spin about z.
inline Vec2 spin_cross(double spin, const Vec2& r) { return {-spin * r.y(), spin * r.x()}; }

/// Rigid motion about a centre: u(x) = translation + spin × (x − centre).
struct RigidVelocity {
  Vec2 centre = Vec2::Zero();
  Vec2 translation = Vec2::Zero();  ///< [m/s]
  double spin = 0;                  ///< [rad/s]
  Vec2 operator()(const Vec2& x) const { return translation + spin_cross(spin, x - centre); }
};

}  // namespace fpi::fluid
