#include "dem/lubrication/shared_inertia.hpp"

#include <algorithm>
#include <utility>

namespace fpi::dem {

SharedInertia::SharedInertia(std::vector<std::uint32_t> bodies, Matrix matrix)
    : bodies_(std::move(bodies)), matrix_(std::move(matrix)), factor_(matrix_) {
  if (empty()) return;
  row_.assign(*std::ranges::max_element(bodies_) + 1, -1);
  each_body([this](std::uint32_t body, Eigen::Index row) { row_[body] = row; });
}

void SharedInertia::answer(Particles& particles) const {
  Vector forces = Vector::Zero(n_rows());
  for (std::size_t k = 0; k < particles.size(); ++k) {
    const Twin& force = particles.force[k];
    if (const Eigen::Index at = row(particles.body[k]); at >= 0)
      forces.segment<3>(at) << force.linear.head<2>(), force.angular[2];
  }
  if (forces.isZero(0)) return particles.contact_force.clear();
  particles.contact_force = particles.force;
  const Vector together = accelerations(forces);
  for (std::size_t k = 0; k < particles.size(); ++k) {
    const Eigen::Index at = row(particles.body[k]);
    if (at < 0) continue;
    const double w = particles.half[k].linear[3], w_turning = particles.half[k].angular[3];
    particles.force[k].linear.head<2>() = together.segment<2>(at) / w;
    particles.force[k].angular[2] = w_turning > 0 ? together[at + 2] / w_turning : 0;
  }
}

}  // namespace fpi::dem
