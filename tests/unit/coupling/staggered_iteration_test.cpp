/// The staggered iteration against linear maps with a known fixed point.
#include "coupling/staggered_iteration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace fpi::coupling {
namespace {

std::vector<scene::Body> discs(std::size_t n) {
  std::vector<scene::Body> bodies(n);
  for (std::size_t i = 0; i < n; ++i) {
    bodies[i].radius = 0.5 + static_cast<double>(i);
    bodies[i].density = 2;
    bodies[i].position = {0, 0};
  }
  return bodies;
}

/// H(x) = x* + A (x − x*), with forces that follow the velocities.
struct LinearMap {
  Eigen::VectorXd fixed_point;
  Eigen::VectorXd slopes;
  std::uint32_t calls = 0;
  Exchange operator()(const Eigen::VectorXd& x, std::uint32_t sub_iteration) {
    EXPECT_EQ(sub_iteration, calls++);
    const Eigen::VectorXd image = fixed_point + slopes.cwiseProduct(x - fixed_point);
    return {
        .converged = true, .reason = "", .residual = image - x, .velocities = image, .forces = 10 * image};
  }
};

struct Problem {
  scene::Coupling parameters;
  RigidDofs dofs{discs(1), 1};
  LinearMap map{.fixed_point = Eigen::Vector3d(1, -2, 0.5), .slopes = Eigen::Vector3d::Zero()};
  Eigen::VectorXd guess = Eigen::VectorXd::Zero(3);
  double time_step = 0.1;

  StepResult solve() {
    return StaggeredIteration(parameters, dofs).solve(std::ref(map), guess, dofs.inertia(), time_step);
  }
};

TEST(StaggeredIteration, a_constant_map_takes_one_relaxed_iterate_and_a_verifying_one) {
  Problem p;
  p.parameters.acceleration = "constant";
  p.parameters.relaxation = 1;
  const StepResult result = p.solve();
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.sub_iterations, 2u);
  EXPECT_EQ(result.velocity.largest, 0);
}

/// No iterate is answered by itself: 0.6 by −0.2, 0.4 by 1.2, and so on.
TEST(StaggeredIteration, where_newtons_answers_alternate_the_step_is_given_up_soon) {
  Problem p;
  const CoupledMap jump = [](const Eigen::VectorXd& x, std::uint32_t) {
    const Eigen::VectorXd image = Eigen::Vector3d(x[0] > 0.5 ? -0.2 : 1.2, 0, 0);
    return Exchange{.converged = true,
                    .reason = "",
                    .residual = image - x,
                    .is_newton = true,
                    .velocities = image,
                    .forces = 10 * image};
  };
  const StepResult result =
      StaggeredIteration(p.parameters, p.dofs).solve(jump, p.guess, p.dofs.inertia(), p.time_step);
  EXPECT_FALSE(result.converged);
  EXPECT_LT(result.sub_iterations, 10u);
  ASSERT_EQ(result.stalls.size(), 1u);
  EXPECT_EQ(result.stalls[0].remedy, Remedy::shorter_step);
}

TEST(StaggeredIteration, a_guess_that_comes_true_takes_one_exchange) {
  Problem p;
  p.guess = p.map.fixed_point;
  EXPECT_EQ(p.solve().sub_iterations, 1u);
}

TEST(StaggeredIteration, converges_to_the_fixed_point_within_the_tolerance) {
  Problem p;
  p.map.slopes = Eigen::Vector3d(-0.8, -0.7, -0.2);
  p.parameters.relative_tolerance = 1e-8;
  Eigen::VectorXd last;
  const CoupledMap map = [&](const Eigen::VectorXd& x, std::uint32_t k) {
    last = x;
    return p.map(x, k);
  };
  const StepResult result =
      StaggeredIteration(p.parameters, p.dofs).solve(map, p.guess, p.dofs.inertia(), p.time_step);
  EXPECT_TRUE(result.converged);
  EXPECT_LT((last - p.map.fixed_point).norm(), 1e-7);
}

