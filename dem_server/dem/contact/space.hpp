/// The vectors of contacts in space and in a plane, several at once, so that one kernel serves both and a
/// plane pays for two axes and one spin: `Vector` is of places, velocities and forces, `Rotation` of spins
/// and moments about the axes that the space has.
#pragma once

#include "dem/base/lane_vectors.hpp"
#include "dem/contact/particles.hpp"

namespace fpi::dem {

/// Numbers of a record of each lane.
struct Gathered {
  Lanes x, y, z, w;

  /// record_of(k) is the record of lane k.
  template <class RecordOf>
  explicit Gathered(RecordOf record_of) : x(record_of(0)), y(record_of(1)), z(record_of(2)), w(record_of(3)) {
    transpose(x, y, z, w);
  }
};

/// Calls put(k, record) for the first n lanes.
template <class Put>
void scatter(std::size_t n, Lanes x, Lanes y, Lanes z, Lanes w, Put put) {
  Lanes records[n_lanes] = {x, y, z, w};
  transpose(records[0], records[1], records[2], records[3]);
  for (std::size_t k = 0; k < n; ++k) put(k, records[k]);
}

struct InSpace {
  using Vector = LaneVector3;
  using Rotation = LaneVector3;

  static Vector shortest(const Vector& line, const PeriodicBox& box) {
    return {box.shortest(line.x, 0), box.shortest(line.y, 1), box.shortest(line.z, 2)};
  }
  static Vec3 lane(const LaneVector3& v, std::size_t k) { return {v.x[k], v.y[k], v.z[k]}; }
  static Vector vector(const Gathered& g) { return {g.x, g.y, g.z}; }
  static Rotation turn(const Gathered& g) { return {g.x, g.y, g.z}; }
  template <class Put>
  static void scatter_vector(std::size_t n, const Vector& v, Put put) {
    scatter(n, v.x, v.y, v.z, Lanes{}, put);
  }
  template <class Put>
  static void scatter_rotation(std::size_t n, const Rotation& v, Lanes w, Put put) {
    scatter(n, v.x, v.y, v.z, w, put);
  }

  /// n × v and m × n.
  static Rotation cross(const Vector& n, const Vector& v) { return n.cross(v); }
  static Vector turned(const Rotation& m, const Vector& n) { return m.cross(n); }
  /// The part of a turn that is not about the normal.
  static Rotation across(const Rotation& w, const Vector& n) { return w - w.dot(n) * n; }
  /// A spring across the normal as it was, turned across the normal as it is without changing its length.
  static Rotation follow(const Rotation& spring, const Vector& n) {
    const Rotation left = across(spring, n);
    const Lanes squared = left.dot(left);
    return select(squared > 0, sqrt(spring.dot(spring) / squared), Lanes{}) * left;
  }
};

struct InPlane {
  using Vector = LaneVector2;
  using Rotation = Lanes;

  static Vector shortest(const Vector& line, const PeriodicBox& box) {
    return {box.shortest(line.x, 0), box.shortest(line.y, 1)};
  }
  static Vec3 lane(const Vector& v, std::size_t k) { return {v.x[k], v.y[k], 0}; }
  static Vec3 lane(Rotation v, std::size_t k) { return {0, 0, v[k]}; }
  static Vector vector(const Gathered& g) { return {g.x, g.y}; }
  static Rotation turn(const Gathered& g) { return g.z; }
  template <class Put>
  static void scatter_vector(std::size_t n, const Vector& v, Put put) {
    scatter(n, v.x, v.y, Lanes{}, Lanes{}, put);
  }
  template <class Put>
  static void scatter_rotation(std::size_t n, Rotation v, Lanes w, Put put) {
    scatter(n, Lanes{}, Lanes{}, v, w, put);
  }

  static Rotation cross(const Vector& n, const Vector& v) { return n.x * v.y - n.y * v.x; }
  static Vector turned(Rotation m, const Vector& n) { return {-m * n.y, m * n.x}; }
  static Rotation across(Rotation w, const Vector&) { return w; }
  static Rotation follow(Rotation spring, const Vector&) { return spring; }
};

}  // namespace fpi::dem
