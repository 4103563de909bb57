#include "setup/doubts.hpp"

#include <cmath>

#include "grains/outlet_fit.hpp"
#include "grains/static_overlap.hpp"

namespace fpi {
namespace {

/// Softer contacts are an error that the scene asks for.
void find_stretch(const scene::Scene& scene, Findings& findings) {
  if (!scene.dem || scene.dem->stretch == 1) return;
  const double k = scene.dem->stretch;
  findings.warn(
      "dem.stretch",
      "dem.stretch = {0:g}: contacts last {0:g} times as long as the materials say; impacts overlap "
      "{0:g} times as far, grains at rest {1:.3g} times",
      k, std::pow(k, scene.dem->contact == "linear" ? 2 : 5.0 / 3));
}

}  // namespace

Findings doubts(const scene::Scene& scene) {
  Findings findings;
  find_stretch(scene, findings);
  for (const std::string& sentence : grains::narrow_outlets(scene)) findings.warn("outlets", "{}", sentence);
  for (const std::string& sentence : grains::soft_materials(scene))
    findings.warn("materials", "{}", sentence);
  return findings;
}

}  // namespace fpi
