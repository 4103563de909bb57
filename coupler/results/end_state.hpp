/// Where free bodies are at the end: of a run, as a table that grains can be read from, so that a scene may
/// go on from there; or of their part in it.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "step/coupled_state.hpp"

namespace fpi {

std::string final_bodies_file(const std::string& folder);

/// Writes FOLDER/final_bodies.csv: place, inside the periodic box if there is one, radius, velocity and spin
/// of every free body that did not leave, in the columns of grains::read_table. No file where no body is
/// free.
void write_final_bodies(const scene::Scene& scene, const CoupledState& state, const std::string& folder);

/// Columns of these, and the entries of a body.
std::vector<std::string> end_state_columns(const scene::Scene& scene);
std::vector<double> end_state(const scene::Scene& scene, std::size_t body,
                              const coupling::RigidMotion& motion);

}  // namespace fpi
