#include "dem/integrate/integrator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "dem/contact/attraction.hpp"
#include "dem/contact/pair_forces.hpp"
#include "dem/integrate/energy.hpp"
#include "dem/integrate/sweep.hpp"
#include "dem/integrate/trapezoidal.hpp"
#include "dem/lubrication/lubrication_forces.hpp"

namespace fpi::dem {
namespace {

constexpr double worth_flying = 4;  ///< sub-steps that a flight must save
constexpr double third = 1.0 / 3;
constexpr double a_little = 1e-6;   ///< of a sub-step: less is not worth one of its own
constexpr double least_batch = 32;  ///< sub-steps for which a look ahead is good, in contacts of few steps
constexpr double instant = 1e-6;    ///< of a sub-step: what implicit ones take contacts as means over
constexpr double agreed = 1e-11;    ///< relative change of velocities at which an implicit sub-step is solved
constexpr int most_iterations = 50;     ///< of an implicit sub-step
constexpr double most_sub_steps = 1e8;  ///< in one step of the coupling, flights included

class Integration {
 public:
  Integration(const Model& model, const Loads& loads, const SharedInertia& inertia,
              std::span<const double> resolved_gaps, double duration, State& state)
      : model_(model),
        loads_(loads),
        inertia_(inertia),
        load_(loads.start),
        duration_(duration),
        state_(state),
        motions_(state.motions),
        lubrication_(model, inertia, resolved_gaps),
        particles_(begin()),
        histories_(state.contacts, *state.neighbours, model.laws.resists_turning()) {
    state_.contacts = {};
    if (model.accounts_energy) meter_.emplace(model);
    note_search();
  }

  Advanced run() {
    for (left_ = duration_; left_ > 0 && outcome_.converged;) {
      write_scene_ordered();
      StepEstimate ahead{left_};
      const double film_step = least_under_loads([&] {
        look_ahead_pairs(model_, *state_.neighbours, particles_, motions_.position, ahead);
        look_ahead_walls(model_, state_, load_, ahead);
        return lubrication_.longest_step(state_, load_);
      });
      lubrication_.place(state_);
      const bool flies = std::isinf(ahead.free_time) || ahead.free_time > worth_flying * ahead.contact_step;
      longest_ = model_.largest_sub_step;
      if (std::isfinite(ahead.contact_step) || !lubrication_.empty())
        longest_ = std::min(longest_, within_quarter_skin());
      if (lubrication_.empty()) {
        const bool iterates = !particles_.load.empty();
        dt_ = sub_step_length(std::min(ahead.contact_step, longest_), dt_, left_, iterates);
        if (!flies || !take_free_flight(ahead, film_step)) take_sub_steps();
      } else {
        dt_ = std::min({film_step, flies ? ahead.free_time : ahead.contact_step, longest_});
        take_sub_steps();
      }
      check_finite();
    }
    particles_.write(motions_);
    state_.contacts = histories_.collect(*state_.neighbours);
    for (Orientation& orientation : motions_.orientation) orientation.settle();
    return outcome_;
  }

 private:
  /// One step through free space, as far as nothing can touch, no film begins and the search for neighbours
  /// holds. It takes the place of whole sub-steps, and moves all as these would, so that the contact it ends
  /// before starts among sub-steps, at a moment that does not depend on how far one flew. False where that is
  /// less than a sub-step.
  bool take_free_flight(const StepEstimate& ahead, double film_step) {
    const double wanted =
        std::min({whole_sub_steps(ahead.free_time - dt_, dt_, left_), film_step, model_.largest_sub_step});
    const double in_skin = least_under_loads(
        [&] { return time_within_skin(*state_.neighbours, state_.wall_contacts, particles_); });
    const double within_skin = whole_sub_steps(in_skin, dt_, left_);
    const bool moved = farthest_moved(*state_.neighbours, particles_) > 0 || state_.wall_contacts.moved > 0;
    if (within_skin < wanted && moved) {
      search_neighbours();
      return true;
    }
    const double duration = std::min(wanted, within_skin);
    if (duration <= 0 && std::isfinite(dt_)) return false;
    if (!is_affordable(left_ / duration)) return true;
    forces_stand_ = false;
    contact_forces_.clear();
    particles_.contact_force.clear();
    sweep({.clear = true});
    load_at(left_ - third * duration);
    move({.kick = 0.5 * duration, .drift = duration});
    load_at(left_ - 2 * third * duration);
    sweep({.kick = 0.5 * duration});
    left_ -= duration;
    ++outcome_.sub_steps;
    outcome_.contacts = 0;
    return true;
  }

