#include "fluid/solve/newton.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "fluid/linear/anderson.hpp"

namespace fpi::fluid {
namespace {

constexpr double smallest_damping = 0.25;
constexpr double best_ratio = 0.05;  ///< a faster contraction is not trusted to go on

/// Velocities below this are round-off of the pressure: p · min(h/μ, Δt/(ρh)) · 1e-13, times the root of the
/// number.
double round_off_velocity(const Flow& flow, const TimeTerms& time, const Fields& fields, double h) {
  const double viscous = h / flow.viscosity;
  const double mobility =
      time.inertia > 0 ? std::min(viscous, 1 / (time.inertia * flow.density * h)) : viscous;
  return 1e-13 * mobility * fields.p.lpNorm<Eigen::Infinity>() *
         std::sqrt(static_cast<double>(fields.u.size()));
}

/// Why an iteration cannot go on.
struct Failed {
  std::string reason;
};

class Iteration {
 public:
  Iteration(System& system, const Flow& flow, const TimeTerms& time, const scene::Newton& parameters,
            Iterate& iterate, Profiler& monitor)
      : system_(system),
        flow_(flow),
        time_(time),
        parameters_(parameters),
        iterate_(iterate),
        monitor_(monitor),
        weight_(system.velocity_weight()) {}

  NewtonResult run() {
    try {
      correct();
      while (!is_small(length_)) {
        const double before = length_;
        if (!try_step()) continue;
        const double ratio = length_ / before;
        slowest_ = std::max({ratio, last_ratio_, best_ratio});
        last_ratio_ = ratio;
        if (slowest_ < 0.5 && is_small(slowest_ / (1 - slowest_) * length_)) break;
        if (damping_ < 1 || !factor_pays()) {
          damping_ = std::min(1.0, 2 * damping_);
          correct_anew();
        }
      }
      finish();
    } catch (const Failed& failed) {
      result_.reason = failed.reason;
    }
    return result_;
  }

 private:
  /// δ = −M⁻¹ F(x), with M made at x where there is none.
  void correct() {
    if (result_.iterations == parameters_.max_iterations) give_up();
    ++result_.iterations;
    count("newton_iterations");
    if (flow_.convection == 0 && !corrector().is_exact && result_.iterations == parameters_.max_iterations)
      corrector() = {};  // the last one is to be with an exact factor
    fresh_ = false;
    const bool is_missing = !corrector().factor;
    const Vector residual = assemble(is_missing);
    if (is_missing) make_factor();
    monitor_.phase("solve");
    const ScopedTimer timer(monitor_.timers, "solve");
    count("solves");
    correction_ = -corrector().factor->solve(residual);
    corrector().cost += corrector().factor->solve_cost();
    length_ = weight_.cwiseProduct(correction_).norm();
    if (fresh_ && !std::isfinite(length_)) throw Failed{"the solution is not finite"};
  }

  void correct_anew() {
    iterate_.corrector = {};
    anderson_.clear();
    last_ratio_ = 0;
    correct();
  }

  Vector assemble(bool with_jacobian) {
    monitor_.phase("assembly");
    const ScopedTimer timer(monitor_.timers, "assembly");
    count("residuals");
    if (with_jacobian) count("jacobians");
    return system_.gather(system_.assemble(flow_, iterate_.fields, time_, with_jacobian));
  }

  void make_factor() {
    monitor_.phase("factor");
    const ScopedTimer timer(monitor_.timers, "factor");
    const auto offered = corrector().reference;
    corrector().factor = system_.factor(time_, corrector().reference, monitor_.timers);
    fresh_ = corrector().reference != offered;
    corrector().is_exact = fresh_ && flow_.convection == 0;
    count(fresh_ ? "factorisations" : "zone_factorisations");
    if (fresh_) corrector().cost = 0;
    corrector().cost += corrector().factor->factor_cost();
    if (!corrector().factor->is_singular()) return;
    iterate_.corrector = {};
    throw Failed{
        "the matrix is singular (arcs far shorter than the elements, or bodies on top of each other?)"};
  }

  /// Moves to the next iterate and finds the correction there. False where that is no better (natural
  /// monotonicity): then x is as before, and the factor is new or the step shorter.
  bool try_step() {
    const Fields fields = iterate_.fields;
    const Vector correction = correction_;
    const double length = length_;
    const bool was_fresh = fresh_;
    system_.add(damping_ < 1 ? Vector(damping_ * correction_) : anderson_.step(correction_, weight_), 1,
                iterate_.fields);
    correct();
    if (length_ <= (1 - damping_ / 4) * length) return true;
    iterate_.fields = fields;
    if (!was_fresh) {
      correct_anew();
      return false;
    }
    anderson_.clear();
    fresh_ = true;
    correction_ = correction;
    length_ = length;
    damping_ /= 2;
    count("damped_steps");
    if (damping_ < smallest_damping)
      throw Failed{
          fmt::format("Newton's iteration stalls: even {:g} of a step does not bring it closer; the "
                      "last update was {:.3g} of the velocity; {}",
                      2 * damping_, relative(length_), system_.largest_residual(assemble(false)))};
    return false;
  }

  /// True while the corrections that are left cost less than a new factor and the three that it would take.
  bool factor_pays() const {
    if (slowest_ >= 1) return false;
    const double left = std::log(target() / length_) / std::log(slowest_);
    const Corrector& corrector = iterate_.corrector;
    const double solve_cost = corrector.factor->solve_cost();
    return left * solve_cost < corrector.reference->factor->factor_cost() + 3 * solve_cost;
  }

  void finish() {
    system_.add(anderson_.step(correction_, weight_), 1, iterate_.fields);
    result_.update = relative(length_);
    if (!iterate_.fields.u.allFinite() || !iterate_.fields.p.allFinite() ||
        !iterate_.fields.lambda.allFinite())
      throw Failed{"the solution is not finite"};
    result_.converged = true;
  }

  [[noreturn]] void give_up() {
    throw Failed{fmt::format(
        "Newton's iteration did not reach {:g} in {} corrections; the last was {:.3g} of "
        "the velocity; {}",
        parameters_.relative_tolerance, parameters_.max_iterations, relative(length_),
        system_.largest_residual(system_.gather(system_.assemble(flow_, iterate_.fields, time_, false))))};
  }

  bool is_small(double length) const {
    return (flow_.convection == 0 && iterate_.corrector.is_exact) || length <= target();
  }
  double target() const {
    return std::max(parameters_.relative_tolerance * size(),
                    round_off_velocity(flow_, time_, iterate_.fields, system_.smallest_size()));
  }
  double size() const { return iterate_.fields.u.norm(); }
  double relative(double length) const { return size() > 0 ? length / size() : 0; }
  Corrector& corrector() { return iterate_.corrector; }
  void count(const char* what) { monitor_.timers.counts[what] += 1; }

  System& system_;
  const Flow& flow_;
  const TimeTerms& time_;
  const scene::Newton& parameters_;
  Iterate& iterate_;
  Profiler& monitor_;
  const Vector weight_;
  Anderson anderson_;
  NewtonResult result_;
  Vector correction_;
  double length_ = 0;                    // of the correction's velocities [m/s]
  bool fresh_ = false;                   // the factor was made at x
  double damping_ = 1;                   // λ
  double last_ratio_ = 0, slowest_ = 1;  // of lengths from one correction to the next
};

}  // namespace

NewtonResult solve(System& system, const Flow& flow, const TimeTerms& time, const scene::Newton& parameters,
                   Iterate& iterate, Profiler& monitor) {
  return Iteration(system, flow, time, parameters, iterate, monitor).run();
}

}  // namespace fpi::fluid
