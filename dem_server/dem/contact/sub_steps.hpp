/// How far a step may go at once: bodies that touch nothing take free flight, bodies that touch or are about
/// to take sub-steps out of the Hertz contact time of the stiffest pair that can touch.
#pragma once

#include "dem/contact/particles.hpp"
#include "dem/contact/state.hpp"

namespace fpi::dem {

inline constexpr double never = std::numeric_limits<double>::infinity();

/// How fast a gap may close, and how fast that may grow.
struct Approach {
  double speed;         ///< [m/s]
  double acceleration;  ///< [m/s²]
};

/// What acts through a gap.
struct Pull {
  double reach = 0;     ///< [m] gap at which it begins
  double step = never;  ///< [s] that resolves it
};

struct StepEstimate {
  double horizon;            ///< [s] how far ahead it looks
  double free_time = never;  ///< [s] before which nothing touches
  /// [s] t_c/steps_per_contact of the stiffest pair nearby, whether it will touch or not: what may or may not
  /// happen in the step must not change the length of all sub-steps. Nothing moves by more than R*/4 in it,
  /// so that nothing passes through what is too soft for it unseen.
  double contact_step = never;

  /// Two surfaces that meet with at most `speed` [m/s].
  void consider(const Model& model, const PairLaw& law, const Normal& normal, const Approach& closing,
                double speed, const Pull& pull);
};

/// Length [s] of the sub-steps from now on: at most `longest`, `now` so far in the step (0 at its start), of
/// which `left` [s] is left. It stays while contacts do, which keeps the integrator symplectic: what is left
/// of the step is divided into equal parts.
///
/// Where a fluid `iterates` on the loads, what may or may not happen in the step must not change the length,
/// or all contacts jump with the loads. So it is that of the contacts that are nearby when the step begins,
/// unless contacts become twice as short or four times as long, and the last sub-step is what is left; a
/// number of equal parts would jump.
double sub_step_length(double longest, double now, double left, bool iterates);

/// The time of the sub-steps of `length` that fit into `time` [s], or all that is `left` of the step.
double whole_sub_steps(double time, double length, double left);

/// Looks ahead at the pairs from the velocities of `half`, under their constant loads; `position` in the
/// scene's order is for attractions only.
void look_ahead_pairs(const Model& model, const Neighbours& neighbours, const Particles& particles,
                      const std::vector<Vec3>& position, StepEstimate& estimate);
/// Looks ahead at the walls from the current motions under the constant `loads`.
void look_ahead_walls(const Model& model, const State& state, const Forces& loads, StepEstimate& estimate);

/// Time [s] for which no body or wall moves farther than half the skin from where the last search found it.
double time_within_skin(const Neighbours& neighbours, const WallContacts& walls, const Particles& particles);

/// Time [s] in which no body or wall moves farther than a quarter of the skin from where it is now.
double time_of_quarter_skin(const Neighbours& neighbours, const WallContacts& walls,
                            const Particles& particles);

/// How far [m] a body has moved since the last search, at most.
double farthest_moved(const Neighbours& neighbours, const Particles& particles);

/// Of a against b, or against a wall, that constant loads make [m/s²].
Vec3 relative_acceleration(const Model& model, const Forces& loads, const Near& near);

/// First t ≥ 0 [s] at which gap − closing t − ½ acceleration t² is zero, infinite where it never is. The
/// surfaces of two spheres, or of a sphere and a plane, cannot meet before: their distance is at least its
/// projection on any line.
double time_to_close(double gap, double closing, double acceleration);

}  // namespace fpi::dem
