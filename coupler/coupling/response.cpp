#include "coupling/response.hpp"

#include <cmath>
#include <numbers>

namespace fpi::coupling {
namespace {

/// K₁(z)/K₀(z). Both underflow beyond z = 700; from 50 on the asymptotic series is exact to 1e-9.
double bessel_ratio(double z) {
  if (z < 50) return std::cyl_bessel_k(1, z) / std::cyl_bessel_k(0, z);
  return 1 + (0.5 - (0.125 - (0.125 - 25.0 / 128 / z) / z) / z) / z;
}

}  // namespace

AddedInertia added_inertia(double density, double viscosity, double radius, double tau, double time_step) {
  const double z = radius * std::sqrt(density / (viscosity * tau)), ratio = bessel_ratio(z);
  const double area = std::numbers::pi * radius * radius;
  return {.mass = density * area * (time_step / tau) * (1 + 4 * ratio / z),
          .inertia = 2 * viscosity * area * time_step * (2 + z / ratio)};
}

/// Around bodies that move the fluid's scheme is BDF2, γ = 2/3, unless the scene wants γ = 1.
Eigen::VectorXd added_inertia(const RigidDofs& dofs, const scene::Fluid& fluid, double hydraulic_radius_ratio,
                              double time_step) {
  const double tau = (fluid.newmark_gamma == 1 ? 1 : 2.0 / 3) * time_step;
  Eigen::VectorXd added(dofs.size());
  for (Eigen::Index k = 0; k < dofs.size(); k += 3) {
    const double radius = hydraulic_radius_ratio * dofs.lever()[k + 2];
    const AddedInertia disc = added_inertia(fluid.density, fluid.viscosity(), radius, tau, time_step);
    added.segment<3>(k) << disc.mass, disc.mass, disc.inertia;
  }
  return dofs.thickness() * added;
}

Eigen::VectorXd displaced_mass(const RigidDofs& dofs, const scene::Fluid& fluid,
                               double hydraulic_radius_ratio) {
  Eigen::VectorXd displaced = Eigen::VectorXd::Zero(dofs.size());
  for (Eigen::Index k = 0; k < dofs.size(); k += 3) {
    const double radius = hydraulic_radius_ratio * dofs.lever()[k + 2];
    displaced.segment<2>(k).setConstant(fluid.density * std::numbers::pi * radius * radius *
                                        dofs.thickness());
  }
  return displaced;
}

}  // namespace fpi::coupling
