#include "fluid/kernel.hpp"

#include <gtest/gtest.h>

#include <random>

namespace fpi::fluid {
namespace {

using Local = Eigen::Matrix<double, 15, 1>;

const Triangle triangle({Vec2(0.1, -0.2), Vec2(1.3, 0.4), Vec2(0.3, 0.9)});

ElementState state_of(const Local& v, double inertia) {
  ElementState s;
  s.ux.setZero();
  s.uy.setZero();
  s.inertia.setZero();
  for (int i = 0; i < 6; ++i) {
    s.ux[i] = v[i];
    s.uy[i] = v[6 + i];
    s.inertia[i] = inertia * (1 + 0.1 * i);
  }
  s.ax = s.inertia.cwiseProduct(s.ux);
  s.ay = s.inertia.cwiseProduct(s.uy);
  for (int k = 0; k < 3; ++k) s.p[k] = v[12 + k];
  return s;
}

Local residual_of(const Flow& flow, const Local& v, double inertia) {
  ElementResidual r;
  element_system(flow, triangle, standard_points(), triangle.area, state_of(v, inertia), r, nullptr);
  Local out;
  out << r.x.head<6>(), r.y.head<6>(), r.q[0], r.q[1], r.q[2];
  return out;
}

Eigen::Matrix<double, 15, 15> jacobian_of(const Flow& flow, const Local& v, double inertia) {
  ElementResidual r;
  ElementJacobian j;
  element_system(flow, triangle, standard_points(), triangle.area, state_of(v, inertia), r, &j);
  Eigen::Matrix<double, 15, 15> out = Eigen::Matrix<double, 15, 15>::Zero();
  out.block<6, 6>(0, 0) = j.xx.topRows<6>();
  out.block<6, 6>(0, 6) = j.xy.topRows<6>();
  out.block<6, 6>(6, 0) = j.yx.topRows<6>();
  out.block<6, 6>(6, 6) = j.yy.topRows<6>();
  for (int k = 0; k < 3; ++k) {
    out.block<6, 1>(0, 12 + k) = j.xp[k].head<6>();
    out.block<6, 1>(6, 12 + k) = j.yp[k].head<6>();
    out.block<1, 6>(12 + k, 0) = j.xp[k].head<6>().transpose();
    out.block<1, 6>(12 + k, 6) = j.yp[k].head<6>().transpose();
  }
  return out;
}

TEST(Kernel, jacobian_is_the_derivative_of_the_residual) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (const bool convection : {false, true})
    for (const bool symmetric : {false, true})
      for (const double inertia : {0.0, 3.0}) {
        const Flow flow{1.7, 0.3, convection, symmetric};
        Local v, d;
        for (double& x : v) x = normal(random);
        for (double& x : d) x = normal(random);
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
  EXPECT_LT(residual_of({1, 1, false, true}, v, 0).norm(), 1e-13);
  EXPECT_GT(residual_of({1, 1, false, false}, v, 0).norm(), 0.1);
}

TEST(Kernel, inertia_of_a_uniform_acceleration_is_the_mass) {
  Local v = Local::Zero();
  v.head<6>().setOnes();
  ElementState s = state_of(v, 0);
  s.ax.setZero();
  s.ax.head<6>().setConstant(2.0);
  ElementResidual r;
  element_system({1.5, 1, false, true}, triangle, standard_points(), triangle.area, s, r, nullptr);
  EXPECT_NEAR(r.x.sum(), 1.5 * triangle.area * 2.0, 1e-14);
}

}  // namespace
}  // namespace fpi::fluid
