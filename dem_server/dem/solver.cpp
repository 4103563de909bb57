#include "dem/solver.hpp"

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "dem/contact/attraction.hpp"

namespace fpi::dem {
namespace {

template <class Place>
void check_overlap(const Model& model, const Near& here, const Place& place, Findings& wrong) {
  const std::vector<double>& radius = model.bodies.radius;
  const double smaller = here.wall() ? radius[here.a] : std::min(radius[here.a], radius[here.b]);
  if (here.at.gap >= -model.start_overlap * smaller) return;
  wrong.error(fmt::format("bodies.{}.position", here.a),
              "{} must not overlap at the start by more than {:g} of the smaller radius (dem.start_overlap); "
              "they do, by {:.3g} m: move one of them",
              names(model, place), model.start_overlap, -here.at.gap);
}

void check_overlaps(const Model& model, const State& state, Findings& wrong) {
  const auto& position = state.motions.position;
  const WallContacts& walls = state.wall_contacts;
  each_pair(*state.neighbours,
            [&](const Pair& pair) { check_overlap(model, near(model, position, pair), pair, wrong); });
  for (const WallPlace& place : walls.places)
    check_overlap(model, near(model, position, walls.motions, place), place, wrong);
}

void check_body(const Model& model, std::uint32_t body, const char* what) {
  require(body < model.bodies.size(), "a {} must be of one of {} bodies; got number {}", what,
          model.bodies.size(), body);
}

void check_motion(const Prescribed& end, const std::string& owner) {
  require(end.position.allFinite() && end.velocity.allFinite() && end.spin.allFinite() &&
              std::abs(end.orientation.norm() - 1) < 1e-6,
          "the prescribed motion of {} must be finite, with a unit quaternion", owner);
}

/// The rotation vector [rad] from one orientation to another that is nearest to `expected`.
Vec3 turn_between(const Quaternion& from, const Quaternion& to, const Vec3& expected) {
  const Eigen::AngleAxisd turn(to * from.conjugate());
  const double whole = 2 * std::numbers::pi;
  const double turns = std::round((turn.axis().dot(expected) - turn.angle()) / whole);
  return (turn.angle() + turns * whole) * turn.axis();
}

void check_load(const Model& model, const Load& load) {
  check_body(model, load.body, "load");
  require(
      load.force.allFinite() && load.torque.allFinite() && load.velocity.allFinite() && load.spin.allFinite(),
      "the load of body {} must be finite", model.bodies.name[load.body]);
  require(
      load.added_mass >= 0 && load.added_inertia >= 0 && std::isfinite(load.added_mass + load.added_inertia),
      "the inertia added to body {} must be ≥ 0; got {} kg and {} kg m²", model.bodies.name[load.body],
      load.added_mass, load.added_inertia);
}

void check_resolved_gaps(const Model& model, std::span<const double> gaps) {
  require(gaps.empty() || gaps.size() == model.bodies.size(),
          "a resolved gap for each of {} bodies is required; got {}", model.bodies.size(), gaps.size());
  for (std::size_t i = 0; i < gaps.size(); ++i)
    require(std::isfinite(gaps[i]) && gaps[i] > 0, "the resolved gap of body {} must be > 0 m; got {}",
            model.bodies.name[i], gaps[i]);
}

/// Nothing moves along this axis, nor does it move others.
void hold(Eigen::Index axis, Eigen::MatrixXd& inertia) {
  constexpr double very_heavy = 1e100;
  inertia.row(axis).setZero();
  inertia.col(axis).setZero();
  inertia(axis, axis) = very_heavy;
}

/// Finds all that acts on each other first, which a state that was just made or resumed does not know.
Energies energies_of(const Model& model, State state) {
  find_neighbours(model, widest_attraction(model), state);
  return energies(model, state);
}

void add_difference(const Energies& more, const Energies& less, Energies& sum) {
  for (double Energies::*part : all_energies) sum.*part += more.*part - less.*part;
}

}  // namespace

Solver::Solver(const Problem& problem) {
  Findings wrong;
  *this = Solver(problem, wrong);
  wrong.raise();
}

Solver::Solver(const Problem& problem, Findings& wrong) : model_(make_model(problem, wrong)) {
  if (wrong.has_errors()) return;
  accepted_.motions = initial_motions(problem);
  accepted_.wall_contacts.motions = at_start(model_.walls);
  find_neighbours(model_, 0, accepted_);
  check_overlaps(model_, accepted_, wrong);
  if (model_.accounts_energy) start_ = energies_of(model_, accepted_);
  restore();
}

Advanced Solver::advance(double time_step, std::span<const Load> loads,
                         std::span<const Prescribed> prescribed, std::span<const double> resolved_gaps,
                         std::span<const Prescribed> walls, std::span<const double> resistance) {
  require(std::isfinite(time_step) && time_step > 0, "a time_step > 0 s is required; got {}", time_step);
  check_resolved_gaps(model_, resolved_gaps);
  restore();
  set_inertia(loads, resistance, time_step);
  set_loads(loads, time_step);
  start_prescribed(prescribed, time_step);
  start_walls(walls, time_step);
  const Advanced outcome = integrate(model_, loads_, inertia_, resolved_gaps, time_step, trial_);
  finish_prescribed(prescribed);
  finish_walls(walls);
  return outcome;
}

void Solver::accept(std::span<const std::uint32_t> leaving) {
  accepted_ = trial_;
  if (leaving.empty()) return;
  const Energies before = model_.accounts_energy ? energies_of(model_, accepted_) : Energies{};
  for (const std::uint32_t i : leaving) {
    check_body(model_, i, "departure");
    require(model_.bodies.is_free(i), "a body that leaves must be free and there; {} is not",
            model_.bodies.name[i]);
    model_.bodies.take_out(i);
    accepted_.left.push_back(i);
    accepted_.motions.velocity[i].setZero();
    accepted_.motions.spin[i].setZero();
  }
  forget_contacts_of_left(model_, accepted_);
  if (model_.accounts_energy) add_difference(before, energies_of(model_, accepted_), accepted_.taken);
  restore();
}

std::vector<std::uint32_t> Solver::contacts() const {
  std::vector<std::uint32_t> count(model_.bodies.size());
  each_acting(model_, trial_, 0, [&count](const Near& near) {
    if (near.at.gap >= 0) return;
    ++count[near.a];
    if (!near.wall()) ++count[near.b];
  });
  return count;
}

void Solver::set_inertia(std::span<const Load> loads, std::span<const double> resistance, double time_step) {
  Bodies& bodies = model_.bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i) bodies.set_added(i, 0, 0);
  std::vector<std::uint32_t> moved;
  for (const Load& load : loads) {
    check_load(model_, load);
    bodies.set_added(load.body, load.added_mass, load.added_inertia);
    moved.push_back(load.body);
  }
  for (std::size_t i = 0; i < bodies.size(); ++i)
    require(!bodies.is_free(i) || std::isfinite(bodies.inverse_mass[i]),
            "free body {} has no mass, and no fluid adds any: give it a density", bodies.name[i]);
  const auto n = static_cast<Eigen::Index>(3 * moved.size());
  require(
      resistance.empty() || (model_.plane && resistance.size() == static_cast<std::size_t>(n * n)),
      "a resistance of 3 rows and columns for each of {} bodies of a plane scene is required; got {} numbers",
      moved.size(), resistance.size());
  if (resistance.empty()) {
    inertia_ = {};
    return;
  }
  using ByRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::MatrixXd matrix = time_step * Eigen::Map<const ByRows>(resistance.data(), n, n);
  require(matrix.allFinite(), "a finite resistance is required");
  for (std::size_t k = 0; k < moved.size(); ++k)
    if (bodies.inverse_inertia[moved[k]] == 0) hold(3 * static_cast<Eigen::Index>(k) + 2, matrix);
  if (!inertia_.is(moved, matrix)) inertia_ = {std::move(moved), matrix};
}

