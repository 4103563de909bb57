/// The fluid for a given motion of the bodies: `advance` from the last accepted state as often as the
/// coupling needs, then `accept`, or `restore` and a shorter step. Forces are per metre of thickness.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/findings.hpp"
#include "fluid/base/state.hpp"
#include "fluid/measure/boundary_traction.hpp"
#include "fluid/measure/exact.hpp"
#include "fluid/measure/force_balance.hpp"
#include "fluid/measure/percolation.hpp"
#include "fluid/measure/resolution.hpp"
#include "fluid/measure/volume_balance.hpp"
#include "fluid/solve/factor_cache.hpp"
#include "fluid/solve/history.hpp"
#include "fluid/solve/motion.hpp"

namespace fpi::fluid {

struct Settings {
  scene::Fluid fluid;
  Vec2 gravity = Vec2::Zero();  ///< [m/s²]
  bool bodies_move = false;
};

/// What the fluid is asked for in one sub-iteration.
struct Request {
  double time = 0;       ///< at the end of the step [s]
  double time_step = 0;  ///< [s]; 0: the steady state
  unsigned sub_iteration = 0;
  std::vector<Interface> interfaces;
  bool wants_resistance = false;  ///< see Result; asked with sub-iteration 0, it holds for the step
};

struct BodyTraction {
  Index body = 0;
  std::vector<Vec2> lambda;   ///< force density of the fluid [Pa]: mean of each arc, value at its middle
  Vec2 force = Vec2::Zero();  ///< at the end of the step, with buoyancy and fall of the mean pressure [N/m]
  double torque = 0;          ///< about the centre [N]
  MeanLoad mean;              ///< what the body's momentum gained of the fluid in the step, over Δt
  double arc_length = 0;      ///< wanted next [m]; 0: it meets no element
  RigidVelocity motion;       ///< of the body, as it was given or, where it has a balance, found
};

struct Result {
  NewtonResult newton;
  TimeError time_error;
  std::vector<BodyTraction> tractions;
  /// How forces and torques on the bodies that the fluid moves go with their velocities Vx, Vy and spins ω at
  /// the end of the step, m/Δt included, per metre of thickness, in the order of the interfaces [kg/(m s),
  /// …]: the Schur complement of the step's first factor, or of the older one that it was made from. Without
  /// entries unless wanted and the linear solver gives it.
  Eigen::MatrixXd resistance;
  double speed = 0;  ///< root mean square of the velocity at the nodes in the fluid [m/s]
};

class NavierStokes {
 public:
  NavierStokes(Mesh mesh, Settings settings);

  /// Throws Error where the request makes no sense; not converging is an ordinary outcome.
  /// Sub-iteration 0 starts from the accepted state, k > 0 from the result of k − 1. The same requests give
  /// bitwise the same results.
  Result advance(const Request& request);
  void accept();
  void restore();
  /// What would keep the first step from being taken, or is doubtful in it, found without solving anything:
  /// cut geometry, numbering, formulas, what holds the fluid, what flows into parts of it that are closed. A
  /// step under way is dropped.
  Findings rehearse(const Request& request);

  const Mesh& mesh() const { return space_.mesh; }
  const State& state() const { return accepted_; }
  /// Continues from `state`; drops every cache, so that what follows does not depend on what was before.
  void set_state(State state);
  /// Drops factors; see Participant::checkpoint.
  void drop_caches();

