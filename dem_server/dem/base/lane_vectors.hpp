/// Vectors of two and three numbers of which each may be several (Lanes), with the names that Eigen's have.
#pragma once

#include "core/lanes.hpp"

namespace fpi::dem {

struct LaneVector3 {
  Lanes x{}, y{}, z{};

  Lanes dot(const LaneVector3& o) const { return x * o.x + y * o.y + z * o.z; }
  LaneVector3 cross(const LaneVector3& o) const {
    return {y * o.z - z * o.y, z * o.x - x * o.z, x * o.y - y * o.x};
  }
  LaneVector3& operator+=(const LaneVector3& o) { return *this = {x + o.x, y + o.y, z + o.z}; }
  friend LaneVector3 operator+(const LaneVector3& a, const LaneVector3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend LaneVector3 operator-(const LaneVector3& a, const LaneVector3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend LaneVector3 operator*(Lanes s, const LaneVector3& a) { return {s * a.x, s * a.y, s * a.z}; }
  friend LaneVector3 operator-(const LaneVector3& a) { return {-a.x, -a.y, -a.z}; }
  friend LaneVector3 operator*(double s, const LaneVector3& a) { return {s * a.x, s * a.y, s * a.z}; }
};

struct LaneVector2 {
  Lanes x{}, y{};

  Lanes dot(const LaneVector2& o) const { return x * o.x + y * o.y; }
  friend LaneVector2 operator-(const LaneVector2& a, const LaneVector2& b) { return {a.x - b.x, a.y - b.y}; }
  friend LaneVector2 operator*(Lanes s, const LaneVector2& a) { return {s * a.x, s * a.y}; }
};

/// a where `where`, else zero.
template <class Mask>
Lanes keep(Mask where, Lanes a) {
  return select(where, a, Lanes{});
}
template <class Mask>
LaneVector3 keep(Mask where, const LaneVector3& a) {
  return {keep(where, a.x), keep(where, a.y), keep(where, a.z)};
}

}  // namespace fpi::dem
