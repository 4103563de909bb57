/// What a coupler may send to a DEM that is configured for a small scene: two free discs, a moving one and
/// walls of which one moves.
#include "conversation.hpp"
#include "dem_service.hpp"
#include "proto/desk.hpp"

namespace {

using namespace fpi::proto;

const Configure configure{.scene = R"(
gravity = [0, -9.81]
[time]
step = 1e-3
end = 1
[dem]
energy = true
[[bodies]]
name = "a"
radius = 0.01
density = 2500
position = [0, 0.0101]
[[bodies]]
name = "b"
radius = 0.01
density = 2500
position = [0.021, 0.0101]
[[bodies]]
name = "stirrer"
radius = 0.01
motion = "prescribed"
prescribed_velocity = ["0.1", "0"]
position = [0.1, 0.02]
[[materials]]
name = "stone"
youngs_modulus = 1e6
[[walls]]
name = "floor"
point = [0, 0]
normal = [0, 1]
[[walls]]
name = "gate"
shape = "polyline"
vertices = [-0.05, 0, -0.05, 0.1]
velocity = ["0.1", "0"]
)"};

Motion stirrer() { return {.body = 2, .position = {0.1001, 0.02, 0}, .velocity = {0.1, 0, 0}}; }
Motion gate() { return {.body = 1, .position = {1e-4, 0, 0}, .velocity = {0.1, 0, 0}}; }
Load load_on(std::uint32_t body) {
  return {
      .body = body, .force = {0.1, 3, 0}, .torque = {0, 0, 1e-3}, .added_mass = 0.3, .added_inertia = 1e-4};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fpi::dem::DemService service;
  Desk<fpi::dem::DemService, DemAdvance> desk(service);
  desk.answer({{}, configure});
  fpi::fuzz::ask_all({data, size}, desk);
  return 0;
}

namespace fpi::fuzz {

std::vector<Bytes> seeds() {
  std::vector<double> resistance(36, 0.0);
  for (std::size_t i = 0; i < 6; ++i) resistance[7 * i] = 100;
  const Envelope dry{{1, 1, 0}, DemAdvance{1e-3, 1e-3, {}, {stirrer()}, {}, {gate()}, {}}};
  const Envelope wet{
      {1, 1, 0},
      DemAdvance{1e-3, 1e-3, {load_on(0), load_on(1)}, {stirrer()}, {1e-3, 1e-3, 1e-3}, {gate()}, {}}};
  const Envelope coupled{
      {1, 1, 0},
      DemAdvance{
          1e-3, 1e-3, {load_on(0), load_on(1)}, {stirrer()}, {1e-3, 1e-3, 1e-3}, {gate()}, resistance}};
  const Envelope accept{{1, 1, 0}, Accept{}};
  return {conversation({dry, accept, dry, {{1, 2, 0}, Goodbye{"the end"}}}),
          conversation({wet, wet, {{1, 1, 0}, Accept{{1}}}, {{1, 1, 0}, Checkpoint{}}}),
          conversation({coupled, {{1, 1, 0}, Restore{}}, coupled, accept, {{1, 1, 0}, Write{}}})};
}

std::vector<std::string> words() { return {}; }

}  // namespace fpi::fuzz
