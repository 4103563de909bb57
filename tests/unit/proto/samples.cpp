#include "samples.hpp"

namespace fpi::proto::samples {

Motion motion() {
  return {.body = 3,
          .position = {1, 2, -0.0},
          .orientation = {0.6, 0, 0, 0.8},
          .velocity = {4, 5, 6},
          .spin = {7, 8, 9}};
}

Interface arcs() {
  return {.body = 4,
          .centre = {1, 2, 3},
          .radius = 0.5,
          .start = {0, 1.5},
          .end = {1.5, 6.28},
          .rigid = false,
          .translation = {4, 5, 6},
          .spin = {7, 8, 9},
          .points = 2,
          .velocities = {1, 2, 3, 4, 5, 6, 7, 8}};
}

Interface surface() {
  return {.body = 5,
          .vertices = {0, 0, 1, 0, 0, 1},
          .points = 1,
          .velocities = {1, 2, 3, 4, 5, 6},
          .balance = Balance{1, 2, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}, {12, 13, 14}}};
}

std::vector<Envelope> all() {
  const Figures figures{{"unknowns", 1234}, {"factor", 0.25}};
  const Traction traction{.body = 1,
                          .values = {1, -2, 3, -4},
                          .force = {5, 6, 7},
                          .torque = {8, 9, 10},
                          .arc_length = 0.1,
                          .velocity = {11, 12, 13},
                          .spin = {14, 15, 16}};
  const Load load{.body = 2,
                  .force = {1, 2, 3},
                  .torque = {4, 5, 6},
                  .start = {0, 1},
                  .end = {1, 2},
                  .tractions = {7, 8, 9, 10},
                  .velocity = {11, 12, 13},
                  .spin = {14, 15, 16},
                  .added_mass = 17,
                  .added_inertia = 18};
  Fields fields{.time = 0.5, .points = std::vector<double>(18, 0.25), .cells = {0, 1, 2, 3, 4, 5}};
  fields.fields = {{"velocity", false, 2, std::vector<double>(12, 1.5)}, {"active", true, 1, {1}}};
  fields.boundaries = {{"wall", std::vector<double>(9, 0.5), {0, 2, 1}, 2, {1, 2, 3, 4, 5, 6}}};
  fields.profiles = {{"middle", {0, 1, 2}, {}, 1, {7}}};
  fields.tables = {{"sections", {"x", "pressure"}, {0, 1, 2, 3}}};

  const std::vector<Finding> findings{{true, "bodies.0", "a body outside"}, {false, "", "a warning"}};

  const std::vector<Message> messages{
      Hello{3, "fluid", "toy", "0.1.0", {"checkpoint", "fields"}, 0xffffffffffffffff, 7},
      Welcome{0xfedcba9876543210, 0.25, 40},
      Refusal{"the role is taken"},
      Configure{"[fluid]\ndensity = 1 # µ\n", {{"channel.msh", {1, 2, 3, 255}}}, {9, 8}},
      Configured{{{0, 0.1}, {1, 0.2}}, 0.01, {"no convection", "one factor"}, figures, findings},
      FluidAdvance{0.3, 0.1, {arcs(), surface()}, false, true, true},
      FluidAdvanced{true, "well", {traction, traction}, 4, 1e-9, 2e-4, 3, {1, 2, 3, 4}, 0.7, findings},
      DemAdvance{
          0.3, 0.1, {load}, {motion(), motion()}, {0.01, 0.02}, {motion()}, std::vector<double>(9, 0.5)},
      DemAdvanced{true, "well", {motion()}, 50, {2}, 1e-6},
      Accept{{3, 7}},
      Accepted{figures, findings},
      Restore{},
      Restored{},
      Write{true},
      fields,
      Checkpoint{},
      State{{1, 2, 3}},
      Heartbeat{"factor", 0.5},
      Failure{"toy", "advance", "no convergence"},
      Goodbye{"the end"},
      Farewell{figures}};
  std::vector<Envelope> envelopes;
  for (const Message& message : messages) envelopes.push_back({{11, 22, 33}, message});
  return envelopes;
}

}  // namespace fpi::proto::samples
