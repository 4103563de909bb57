#include "dem/integrator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dem/attraction.hpp"
#include "dem/films.hpp"
#include "dem/forces.hpp"

namespace fpi::dem {
namespace {

constexpr double worth_flying = 4;      ///< sub-steps that a flight must save
constexpr double most_sub_steps = 1e8;  ///< in one step of the coupling, flights included

class Integration {
 public:
  Integration(const Model& model, const Forces& loads, std::span<const double> resolved_gaps, State& state)
      : model_(model),
        loads_(loads),
        state_(state),
        motions_(state.motions),
        neighbours_(state.neighbours),
        films_(model, resolved_gaps),
        forces_(loads),
        velocity_now_(motions_.velocity),
        spin_now_(motions_.spin) {
    if (neighbours_.origin.empty() || neighbours_.reach < reach()) search_neighbours();
  }

  Advanced run(double duration) {
    for (left_ = duration; left_ > 0 && outcome_.converged;) {
      const Outlook ahead = look_ahead(model_, state_, loads_, left_);
      const double film_step = films_.longest_step(state_, loads_);
      films_.place(state_);
      const bool flies = std::isinf(ahead.free_time) || ahead.free_time > worth_flying * ahead.contact_step;
      if (flies && films_.empty()) {
        fly(ahead, film_step);
      } else {
        take_sub_steps(std::min(film_step, flies ? ahead.free_time : ahead.contact_step));
      }
      check_finite();
    }
    for (Orientation& orientation : motions_.orientation) orientation.settle();
    return outcome_;
  }

 private:
  /// One step through free space, as far as nothing can touch, no film begins and the search for neighbours
  /// holds. It ends a sub-step before the surfaces meet, so that the contact starts among sub-steps.
  void fly(const Outlook& ahead, double film_step) {
    const double before_contact =
        std::isinf(ahead.free_time) ? ahead.free_time : ahead.free_time - ahead.contact_step;
    const double wanted = std::min({left_, before_contact, film_step, model_.largest_sub_step});
    const double within_skin = time_within_skin(model_, state_, loads_);
    const bool moved = neighbours_.origin != motions_.position || state_.wall_contacts.moved > 0;
    if (within_skin < wanted && moved) return search_neighbours();
    const double duration = std::min(wanted, within_skin);
    if (!is_affordable(left_ / duration)) return;
    forces_ = loads_;
    forces_stand_ = false;
    kick(0.5 * duration);
    drift(duration);
    kick(0.5 * duration);
    left_ -= duration;
    ++outcome_.sub_steps;
    outcome_.contacts = 0;
  }

  /// About one contact time of sub-steps, or what is left; ends early where a search finds new neighbours,
  /// and after each sub-step where there are films, whose step follows the gap.
  void take_sub_steps(double sub_step_wanted) {
    // Steps that keep their length keep the integrator symplectic: a hundredth is not worth another one.
    const double longest = std::min(sub_step_wanted, model_.largest_sub_step);
    const double wanted = std::max(1.0, std::ceil(left_ / longest - 0.01));
    if (!is_affordable(wanted)) return;
    const double dt = left_ / wanted;
    films_.prepare(0.5 * dt);
    if (!forces_stand_) find_forces_at_start(dt);
    const double batch = films_.empty() ? std::min(wanted, std::ceil(model_.steps_per_contact)) : 1;
    const std::uint64_t searches = outcome_.searches;
    double taken = 0;
    while (taken < batch && outcome_.converged && outcome_.searches == searches) {
      sub_step(dt);
      ++taken;
    }
    left_ = taken < wanted ? left_ - taken * dt : 0;
  }

