/// The particles' problem, paper section 4. `advance` always starts from the last accepted state and gives
/// bitwise the same for the same arguments; `accept` keeps its result, `restore` forgets it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "dem/integrate/energy.hpp"
#include "dem/integrate/integrator.hpp"

namespace fpi::dem {

/// What a fluid exerts, besides weight and contacts: held over the step, or at its end (dem.loads). A fluid
/// that resists a change of motion adds inertia: for a body that would end the step with another velocity
/// than the load goes with, the load changes by −added_mass (v − velocity)/Δt.
struct Load {
  std::uint32_t body = 0;
  Vec3 force = Vec3::Zero();                          ///< [N]
  Vec3 torque = Vec3::Zero();                         ///< [N m] about the centre
  Vec3 velocity = Vec3::Zero(), spin = Vec3::Zero();  ///< at the end of the step [m/s], [rad/s]
  double added_mass = 0, added_inertia = 0;           ///< [kg], [kg m²]
};

/// Where a body that is not free, or a wall that moves, is to be at the end of the step; on the way it moves
/// linearly.
struct Prescribed {
  std::uint32_t body = 0;        ///< or number of the wall
  Vec3 position = Vec3::Zero();  ///< [m]
  Quaternion orientation = Quaternion::Identity();
  Vec3 velocity = Vec3::Zero();  ///< [m/s]
  Vec3 spin = Vec3::Zero();      ///< [rad/s]
};

class Solver {
 public:
  /// Throws Error with everything that keeps the set-up from being run.
  explicit Solver(const Problem& problem);
  /// Adds all of it to `wrong` instead: what make_model finds, and free bodies that overlap at the start by
  /// more than dem.start_overlap. With errors the solver is of no use.
  Solver(const Problem& problem, Findings& wrong);

  /// Throws Error for a step that is not > 0 s, a body that does not exist, or numbers that are not finite. A
  /// body that is not free and not among `prescribed` stays where it is, as a wall does that is not among
  /// `walls`. `resolved_gaps` [m], one a body:
  /// narrower ones the fluid does not resolve; empty where there is no fluid. `resistance` of the bodies of
  /// `loads`, by rows: how force x, y and torque go with velocity x, y and spin at the end of the step, their
  /// own inertia over the step included [kg/s, kg m/s, kg m²/s]; empty where nobody says.
  Advanced advance(double time_step, std::span<const Load> loads, std::span<const Prescribed> prescribed = {},
                   std::span<const double> resolved_gaps = {}, std::span<const Prescribed> walls = {},
                   std::span<const double> resistance = {});
  /// Bodies that leave are taken out, contacts and all.
  void accept(std::span<const std::uint32_t> leaving = {});
  void restore() { trial_ = accepted_; }

  /// Throws Error naming a free body that left the places where it could be expected, `time` being now [s].
  void check_none_lost(double time) const;

  /// As the last `advance`, `accept` or `restore` left them.
  const Motions& motions() const { return trial_.motions; }
  const WallMotions& walls() const { return trial_.wall_contacts.motions; }
  const Model& model() const { return model_; }
  /// How many places each body touches others and walls at.
  std::vector<std::uint32_t> contacts() const;

  /// Of the accepted state; nothing where the scene keeps no account.
  std::optional<EnergyAccount> energies() const;

  /// The accepted state as bytes. Forgets the search for neighbours, which a resumed run does not have, so
  /// that both go on bitwise alike.
  std::vector<std::uint8_t> checkpoint();
  /// Takes up an accepted state. Throws Error unless the bytes are a state of this scene.
  void resume(std::span<const std::uint8_t> bytes);

 private:
  void set_inertia(std::span<const Load> loads, std::span<const double> resistance, double time_step);
  void set_loads(std::span<const Load> loads, double time_step);
  void share_expected_contacts(const Forces& gained, const Forces& exerted, Forces& others) const;
  void start_prescribed(std::span<const Prescribed> prescribed, double time_step);
  void finish_prescribed(std::span<const Prescribed> prescribed);
  void start_walls(std::span<const Prescribed> walls, double time_step);
  void finish_walls(std::span<const Prescribed> walls);

  Model model_;
  State accepted_, trial_;
  Energies start_;  ///< of the run
  Loads loads_;     ///< weight included
  SharedInertia inertia_;
};

}  // namespace fpi::dem
