/// A vector of three numbers of which each may be several (Lanes), with the names that Eigen's have.
#pragma once

#include "core/lanes.hpp"

namespace fpi::dem {

struct Triple {
  Lanes x{}, y{}, z{};

  Lanes dot(const Triple& o) const { return x * o.x + y * o.y + z * o.z; }
  Triple cross(const Triple& o) const { return {y * o.z - z * o.y, z * o.x - x * o.z, x * o.y - y * o.x}; }
  Triple& operator+=(const Triple& o) { return *this = {x + o.x, y + o.y, z + o.z}; }
  friend Triple operator+(const Triple& a, const Triple& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Triple operator-(const Triple& a, const Triple& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Triple operator*(Lanes s, const Triple& a) { return {s * a.x, s * a.y, s * a.z}; }
  friend Triple operator-(const Triple& a) { return {-a.x, -a.y, -a.z}; }
  friend Triple operator*(double s, const Triple& a) { return {s * a.x, s * a.y, s * a.z}; }
};

/// a where `where`, else zero.
template <class Mask>
Triple keep(Mask where, const Triple& a) {
  return {select(where, a.x, Lanes{}), select(where, a.y, Lanes{}), select(where, a.z, Lanes{})};
}

}  // namespace fpi::dem
