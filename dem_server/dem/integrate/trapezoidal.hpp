/// One sub-step by the implicit trapezoidal rule of Campello's papers, as a fixed-point iteration on the
/// velocities at its end: v₁ = v₀ + Δt/2 (a₀ + a₁), x₁ = x₀ + Δt/2 (v₀ + v₁); orientations turn by Δt/2 (ω₀ +
/// ω₁).
#pragma once

#include "dem/contact/particles.hpp"

namespace fpi::dem {

class TrapezoidalStep {
 public:
  /// From the motions as they are, with the forces that stand, for `duration` [s].
  TrapezoidalStep(const Particles& particles, const std::vector<Orientation>& orientation, double duration);

  /// Takes the forces that stand for those at the end, and moves the particles to where that leads, `half`
  /// with the mean velocities. Returns by how much these have changed since the last iterate,
  /// over the largest of velocities and their changes.
  double iterate(Particles& particles, std::vector<Orientation>& orientation);
  /// Leaves the velocities at the end in `now`.
  void set_ends(Particles& particles) const;
  /// Leaves the velocities that half a kick by the forces at the end makes those there.
  void finish(Particles& particles) const { particles.half = kicked_; }

 private:
  double duration_;
  std::vector<Record> place_, turned_;
  std::vector<Orientation> orientation_;
  std::vector<Twin> before_, kicked_,
      end_;  ///< velocities: at the start, after half a kick, of the last iterate
};

}  // namespace fpi::dem
