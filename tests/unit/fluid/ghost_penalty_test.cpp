#include "fluid/cut/ghost_penalty.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "fluid/mesh/rectangle.hpp"

namespace fpi::fluid {
namespace {

const Mesh mesh = make_rectangle(uniform_lines(0, 1, 3), uniform_lines(0, 1, 4));

Index inner_edge() {
  for (Index e = 0; e < mesh.n_edges(); ++e)
    if (mesh.edge_cells[e][1] != -1) return e;
  return -1;
}

TEST(GhostPenalty, a_quadratic_velocity_and_a_linear_pressure_cost_nothing) {
  const GhostFace face = ghost_face(mesh, inner_edge());
  Eigen::Matrix<double, 9, 1> u;
  for (int i = 0; i < 9; ++i) {
    const Vec2 x = mesh.node_position(face.nodes[i]);
    u[i] = 1 + x.x() - 2 * x.y() + x.x() * x.y() + 3 * x.y() * x.y();
  }
  Eigen::Vector4d p;
  for (int i = 0; i < 4; ++i)
    p[i] = 2 - mesh.vertices[face.vertices[i]].x() + mesh.vertices[face.vertices[i]].y();
  EXPECT_LT((face.velocity * u).norm(), 1e-15);
  EXPECT_LT((face.pressure * p).norm(), 1e-15);
}

TEST(GhostPenalty, is_symmetric_and_penalises_everything_else) {
  const GhostFace face = ghost_face(mesh, inner_edge());
  EXPECT_LT((face.velocity - face.velocity.transpose()).norm(), 1e-16);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> velocity(face.velocity);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> pressure(face.pressure);
  const auto n_zero = [](const auto& values) {
    return (values.array().abs() < 1e-12 * values.maxCoeff()).count();
  };
  EXPECT_EQ(n_zero(velocity.eigenvalues()), 6);  // quadratics
  EXPECT_EQ(n_zero(pressure.eigenvalues()), 3);  // linear functions
  EXPECT_GT(velocity.eigenvalues().minCoeff(), -1e-14);
}

}  // namespace
}  // namespace fpi::fluid
