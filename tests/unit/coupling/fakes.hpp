/// Participants in this process whose coupled answer is known: a fluid of drag, added mass and buoyancy, and
/// a DEM of free flight. Where the added mass exceeds the body's, the plain iteration between them diverges.
#pragma once

#include <cmath>
#include <cstring>
#include <numbers>
#include <vector>

#include "core/error.hpp"
#include "proto/participant.hpp"

namespace fpi {

template <class T>
proto::Bytes to_bytes(const std::vector<T>& values) {
  proto::Bytes bytes(values.size() * sizeof(T));
  if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}
template <class T>
std::vector<T> from_bytes(const proto::Bytes& bytes) {
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

/// F_y = −drag v − added_mass (v − v_n)/Δt + buoyancy for every body; v is given, or found from a balance.
class FakeFluid : public proto::FluidParticipant {
 public:
  double drag = 2, added_mass = 3, buoyancy = 0.5, arc_length = 0.2;
  double largest_step = 1e9;  ///< [s] larger ones do not converge
  double stiffness = 0;       ///< [1/s³] error in time over Δt³; 0: it says none
  std::size_t missing_tractions = 0;
  bool has_fields = true;
  std::vector<Finding> findings;  ///< of the scene

  std::vector<proto::FluidAdvance> asked;
  std::vector<proto::Stamp> stamps;
  std::size_t accepts = 0, restores = 0;

  proto::Configured configure(const proto::Configure& message) override {
    velocities_ = from_bytes<double>(message.state);
    velocities_.resize(bodies_in(message.scene));
    proto::Configured configured;
    for (std::uint32_t i = 0; i < velocities_.size(); ++i) configured.arc_lengths.push_back({i, arc_length});
    configured.findings = findings;
    return configured;
  }

  proto::FluidAdvanced advance(const proto::Stamp& stamp, const proto::FluidAdvance& message) override {
    asked.push_back(message);
    stamps.push_back(stamp);
    proto::FluidAdvanced answer{.converged = message.time_step <= largest_step,
                                .reason = "the step is too large",
                                .tractions = {},
                                .newton_iterations = 2,
                                .time_error = stiffness * std::pow(message.time_step, 3),
                                .time_error_order = stiffness > 0 ? 3.0 : 0.0};
    tried_ = velocities_;
    for (const proto::Interface& body : message.interfaces) {
      const double before = velocities_[body.body], rate = message.time_step > 0 ? 1 / message.time_step : 0;
      double v = body.translation[1];
      if (const auto& b = body.balance)
        v = (rate * (b->mass * b->velocity[1] + added_mass * before) + b->force[1] + buoyancy) /
            (rate * (b->mass + added_mass) + drag);
      if (body.balance && message.wants_resistance)
        answer.resistance = {1, 0, 0, 0, rate * (body.balance->mass + added_mass) + drag, 0, 0, 0, 1};
      const double inertia = added_mass * (v - before) * rate;
      answer.tractions.push_back({.body = body.body,
                                  .values = std::vector<double>(2 * body.size(), v),
                                  .force = {0, buoyancy - drag * v - inertia, 0},
                                  .torque = {},
                                  .arc_length = arc_length,
                                  .velocity = {body.translation[0], v, 0},
                                  .spin = body.spin});
      tried_[body.body] = v;
    }
    answer.tractions.resize(answer.tractions.size() - missing_tractions);
    return answer;
  }

  proto::Accepted accept(const proto::Accept&) override {
    ++accepts;
    velocities_ = tried_;
    return {{{"p", static_cast<double>(accepts)}, {"force_x:left", 4}, {"force_y:left", 6}}};
  }
  void restore() override { ++restores; }

  proto::Fields write(const proto::Write& message) override {
    if (!has_fields) return {};
    proto::Fields fields;
    if (message.mesh) {
      fields.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, .5, 0, 0, .5, .5, 0, 0, .5, 0};
      fields.cells = {0, 1, 2, 3, 4, 5};
    }
    fields.fields = {
        {"velocity", false, 2, std::vector<double>(12, velocities_.empty() ? 0 : velocities_[0])},
        {"pressure", false, 1, std::vector<double>(6)},
        {"active", true, 1, {1}}};
    return fields;
  }
  proto::State checkpoint() override { return {to_bytes(velocities_)}; }

 private:
  static std::size_t bodies_in(const std::string& scene) {
    std::size_t n = 0;
    for (std::size_t at = 0; (at = scene.find("[[bodies]]", at)) != std::string::npos; ++at) ++n;
    return n;
  }
  std::vector<double> velocities_, tried_;
};

/// v_{n+1} = v_n + Δt (F − damper v_{n+1} + m g)/m, x by the trapezoidal rule; inertia that the fluid adds,
/// or its resistance, counts.
class FakeDem : public proto::DemParticipant {
 public:
  FakeDem(double mass, double gravity, std::vector<proto::Motion> motions)
      : mass_(mass), gravity_(gravity), motions_(std::move(motions)) {}

  double damper = 0;  ///< [N s/m] between each body and the ground
  std::vector<proto::DemAdvance> asked;
  std::size_t restores = 0;

  proto::Configured configure(const proto::Configure& message) override {
    if (!message.state.empty()) motions_ = from_bytes<proto::Motion>(message.state);
    return {};
  }
  proto::DemAdvanced advance(const proto::Stamp&, const proto::DemAdvance& message) override {
    asked.push_back(message);
    tried_ = motions_;
    for (proto::Motion& motion : tried_) {
      const double before = motion.velocity[1];
      double force = mass_ * gravity_, mass = mass_;
      for (const proto::Load& load : message.loads) {
        if (load.body != motion.body) continue;
        force += load.force[1] + load.added_mass * (load.velocity[1] - before) / message.time_step;
        mass += load.added_mass;
        if (message.resistance.empty()) continue;
        const double gained = (load.velocity[1] - before) / message.time_step;
        mass = message.time_step * message.resistance[4];
        force += (mass - mass_ - load.added_mass) * gained;
      }
      motion.velocity[1] = (mass * before + message.time_step * force) / (mass + message.time_step * damper);
      motion.position[1] += 0.5 * message.time_step * (before + motion.velocity[1]);
    }
    return {.converged = true, .reason = "", .motions = tried_};
  }
  std::vector<std::uint32_t> left;  ///< in the order in which it was told

  proto::Accepted accept(const proto::Accept& message) override {
    motions_ = tried_;
    left.insert(left.end(), message.left.begin(), message.left.end());
    return {};
  }
  void restore() override { ++restores; }
  proto::State checkpoint() override { return {to_bytes(motions_)}; }

 private:
  double mass_, gravity_;
  std::vector<proto::Motion> motions_, tried_;
};

}  // namespace fpi
