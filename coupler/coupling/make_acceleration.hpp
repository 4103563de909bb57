/// The acceleration that a scene asks for, by its name.
#pragma once

#include <memory>

#include "coupling/acceleration.hpp"
#include "scene/coupling.hpp"

namespace fpi::coupling {

std::unique_ptr<Acceleration> make_acceleration(const scene::Coupling& parameters);

}  // namespace fpi::coupling