/// A light body in a dense fluid: its added mass weighs more than itself, so the plain iteration has slope <
/// −1.
TEST(StaggeredIteration, added_mass_makes_the_plain_iteration_diverge_and_aitken_converge) {
  Problem p;
  p.map.slopes = Eigen::Vector3d(-1.6, -1.5, -0.3);
  p.parameters.acceleration = "constant";
  p.parameters.relaxation = 1;
  const StepResult rescued = p.solve();
  EXPECT_TRUE(rescued.converged);
  ASSERT_EQ(rescued.stalls.size(), 2u);  // its history is dropped, in vain, then Aitken's factor takes over
  EXPECT_EQ(rescued.stalls[1].remedy, Remedy::aitken);
  p.map.calls = 0;
  p.parameters.acceleration = "aitken";
  p.parameters.relaxation = 0.5;
  const StepResult result = p.solve();
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.sub_iterations, 8u);  // pinned: a change of the acceleration shows here
}

TEST(StaggeredIteration, aitken_solves_a_map_with_one_slope_in_three_exchanges) {
  Problem p;
  p.parameters.acceleration = "aitken";
  p.parameters.relaxation = 0.5;
  p.map.slopes = Eigen::Vector3d::Constant(-4);
  const StepResult result = p.solve();
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.sub_iterations, 3u);
}

/// Without the filter three slopes would take five sub-iterations; one column adds too little to the newest.
TEST(StaggeredIteration, iqn_solves_a_linear_map_with_three_slopes_in_six_exchanges) {
  Problem p;
  p.map.slopes = Eigen::Vector3d(-1.6, -4, 0.7);
  const StepResult result = p.solve();
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.sub_iterations, 6u);
}

/// The next step of the same map starts with all that the last one learnt.
TEST(StaggeredIteration, iqn_takes_two_exchanges_for_a_map_that_it_knows) {
  Problem p;
  p.map.slopes = Eigen::Vector3d(-1.6, -4, 0.7);
  StaggeredIteration iteration(p.parameters, p.dofs);
  iteration.solve(std::ref(p.map), p.guess, p.dofs.inertia(), p.time_step);
  iteration.accept();
  p.map.calls = 0;
  p.map.fixed_point = Eigen::Vector3d(3, 1, -7);
  EXPECT_EQ(iteration.solve(std::ref(p.map), p.guess, p.dofs.inertia(), p.time_step).sub_iterations, 2u);
}

TEST(StaggeredIteration, the_same_map_and_guess_give_the_same_bits) {
  Problem p;
  p.map.slopes = Eigen::Vector3d(-1.6, -0.5, -0.3);
  StaggeredIteration iteration(p.parameters, p.dofs);
  iteration.solve(std::ref(p.map), p.guess, p.dofs.inertia(), p.time_step);
  iteration.accept();
  p.map.calls = 0;
  const std::vector<double> before = iteration.state();
  const StepResult first = iteration.solve(std::ref(p.map), p.guess, p.dofs.inertia(), p.time_step);
  iteration.set_state(before);
  p.map.calls = 0;
  const StepResult again = iteration.solve(std::ref(p.map), p.guess, p.dofs.inertia(), p.time_step);
  EXPECT_EQ(first.sub_iterations, again.sub_iterations);
  EXPECT_EQ(first.velocity.relative, again.velocity.relative);
  EXPECT_EQ(first.force.relative, again.force.relative);
}

TEST(StaggeredIteration, does_not_exceed_max_iterations_and_says_so) {
  Problem p;
  p.parameters.max_iterations = 4;
  p.parameters.acceleration = "constant";
  p.map.slopes = Eigen::Vector3d(-3, -3, -3);
  const StepResult result = p.solve();
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(p.map.calls, 4u);
  EXPECT_NE(result.reason.find("did not converge in 4 sub-iterations"), std::string::npos) << result.reason;
}

TEST(StaggeredIteration, a_participant_that_does_not_converge_ends_the_step_with_its_reason) {
  Problem p;
  const CoupledMap map = [](const Eigen::VectorXd& x, std::uint32_t) {
    return Exchange{.converged = false, .reason = "singular", .residual = x, .velocities = x, .forces = x};
  };
  const StepResult result =
      StaggeredIteration(p.parameters, p.dofs).solve(map, p.guess, p.dofs.inertia(), p.time_step);
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.reason, "singular");
  EXPECT_EQ(result.sub_iterations, 1u);
}

TEST(StaggeredIteration, velocities_that_are_not_finite_end_the_step) {
  Problem p;
  const CoupledMap map = [](const Eigen::VectorXd& x, std::uint32_t) {
    const Eigen::VectorXd bad = Eigen::VectorXd::Constant(x.size(), std::numeric_limits<double>::infinity());
    return Exchange{.converged = true, .reason = "", .residual = bad, .velocities = bad, .forces = x};
  };
  EXPECT_FALSE(
      StaggeredIteration(p.parameters, p.dofs).solve(map, p.guess, p.dofs.inertia(), p.time_step).converged);
}

