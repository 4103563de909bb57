/// What a step makes of its loads changes continuously with them: an impact that a little more force brings
/// into the step begins with nothing. Who iterates on the loads, as the coupling does, could not converge
/// otherwise.
#include <gtest/gtest.h>

#include "grains.hpp"

namespace fpi::dem {
namespace {

using test::body;
using test::box_of_discs;
using test::step;

Problem scene_with(const std::string& contact) {
  Problem problem = box_of_discs();
  problem.dem.contact = contact;
  problem.materials.front().normal_stiffness = 4e3;
  return problem;
}

/// Velocities and spins at the end of a step in which all discs are drawn down and sideways by a part of
/// their weight.
Eigen::VectorXd after_step(Solver& solver, double share) {
  const Model& model = solver.model();
  std::vector<Load> loads;
  for (std::uint32_t i = 0; i < model.bodies.size(); ++i) {
    const double force = share * model.bodies.mass[i] * 9.81;
    loads.push_back({.body = i, .force = {force * (i % 2 ? 1.0 : -0.5), -3 * force, 0}});
  }
  const Advanced outcome = solver.advance(0.02, loads);
  require(outcome.converged, "a step that converges is required: {}", outcome.reason);
  Eigen::VectorXd out(3 * static_cast<Eigen::Index>(loads.size()));
  for (std::uint32_t i = 0; i < loads.size(); ++i)
    out.segment<3>(3 * i) << solver.motions().velocity[i].head<2>(),
        model.bodies.radius[i] * solver.motions().spin[i].z();
  return out;
}

/// The largest jump that is left between loads that differ by 1e-12, in any of ten parts of their range.
double largest_jump(Solver& solver) {
  constexpr int parts = 10;
  double largest = 0;
  for (int k = 0; k < parts; ++k) {
    double low = 0.1 + double(k) / parts, high = low + 1.0 / parts;
    Eigen::VectorXd at_low = after_step(solver, low), at_high = after_step(solver, high);
    while (high - low > 1e-12) {
      const double middle = 0.5 * (low + high);
      const Eigen::VectorXd at = after_step(solver, middle);
      const bool lower = (at - at_low).norm() > (at_high - at).norm();
      (lower ? high : low) = middle;
      (lower ? at_high : at_low) = at;
    }
    largest = std::max(largest, (at_high - at_low).norm());
  }
  return largest;
}

TEST(Continuity, loads_that_hardly_differ_move_bodies_alike) {
  for (const std::string contact : {"linear", "hertz"}) {
    Solver solver(scene_with(contact));
    for (int n = 0; n < 8; ++n) {
      EXPECT_LT(largest_jump(solver), 1e-9 * after_step(solver, 0.5).norm()) << contact << ", step " << n;
      step(solver, 0.02);
    }
  }
}

}  // namespace
}  // namespace fpi::dem
