/// Order in time of the flow around bodies that move through the mesh, at steps of a fraction of an element
/// and of several elements.
#include <gtest/gtest.h>

#include "stress/fluid_case.hpp"

namespace fpi::fluid::testing {
namespace {

constexpr double period = 5, diameter = 1, amplitude = 0.8;  // speeds up to 1 m/s; Re = 5

/// A body at its place at time t, with its velocity there.
using Moving = std::function<Interface(double)>;

/// Force and torque on a body in a closed box at half and three quarters of the period.
std::vector<double> forces(const Moving& body, int steps_a_period) {
  auto s = settings(1, 0.2,
                    {{"left", no_slip()}, {"right", no_slip()}, {"bottom", no_slip()}, {"top", no_slip()}});
  s.bodies_move = true;
  NavierStokes solver(make_rectangle(uniform_lines(-2, 2, 32), uniform_lines(-1.25, 1.25, 20)), s);
  const double dt = period / steps_a_period;
  std::vector<double> out;
  for (int step = 1; 4 * step <= 3 * steps_a_period; ++step) {
    const double t = step * dt;
    const Result result = solver.advance({t, dt, 0, {body(t)}});
    EXPECT_TRUE(result.newton.converged) << result.newton.reason;
    solver.accept();
    if (2 * step == steps_a_period || 4 * step == 3 * steps_a_period) {
      const BodyTraction& traction = result.tractions[0];
      out.insert(out.end(), {traction.force.x(), traction.torque});
    }
  }
  return out;
}

/// From three runs, each with half the step of the one before.
double order_in_time(const Moving& body, int coarsest) {
  const auto a = forces(body, coarsest), b = forces(body, 2 * coarsest), c = forces(body, 4 * coarsest);
  double first = 0, second = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    first += std::pow(a[i] - b[i], 2);
    second += std::pow(b[i] - c[i], 2);
  }
  const double order = 0.5 * std::log2(first / second);
  std::cout << fmt::format("changes {:.2e}, {:.2e}: order {:.2f} in time\n", std::sqrt(first),
                           std::sqrt(second), order);
  return order;
}

const double frequency = 2 * std::numbers::pi / period;

TEST(MovingBody, force_on_a_disc_that_crosses_more_than_an_element_a_step_is_of_second_order_in_time) {
  const auto disc = [](double t) {
    Interface f =
        circle(0, {0.0123 - amplitude * std::cos(frequency * t), 0.0234}, 0.5 * diameter, diameter / 8);
    f.rigid.translation = {amplitude * frequency * std::sin(frequency * t), 0};
    f.rigid.spin = std::sin(frequency * t);
    return f;
  };
  EXPECT_GT(order_in_time(disc, 24), 1.75);
}

TEST(MovingBody, a_flow_that_moves_with_the_body_has_no_history) {
  auto s = settings(1, 0.2,
                    {{"left", velocity("0.7", "0")},
                     {"right", open()},
                     {"bottom", velocity("0.7", "0")},
                     {"top", velocity("0.7", "0")}});
  s.bodies_move = true;
  s.fluid.initial_velocity = {"0.7", "0"};
  NavierStokes solver(make_rectangle(uniform_lines(-2, 2, 32), uniform_lines(-1, 1, 16)), s);
  for (int step = 1; step <= 6; ++step) {
    const double t = 0.2 * step;  // more than an element a step
    Interface disc = circle(0, {0.7 * t - 0.8, 0.0234}, 0.5 * diameter, diameter / 8);
    disc.rigid.translation = {0.7, 0};
    const Result result = solver.advance({t, 0.2, 0, {disc}});
    ASSERT_TRUE(result.newton.converged) << result.newton.reason;
    EXPECT_LT(result.tractions[0].force.norm(), 1e-10) << step;
    solver.accept();
  }
}

/// Rigid rotation is Stokes flow, steady in space; its history along the paths of a turning bar is all mesh
/// velocity, to the interpolation of the paths themselves.
TEST(MovingBody, a_stokes_flow_that_turns_with_a_bar_exerts_nothing_on_it) {
  const scene::Boundary turning = velocity("-2*y", "2*x");
  auto s = settings(1, 0.2, {{"left", turning}, {"right", turning}, {"bottom", turning}, {"top", turning}});
  s.bodies_move = true;
  s.fluid.convection = false;
  s.fluid.initial_velocity = {"-2*y", "2*x"};
  NavierStokes solver(square(24, -1, 1), s);
  double angle = 0.3, t = 0;
  for (const double dt : {0.05, 0.05, 0.1, 0.02, 0.2, 0.2}) {
    t += dt;
    angle += 2 * dt;
    const Vec2 along(std::cos(angle), std::sin(angle)), across(-along.y(), along.x());
    Interface bar;
    set_edges(bar, {-0.4 * along - 0.1 * across, 0.4 * along - 0.1 * across, 0.4 * along + 0.1 * across,
                    -0.4 * along + 0.1 * across});
    bar.rigid.spin = 2;
    const Result result = solver.advance({t, dt, 0, {bar}});
    ASSERT_TRUE(result.newton.converged) << result.newton.reason;
    EXPECT_LT(result.tractions[0].force.norm() + std::abs(result.tractions[0].torque), 1e-5) << t;
    solver.accept();
  }
}

}  // namespace
}  // namespace fpi::fluid::testing
