/// Whether bodies fit into the outlets that they are to leave through: one leaves where it is wholly inside.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace fpi::grains {

/// Throws Error naming an outlet that is narrower than every free body, so that nothing could ever leave.
void check_outlets(const scene::Scene& scene);

/// A sentence for each outlet that is narrower than some of the free bodies, for a warning.
std::vector<std::string> narrow_outlets(const scene::Scene& scene);

}  // namespace fpi::grains
