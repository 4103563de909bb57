#include "fluid/discretisation/kernel.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace fpi::fluid {
namespace {

using Local = Eigen::Matrix<double, 15, 1>;

const Triangle triangle({Vec2(0.1, -0.2), Vec2(1.3, 0.4), Vec2(0.3, 0.9)});

ElementState<double> state_of(const Local& v, double inertia) {
  ElementState<double> s;
  s.inertia = inertia;
  for (int i = 0; i < 6; ++i) {
    s.ux[i] = v[i];
    s.uy[i] = v[6 + i];
    s.ax[i] = inertia * s.ux[i];
    s.ay[i] = inertia * s.uy[i];
    s.wx[i] = inertia * (0.1 - 0.03 * i);  // paths move in unsteady flow only
    s.wy[i] = inertia * 0.06 * i;
  }
  for (int k = 0; k < 3; ++k) s.p[k] = v[12 + k];
  return s;
}

ElementSystem<double> system_of(const Flow& flow, const ElementState<double>& state) {
  const Metric<double> metric = metric_of(triangle);
  ElementSystem<double> system;
  element_system<double>(flow, standard_points(), {&metric, 1}, state, system, true);
  return system;
}

Local residual_of(const Flow& flow, const Local& v, double inertia) {
  return Local(system_of(flow, state_of(v, inertia)).residual.data());
}

Eigen::Matrix<double, 15, 15> jacobian_of(const Flow& flow, const Local& v, double inertia) {
  return Eigen::Matrix<double, 15, 15>(system_of(flow, state_of(v, inertia)).jacobian.data());
}

Local random_values(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Local v;
  for (double& x : v) x = normal(random);
  return v;
}

TEST(Kernel, jacobian_is_the_derivative_of_the_residual) {
  for (const double convection : {0.0, 1.0})
    for (const bool symmetric : {false, true})
      for (const double inertia : {0.0, 3.0}) {
        const Flow flow{1.7, 0.3, convection, symmetric};
        const Local v = random_values(5), d = random_values(6);
        const double eps = 1e-4;  // the residual is quadratic: a central difference is exact
        const Local difference =
            (residual_of(flow, v + eps * d, inertia) - residual_of(flow, v - eps * d, inertia)) / (2 * eps);
        EXPECT_LT((jacobian_of(flow, v, inertia) * d - difference).norm(), 1e-9);
      }
}

TEST(Kernel, rigid_motion_has_no_viscous_stress_in_the_symmetric_form) {
  Local v = Local::Zero();
  for (int i = 0; i < 3; ++i) {
    const Vec2 vertex = triangle.corner[i],
               middle = 0.5 * (triangle.corner[i] + triangle.corner[(i + 1) % 3]);
    v[i] = 1 - 2 * vertex.y();
    v[6 + i] = 3 + 2 * vertex.x();
    v[3 + i] = 1 - 2 * middle.y();
    v[9 + i] = 3 + 2 * middle.x();
  }
  EXPECT_LT(residual_of({1, 1, 0, true}, v, 0).norm(), 1e-13);
  EXPECT_GT(residual_of({1, 1, 0, false}, v, 0).norm(), 0.1);
}

TEST(Kernel, inertia_of_a_uniform_acceleration_is_the_mass) {
  Local v = Local::Zero();
  v.head<6>().setOnes();
  ElementState<double> s = state_of(v, 0);
  s.ax.fill(2.0);
  const auto residual = system_of({1.5, 1, 0, true}, s).residual;
  EXPECT_NEAR(std::accumulate(residual.begin(), residual.begin() + 6, 0.0), 1.5 * triangle.area * 2.0, 1e-14);
}

TEST(Kernel, four_elements_at_once_give_what_each_gives_alone) {
  const Flow flow{1.7, 0.3, 1, true};
  ElementState<Lanes> states{};
  Metric<Lanes> metrics{};
  const auto put = [](Lanes& to, int lane, double value) { part(to, lane) = value; };
  const Metric<double> metric = metric_of(triangle);
  for (int lane = 0; lane < n_lanes; ++lane) {
    const ElementState<double> one = state_of(random_values(lane), 2);
    for (int i = 0; i < 6; ++i) {
      put(states.ux[i], lane, one.ux[i]);
      put(states.uy[i], lane, one.uy[i]);
      put(states.ax[i], lane, one.ax[i]);
      put(states.ay[i], lane, one.ay[i]);
      put(states.wx[i], lane, one.wx[i]);
      put(states.wy[i], lane, one.wy[i]);
    }
    states.inertia = one.inertia;
    for (int k = 0; k < 3; ++k) {
      put(states.p[k], lane, one.p[k]);
      put(metrics.gx[k], lane, metric.gx[k]);
      put(metrics.gy[k], lane, metric.gy[k]);
    }
    put(metrics.area, lane, metric.area);
  }
  ElementSystem<Lanes> all;
  element_system<Lanes>(flow, standard_points(), {&metrics, 1}, states, all, true);
  for (int lane = 0; lane < n_lanes; ++lane) {
    const auto one = system_of(flow, state_of(random_values(lane), 2));
    for (int i = 0; i < 15; ++i) EXPECT_NEAR(all.residual[i][lane], one.residual[i], 1e-12);
    for (int i = 0; i < 225; ++i) EXPECT_NEAR(all.jacobian[i][lane], one.jacobian[i], 1e-12);
  }
}

TEST(Kernel, an_isoparametric_element_with_straight_sides_is_the_straight_one) {
  std::array<Vec2, 6> nodes;
  for (int i = 0; i < 3; ++i) {
    nodes[i] = triangle.corner[i];
    nodes[3 + i] = 0.5 * (triangle.corner[i] + triangle.corner[(i + 1) % 3]);
  }
  std::vector<Metric<double>> metrics;
  for (const ElementPoint& point : curved_points()) metrics.push_back(metric_at(nodes, point.shape));
  const Flow flow{1.7, 0.3, 1, true};
  const ElementState<double> state = state_of(random_values(3), 2);
  ElementSystem<double> curved;
  element_system<double>(flow, curved_points(), metrics, state, curved, true);
  const auto straight = system_of(flow, state);
  for (int i = 0; i < 15; ++i) EXPECT_NEAR(curved.residual[i], straight.residual[i], 1e-12);
  for (int i = 0; i < 225; ++i) EXPECT_NEAR(curved.jacobian[i], straight.jacobian[i], 1e-12);
}

}  // namespace
}  // namespace fpi::fluid