TEST(StaggeredIteration, without_unknowns_the_first_exchange_is_the_last) {
  const RigidDofs none({}, 1);
  LinearMap map{.fixed_point = Eigen::VectorXd(0), .slopes = Eigen::VectorXd(0)};
  const StepResult result =
      StaggeredIteration({}, none).solve(std::ref(map), Eigen::VectorXd(0), none.inertia(), 0.1);
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.sub_iterations, 1u);
}

TEST(ConvergenceMeasure, both_velocity_and_force_must_pass) {
  const RigidDofs dofs(discs(1), 1);
  const ConvergenceMeasure measure({}, dofs.inertia(), dofs.lever());
  const Residual passes{.relative = 1e-6, .largest = 1}, fails{.relative = 1e-4, .largest = 1};
  EXPECT_TRUE(measure.converged(passes, passes));
  EXPECT_FALSE(measure.converged(fails, passes));
  EXPECT_FALSE(measure.converged(passes, fails));
}

TEST(ConvergenceMeasure, a_change_below_the_absolute_limit_passes_however_large_it_is_relatively) {
  const RigidDofs dofs(discs(1), 1);
  const ConvergenceMeasure measure({}, dofs.inertia(), dofs.lever());
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(3), tiny = Eigen::Vector3d(1e-13, 0, 0);
  EXPECT_TRUE(measure.converged(measure.velocity(tiny, tiny), measure.force(tiny, rest, 1)));
}

TEST(ConvergenceMeasure, is_a_norm_of_kinetic_energy) {
  const RigidDofs dofs(discs(2), 1);
  const ConvergenceMeasure measure({}, dofs.inertia(), dofs.lever());
  const double m = 2 * std::numbers::pi * 0.25, inertia = 0.5 * m * 0.25;
  Eigen::VectorXd residual = Eigen::VectorXd::Zero(6), velocities = residual;
  residual << 3, 0, 0, 0, 0, 0;
  velocities << 3, 0, 2, 0, 0, 0;
  EXPECT_NEAR(measure.velocity(residual, velocities).relative, std::sqrt(m * 9 / (m * 9 + inertia * 4)),
              1e-14);
  EXPECT_EQ(measure.velocity(residual, velocities).largest, 3);
}

TEST(ConvergenceMeasure, of_velocity_is_against_the_bodies_or_the_fluid_whichever_is_faster) {
  const RigidDofs dofs(discs(2), 1);
  const ConvergenceMeasure measure({}, dofs.inertia(), dofs.lever());
  Eigen::VectorXd residual = Eigen::VectorXd::Zero(6), velocities = residual;
  residual << 1e-3, 0, 0, 1e-3, 0, 0;
  velocities << 0, 0.1, 0, 0, 0.1, 0;
  EXPECT_NEAR(measure.velocity(residual, velocities).relative, 1e-2, 1e-15);
  EXPECT_NEAR(measure.velocity(residual, velocities, 0.05).relative, 1e-2, 1e-15);
  EXPECT_NEAR(measure.velocity(residual, velocities, 2).relative, 5e-4, 1e-16);
  EXPECT_EQ(measure.velocity(residual, velocities, 2).largest, 1e-3);
}

TEST(ConvergenceMeasure, of_force_is_the_force_that_is_missing) {
  const RigidDofs dofs(discs(1), 1);
  const ConvergenceMeasure measure({}, dofs.inertia(), dofs.lever());
  const double m = 2 * std::numbers::pi * 0.25, inertia = 0.5 * m * 0.25, time_step = 0.1;
  const Residual translation =
      measure.force(Eigen::Vector3d(0, 2, 0), Eigen::Vector3d(0, 40 * m, 0), time_step);
  EXPECT_NEAR(translation.largest, m * 2 / time_step, 1e-12);
  EXPECT_NEAR(translation.relative, 2 / time_step / 40, 1e-14);
  const Residual rotation = measure.force(Eigen::Vector3d(0, 0, 2), Eigen::Vector3d(0, 0, 1), time_step);
  EXPECT_NEAR(rotation.largest, inertia * 2 / time_step / 0.5, 1e-12);
}

}  // namespace
}  // namespace fpi::coupling