  void sub_step(double dt) {
    kick(0.5 * dt);
    films_.damp(motions_.velocity, motions_.spin);
    drift(dt);
    if (moved_beyond_skin()) search_neighbours();
    films_.place(state_);
    films_.prepare(0.5 * dt);
    extrapolate(0.5 * dt);
    films_.damp(velocity_now_, spin_now_);
    find_forces(dt, dt);
    kick(0.5 * dt);
    films_.damp(motions_.velocity, motions_.spin);
    ++outcome_.sub_steps;
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

  void kick(double duration) {
    for (std::size_t i = 0; i < motions_.velocity.size(); ++i) {
      motions_.velocity[i] += duration * model_.bodies.inverse_mass[i] * forces_.force[i];
      motions_.spin[i] += duration * model_.bodies.inverse_inertia[i] * forces_.torque[i];
    }
  }

  void drift(double duration) {
    for (std::size_t i = 0; i < motions_.position.size(); ++i) {
      motions_.position[i] += duration * motions_.velocity[i];
      motions_.orientation[i].turn(duration * motions_.spin[i]);
    }
    state_.wall_contacts.drift(duration);
  }

  /// Velocities after the second half of a sub-step as the forces of its first half would have them: with
  /// these the dashpots keep the order 2.
  void extrapolate(double duration) {
    for (std::size_t i = 0; i < motions_.velocity.size(); ++i) {
      velocity_now_[i] = motions_.velocity[i] + duration * model_.bodies.inverse_mass[i] * forces_.force[i];
      spin_now_[i] = motions_.spin[i] + duration * model_.bodies.inverse_inertia[i] * forces_.torque[i];
    }
  }

  void find_forces_at_start(double dt) {
    velocity_now_ = motions_.velocity;
    spin_now_ = motions_.spin;
    find_forces(0, dt);
  }

  void find_forces(double stretch_time, double dt) {
    forces_ = loads_;
    const Velocities velocities{motions_.velocity, motions_.spin, velocity_now_, spin_now_};
    const ContactCount count = add_contacts(model_, motions_.position, velocities, stretch_time, dt,
                                            neighbours_, state_.wall_contacts, forces_);
    add_attractions(model_, state_, forces_);
    forces_stand_ = true;
    outcome_.contacts = count.touching;
    outcome_.largest_overlap = std::max(outcome_.largest_overlap, count.largest_overlap);
    if (!count.too_deep.empty()) {
      stop(fmt::format(
          "{} overlap by more than a radius: take a shorter time step, or a larger youngs_modulus",
          count.too_deep));
    }
  }

  bool moved_beyond_skin() const {
    if (state_.wall_contacts.moved > 0.5 * neighbours_.skin) return true;
    const double allowed = 0.25 * neighbours_.skin * neighbours_.skin;
    for (std::size_t i = 0; i < motions_.position.size(); ++i) {
      // Written so that a position that is not a number counts as moved.
      if (!((motions_.position[i] - neighbours_.origin[i]).squaredNorm() <= allowed)) return true;
    }
    return false;
  }

  /// The gap at which surfaces begin to act on each other [m].
  double reach() const { return std::max(films_.reach(), widest_attraction(model_)); }

  void search_neighbours() {
    check_finite();
    if (!outcome_.converged) return;
    find_neighbours(model_, reach(), state_);
    ++outcome_.searches;
  }

  void check_finite() {
    for (std::size_t i = 0; i < motions_.position.size() && outcome_.converged; ++i) {
      const double sum = motions_.position[i].squaredNorm() + motions_.velocity[i].squaredNorm() +
                         motions_.spin[i].squaredNorm();
      if (!std::isfinite(sum)) {
        stop(fmt::format(
            "body {} has a position, velocity or spin that is not finite: take a shorter time step",
            model_.bodies.name[i]));
      }
    }
  }

  void stop(std::string reason) {
    outcome_.converged = false;
    outcome_.reason = std::move(reason);
  }

  const Model& model_;
  const Forces& loads_;
  State& state_;
  Motions& motions_;
  Neighbours& neighbours_;
  Films films_;
  Forces forces_;
  std::vector<Vec3> velocity_now_, spin_now_;
  bool forces_stand_ = false;  ///< forces_ are those of the current motions
  double left_ = 0;            ///< [s] of the step
  Advanced outcome_;
};

}  // namespace

Advanced integrate(const Model& model, const Forces& loads, std::span<const double> resolved_gaps,
                   double duration, State& state) {
  return Integration(model, loads, resolved_gaps, state).run(duration);
}

}  // namespace fpi::dem
