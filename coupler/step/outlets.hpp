/// Bodies that leave the scene through [[outlets]]. They keep their numbers: one that left rests where it
/// was, and is named in no message any more.
#pragma once

#include <span>
#include <vector>

#include "scene/scene.hpp"
#include "step/coupled_state.hpp"

namespace fpi {

/// The end of a body's part in the run.
struct Departure {
  std::size_t body = 0, outlet = 0;
  coupling::RigidMotion motion;  ///< with which it left
  double mass = 0;               ///< [kg]
};

/// The free bodies that are still there and were wholly in an outlet on the straight way from where they were
/// `before` the step, so that a fast one does not jump over it; at its end only where that is left out.
std::vector<Departure> departures(const scene::Scene& scene, const CoupledState& state,
                                  std::span<const coupling::RigidMotion> before = {});

/// Whether a body at this place [m] is in an outlet, wholly or in part.
bool is_at_outlet(const scene::Scene& scene, const scene::Body& body, const Eigen::Vector3d& position);

/// Takes them out of the state and adds them to what left before.
void take_out(const std::vector<Departure>& departures, CoupledState& state);

}  // namespace fpi
