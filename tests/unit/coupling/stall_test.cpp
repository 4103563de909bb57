/// Iterations that get nowhere, what is done about it, and steps that are taken without being verified.
#include "coupling/stall.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "coupling/staggered_iteration.hpp"

namespace fpi::coupling {
namespace {

Eigen::VectorXd vector(double a, double b) { return Eigen::Vector2d(a, b); }

TEST(StallWatch, residuals_that_shrink_are_no_stall) {
  StallWatch watch;
  for (int k = 0; k < 100; ++k)
    EXPECT_EQ(watch.add(vector(std::pow(0.95, k), std::pow(-0.9, k))), Stall::none);
}

TEST(StallWatch, residuals_that_stay_are_a_stagnation_when_patience_ends) {
  StallWatch watch;
  watch.add(vector(1, 1));
  for (int k = 1; k < StallWatch::patience; ++k) EXPECT_EQ(watch.add(vector(1 - 1e-3 * k, 1)), Stall::none);
  EXPECT_EQ(watch.add(vector(1, 1)), Stall::stagnation);
}

TEST(StallWatch, residuals_that_come_back_are_a_cycle) {
  for (const int period : {2, 3}) {
    StallWatch watch;
    Stall stall = Stall::none;
    int exchanges = 0;
    for (; stall == Stall::none && exchanges < 20; ++exchanges)
      stall =
          watch.add(vector(std::cos(2 * M_PI * exchanges / period), std::sin(2 * M_PI * exchanges / period)));
    EXPECT_EQ(stall, Stall::cycle);
    EXPECT_LE(exchanges, period + 2);
  }
}

scene::Coupling with(const std::string& acceleration, const std::string& scheme = "implicit") {
  scene::Coupling parameters;
  parameters.acceleration = acceleration;
  parameters.scheme = scheme;
  return parameters;
}

RigidDofs disc() {
  std::vector<scene::Body> bodies(1);
  bodies[0].radius = 1;
  bodies[0].density = 1;
  bodies[0].position = {0, 0};
  return RigidDofs(bodies, 1);
}

StepResult solve(const scene::Coupling& parameters,
                 const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& H, double contraction = 1) {
  const RigidDofs dofs = disc();
  const CoupledMap map = [&](const Eigen::VectorXd& x, std::uint32_t) {
    const Eigen::VectorXd image = H(x);
    return Exchange{
        .converged = true, .reason = "", .residual = image - x, .velocities = image, .forces = 10 * image};
  };
  return StaggeredIteration(parameters, dofs)
      .solve(map, Eigen::Vector3d(1, 1, 1), dofs.inertia(), 0.1, contraction);
}

/// A plain iteration that flips for ever; Aitken's factor finds the middle.
TEST(Remedies, a_cycle_is_ended_by_aitken_where_dropping_the_history_does_not_help) {
  const StepResult result = solve(with("constant"), [](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return Eigen::Vector3d(2, 4, 6) - x;
  });
  EXPECT_TRUE(result.converged) << result.reason;
  ASSERT_EQ(result.stalls.size(), 2u);
  EXPECT_EQ(result.stalls[0].stall, Stall::cycle);
  EXPECT_EQ(result.stalls[0].remedy, Remedy::drop_history);
  EXPECT_EQ(result.stalls[1].remedy, Remedy::aitken);
  EXPECT_EQ(result.stalls[1].unknown, 2) << "the spin is farthest from its middle";
}

/// No velocity has this for its image: nothing helps but another step.
TEST(Remedies, a_map_without_a_fixed_point_is_given_up_long_before_the_last_sub_iteration) {
  for (const char* acceleration : {"constant", "aitken", "iqn-ils", "iqn-imvj"}) {
    const StepResult result = solve(with(acceleration), [](const Eigen::VectorXd& x) -> Eigen::VectorXd {
      return x.array() + (x.array() > 0).select(Eigen::Array3d::Constant(-1), 1);
    });
    EXPECT_FALSE(result.converged) << acceleration;
    ASSERT_EQ(result.stalls.size(), 3u) << acceleration;
    EXPECT_EQ(result.stalls[2].remedy, Remedy::shorter_step);
    EXPECT_LE(result.sub_iterations, 40u);
    EXPECT_NE(result.reason.find("did not converge"), std::string::npos) << result.reason;
  }
}

Eigen::VectorXd heavy(const Eigen::VectorXd& x) { return Eigen::Vector3d(2, 3, 4) - 0.01 * x; }

TEST(Schemes, explicit_takes_one_exchange_and_semi_implicit_two) {
  EXPECT_EQ(solve(with("iqn-ils", "explicit"), heavy).sub_iterations, 1u);
  EXPECT_EQ(solve(with("iqn-ils", "semi_implicit"), heavy).sub_iterations, 2u);
  EXPECT_EQ(solve(with("iqn-ils", "implicit"), heavy).sub_iterations, 3u);
}

TEST(Schemes, auto_leaves_out_the_exchange_that_only_verifies_where_it_is_proven_to_pass) {
  const auto nearly = [](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return Eigen::Vector3d(1, 1, 1) + 0.01 * (x - Eigen::Vector3d(1.0003, 1, 1));
  };
  const auto shifted = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return nearly(x) + Eigen::VectorXd(Eigen::Vector3d(3e-4, 0, 0));
  };
  EXPECT_EQ(solve(with("iqn-ils", "auto"), shifted, 0.02).sub_iterations, 1u);
  EXPECT_EQ(solve(with("iqn-ils", "auto"), shifted, 0.3).sub_iterations, 2u) << "not proven";
  EXPECT_EQ(solve(with("iqn-ils", "implicit"), shifted, 0.02).sub_iterations, 2u);
}

}  // namespace
}  // namespace fpi::coupling
