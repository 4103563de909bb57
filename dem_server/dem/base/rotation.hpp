/// Finite rotations by the rescaled Rodrigues vector α = tan(θ/2)/(θ/2) θ of Campello's papers, θ the
/// rotation vector [rad]. α turns with θ's period of 2π and costs one tangent; where it nears its pole, θ =
/// π, a quaternion takes over.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

namespace fpi::dem {

using Vec3 = Eigen::Vector3d;
using Quaternion = Eigen::Quaterniond;

/// tan(x)/x by its series, exact to 1e-17 below x² = 1e-4.
template <class Real>
Real rescaling_of_small(Real x_squared) {
  return 1 + x_squared * (1.0 / 3 + x_squared * (2.0 / 15 + x_squared * (17.0 / 315)));
}

/// α of the rotation vector θ.
inline Vec3 rescaled(const Vec3& theta) {
  const double half_squared = 0.25 * theta.squaredNorm();
  if (half_squared < 1e-4) return rescaling_of_small(half_squared) * theta;
  const double half = std::sqrt(half_squared);
  return std::tan(half) / half * theta;
}

/// Rotation by α₁ followed by rotation by α_Δ: α = 4/(4 − α₁·α_Δ) (α₁ + α_Δ − ½ α₁ × α_Δ). Needs α₁·α_Δ ≠ 4.
inline Vec3 compose(const Vec3& first, const Vec3& increment) {
  return 4 / (4 - first.dot(increment)) * (first + increment - 0.5 * first.cross(increment));
}

/// Q = I + 4/(4 + |α|²) (A + A²/2), A the skew matrix of α.
inline Eigen::Matrix3d matrix(const Vec3& alpha) {
  Eigen::Matrix3d A;
  A << 0, -alpha.z(), alpha.y(), alpha.z(), 0, -alpha.x(), -alpha.y(), alpha.x(), 0;
  return Eigen::Matrix3d::Identity() + 4 / (4 + alpha.squaredNorm()) * (A + 0.5 * A * A);
}

/// The unit quaternion of α: (1, α/2) normalised.
inline Quaternion quaternion(const Vec3& alpha) {
  return Quaternion(1, 0.5 * alpha.x(), 0.5 * alpha.y(), 0.5 * alpha.z()).normalized();
}

/// An orientation as a quaternion and the rotation since, in α: many small turns cost no square root.
struct Orientation {
  Quaternion base = Quaternion::Identity();
  Vec3 since = Vec3::Zero();  ///< α on top of `base`

  /// Turns further by the rotation vector θ [rad].
  void turn(const Vec3& theta) {
    const Vec3 increment = rescaled(theta);
    if (since.squaredNorm() < 1 && increment.squaredNorm() < 1) {
      since = compose(since, increment);
    } else {
      settle();
      since = increment;
    }
  }
  /// Moves all of the rotation into `base`.
  void settle() {
    base = (quaternion(since) * base).normalized();
    since.setZero();
  }
};

}  // namespace fpi::dem
