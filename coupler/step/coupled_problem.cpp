#include "step/coupled_problem.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

#include "core/error.hpp"

namespace fpi {
namespace {

/// Only where a fluid answers to the motion is there something to iterate on.
std::span<const scene::Body> coupled_bodies(const scene::Scene& scene) {
  return scene.fluid ? std::span<const scene::Body>(scene.bodies) : std::span<const scene::Body>();
}

/// Whether the fluid solves the free bodies' balances: it can, and the scene does not ask otherwise.
bool lets_fluid_move_bodies(const scene::Coupling& coupling, const Participants& participants) {
  const std::string& asked = coupling.response;
  require(
      asked != "fluid" || participants.fluid_moves_bodies,
      "coupling.response = \"fluid\" needs a fluid that offers \"balance\"; this one does not: take \"auto\" "
      "or \"analytic\"");
  return participants.fluid_moves_bodies && (asked == "auto" || asked == "fluid");
}

Eigen::VectorXd displaced_mass(const scene::Scene& scene, const coupling::RigidDofs& dofs) {
  if (!scene.fluid) return Eigen::VectorXd::Zero(dofs.size());
  return coupling::displaced_mass(dofs, *scene.fluid, scene.hydraulic_radius_ratio);
}

constexpr std::uint32_t most_recuts = 2;  ///< in a step

Eigen::VectorXd weights(const coupling::RigidDofs& dofs, const std::vector<double>& gravity) {
  Eigen::VectorXd force = dofs.inertia();
  for (Eigen::Index k = 0; k < dofs.size(); k += 3)
    force.segment<3>(k).array() *= Eigen::Array3d(gravity[0], gravity[1], 0);
  return force;
}

}  // namespace

CoupledProblem::CoupledProblem(const scene::Scene& scene, Participants participants, std::uint64_t run)
    : scene_(scene),
      run_(run),
      dofs_(coupled_bodies(scene), scene.thickness),
      fluid_can_move_bodies_(participants.fluid_moves_bodies),
      fluid_moves_bodies_(lets_fluid_move_bodies(scene.coupling, participants)),
      solvers_(scene, dofs_, participants, fluid_moves_bodies_),
      predictor_(scene.coupling.predictor),
      forecast_(dofs_.inertia(), displaced_mass(scene, dofs_)),
      iteration_(scene.coupling, dofs_),
      // Before the first step this is all that is known of what the DEM adds.
      force_of_dem_(weights(dofs_, scene.gravity)) {
  for (const scene::Body& body : scene.bodies) {
    coupling::RigidMotion motion = coupling::initial_motion(body);
    prescribed_.emplace_back();
    if (!body.is_free()) {
      prescribed_.back().emplace(body);
      motion = prescribed_.back()->with_velocities(motion, 0);
    }
    accepted_.motions.push_back(motion);
    accepted_.cut_at.push_back(motion.position);
  }
  accepted_.loads.resize(scene.bodies.size());
  if (scene.fluid) float_in_still_fluid();
  accepted_.contacts.resize(scene.bodies.size());
  accepted_.left.resize(scene.bodies.size());
  accepted_.departed.resize(scene.outlets.size());
  for (const scene::Wall& wall : scene.walls) {
    if (!wall.moves()) continue;
    moving_walls_.emplace_back(wall);
    const coupling::RigidMotion start{.position = coupling::to_eigen(scene::to_vec3(wall.centre))};
    accepted_.walls.push_back(moving_walls_.back().with_velocities(start, 0));
  }
}

/// Before the first step this is all that is known of the fluid's force.
void CoupledProblem::float_in_still_fluid() {
  for (const std::size_t i : dofs_.bodies()) {
    const scene::Body& body = scene_.bodies[i];
    const double volume = body.volume(scene_.hydraulic_radius_ratio * body.radius, scene_.thickness);
    accepted_.loads[i].force =
        -scene_.fluid->density * volume * coupling::to_eigen(scene::to_vec3(scene_.gravity));
  }
}

Attempt CoupledProblem::attempt(double start, double end, double time_step) {
  begin_trial(start, end, time_step);
  Eigen::VectorXd force_of_dem = force_of_dem_;
  const Eigen::VectorXd velocities = place_first(start, force_of_dem);
  iterate(fluid_moves_bodies_ ? iterate_of(force_of_dem) : velocities);
  while (is_badly_placed()) {
    ++trial_.report.recuts;
    const Eigen::VectorXd found = dofs_.velocities(trial_.state.motions);
    place_bodies(start, found);
    iterate(fluid_moves_bodies_ ? iterate_of(trial_.force_of_dem) : found);
  }
  return trial_.report;
}

/// Puts the bodies where the predicted velocities bring them, and returns these.
Eigen::VectorXd CoupledProblem::place_first(double start, Eigen::VectorXd& force_of_dem) {
  Eigen::VectorXd velocities = predictor_.guess(step_start());
  if (fluid_moves_bodies_ && solvers_.dem_takes_added_inertia() && trial_.time_step > 0)
    foresee_contacts(start, velocities, force_of_dem);
  trial_.wants_resistance = bodies_act(force_of_dem_) || bodies_act(force_of_dem);
  place_bodies(start, velocities);
  return velocities;
}

/// The messages are those of the first sub-iteration; without a fluid the grains are moved, which costs
/// little.
Findings CoupledProblem::rehearse(double end, double time_step) {
  begin_trial(0, end, time_step);
  Eigen::VectorXd force_of_dem = force_of_dem_;
  const Eigen::VectorXd velocities = place_first(0, force_of_dem);
  take_iterate(fluid_moves_bodies_ ? iterate_of(force_of_dem) : velocities);
  const proto::Stamp stamp{.run = run_, .step = steps_ + 1, .sub_iteration = 0};
  if (!scene_.fluid) solvers_.advance_dem(stamp, trial_);
  return solvers_.rehearse(stamp, accepted_, trial_);
}

/// What the DEM makes of the predicted velocities, with the fluid's balance as the last steps foretell it:
/// contacts that will open or close change the prediction before the fluid, which costs far more, is asked
/// at all.
void CoupledProblem::foresee_contacts(double start, Eigen::VectorXd& velocities,
                                      Eigen::VectorXd& force_of_dem) {
  if (forecast_.knows()) {
    velocities = forecast_.velocities(trial_.time_step, force_of_dem);
    trial_.resistance = forecast_.resistance(trial_.time_step);
  }
  place_bodies(start, velocities);
  const Eigen::VectorXd gained = velocities - dofs_.velocities(accepted_.motions);
  dofs_.set_loads(dofs_.inertia().cwiseProduct(gained) / trial_.time_step - force_of_dem, trial_.state.loads);
  const proto::Stamp stamp{.run = run_, .step = steps_ + 1, .sub_iteration = 0};
  if (solvers_.advance_dem(stamp, trial_).empty()) {
    const Eigen::VectorXd foreseen = dofs_.velocities(trial_.state.motions);
    force_of_dem += missing_force(foreseen - velocities);
    velocities = foreseen;
  }
  trial_.resistance.resize(0, 0);
  trial_.state.motions = accepted_.motions;
  trial_.state.loads = accepted_.loads;
  trial_.state.contacts = accepted_.contacts;
}

/// Whether contacts or films, not weights alone, are what the DEM adds: then it is worth knowing how the
/// fluid resists all bodies together.
bool CoupledProblem::bodies_act(const Eigen::VectorXd& force_of_dem) const {
  if (!fluid_moves_bodies_ || !solvers_.dem_takes_resistance()) return false;
  const Eigen::VectorXd scale = dofs_.lever().cwiseInverse(), weight = weights(dofs_, scene_.gravity);
  const double acting = of_bodies_there(force_of_dem - weight, accepted_).cwiseProduct(scale).norm();
  const double all = std::max(weight.norm(), dofs_.loads(accepted_.loads).cwiseProduct(scale).norm());
  return acting > std::max(scene_.coupling.relative_tolerance * all, scene_.coupling.absolute_force);
}

/// Zero where a body has left.
Eigen::VectorXd CoupledProblem::of_bodies_there(Eigen::VectorXd unknowns, const CoupledState& state) const {
  unknowns(unknowns_left(state)).setZero();
  return unknowns;
}

/// Those of bodies that have left.
std::vector<Eigen::Index> CoupledProblem::unknowns_left(const CoupledState& state) const {
  std::vector<Eigen::Index> unknowns;
  for (std::size_t k = 0; k < dofs_.bodies().size(); ++k)
    for (Eigen::Index i = 0; i < 3 && !state.is_there(dofs_.bodies()[k]); ++i)
      unknowns.push_back(3 * static_cast<Eigen::Index>(k) + i);
  return unknowns;
}

/// What the DEM exerts more than the fluid was told, as its bodies end that much faster.
Eigen::VectorXd CoupledProblem::missing_force(const Eigen::VectorXd& residual) const {
  if (trial_.resistance.size() > 0) return trial_.resistance * residual;
  return inertia_.cwiseProduct(residual) / trial_.time_step;
}

bool CoupledProblem::is_badly_placed() const {
  const scene::Coupling& asked = scene_.coupling;
  const bool iterates = asked.scheme == "auto" || asked.scheme == "implicit";
  return iterates && asked.recut_above > 0 && trial_.report.converged &&
         trial_.report.miss > asked.recut_above && trial_.report.recuts < most_recuts;
}

/// Exchanges until the step converges or fails, added to those that the trial has seen.
void CoupledProblem::iterate(const Eigen::VectorXd& first) {
  const std::uint32_t before = trial_.report.sub_iterations;
  const coupling::CoupledMap map = [this](const Eigen::VectorXd& x, std::uint32_t k) {
    return exchange(x, k);
  };
  std::vector<coupling::StallEvent> stalls = std::move(trial_.report.stalls);
  coupling::StepResult& result = trial_.report;
  result = iteration_.solve(map, first, inertia_, trial_.time_step, contraction());
  result.sub_iterations += before;
  result.stalls.insert(result.stalls.begin(), stalls.begin(), stalls.end());
  measure_ways();
}

/// How far bodies went, and how far from where they were predicted, against the elements beside them.
void CoupledProblem::measure_ways() {
  if (!solvers_.has_fluid() || trial_.time_step == 0) return;
  double way = 0, miss = 0;
  for (std::size_t i = 0; i < trial_.placed.size(); ++i) {
    const Eigen::Vector3d& found = trial_.state.motions[i].position;
    way = std::max(way, (found - accepted_.motions[i].position).norm() / element_size(i));
    miss = std::max(miss, (found - trial_.placed[i].position).norm() / element_size(i));
  }
  trial_.report.displacement = way;
  trial_.report.miss = miss;
}

double CoupledProblem::element_size(std::size_t body) const {
  return solvers_.arc_lengths()[body] / scene_.fluid->embedding.arc_ratio;
}

coupling::StepStart CoupledProblem::step_start() const {
  return {.velocities = dofs_.velocities(accepted_.motions),
          .force = dofs_.loads(accepted_.loads) + weights(dofs_, scene_.gravity),
          .inertia = dofs_.inertia(),
          .added_inertia = trial_.added,
          .time_step = trial_.time_step};
}

/// What a residual becomes at most in the next sub-iteration, where nothing touches: a body's motion changes
/// the fluid's force on it by its added inertia, or several times that near others; the DEM answers with its
/// mass.
double CoupledProblem::contraction() const {
  constexpr double near_others = 4;
  const bool touches = std::ranges::any_of(trial_.state.contacts, [](std::uint32_t n) { return n > 0; });
  if (fluid_moves_bodies_ || touches || trial_.added.isZero(0)) return 1;
  return near_others * trial_.added.cwiseQuotient(dofs_.inertia()).maxCoeff();
}

void CoupledProblem::begin_trial(double start, double end, double time_step) {
  trial_ = {};
  exchanges_ = 0;
  trial_.end = end;
  trial_.time_step = time_step;
  trial_.placed = accepted_.motions;
  trial_.state.motions = accepted_.motions;
  trial_.state.loads = accepted_.loads;
  for (std::size_t i = 0; i < moving_walls_.size(); ++i)
    trial_.state.walls.push_back(moving_walls_[i].advanced(accepted_.walls[i], start, end));
  trial_.state.cut_at = accepted_.cut_at;
  trial_.state.contacts = accepted_.contacts;
  trial_.state.left = accepted_.left;
  trial_.state.departed = accepted_.departed;
  trial_.state.onset = accepted_.onset;
  trial_.added = scene_.fluid && scene_.coupling.response != "none"
                     ? coupling::added_inertia(dofs_, *scene_.fluid, scene_.hydraulic_radius_ratio, time_step)
                     : Eigen::VectorXd::Zero(dofs_.size());
  inertia_ = dofs_.inertia() + trial_.added;
}

/// Free bodies where the predicted velocities bring them, the others where their formulas say. All
/// sub-iterations share the geometry; only velocities change (numerics: re-cutting costs two to three times
/// and changes the speed by 3e-6 to 8e-4).
void CoupledProblem::place_bodies(double start, const Eigen::VectorXd& predicted) {
  dofs_.set_velocities(predicted, trial_.placed);
  trial_.state.arcs.clear();
  for (std::size_t i = 0; i < trial_.placed.size(); ++i) {
    const coupling::RigidMotion& before = accepted_.motions[i];
    coupling::RigidMotion& placed = trial_.placed[i];
    if (!accepted_.is_there(i)) {
      placed = before;
    } else if (prescribed_[i]) {
      placed = trial_.state.motions[i] = prescribed_[i]->advanced(before, start, trial_.end);
    } else {
      placed.position = coupling::trapezoidal_position(before, placed.velocity, trial_.time_step);
      if (stays_cut(i)) placed.position = accepted_.cut_at[i];
    }
    trial_.state.cut_at[i] = placed.position;
    if (!solvers_.has_fluid()) continue;
    trial_.state.arcs.push_back(accepted_.is_there(i) ? surface(i, placed) : coupling::Arcs{});
  }
}

/// Whether a body rests, as far as the fluid's geometry is concerned.
bool CoupledProblem::stays_cut(std::size_t body) const {
  return solvers_.has_fluid() && (trial_.placed[body].position - accepted_.cut_at[body]).norm() <=
                                     scene_.coupling.hold_below * element_size(body);
}

coupling::Arcs CoupledProblem::surface(std::size_t body, const coupling::RigidMotion& placed) const {
  return coupling::cut_surface(scene_.bodies[body], placed, scene_.hydraulic_radius_ratio,
                               solvers_.arc_lengths()[body]);
}

/// Where the fluid moves the bodies: the velocities that the DEM alone would give with all inertia.
Eigen::VectorXd CoupledProblem::iterate_of(const Eigen::VectorXd& force_of_dem) const {
  return dofs_.velocities(accepted_.motions) + trial_.time_step * force_of_dem.cwiseQuotient(inertia_);
}

void CoupledProblem::take_iterate(const Eigen::VectorXd& x) {
  if (fluid_moves_bodies_)
    trial_.force_of_dem = inertia_.cwiseProduct(x - dofs_.velocities(accepted_.motions)) / trial_.time_step;
  else
    dofs_.set_velocities(x, trial_.placed);
}

/// One answer of the fluid and one of the DEM. Both have moved the free bodies then; the residual is by how
/// much they disagree.
coupling::Exchange CoupledProblem::exchange(const Eigen::VectorXd& x, std::uint32_t sub_iteration) {
  const proto::Stamp stamp{.run = run_, .step = steps_ + 1, .sub_iteration = sub_iteration};
  take_iterate(x);
  coupling::Exchange answer;
  answer.reason = solvers_.advance_fluid(stamp, accepted_, trial_);
  if (answer.reason.empty()) answer.reason = solvers_.advance_dem(stamp, trial_);
  answer.converged = answer.reason.empty();
  answer.velocities = dofs_.velocities(trial_.state.motions);
  answer.forces = dofs_.loads(trial_.state.loads);
  answer.fluid_speed = trial_.fluid_speed;
  answer.residual = answer.velocities - dofs_.velocities(trial_.placed);
  answer.is_newton = trial_.resistance.size() > 0;
  if (answer.is_newton)
    answer.residual = trial_.time_step * missing_force(answer.residual).cwiseQuotient(inertia_);
  if (!solvers_.dem_takes_added_inertia())
    answer.residual.array() *= dofs_.inertia().array() / inertia_.array();
  if (fluid_moves_bodies_) trial_.force_of_dem += inertia_.cwiseProduct(answer.residual) / trial_.time_step;
  if (after_sub_iteration) after_sub_iteration(++exchanges_);
  return answer;
}

/// Whether a body or the fluid has a velocity at the start.
bool CoupledProblem::starts_suddenly() const {
  if (!scene_.fluid || scene_.time.steady || !scene_.moves()) return false;
  const auto moves = [](const coupling::RigidMotion& motion) {
    return !motion.velocity.isZero(0) || !motion.spin.isZero(0);
  };
  const auto is_not_zero = [](const std::string& formula) { return formula != "0"; };
  return std::ranges::any_of(accepted_.motions, moves) ||
         std::ranges::any_of(scene_.fluid->initial_velocity, is_not_zero);
}

std::optional<Attempt> CoupledProblem::start_suddenly(double time_step) {
  constexpr double vanishing = 1e-6;
  const bool is_solved = dofs_.bodies().empty() ? fluid_can_move_bodies_ : fluid_moves_bodies_;
  if (!is_solved || !starts_suddenly()) return std::nullopt;
  const Eigen::VectorXd force_of_dem = force_of_dem_;
  Attempt found = attempt(0, 0, vanishing * time_step);
  if (!found.converged) {
    restore();
    return found;
  }
  settle();
  // Forces, accelerations and what the coupling learnt are those of the impulse.
  predictor_ = coupling::Predictor(scene_.coupling.predictor);
  forecast_ = coupling::PredictedForce(dofs_.inertia(), displaced_mass(scene_, dofs_));
  std::vector<Eigen::Index> all(static_cast<std::size_t>(dofs_.size()));
  std::iota(all.begin(), all.end(), 0);
  iteration_.forget(all);
  force_of_dem_ = force_of_dem;
  std::ranges::fill(accepted_.loads, coupling::RigidLoad{});
  float_in_still_fluid();
  return found;
}

void CoupledProblem::accept() {
  settle();
  ++steps_;
}

/// The trial becomes the accepted state.
void CoupledProblem::settle() {
  if (!trial_.state.onset) trial_.state.onset = find_onset(scene_, trial_.state.motions, trial_.end);
  remember_balance();
  departures_ = fpi::departures(scene_, trial_.state, accepted_.motions);
  take_out(departures_, trial_.state);
  forecast_.take_out(unknowns_left(trial_.state));
  solvers_.accept(trial_.state, departures_);
  predictor_.accept(dofs_.velocities(trial_.state.motions));
  iteration_.accept();
  forget_changed_bodies();
  if (fluid_moves_bodies_) force_of_dem_ = of_bodies_there(trial_.force_of_dem, trial_.state);
  accepted_ = std::move(trial_.state);
}

void CoupledProblem::remember_balance() {
  if (!fluid_moves_bodies_ || trial_.time_step == 0) return;
  forecast_.accept(trial_.time_step, dofs_.velocities(accepted_.motions),
                   dofs_.velocities(trial_.state.motions), trial_.force_of_dem, std::move(trial_.resistance));
}

/// A contact that opened or closed makes a body answer in another way, and one that left answers no more.
void CoupledProblem::forget_changed_bodies() {
  const std::vector<std::uint32_t>&before = accepted_.contacts, &now = trial_.state.contacts;
  const bool knows_contacts = !now.empty() && now.size() == before.size();
  std::vector<Eigen::Index> unknowns;
  for (std::size_t k = 0; k < dofs_.bodies().size(); ++k) {
    const std::size_t body = dofs_.bodies()[k];
    const bool touches_others = knows_contacts && before[body] != now[body];
    if (!touches_others && accepted_.left[body] == trial_.state.left[body]) continue;
    for (Eigen::Index i = 0; i < 3; ++i) unknowns.push_back(3 * static_cast<Eigen::Index>(k) + i);
  }
  iteration_.forget(unknowns);
}

void CoupledProblem::restore() {
  solvers_.restore();
  iteration_.reject();
  predictor_.reject();
}

NumbersByName CoupledProblem::numbers() const {
  NumbersByName numbers;
  numbers["steps"] = {static_cast<double>(steps_)};
  numbers["arc_lengths"] = solvers_.arc_lengths();
  numbers["predictor"] = predictor_.state();
  numbers["acceleration"] = iteration_.state();
  numbers["force_of_dem"] = {force_of_dem_.begin(), force_of_dem_.end()};
  numbers["forecast"] = forecast_.state();
  put_numbers(accepted_, numbers);
  return numbers;
}

void CoupledProblem::set_numbers(const NumbersByName& numbers) {
  steps_ = static_cast<std::uint64_t>(numbers.at("steps").at(0));
  predictor_.set_state(numbers.at("predictor"));
  iteration_.set_state(numbers.at("acceleration"));
  const std::vector<double>& force = numbers.at("force_of_dem");
  force_of_dem_ = Eigen::Map<const Eigen::VectorXd>(force.data(), static_cast<Eigen::Index>(force.size()));
  forecast_.set_state(numbers.at("forecast"));
  solvers_.set_arc_lengths(numbers.at("arc_lengths"));
  take_numbers(numbers, accepted_);
}

}  // namespace fpi
