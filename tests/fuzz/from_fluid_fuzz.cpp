/// What a fluid may answer to the coupler: the other role is the real DEM, and results are written.
#include <cmath>
#include <numbers>

#include "dem_service.hpp"
#include "run_with.hpp"

namespace {

using namespace fpi::proto;
using std::numbers::pi;

constexpr std::size_t n_arcs = 6;

const char* const scene = R"(
gravity = [0, -9.81]
[time]
step = 0.01
end = 0.02
max_halvings = 2
[coupling]
max_iterations = 5
relative_tolerance = 0.1
[output]
checkpoint_every = 1
[fluid]
density = 1000
kinematic_viscosity = 1e-3
mesh = {lower = [0, 0], upper = [1, 1], cells_x = 3, cells_y = 3}
[fluid.boundaries]
left.type = "no_slip"
right.type = "no_slip"
bottom.type = "no_slip"
top.type = "no_slip"
[[materials]]
name = "stone"
youngs_modulus = 1e6
[coefficients]
on = "post"
velocity = 1
length = 0.2
[[probes]]
name = "p"
quantity = "pressure"
point = [0.1, 0.1]
[[bodies]]
name = "ball"
radius = 0.1
density = 1200
position = [0.5, 0.55]
[[bodies]]
name = "post"
radius = 0.1
motion = "fixed"
position = [0.2, 0.2]
)";

Traction traction(std::uint32_t body) {
  return {.body = body,
          .values = std::vector<double>(2 * n_arcs, 0.5),
          .force = {0, body == 0 ? 369.8 : 308.2, 0},
          .arc_length = 0.2 * pi / n_arcs};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const bool moves_bodies = size % 2 == 0;
  fpi::fuzz::PuppetFluid fluid(data, size);
  fpi::dem::DemService dem;
  fpi::fuzz::run(scene, {&fluid, &dem, moves_bodies, true, true});
  return 0;
}

namespace fpi::fuzz {

std::vector<Bytes> seeds() {
  const double length = 0.2 * pi / n_arcs;
  const Envelope configured{{}, Configured{{{0, length}, {1, length}}, 0.01, {"a toy"}, {{"cells", 9}}}};
  const Envelope advanced{
      {1, 1, 0},
      FluidAdvanced{
          true, "", {traction(0), traction(1)}, 3, 1e-9, 1e-4, 3, {9, 0, 0, 0, 9, 0, 0, 0, 9}, 0.1}};
  const Envelope failed{{1, 1, 0}, FluidAdvanced{.reason = "Newton's iteration diverges", .residual = 1e9}};
  const Envelope accepted{{1, 1, 0}, Accepted{{{"p", 1.5}, {"force_x:left", 1}, {"force_y:left", 2}}}};
  const Envelope restored{{1, 1, 0}, Restored{}};
  Fields mesh{.time = 0.01, .points = std::vector<double>(18, 0.25), .cells = {0, 1, 2, 3, 4, 5}};
  mesh.fields = {{"velocity", false, 2, std::vector<double>(12, 1.5)}, {"active", true, 1, {1}}};
  mesh.boundaries = {{"left", std::vector<double>(9, 0.5), {0, 2, 1}, 2, {1, 2, 3, 4, 5, 6}}};
  mesh.profiles = {{"middle", {0, 1, 2}, {}, 1, {7}}};
  mesh.tables = {{"sections", {"x", "pressure"}, {0, 1, 2, 3}}};
  const Envelope fields{{1, 1, 0}, mesh};
  const Envelope state{{1, 1, 0}, State{{1, 2, 3}}};
  return {conversation({configured, advanced, accepted, restored, fields, state}),
          conversation({configured, failed, advanced, advanced, advanced, advanced, advanced, advanced,
                        advanced, accepted, restored, fields, state}),
          conversation({configured, advanced, accepted, restored, {{1, 1, 0}, Fields{}}, state})};
}

std::vector<std::string> words() { return {}; }

}  // namespace fpi::fuzz
