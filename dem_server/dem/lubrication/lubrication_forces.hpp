/// The lubricated gaps between the bodies as they are now: dampers between pairs, and their implicit action
/// on velocities. Stiff films are no harder than soft ones; momentum is exact and energy only ever lost.
#pragma once

#include <Eigen/SparseCholesky>
#include <span>

#include "dem/contact/contact.hpp"
#include "dem/contact/state.hpp"
#include "dem/lubrication/lubrication_law.hpp"
#include "dem/lubrication/shared_inertia.hpp"

namespace fpi::dem {

class LubricationForces {
 public:
  /// `resolved_gaps` [m] of each body; empty: no fluid is resolved. Bodies move with `inertia`.
  LubricationForces(const Model& model, const SharedInertia& inertia, std::span<const double> resolved_gaps);

  /// The gap below which the widest film begins [m]; 0 where there are none.
  double reach() const { return reach_; }
  /// Time [s] in which no film changes by much, under constant `loads`; infinite where none is near.
  double longest_step(const State& state, const Forces& loads) const;

  /// Finds the films where the bodies are now.
  void place(const State& state);
  bool empty() const { return dampers_.empty(); }
  /// Gets ready to let them act for `duration` [s].
  void prepare(double duration);
  /// Lets the films act: backward Euler for all of them together.
  void damp(std::vector<Vec3>& velocity, std::vector<Vec3>& spin) const;

 private:
  using Vec6 = Eigen::Matrix<double, 6, 1>;  ///< of velocity and spin
  /// Resists c · (along_a · v_a + along_b · v_b − wall_rate), v the velocity and spin of a body. A wall has
  /// no v_b.
  struct Damper {
    std::uint32_t a, b;  ///< b = no_body at a wall
    double c;
    Vec6 along_a, along_b;
    double wall_rate;
  };
  double resolved_gap(const Near& near) const;
  void add_dampers(const Near& near, const Resistance& film);
  void number_bodies();
  double rate(const Damper& damper, const std::vector<Vec3>& velocity, const std::vector<Vec3>& spin) const;
  /// Of a damper as its bodies' velocities change.
  double rate(const Damper& damper, const Eigen::VectorXd& change) const;
  /// Adds an impulse of a damper to the rows of its bodies.
  void add_impulse(const Damper& damper, double impulse, Eigen::VectorXd& to) const;
  Eigen::VectorXd changes(const Eigen::VectorXd& impulses) const;
  Eigen::VectorXd changes_together(const Eigen::VectorXd& impulses) const;
  Eigen::VectorXd answer(const Eigen::VectorXd& impulses) const;
  void force(const std::vector<double>& impulses, std::vector<Vec3>& velocity, std::vector<Vec3>& spin) const;
  /// Calls visit(body, along) for the bodies of a damper.
  template <class Visit>
  void each_body(const Damper& damper, Visit visit) const {
    visit(damper.a, damper.along_a);
    if (damper.b != no_body) visit(damper.b, damper.along_b);
  }

  const Model& model_;
  const SharedInertia& inertia_;
  std::span<const double> resolved_gaps_;
  double reach_ = 0, duration_ = 0;
  std::vector<int> axes_;  ///< of the six that a body moves along: three in the plane
  std::vector<Damper> dampers_;
  std::vector<Eigen::Index> row_;  ///< first equation of each body, or −1
  Eigen::Index n_rows_ = 0;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;  ///< where each body has its own inertia
  Eigen::VectorXd own_inertia_;                                ///< of each equation
};

}  // namespace fpi::dem
