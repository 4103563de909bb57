/// Set-ups that the DEM's tests share.
#pragma once

#include <string>

#include "core/error.hpp"
#include "dem/solver.hpp"

namespace fpi::dem::test {

inline scene::Material material(double youngs_modulus, double poisson_ratio, double restitution = 1,
                                double friction = 0, double rolling_friction = 0) {
  scene::Material m;
  m.name = "m" + std::to_string(youngs_modulus);
  m.youngs_modulus = youngs_modulus;
  m.poisson_ratio = poisson_ratio;
  m.restitution = restitution;
  m.friction = friction;
  m.rolling_friction = rolling_friction;
  return m;
}

/// A wall's material that does not yield, nor change restitution or friction of what touches it.
inline scene::Material rigid(const scene::Material& other) {
  scene::Material m = other;
  m.name = "rigid";
  m.youngs_modulus = 1e30;
  return m;
}

inline scene::Body body(const std::string& name, const std::string& shape, double radius, double density,
                        std::vector<double> position, std::vector<double> velocity = {0, 0}) {
  scene::Body b;
  b.name = name;
  b.shape = shape;
  b.radius = radius;
  b.density = density;
  b.position = std::move(position);
  b.velocity = std::move(velocity);
  return b;
}

inline scene::Wall wall(const std::string& name, std::vector<double> point, std::vector<double> normal,
                        const std::string& of = "") {
  scene::Wall w;
  w.name = name;
  w.point = std::move(point);
  w.normal = std::move(normal);
  w.material = of;
  return w;
}

/// A floor at y = 0 under gravity.
inline Problem on_floor(const scene::Material& m, scene::Body b) {
  Problem problem;
  problem.gravity = {0, -9.81, 0};
  problem.materials = {m};
  problem.walls = {wall("floor", {0, 0}, {0, 1})};
  problem.bodies = {std::move(b)};
  return problem;
}

/// 25 discs of several sizes over the floor of a box 0.2 m wide, some spinning: more than are listed pair by
/// pair.
inline Problem box_of_discs() {
  Problem problem = on_floor(material(2e6, 0.3, 0.5, 0.4, 0.1), {});
  problem.thickness = 0.02;
  problem.bodies.clear();
  problem.walls.push_back(wall("left", {0, 0}, {1, 0}));
  problem.walls.push_back(wall("right", {0.2, 0}, {-1, 0}));
  for (int i = 0; i < 25; ++i) {
    const double x = 0.022 + 0.037 * (i % 5) + 0.002 * (i / 5), y = 0.03 + 0.04 * (i / 5);
    const double radius = 0.010 + 0.001 * (i % 7);
    problem.bodies.push_back(
        body("disc" + std::to_string(i), "disc", radius, 2500, {x, y}, {0.3 - 0.02 * i, 0}));
    problem.bodies.back().spin = {double(i % 3) - 1};
  }
  return problem;
}

/// Advances and accepts; the step must converge.
inline Advanced step(Solver& solver, double time_step, std::span<const Load> loads = {}) {
  const Advanced outcome = solver.advance(time_step, loads);
  require(outcome.converged, "a step that converges is required: {}", outcome.reason);
  solver.accept();
  return outcome;
}

/// What a contact stores along its normal [J].
inline double stored(const Model& model, const Motions& motions, const Near& near) {
  const Normal c = normal_state(model, near, motions.velocity);
  return with_elastic_law(model.elasticity, [&](auto law) {
    const double s = law.amplitude(std::max(c.overlap, 0.0));
    return 0.5 * law.stiffness(near.law.normal, c.radius) * s * s;
  });
}

/// Kinetic, of height, and stored by overlaps.
inline double energy(const Solver& solver) {
  const Model& model = solver.model();
  const Motions& m = solver.motions();
  double sum = 0;
  for (std::uint32_t i = 0; i < m.position.size(); ++i) {
    sum += 0.5 * model.bodies.mass[i] * m.velocity[i].squaredNorm() -
           model.bodies.mass[i] * model.gravity.dot(m.position[i]);
    if (model.bodies.inverse_inertia[i] > 0)
      sum += 0.5 / model.bodies.inverse_inertia[i] * m.spin[i].squaredNorm();
    for (std::uint32_t j = 0; j < i; ++j) sum += stored(model, m, near(model, m.position, Pair{j, i}));
    for (std::uint32_t f = 0; f < model.walls.facets.size(); ++f)
      sum += stored(model, m, near(model, m.position, solver.walls(), WallPlace{i, f}));
  }
  return sum;
}

inline bool bitwise_equal(const Motions& a, const Motions& b) {
  for (std::size_t i = 0; i < a.position.size(); ++i) {
    if (a.position[i] != b.position[i] || a.velocity[i] != b.velocity[i] || a.spin[i] != b.spin[i])
      return false;
    if (a.orientation[i].base.coeffs() != b.orientation[i].base.coeffs()) return false;
  }
  return a.position.size() == b.position.size();
}

}  // namespace fpi::dem::test
