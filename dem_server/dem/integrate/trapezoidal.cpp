#include "dem/integrate/trapezoidal.hpp"

#include <algorithm>

#include "dem/integrate/sweep.hpp"

namespace fpi::dem {
namespace {

/// `velocity` after a kick of `duration` [s] by the forces that stand.
Twin kicked(const Particles& particles, std::size_t k, const Twin& velocity, double duration) {
  const Twin &half = particles.half[k], &force = particles.force[k];
  Record turning = half.angular[3] * force.angular;
  if (!particles.load.empty()) turning += particles.load[k].angular;
  Twin after;
  after.linear = velocity.linear + duration * (half.linear[3] * force.linear + particles.acceleration(k));
  after.angular = velocity.angular + duration * turning;
  return after;
}

}  // namespace

TrapezoidalStep::TrapezoidalStep(const Particles& particles, const std::vector<Orientation>& orientation,
                                 double duration)
    : duration_(duration),
      place_(particles.place),
      turned_(particles.turned),
      orientation_(orientation),
      before_(particles.half),
      kicked_(particles.half),
      end_(particles.half) {
  for (std::size_t k = 0; k < particles.size(); ++k)
    kicked_[k] = kicked(particles, k, before_[k], 0.5 * duration);
}

double TrapezoidalStep::iterate(Particles& particles, std::vector<Orientation>& orientation) {
  double change = 0, largest = 0;
  for (std::size_t k = 0; k < particles.size(); ++k) {
    const Twin end = kicked(particles, k, kicked_[k], 0.5 * duration_);
    const double R = particles.radius(k);
    const auto size = [R](const Twin& v, const Twin& w) {
      return std::max((v.linear - w.linear).norm(), R * (v.angular - w.angular).norm());
    };
    change = std::max(change, size(end, end_[k]));
    largest = std::max(
        {largest, end.linear.head<3>().norm(), R * end.angular.head<3>().norm(), size(end, before_[k])});
    end_[k] = end;
    particles.half[k].linear = 0.5 * (before_[k].linear + end.linear);
    particles.half[k].angular = 0.5 * (before_[k].angular + end.angular);
  }
  particles.place = place_;
  particles.turned = turned_;
  orientation = orientation_;
  Sweep{.drift = duration_}(particles, orientation);
  return largest > 0 ? change / largest : 0;
}

void TrapezoidalStep::set_ends(Particles& particles) const {
  for (std::size_t k = 0; k < particles.size(); ++k) {
    particles.now[k].linear.head<3>() = end_[k].linear.head<3>();
    particles.now[k].angular.head<3>() = end_[k].angular.head<3>();
  }
}

}  // namespace fpi::dem
