/// Vectors of two and three numbers of which each may be several (Lanes), with the names that Eigen's have.
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

struct Couple {
  Lanes x{}, y{};

  Lanes dot(const Couple& o) const { return x * o.x + y * o.y; }
  friend Couple operator-(const Couple& a, const Couple& b) { return {a.x - b.x, a.y - b.y}; }
  friend Couple operator*(Lanes s, const Couple& a) { return {s * a.x, s * a.y}; }
};

/// a where `where`, else zero.
template <class Mask>
Lanes keep(Mask where, Lanes a) {
  return select(where, a, Lanes{});
}
template <class Mask>
Triple keep(Mask where, const Triple& a) {
  return {keep(where, a.x), keep(where, a.y), keep(where, a.z)};
}

}  // namespace fpi::dem
