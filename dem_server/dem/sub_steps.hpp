/// How far a step may go at once: bodies that touch nothing fly, bodies that touch or are about to take
/// sub-steps out of the Hertz contact time of the stiffest pair that can touch.
#pragma once

#include "dem/contact.hpp"
#include "dem/state.hpp"

namespace fpi::dem {

struct Outlook {
  double
      free_time;  ///< [s] before which nothing touches; infinite where nothing does in the step or just after
  double contact_step;  ///< [s] t_c/steps_per_contact of the stiffest pair that can touch; else infinite
};

/// Looks ahead by `horizon` [s] from the current motions under the constant `loads`.
Outlook look_ahead(const Model& model, const State& state, const Forces& loads, double horizon);

/// Time [s] for which no body moves farther than half the skin from where the last search found it.
double time_within_skin(const Model& model, const State& state, const Forces& loads);

/// Of a against b, or against a wall, that constant loads make [m/s²].
Vec3 relative_acceleration(const Model& model, const Forces& loads, const Near& near);

/// First t ≥ 0 [s] at which gap − closing t − ½ acceleration t² is zero, infinite where it never is. The
/// surfaces of two spheres, or of a sphere and a plane, cannot meet before: their distance is at least its
/// projection on any line.
double time_to_close(double gap, double closing, double acceleration);

}  // namespace fpi::dem
