/// The bodies as sub-steps see them: in the order of their cells, so that neighbours in space are near in
/// memory, and in records of four numbers, so that one load takes a vector and what is read with it.
#pragma once

#include "dem/base/record.hpp"
#include "dem/contact/contact.hpp"

namespace fpi::dem {

/// What belongs to the centre and to the turning about it.
struct alignas(64) Twin {
  Record linear = Record::Zero(), angular = Record::Zero();
};

/// Arrays are padded with bodies that nothing moves to a multiple of the lanes.
struct Particles {
  std::vector<std::uint32_t> body;  ///< in the scene, of each; not padded
  std::vector<Record> place;        ///< x, y, z [m], R [m]
  std::vector<Twin> half;           ///< velocity [m/s] and 1/m, spin [rad/s] and 1/I: middle of the sub-step
  std::vector<Twin> now;            ///< velocity and 1/m, spin and R: at its end, for dashpots
  std::vector<Twin> force;          ///< force [N] and moment [N m] that it moves by, besides the loads
  std::vector<Twin> contact_force;  ///< those of the contacts; empty: the same
  std::vector<Twin> load;  ///< acceleration [m/s²] and angular [rad/s²] by what is held; empty: weight only
  Record gravity;          ///< [m/s²], and 0
  std::vector<Record> turned;  ///< Orientation::since
  std::vector<std::uint16_t> material;

  std::size_t size() const { return body.size(); }
  double radius(std::size_t i) const { return place[i][3]; }
  bool is_free(std::size_t i) const { return half[i].linear[3] > 0; }
  /// By what is held [m/s²].
  Record acceleration(std::size_t i) const {
    if (!load.empty()) return load[i].linear;
    return is_free(i) ? gravity : Record(Record::Zero());
  }

  /// The bodies in the order given.
  Particles(const Model& model, const Motions& motions, const Forces& loads,
            const std::vector<std::uint32_t>& order);
  /// Takes up what is held from now on.
  void set_loads(const Model& model, const Forces& loads);
  /// Entry k becomes what entry order[k] was.
  void reorder(const std::vector<std::uint32_t>& order);
  /// Places, velocities and spins of `half`, and turns, back to the scene's order.
  void write(Motions& motions) const;
  void write(std::size_t i, Motions& motions) const;
};

}  // namespace fpi::dem