/// The whole weight m g, as the fluid's force includes the buoyancy; in a plane scene only what acts in the
/// plane. Added inertia moves with the body: (m + m_a) dv/dt = F + m_a (V − v_n)/Δt, which is F alone where
/// the body ends with V. Linear loads go on from where those of the last accepted step ended; those of the
/// first are held.
void Solver::set_loads(std::span<const Load> loads, double time_step) {
  const Bodies& bodies = model_.bodies;
  Forces others(bodies.size()), exerted(bodies.size()), gained(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) others.force[i] = bodies.mass[i] * model_.gravity;
  const Vec3 force_axes = model_.plane ? Vec3(1, 1, 0) : Vec3(1, 1, 1);
  const Vec3 torque_axes = model_.plane ? Vec3(0, 0, 1) : Vec3(1, 1, 1);
  for (const Load& load : loads) {
    const std::uint32_t i = load.body;
    const Vec3 rise = (load.velocity - trial_.motions.velocity[i]) / time_step;
    const Vec3 spin_up = (load.spin - trial_.motions.spin[i]) / time_step;
    exerted.force[i] += load.force.cwiseProduct(force_axes);
    exerted.torque[i] += load.torque.cwiseProduct(torque_axes);
    gained.force[i] = bodies.mass[i] * rise.cwiseProduct(force_axes);
    gained.torque[i] = bodies.inertia[i] * spin_up.cwiseProduct(torque_axes);
    others.force[i] += load.added_mass * rise.cwiseProduct(force_axes);
    others.torque[i] += load.added_inertia * spin_up.cwiseProduct(torque_axes);
  }
  if (!inertia_.empty()) share_expected_contacts(gained, exerted, others);
  loads_ = {.start = std::move(others), .growth = {}};
  const bool grows = model_.loads_are_linear && !accepted_.loads.empty();
  loads_.start.add(1, grows ? accepted_.loads : exerted);
  if (grows) {
    loads_.growth = exerted;
    loads_.growth.add(-1, accepted_.loads);
  }
  if (model_.loads_are_linear) trial_.loads = std::move(exerted);
}