  /// Sub-steps of one contact time or more, or what is left; ends early where a search finds new neighbours,
  /// and after each sub-step where there are films, whose step follows the gap.
  void take_sub_steps() {
    if (!is_affordable(left_ / dt_)) return;
    double batch = lubrication_.empty() ? std::max(model_.steps_per_contact, least_batch) : 1;
    batch = std::clamp(std::floor(left_ / dt_ + a_little), 1.0, batch);
    // The last sub-step is shorter, or by a little longer than the others.
    if (left_ - batch * dt_ < a_little * dt_) dt_ = left_ / batch;
    const double at_end = left_ - batch * dt_ < a_little * dt_ ? 0 : left_ - batch * dt_;
    lubrication_.prepare(0.5 * dt_);
    if (!forces_stand_) find_forces_at_start();
    const std::uint64_t searches = outcome_.searches;
    load_at(left_ - third * dt_);
    for (double kick = 0.5 * dt_; batch > 0 && outcome_.converged && outcome_.searches == searches; --batch) {
      left_ = at_end + (batch - 1) * dt_;
      if (!lubrication_.empty()) {
        sub_step_with_films();
      } else if (model_.implicit) {
        implicit_sub_step();
      } else {
        sub_step(kick);
      }
      load_at(left_);
      kick = dt_;
    }
    load_at(left_ + third * dt_);
    if (lubrication_.empty() && !model_.implicit) sweep({.kick = 0.5 * dt_});
  }

  /// From the middle of the last sub-step, or with half the `kick` from its end, to the middle of this one.
  void sub_step(double kick) {
    search_ahead();
    move({.kick = kick, .drift = dt_, .extrapolate = 0.5 * dt_, .clear = true});
    find_forces(dt_, dt_);
    ++outcome_.sub_steps;
  }

  void implicit_sub_step() {
    fastest_ = sweep({});
    moved_ = farthest_moved(*state_.neighbours, particles_);
    search_ahead();
    TrapezoidalStep step(particles_, motions_.orientation, dt_);
    const PairHistories histories = histories_;
    const std::vector<ContactHistory> wall_histories = state_.wall_contacts.histories;
    sweep({.kick = 0.5 * dt_});
    state_.wall_contacts.drift(dt_);
    load_at(left_ + third * dt_);
    for (int k = 0; step.iterate(particles_, motions_.orientation) > agreed || k == 0; ++k) {
      if (k == most_iterations) return stop_unsolved();
      histories_ = histories;
      state_.wall_contacts.histories = wall_histories;
      fastest_ = sweep({.clear = true});
      step.set_ends(particles_);
      find_forces(dt_, instant * dt_);
    }
    step.finish(particles_);
    sweep({.kick = 0.5 * dt_});
    ++outcome_.sub_steps;
  }

  double within_quarter_skin() {
    return least_under_loads(
        [&] { return time_of_quarter_skin(*state_.neighbours, state_.wall_contacts, particles_); });
  }

  /// A search where neighbours might not hold until the end of the sub-step, even if the fastest became twice
  /// as fast in it.
  void search_ahead() {
    const double allowed = 0.5 * state_.neighbours->skin, way = 2 * dt_ * fastest_;
    const WallContacts& walls = state_.wall_contacts;
    if (moved_ + way > allowed) moved_ = farthest_moved(*state_.neighbours, particles_);
    if (moved_ + way > allowed || walls.moved + 2 * dt_ * walls.speed > allowed) search_neighbours();
  }

  void sub_step_with_films() {
    search_ahead();
    sweep({.kick = 0.5 * dt_});
    damp(particles_.half);
    move({.drift = dt_});
    particles_.write(motions_);
    lubrication_.place(state_);
    lubrication_.prepare(0.5 * dt_);
    sweep({.extrapolate = 0.5 * dt_, .clear = true});
    damp(particles_.now);
    find_forces(dt_, dt_);
    load_at(left_ + third * dt_);
    sweep({.kick = 0.5 * dt_});
    damp(particles_.half);
    ++outcome_.sub_steps;
  }

  /// The loads `left` [s] before the end of the step. Half kicks take linear ones at the thirds of the
  /// sub-step on their side, which moves a free body exactly; a kick from middle to middle takes those
  /// between.
  void load_at(double left) {
    if (loads_.held()) return;
    load_ = loads_.at(1 - left / duration_);
    particles_.set_loads(model_, load_);
  }

