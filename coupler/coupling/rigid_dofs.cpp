#include "coupling/rigid_dofs.hpp"

#include "core/error.hpp"

namespace fpi::coupling {

RigidDofs::RigidDofs(std::span<const scene::Body> bodies, double thickness) : thickness_(thickness) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].is_free()) bodies_.push_back(i);
  }
  inertia_.resize(3 * static_cast<Eigen::Index>(bodies_.size()));
  lever_.resize(inertia_.size());
  Eigen::Index k = 0;
  for (const std::size_t i : bodies_) {
    const scene::Body& body = bodies[i];
    require(body.shape == "disc", "a plane fluid takes discs only; body \"{}\" is a {}", body.name,
            body.shape);
    const double mass = body.density * body.volume(body.radius, thickness);
    inertia_.segment<3>(k) << mass, mass, 0.5 * mass * body.radius * body.radius;
    lever_.segment<3>(k) << 1, 1, body.radius;
    k += 3;
  }
}

Eigen::VectorXd RigidDofs::velocities(std::span<const RigidMotion> motions) const {
  Eigen::VectorXd x(size());
  Eigen::Index k = 0;
  for (const std::size_t i : bodies_) {
    x.segment<3>(k) << motions[i].velocity.x(), motions[i].velocity.y(), motions[i].spin.z();
    k += 3;
  }
  return x;
}

Eigen::VectorXd RigidDofs::loads(std::span<const RigidLoad> loads) const {
  Eigen::VectorXd f(size());
  Eigen::Index k = 0;
  for (const std::size_t i : bodies_) {
    f.segment<3>(k) << loads[i].force.x(), loads[i].force.y(), loads[i].torque.z();
    k += 3;
  }
  return f;
}

void RigidDofs::set_loads(const Eigen::VectorXd& forces, std::span<RigidLoad> loads) const {
  Eigen::Index k = 0;
  for (const std::size_t i : bodies_) {
    loads[i] = {.force = {forces[k], forces[k + 1], 0}, .torque = {0, 0, forces[k + 2]}};
    k += 3;
  }
}

void RigidDofs::set_velocities(const Eigen::VectorXd& velocities, std::span<RigidMotion> motions) const {
  Eigen::Index k = 0;
  for (const std::size_t i : bodies_) {
    motions[i].velocity = {velocities[k], velocities[k + 1], 0};
    motions[i].spin = {0, 0, velocities[k + 2]};
    k += 3;
  }
}

}  // namespace fpi::coupling
