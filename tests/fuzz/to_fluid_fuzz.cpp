/// What a coupler may send to a fluid that is configured for a small scene: moving and fixed bodies on a
/// coarse mesh.
#include "conversation.hpp"
#include "fluid_service.hpp"
#include "proto/desk.hpp"

namespace {

using namespace fpi::proto;

const Configure configure{.scene = R"(
gravity = [0, -9.81]
[time]
step = 0.01
end = 1
[fluid]
density = 1000
kinematic_viscosity = 1e-3
mesh = {lower = [0, 0], upper = [1, 1], cells_x = 3, cells_y = 3}
[fluid.boundaries]
left.type = "no_slip"
right.type = "no_slip"
bottom.type = "no_slip"
top.type = "no_slip"
[[bodies]]
name = "ball"
radius = 0.2
density = 1200
position = [0.5, 0.55]
)"};

/// Four arcs around (0.5, y).
Interface ball(double y, bool free) {
  Interface interface {
    .centre = {0.5, y, 0}, .radius = 0.2, .start = {0, 1.5, 3, 4.5}, .end = { 1.5, 3, 4.5 }
  };
  interface.end.push_back(2 * 3.141592653589793);
  interface.translation = {0, -0.01, 0};
  if (free)
    interface.balance = Balance{.mass = 150, .inertia = 3, .velocity = {0, -0.01, 0}, .force = {0, -1470, 0}};
  return interface;
}

Interface square() {
  return {.body = 0,
          .centre = {0.5, 0.5, 0},
          .vertices = {0.3, 0.3, 0.7, 0.3, 0.7, 0.7, 0.3, 0.7},
          .rigid = false,
          .points = 1,
          .velocities = {0, 0.1, 0, 0.1, 0, 0.1, 0, 0.1}};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fpi::fluid::FluidService service;
  Desk<fpi::fluid::FluidService, FluidAdvance> desk(service);
  desk.answer({{}, configure});
  fpi::fuzz::ask_all({data, size}, desk);
  return 0;
}

namespace fpi::fuzz {

std::vector<Bytes> seeds() {
  const Envelope step{{1, 1, 0}, FluidAdvance{0.01, 0.01, {ball(0.55, true)}, false, true}};
  const Envelope again{{1, 1, 1}, FluidAdvance{0.01, 0.01, {ball(0.55, true)}}};
  Interface wide = ball(0.55, false);  // no element is left to the fluid
  wide.radius = 2;
  const Envelope covered{{1, 1, 0}, FluidAdvance{0.01, 0.01, {wide}}};
  const Envelope next{{1, 2, 0}, FluidAdvance{.time = 0.02, .time_step = 0.01, .same_interfaces = true}};
  const Envelope steady{{1, 0, 0}, FluidAdvance{.interfaces = {square()}}};
  const Envelope rehearsal{{1, 1, 0}, FluidAdvance{.time = 0.01, .time_step = 0.01, .rehearsal = true}};
  return {
      conversation({step, rehearsal, {{1, 1, 0}, Accept{}}}),
      conversation({step, {{1, 1, 0}, Accept{}}, {{1, 1, 0}, Write{true}}, {{1, 1, 0}, Goodbye{"the end"}}}),
      conversation({step, again, {{1, 1, 1}, Accept{{0}}}, next}),
      conversation(
          {step, {{1, 1, 0}, Restore{}}, step, {{1, 1, 0}, Accept{}}, {{1, 1, 0}, Checkpoint{}}, next}),
      conversation({steady, {{1, 0, 0}, Accept{}}, {{1, 0, 0}, Write{false}}}),
      conversation({{{}, configure}})};
}

std::vector<std::string> words() { return {}; }

}  // namespace fpi::fuzz
