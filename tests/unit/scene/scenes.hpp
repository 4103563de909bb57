/// Scenes that the tests of this folder start from, and the error that a text gives.
#pragma once

#include <string>

#include "core/error.hpp"
#include "scene/scene.hpp"

namespace fpi::scene {

/// A disc that settles in a box: a bit of everything.
inline const std::string settling = R"(title = "a disc settles"
gravity = [0, -9.81]

[time]
step = 0.001
end = 1

[fluid]
density = 1000
kinematic_viscosity = 1e-5

[fluid.mesh]
lower = [0, 0]
upper = [0.02, 0.06]
cells_x = 4
cells_y = 12

[fluid.boundaries]
left.type = "no_slip"
right.type = "no_slip"
bottom.type = "no_slip"
top.type = "no_slip"

[[bodies]]
name = "disc"
radius = 0.00125
density = 1250
position = [0.01, 0.04]

[[materials]]
name = "steel"
youngs_modulus = 1e6

[[walls]]
name = "floor"
point = [0, 0]
normal = [0, 1]
)";

/// `text` with its first `from` replaced; both lengths may differ.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  require(at != std::string::npos, "the test's scene must contain \"{}\"", from);
  return text.replace(at, from.size(), to);
}

/// The message of the Error that reading gives, or "" where it is read.
inline std::string error_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    read_text(text, "drop.toml", overrides);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

}  // namespace fpi::scene
