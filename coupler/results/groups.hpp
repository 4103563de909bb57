/// What is told of a group of grains as a whole, since there may be too many of them for a column each.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "step/coupled_state.hpp"

namespace fpi {

struct GroupMotion {
  std::string name;
  std::size_t count = 0;                               ///< grains that are there
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< centre of mass [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< its velocity [m/s]
  double kinetic_energy = 0;                           ///< of all grains, with that of their spin [J]
};

/// One a group of the scene, of the grains that did not leave; NaN where none is left. A group without
/// density counts by volume, and has no energy.
std::vector<GroupMotion> group_motions(const scene::Scene& scene, const CoupledState& state);

}  // namespace fpi