  /// The least that `find` gives under the loads now and at the end: linear ones are never beyond both.
  template <class Find>
  double least_under_loads(Find find) {
    if (loads_.held()) return find();
    load_at(0);
    const double at_end = find();
    load_at(left_);
    return std::min(at_end, find());
  }

  double sweep(const Sweep& pass) {
    if (meter_ && pass.kick > 0) meter_->add_kick(pass.kick, particles_, contact_forces_, state_.works);
    return pass(particles_, motions_.orientation);
  }

  /// A sweep on which bodies and walls move, and a search where they have left their skin.
  void move(const Sweep& pass) {
    fastest_ = sweep(pass);
    state_.wall_contacts.drift(pass.drift);
    moved_ += fastest_ * pass.drift;
    const double allowed = 0.5 * state_.neighbours->skin;
    if (moved_ > allowed) moved_ = farthest_moved(*state_.neighbours, particles_);
    // Written so that a position that is not a number counts as moved.
    if (!(moved_ <= allowed) || state_.wall_contacts.moved > allowed) search_neighbours();
  }

  void damp(std::vector<Twin>& motion) {
    for (std::size_t k = 0; k < particles_.size(); ++k) {
      velocity_now_[particles_.body[k]] = motion[k].linear.head<3>();
      spin_now_[particles_.body[k]] = motion[k].angular.head<3>();
    }
    const auto kinetic = [&] { return kinetic_energy(model_.bodies, velocity_now_, spin_now_); };
    const bool counts = meter_ && &motion == &particles_.half;
    if (counts) state_.works.films -= kinetic();
    lubrication_.damp(velocity_now_, spin_now_);
    if (counts) state_.works.films += kinetic();
    for (std::size_t k = 0; k < particles_.size(); ++k) {
      motion[k].linear.head<3>() = velocity_now_[particles_.body[k]];
      motion[k].angular.head<3>() = spin_now_[particles_.body[k]];
    }
  }

  void stop_unsolved() {
    stop(
        fmt::format("an implicit sub-step of {:.3g} s must be solved in {} iterations: raise "
                    "dem.steps_per_contact, or take "
                    "dem.scheme = \"verlet\"",
                    dt_, most_iterations));
  }

  /// Stops where `more` steps would be too many.
  bool is_affordable(double more) {
    if (static_cast<double>(outcome_.sub_steps) + more < most_sub_steps) return true;
    stop(fmt::format(
        "at most {:g} sub-steps are allowed; got {:g} for the {} s that are left: take a shorter time step, "
        "a smaller youngs_modulus, or find the body that is too fast",
        most_sub_steps, more, left_));
    return false;
  }

  void find_forces_at_start() {
    fastest_ = sweep({.clear = true});
    find_forces(0, model_.implicit ? instant * dt_ : dt_);
  }

  /// Springs have stretched for `stretch_time` [s] at the middle velocities; contacts are means over
  /// `mean_over` [s].
  void find_forces(double stretch_time, double mean_over) {
    const double reach = dt_ * std::max(fastest_, state_.wall_contacts.speed);
    const SubStep step{stretch_time, mean_over, reach};
    ContactCount count = add_pair_forces(model_, *state_.neighbours, step, histories_, particles_);
    add_scene_ordered(step, count);
    if (!inertia_.empty()) inertia_.answer(particles_);
    forces_stand_ = true;
    contact_forces_ = std::move(count.forces);
    outcome_.contacts = count.touching;
    outcome_.largest_overlap = std::max(outcome_.largest_overlap, count.largest_overlap);
    if (!count.too_deep.empty()) stop_too_deep(count);
  }

  void stop_too_deep(const ContactCount& count) {
    particles_.write(motions_);
    const std::uint32_t i = count.deep_body;
    stop(
        fmt::format("{} overlap by more than a radius: {} would pass through at {} m, with {:.3g} m/s. Take "
                    "a larger {}{}, or "
                    "find what presses it in",
                    count.too_deep, model_.bodies.name[i], text(model_.periodic.inside(motions_.position[i])),
                    motions_.velocity[i].norm(),
                    model_.elasticity == Elasticity::linear ? "normal_stiffness" : "youngs_modulus",
                    model_.stretch > 1 ? ", a smaller dem.stretch" : ""));
  }

