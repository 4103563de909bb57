/// What a DEM may answer to the coupler: alone, or with the real fluid on a coarse mesh.
#include "fluid_service.hpp"
#include "run_with.hpp"

namespace {

using namespace fpi::proto;

const std::string dry = R"(
gravity = [0, -9.81]
[time]
step = 0.01
end = 0.02
max_halvings = 2
[coupling]
max_iterations = 5
[output]
checkpoint_every = 1
[dem]
energy = true
[[materials]]
name = "stone"
youngs_modulus = 1e6
[[outlets]]
name = "below"
lower = [-1, -9]
upper = [1, 0]
[[bodies]]
name = "ball"
radius = 0.2
density = 1200
position = [0.5, 0.55]
)";

const std::string wet = dry + R"(
[fluid]
density = 1000
kinematic_viscosity = 1e-3
mesh = {lower = [0, 0], upper = [1, 1], cells_x = 2, cells_y = 2}
[fluid.boundaries]
left.type = "no_slip"
right.type = "no_slip"
bottom.type = "traction"
top.type = "no_slip"
)";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const bool is_dry = size % 2 == 0;
  fpi::fuzz::PuppetDem dem(data, size);
  fpi::fluid::FluidService fluid;
  fpi::fuzz::run((is_dry ? dry : wet).c_str(), {is_dry ? nullptr : &fluid, &dem, true, true, true});
  return 0;
}

namespace fpi::fuzz {

std::vector<Bytes> seeds() {
  const Envelope configured{{}, Configured{.notes = {"a toy"}, .figures = {{"bodies", 1}}}};
  const auto advanced = [](double y, double vy) {
    const Motion motion{.body = 0, .position = {0.5, y, 0}, .velocity = {0, vy, 0}};
    return Envelope{{1, 1, 0}, DemAdvanced{true, "", {motion}, 5, {0}, 1e-6}};
  };
  const Envelope failed{{1, 1, 0}, DemAdvanced{.reason = "no sub-step is small enough"}};
  const Envelope accepted{{1, 1, 0}, Accepted{{{"energy.kinetic", 0.1}}}};
  const Envelope state{{1, 1, 0}, State{{1, 2, 3}}};
  const Envelope restored{{1, 1, 0}, Restored{}};
  return {conversation({configured, advanced(0.5498, -0.02), accepted, restored, state}),
          conversation({configured, failed, advanced(0.5498, -0.02), accepted, restored, state}),
          conversation({configured, advanced(-0.3, -9), accepted, restored, state}),
          conversation({configured, advanced(0.5, -1), advanced(0.4, -2), accepted, restored, state})};
}

std::vector<std::string> words() { return {}; }

}  // namespace fpi::fuzz
