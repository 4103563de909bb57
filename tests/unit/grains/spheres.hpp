/// What the tests of this folder share: random spheres, the narrowest gap by brute force, and the error of a
/// scene.
#pragma once

#include <limits>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "grains/expand.hpp"
#include "grains/sphere.hpp"

namespace fpi::grains {

inline double gap(const Sphere& a, const Sphere& b, const Periods& periods = {}) {
  return length(difference(a.centre, b.centre, periods)) - a.radius - b.radius;
}

inline double narrowest_gap(std::span<const Sphere> spheres, const Periods& periods = {}) {
  double narrowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < spheres.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) narrowest = std::min(narrowest, gap(spheres[i], spheres[j], periods));
  return narrowest;
}

inline const std::string head = R"([time]
step = 1e-3
end = 1
[[materials]]
name = "stone"
youngs_modulus = 1e8
)";

/// The scene with its groups expanded; the one table that there is has the text `table`.
inline scene::Scene expanded(const std::string& groups, const std::string& table = "") {
  scene::Scene scene = scene::read_text(head + groups, "sand.toml");
  expand(scene, [&table](const std::string&) { return std::string_view(table); });
  return scene;
}

inline std::string error_of(const std::string& groups, const std::string& table = "") {
  try {
    expanded(groups, table);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

}  // namespace fpi::grains
