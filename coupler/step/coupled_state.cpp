#include "step/coupled_state.hpp"

#include <array>

#include "core/error.hpp"

namespace fpi {

void put_numbers(const CoupledState& state, NumbersByName& numbers) {
  const auto put = [&numbers](const char* name, const auto& vector) {
    numbers[name].insert(numbers[name].end(), vector.begin(), vector.end());
  };
  for (const coupling::RigidMotion& motion : state.motions) {
    put("position", motion.position);
    put("orientation", motion.orientation.coeffs());
    put("velocity", motion.velocity);
    put("spin", motion.spin);
  }
  for (const coupling::RigidMotion& wall : state.walls) {
    put("wall_position", wall.position);
    put("wall_orientation", wall.orientation.coeffs());
  }
  for (const coupling::RigidLoad& load : state.loads) {
    put("force", load.force);
    put("torque", load.torque);
  }
  for (const Eigen::Vector3d& centre : state.cut_at) put("cut_at", centre);
  put("contacts", state.contacts);
  put("left", state.left);
  put("onset", state.onset ? std::vector{state.onset->time, static_cast<double>(state.onset->body)}
                           : std::vector<double>{});
  for (const Departed& departed : state.departed) {
    put("departed", std::array{departed.count, departed.mass});
    put("departed_momentum", departed.momentum);
  }
}

void take_numbers(const NumbersByName& numbers, CoupledState& state) {
  const auto entry = [&numbers](const char* name, std::size_t index, std::size_t size) {
    const std::vector<double>& all = numbers.at(name);
    require(all.size() >= (index + 1) * size,
            "a checkpoint of as many bodies as the scene has is required; its {} end at {}", name, index);
    return &all[index * size];
  };
  const auto triple = [&entry](const char* name, std::size_t body) {
    return Eigen::Vector3d(entry(name, body, 3));
  };
  for (std::size_t i = 0; i < state.motions.size(); ++i) {
    state.motions[i] = {.position = triple("position", i),
                        .orientation = Eigen::Quaterniond(entry("orientation", i, 4)),
                        .velocity = triple("velocity", i),
                        .spin = triple("spin", i)};
    state.loads[i] = {.force = triple("force", i), .torque = triple("torque", i)};
    state.cut_at[i] = triple("cut_at", i);
  }
  const std::vector<double>& contacts = numbers.at("contacts");
  state.contacts.assign(contacts.begin(), contacts.end());
  if (const std::vector<double>& onset = numbers.at("onset"); !onset.empty())
    state.onset = {.time = onset[0], .body = static_cast<std::size_t>(onset[1])};
  const std::vector<double>& left = numbers.at("left");
  state.left.assign(left.begin(), left.end());
  for (std::size_t i = 0; i < state.departed.size(); ++i) {
    const double* sums = entry("departed", i, 2);
    state.departed[i] = {.count = sums[0], .mass = sums[1], .momentum = triple("departed_momentum", i)};
  }
  for (std::size_t i = 0; i < state.walls.size(); ++i) {
    state.walls[i].position = triple("wall_position", i);
    state.walls[i].orientation = Eigen::Quaterniond(entry("wall_orientation", i, 4));
  }
}

}  // namespace fpi
