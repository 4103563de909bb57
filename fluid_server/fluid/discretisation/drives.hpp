/// Loads of unknown size that bring about a given flow: the fall of the mean pressure along a periodic axis
/// for a superficial velocity, the pressure on an open boundary for a flow rate. The size a of each is an
/// unknown of the system; its equation says that the flow which its unit load L works on, Lᵀu, is as given. A
/// fall of the mean pressure acts on bodies too, and the flow that it works on is theirs too.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/expression.hpp"
#include "fluid/base/types.hpp"

namespace fpi::fluid {

struct Drive {
  std::string name;       ///< of what is found: "pressure_drop_x" [Pa/m], or "pressure_at_BOUNDARY" [Pa]
  int axis = -1;          ///< of a fall of the mean pressure; −1: it is the pressure on a boundary
  std::string boundary;   ///< name
  Expression given{"0"};  ///< formula of t
  double unit = 1;        ///< what it is multiplied by to become a flow: [m²/s] of a rate, [m³/s] of a mean
  Vector load;            ///< L: x, y of each node for size 1
  Vector load_on_bodies;  ///< along Vx, Vy, ω of each interface; also what it adds to the flow as it moves
};

class Drives {
 public:
  Drives() = default;
  explicit Drives(std::vector<Drive> drives) : drives_(std::move(drives)) { set_time(0); }

  Index size() const { return static_cast<Index>(drives_.size()); }
  const std::vector<Drive>& all() const { return drives_; }
  void set_time(double t);
  /// What a flow lacks to the given ones, negative [m²/s or m³/s]; `motions`: Vx, Vy, ω of each interface.
  Vector excess(const Vector& u, const Vector& motions) const;
  /// Adds loads of these sizes.
  void add(const Vector& sizes, Vector& load, Vector& load_on_bodies) const;
  /// Force of these sizes on the fluid [N/m]: at a boundary, and all over it.
  Vec2 force_at(const std::string& boundary, const Vector& sizes) const;
  Vec2 force_density(const Vector& sizes) const;
  /// The fall of the mean pressure among these sizes [Pa/m].
  Vec2 pressure_drop(const Vector& sizes) const;

 private:
  Vec2 force(const Vector& sizes, const std::function<bool(const Drive&)>& counts) const;

  std::vector<Drive> drives_;
  Vector flows_;  // given now
};

}  // namespace fpi::fluid
