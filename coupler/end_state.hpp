/// Where the free bodies are at the end of a run, as a table that grains can be read from: a scene may go on
/// from there.
#pragma once

#include <string>
#include <vector>

#include "coupling/rigid_motion.hpp"
#include "scene/scene.hpp"

namespace fpi {

std::string final_bodies_file(const std::string& folder);

/// Writes FOLDER/final_bodies.csv: place, inside the periodic box if there is one, radius, velocity and spin
/// of every free body, in the columns of grains::read_table. No file where no body is free.
void write_final_bodies(const scene::Scene& scene, const std::vector<coupling::RigidMotion>& motions,
                        const std::string& folder);

}  // namespace fpi