/// The contacts that the fluid's V goes with exert C = m (V − v_n)/Δt − F − m g in the mean. The bodies share
/// what is pushed, so without contacts they would lose K⁻¹ C, K the inertia of all of them with the fluid,
/// where each by itself would lose C/(m + m_a).
void Solver::share_expected_contacts(const Forces& gained, const Forces& exerted, Forces& others) const {
  const Bodies& bodies = model_.bodies;
  Eigen::VectorXd expected(inertia_.n_rows());
  inertia_.each_body([&](std::uint32_t i, Eigen::Index at) {
    const Vec3 force = gained.force[i] - exerted.force[i] - bodies.mass[i] * model_.gravity;
    expected.segment<3>(at) << force.head<2>(), gained.torque[i].z() - exerted.torque[i].z();
  });
  const Eigen::VectorXd lost = inertia_.accelerations(expected);
  inertia_.each_body([&](std::uint32_t i, Eigen::Index at) {
    others.force[i].head<2>() += expected.segment<2>(at) - lost.segment<2>(at) / bodies.inverse_mass[i];
    if (bodies.inverse_inertia[i] > 0)
      others.torque[i].z() += expected[at + 2] - lost[at + 2] / bodies.inverse_inertia[i];
  });
}

/// Bodies that are not free have the velocity of the way they go, and the mean of their spins.
void Solver::start_prescribed(std::span<const Prescribed> prescribed, double time_step) {
  Motions& motions = trial_.motions;
  for (std::size_t i = 0; i < model_.bodies.size(); ++i) {
    if (model_.bodies.is_free(i)) continue;
    motions.velocity[i].setZero();
    motions.spin[i].setZero();
  }
  for (const Prescribed& end : prescribed) {
    check_body(model_, end.body, "prescribed motion");
    const std::string& name = model_.bodies.name[end.body];
    require(!model_.bodies.is_free(end.body), "body {} is free and cannot have a prescribed motion", name);
    check_motion(end, "body " + name);
    motions.velocity[end.body] = (end.position - motions.position[end.body]) / time_step;
    motions.spin[end.body] = 0.5 * (accepted_.motions.spin[end.body] + end.spin);
  }
}

void Solver::finish_prescribed(std::span<const Prescribed> prescribed) {
  for (const Prescribed& end : prescribed) {
    trial_.motions.position[end.body] = end.position;
    trial_.motions.orientation[end.body] = {end.orientation, Vec3::Zero()};
    trial_.motions.velocity[end.body] = end.velocity;
    trial_.motions.spin[end.body] = end.spin;
  }
}

/// Walls turn at the one rate that leads to their orientation at the end: of those a whole turn apart it is
/// the nearest to the mean of their spins.
void Solver::start_walls(std::span<const Prescribed> walls, double time_step) {
  WallMotions& motions = trial_.wall_contacts.motions;
  for (WallMotion& motion : motions) motion.velocity = motion.spin = Vec3::Zero();
  for (const Prescribed& end : walls) {
    require(end.body < motions.size(), "a wall's motion must be of one of {} walls; got number {}",
            motions.size(), end.body);
    const Wall& wall = model_.walls.walls[end.body];
    require(wall.moves, "wall {} has no velocity or spin and cannot move", wall.name);
    check_motion(end, "wall " + wall.name);
    WallMotion& motion = motions[end.body];
    motion.velocity = (end.position - motion.position) / time_step;
    const Vec3 mean = 0.5 * (accepted_.wall_contacts.motions[end.body].spin + end.spin);
    motion.spin = turn_between(motion.orientation, end.orientation, time_step * mean) / time_step;
  }
  trial_.wall_contacts.speed = largest_speed(model_.walls, motions, trial_.motions.position);
}

void Solver::finish_walls(std::span<const Prescribed> walls) {
  for (const Prescribed& end : walls)
    trial_.wall_contacts.motions[end.body] = {end.position, end.orientation, end.velocity, end.spin};
}

void Solver::check_none_lost(double time) const {
  const Box& expected = model_.expected;
  for (std::size_t i = 0; i < model_.bodies.size(); ++i) {
    const Vec3 x = model_.periodic.inside(accepted_.motions.position[i]);
    if (!model_.bodies.is_free(i) || expected.contains(x)) continue;
    fail(
        "free bodies must stay between {} and {} m; {} is lost: it is at {} m at t = {:.6g} s. Close the "
        "walls that it left through, or let it go farther by dem.lost_distance",
        text(expected.min()), text(expected.max()), model_.bodies.name[i], text(x), time);
  }
}

std::optional<EnergyAccount> Solver::energies() const {
  if (!model_.accounts_energy) return std::nullopt;
  return energy_account(start_, energies_of(model_, accepted_), accepted_);
}

std::vector<std::uint8_t> Solver::checkpoint() {
  forget_search(accepted_);
  restore();
  return to_bytes(accepted_);
}

void Solver::resume(std::span<const std::uint8_t> bytes) {
  accepted_ = from_bytes(bytes, model_);
  for (const std::uint32_t i : accepted_.left) model_.bodies.take_out(i);
  restore();
}

}  // namespace fpi::dem