  /// The contacts of walls and the attractions read and write in the scene's order, for the particles that
  /// have such.
  void add_scene_ordered(const SubStep& step, ContactCount& count) {
    for (const std::uint32_t k : scene_ordered_) {
      const std::uint32_t i = particles_.body[k];
      particles_.write(k, motions_);
      velocity_now_[i] = particles_.now[k].linear.head<3>();
      spin_now_[i] = particles_.now[k].angular.head<3>();
      forces_.force[i].setZero();
      forces_.torque[i].setZero();
    }
    const Velocities velocities{motions_.velocity, motions_.spin, velocity_now_, spin_now_};
    add_wall_contacts(model_, motions_.position, velocities, step, state_.wall_contacts, forces_, count);
    add_attractions(model_, state_, forces_, count);
    for (const std::uint32_t k : scene_ordered_) {
      const std::uint32_t i = particles_.body[k];
      particles_.force[k].linear.head<3>() += forces_.force[i];
      particles_.force[k].angular.head<3>() += forces_.torque[i];
    }
  }

  void write_scene_ordered() {
    for (const std::uint32_t k : scene_ordered_) particles_.write(k, motions_);
  }

  /// The gap at which surfaces begin to act on each other [m].
  double reach() const { return std::max(lubrication_.reach(), widest_attraction(model_)); }

  Particles begin() {
    if (!state_.neighbours || state_.neighbours->reach < reach()) find_neighbours(model_, reach(), state_);
    return {model_, motions_, load_, state_.neighbours->order};
  }

  void search_neighbours() {
    check_finite();
    if (!outcome_.converged) return;
    particles_.write(motions_);
    state_.contacts = histories_.collect(*state_.neighbours);
    std::vector<std::uint32_t> particle(particles_.size());
    for (std::uint32_t k = 0; k < particle.size(); ++k) particle[particles_.body[k]] = k;
    find_neighbours(model_, reach(), state_);
    std::vector<std::uint32_t> order = state_.neighbours->order;
    for (std::uint32_t& k : order) k = particle[k];
    particles_.reorder(order);
    histories_ = {state_.contacts, *state_.neighbours, model_.laws.resists_turning()};
    ++outcome_.searches;
    note_search();
  }

  /// What follows from a list of neighbours.
  void note_search() {
    moved_ = farthest_moved(*state_.neighbours, particles_);
    std::vector<bool> takes_part(particles_.size(), reach() > 0);
    for (const WallPlace& place : state_.wall_contacts.places) takes_part[place.body] = true;
    scene_ordered_.clear();
    for (std::uint32_t k = 0; k < particles_.size(); ++k) {
      if (takes_part[particles_.body[k]]) scene_ordered_.push_back(k);
    }
    if (scene_ordered_.empty()) return;
    for (auto* values : {&velocity_now_, &spin_now_, &forces_.force, &forces_.torque})
      values->resize(particles_.size());
  }

  void check_finite() {
    for (std::size_t k = 0; k < particles_.size() && outcome_.converged; ++k) {
      const double sum = particles_.place[k].squaredNorm() +
                         particles_.half[k].linear.head<3>().squaredNorm() +
                         particles_.half[k].angular.head<3>().squaredNorm();
      if (!std::isfinite(sum)) {
        stop(fmt::format(
            "body {} has a position, velocity or spin that is not finite: take a shorter time step",
            model_.bodies.name[particles_.body[k]]));
      }
    }
  }

  void stop(std::string reason) {
    outcome_.converged = false;
    outcome_.reason = std::move(reason);
  }

  const Model& model_;
  const Loads& loads_;
  const SharedInertia& inertia_;
  Forces load_;      ///< at the moment
  double duration_;  ///< [s] of the step
  State& state_;
  Motions& motions_;
  LubricationForces lubrication_;
  Particles particles_;
  PairHistories histories_;
  std::vector<std::uint32_t> scene_ordered_;  ///< particles near walls; all where something acts through gaps
  std::vector<Vec3> velocity_now_, spin_now_;
  Forces forces_;                             ///< on these
  std::optional<WorkMeter> meter_;            ///< none: no account of energies
  std::vector<ContactForce> contact_forces_;  ///< those that stand, for the meter
  bool forces_stand_ = false;                 ///< the forces are those of the current motions
  double left_ = 0;                           ///< [s] of the step
  double dt_ = 0;                             ///< [s] the sub-step; infinite where nothing can touch
  double longest_ = never;                    ///< [s] that a sub-step may last, whatever touches
  double fastest_ = 0;                        ///< [m/s] that no body exceeds
  double moved_ = 0;                          ///< [m] that no body has moved farther since the last search
  Advanced outcome_;
};

}  // namespace

Advanced integrate(const Model& model, const Loads& loads, const SharedInertia& inertia,
                   std::span<const double> resolved_gaps, double duration, State& state) {
  return Integration(model, loads, inertia, resolved_gaps, duration, state).run();
}

}  // namespace fpi::dem