  double arc_length(const Surface& surface) const;
  /// Cells of the accepted state that are in the fluid, wholly or in part.
  std::vector<bool> active_cells() const;
  /// Velocity of each node of the accepted state for pictures [m/s]: inside a body it is the body's, where
  /// the solution itself only has what cut elements extend.
  Vector velocity_with_bodies() const;
  /// Of the Jacobian as it was last assembled, see `condition_estimate`; factors it anew.
  double condition();
  Index n_unknowns() const { return system_ ? system_->n_unknowns() : 0; }
  const Locator& locator() const { return space_.locator; }
  bool has(const Vec2& x) const { return space_.locator.find(x).has_value(); }
  /// Velocity [m/s] and pressure [Pa] of the accepted state; nothing inside a body or outside the mesh.
  std::optional<std::pair<Vec2, double>> at(const Vec2& x) const;
  /// Of the last accepted step; throws Error before the first.
  PoreFlow pore_flow() const;
  Vec2 superficial_velocity() const;  ///< [m/s]
  /// Means over `n` slabs across an axis, the fall of the mean pressure included.
  std::vector<Section> sections(int axis, int n) const;
  std::vector<SpeedBin> speed_histogram(int axis, int n) const;
  /// By how much the pressure falls a metre along an axis [Pa/m]: the mean one where that is periodic, else
  /// between the sides of a rectangle; nothing where they have other names.
  std::optional<double> pressure_fall(int axis);
  /// At vanishing Reynolds number, see measure/percolation.hpp; factors the Stokes equations.
  Eigen::Matrix2d permeability();
  /// Parts of the fluid that no open boundary gives a pressure level.
  std::size_t n_closed_parts() const;
  /// Of the accepted flow.
  std::vector<BodyTraction> body_tractions() const { return accepted_tractions_; }
  /// Of the accepted state.
  FlowErrors errors(const ExactFlow& exact) const;
  /// The named boundaries that hold the fluid, and what it did to them as of the last accept.
  const std::vector<BoundaryCurve>& boundary_curves() const { return boundary_recovery_.curves(); }
  const std::vector<BoundaryTraction>& boundary_tractions() const { return boundary_tractions_; }
  /// Of the accepted flow; none before a step, or while another is tried.
  std::optional<ForceBalance> force_balance();
  std::optional<VolumeBalance> volume_balance() const;
  /// How finely mesh and step resolve what is given before the first step: the initial flow and, over a run
  /// until `end` [s] in steps of `time_step` [s], the velocities of boundaries.
  Resolution given_resolution(double end, double time_step) const;
  /// The same of the accepted flow and its step.
  Resolution resolution() const;
  /// "", or what is doubtful in the flow through boundaries none of which is open.
  std::string doubtful_net_flux() const {
    return space_.boundary.doubtful_net_flux(accepted_.time, accepted_.u);
  }
  /// What the accepted flow took to be as it is given: "pressure_drop_x" [Pa/m], "pressure_at_BOUNDARY" [Pa].
  std::map<std::string, double> found_drives() const;
  /// How large the mesh is and what this scene does not need, as sentences.
  std::vector<std::string> notes() const;

  Profiler monitor;

 private:
  NewtonResult start_step(const Request& request);
  Vec2 mean_force(double time) const;
  Vec2 mean_fall() const;
  double gamma(const Request& request) const;
  MeanLoad load_before(Index body) const;
  std::vector<Interface> with_fluid_loads(const Request& request) const;
  Scheme scheme_of_moving_bodies(double time_step) const;
  void set_time_terms(const Request& request);
  /// u and p [m/s, Pa], and no multiplier yet.
  Fields with_multipliers(const Vector& u, const Vector& p) const;
  NewtonResult begin(const Request& request);
  NewtonResult find_consistent_start(const Request& request, State& start);
  NewtonResult first_half_step(const Request& request);
  NewtonResult solve_step(const Request& request);
  std::vector<BodyTraction> tractions() const;
  void check_held(bool steady) const;
  std::vector<double> times_asked_for(const Request& request) const;
  bool keeps_momentum() const;
  Vec2 body_velocity(const CoveredNode& covered) const;
  void measure_boundaries();

  Settings settings_;
  Flow flow_;
  BodyForce body_force_;
  Space space_;
  State accepted_;
  Vector accepted_drive_;
  std::vector<BodyTraction> accepted_tractions_;
  BoundaryTractions boundary_recovery_;
  std::vector<BoundaryTraction> boundary_tractions_;

  std::shared_ptr<System> system_;  // of the last geometry asked for
  TimeTerms time_terms_;
  Iterate base_, current_;  // before and after the last sub-iteration
  Scheme scheme_;           // of this step
  Vector displacement_;     // of the nodes in this step; empty: no body moves
  State start_;             // of this step: the accepted state, made consistent at the first step
  FactorCache kept_;        // of the accepted system
  std::shared_ptr<System> accepted_system_;
  std::vector<Interface> accepted_interfaces_;
  std::optional<Request> last_;  // nothing since the last accept or restore
  bool last_converged_ = false;
};

}  // namespace fpi::fluid
