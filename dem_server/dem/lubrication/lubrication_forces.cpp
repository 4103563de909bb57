#include "dem/lubrication/lubrication_forces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dem/base/bicgstab.hpp"
#include "dem/contact/sub_steps.hpp"

namespace fpi::dem {
namespace {

constexpr double most_change = 0.1;  ///< of a gap in one sub-step
constexpr double held = 1e-100;      ///< [1/kg m²] of a body that does not turn, in place of zero

GapShape shape_of(const Model& model, const Near& near) {
  const double ratio = model.lubricant.radius_ratio, Ra = ratio * model.bodies.radius[near.a];
  return gap_shape(
      Ra, near.wall() ? std::numeric_limits<double>::infinity() : ratio * model.bodies.radius[near.b]);
}

/// The gap of the surfaces that the fluid sees.
double film_gap(const Model& model, const Near& near) {
  const double sum = model.bodies.radius[near.a] + (near.wall() ? 0 : model.bodies.radius[near.b]);
  return near.at.gap + (1 - model.lubricant.radius_ratio) * sum;
}

double roughness(const Model& model, const Near& near) {
  const double Ra = model.bodies.radius[near.a];
  return model.lubricant.roughness * (near.wall() ? Ra : std::min(Ra, model.bodies.radius[near.b]));
}

/// Below the roughness a film stays as it is there.
Resistance unresolved_film(const Model& model, const Near& near, double gap, double resolved) {
  return unresolved(model.plane ? disc_film : sphere_film, model.lubricant.viscosity, shape_of(model, near),
                    std::max(gap, roughness(model, near)), resolved);
}

}  // namespace

LubricationForces::LubricationForces(const Model& model, const SharedInertia& inertia,
                                     std::span<const double> resolved_gaps)
    : model_(model), inertia_(inertia), resolved_gaps_(resolved_gaps), row_(model.bodies.size(), -1) {
  if (model.lubricant.viscosity == 0) return;
  axes_ = model.plane ? std::vector{0, 1, 5} : std::vector{0, 1, 2, 3, 4, 5};
  const auto& widest = resolved_gaps.empty() ? model.bodies.radius : resolved_gaps;
  reach_ = *std::ranges::max_element(widest);
}

double LubricationForces::resolved_gap(const Near& near) const {
  if (resolved_gaps_.empty()) return 0;
  const double a = resolved_gaps_[near.a];
  return near.wall() ? a : 0.5 * (a + resolved_gaps_[near.b]);
}

double LubricationForces::longest_step(const State& state, const Forces& loads) const {
  double longest = std::numeric_limits<double>::infinity();
  if (reach_ == 0) return longest;
  each_near(model_, state, [&](const Near& near) {
    const Normal normal = normal_state(model_, near, state.motions.velocity);
    const double gap = film_gap(model_, near), rough = roughness(model_, near);
    const double resolved = resolved_gap(near),
                 begin = resolved > 0 ? resolved : shape_of(model_, near).radius;
    double way = most_change * std::max(rough, std::min(gap, begin));  // that changes the film by little
    if (gap > begin) way += gap - begin;
    if (gap < rough) way = normal.rate > 0 ? begin : way + rough - gap;
    const double acceleration = std::abs(relative_acceleration(model_, loads, near).dot(near.at.normal));
    const double c = unresolved_film(model_, near, gap, resolved).normal, speed = std::abs(normal.rate);
    const double free = time_to_close(way, speed, acceleration);
    longest =
        std::min(longest, c > 0 ? std::max(free, way / (speed + acceleration * normal.mass / c)) : free);
  });
  return longest;
}

void LubricationForces::place(const State& state) {
  dampers_.clear();
  if (reach_ == 0) return;
  each_acting(model_, state, reach_, [&](const Near& near) {
    const Resistance film = unresolved_film(model_, near, film_gap(model_, near), resolved_gap(near));
    if (film.normal > 0) add_dampers(near, film);
  });
}

/// With the centres D apart the line of centres turns at ω_L = (v_b − v_a)·t/D about e = n × t; a wall is a
/// body with an infinite radius, whose line of centres does not turn.
void LubricationForces::add_dampers(const Near& near, const Resistance& film) {
  const bool wall = near.wall();
  const double ratio = model_.lubricant.radius_ratio, Ra = ratio * model_.bodies.radius[near.a];
  const double Rb = wall ? 0 : ratio * model_.bodies.radius[near.b];
  const double D = Ra / ratio + near.at.gap + Rb / ratio;
  const auto join = [](const Vec3& velocity, const Vec3& spin) {
    return (Vec6() << velocity, spin).finished();
  };
  const Vec3& n = near.at.normal;
  const Vec6 frame = join(near.frame.velocity, near.frame.spin);
  const auto add = [&](double c, const Vec6& along_a, const Vec6& along_b) {
    dampers_.push_back({near.a, near.b, c, along_a, along_b, wall ? along_a.dot(frame) : 0});
  };
  add(film.normal, join(n, Vec3::Zero()), join(-n, Vec3::Zero()));
  const auto add_along = [&](const Vec3& t) {
    const Vec3 e = n.cross(t);
    const Vec3 slide = (wall ? 1 : (Ra + Rb) / D) * t, roll = (wall ? -1 : (Ra - Rb) / D) * t;
    add(film.sliding, join(slide, Ra * e), join(-slide, Rb * e));
    add(film.rolling, join(roll, Ra * e), join(-roll, -Rb * e));
  };
  const Vec3 t = model_.plane ? Vec3(-n.y(), n.x(), 0) : n.unitOrthogonal();
  add_along(t);
  if (!model_.plane) add_along(n.cross(t));
}

void LubricationForces::number_bodies() {
  n_rows_ = 0;
  std::ranges::fill(row_, -1);
  for (const Damper& damper : dampers_)
    each_body(damper, [&](std::uint32_t body, const Vec6&) {
      if (row_[body] >= 0 || !model_.bodies.is_free(body)) return;
      row_[body] = n_rows_;
      n_rows_ += static_cast<Eigen::Index>(axes_.size());
    });
}

/// M + Δt Σ c g gᵀ over the free bodies that a film touches.
void LubricationForces::prepare(double duration) {
  if (empty()) return;
  duration_ = duration;
  number_bodies();
  std::vector<Eigen::Triplet<double>> entries;
  const auto n_axes = static_cast<Eigen::Index>(axes_.size());
  own_inertia_.resize(n_rows_);
  for (std::size_t i = 0; i < row_.size(); ++i) {
    if (row_[i] < 0) continue;
    for (Eigen::Index k = 0; k < n_axes; ++k)
      own_inertia_[row_[i] + k] =
          1 / std::max(axes_[k] < 3 ? model_.bodies.inverse_mass[i] : model_.bodies.inverse_inertia[i], held);
  }
  for (Eigen::Index k = 0; k < n_rows_; ++k) entries.emplace_back(k, k, own_inertia_[k]);
  for (const Damper& damper : dampers_)
    each_body(damper, [&](std::uint32_t i, const Vec6& along_i) {
      each_body(damper, [&](std::uint32_t j, const Vec6& along_j) {
        if (row_[i] < 0 || row_[j] < 0) return;
        for (Eigen::Index k = 0; k < n_axes; ++k)
          for (Eigen::Index l = 0; l < n_axes; ++l)
            entries.emplace_back(row_[i] + k, row_[j] + l,
                                 duration_ * damper.c * along_i[axes_[k]] * along_j[axes_[l]]);
      });
    });
  Eigen::SparseMatrix<double> matrix(n_rows_, n_rows_);
  matrix.setFromTriplets(entries.begin(), entries.end());
  factor_.compute(matrix);
}

double LubricationForces::rate(const Damper& damper, const std::vector<Vec3>& velocity,
                               const std::vector<Vec3>& spin) const {
  double sum = -damper.wall_rate;
  each_body(damper, [&](std::uint32_t i, const Vec6& along) {
    sum += along.head<3>().dot(velocity[i]) + along.tail<3>().dot(spin[i]);
  });
  return sum;
}

double LubricationForces::rate(const Damper& damper, const Eigen::VectorXd& change) const {
  double sum = 0;
  each_body(damper, [&](std::uint32_t i, const Vec6& along) {
    if (row_[i] < 0) return;
    for (std::size_t k = 0; k < axes_.size(); ++k)
      sum += along[axes_[k]] * change[row_[i] + static_cast<Eigen::Index>(k)];
  });
  return sum;
}

void LubricationForces::add_impulse(const Damper& damper, double impulse, Eigen::VectorXd& to) const {
  each_body(damper, [&](std::uint32_t i, const Vec6& along) {
    if (row_[i] < 0) return;
    for (std::size_t k = 0; k < axes_.size(); ++k)
      to[row_[i] + static_cast<Eigen::Index>(k)] += impulse * along[axes_[k]];
  });
}

/// (M + Δt Z) v₁ = M v₀ gives the dampers' rates at the end; their impulses, equal and opposite to the last
/// bit, are what the bodies get, so that momentum does not depend on how well the equations were solved.
void LubricationForces::damp(std::vector<Vec3>& velocity, std::vector<Vec3>& spin) const {
  if (empty()) return;
  std::vector<double> impulses;
  Eigen::VectorXd first = Eigen::VectorXd::Zero(n_rows_);
  for (const Damper& damper : dampers_) {
    impulses.push_back(-duration_ * damper.c * rate(damper, velocity, spin));
    add_impulse(damper, impulses.back(), first);
  }
  const Eigen::VectorXd change = changes(first);
  for (std::size_t d = 0; d < dampers_.size(); ++d)
    impulses[d] -= duration_ * dampers_[d].c * rate(dampers_[d], change);
  force(impulses, velocity, spin);
}

/// What the velocities change by where the dampers would exert `impulses` if they did not: v₁ − v₀.
Eigen::VectorXd LubricationForces::changes(const Eigen::VectorXd& impulses) const {
  return inertia_.empty() ? Eigen::VectorXd(factor_.solve(impulses)) : changes_together(impulses);
}

/// With Y the answer of all bodies together: (1 + Y Δt Z) (v₁ − v₀) = Y · impulses.
Eigen::VectorXd LubricationForces::changes_together(const Eigen::VectorXd& impulses) const {
  constexpr double tolerance = 1e-10;
  constexpr int most = 200;
  const auto apply = [this](const Eigen::VectorXd& change) -> Eigen::VectorXd {
    Eigen::VectorXd drag = Eigen::VectorXd::Zero(n_rows_);
    for (const Damper& damper : dampers_)
      add_impulse(damper, duration_ * damper.c * rate(damper, change), drag);
    return change + answer(drag);
  };
  const auto by_itself = [this](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return factor_.solve(own_inertia_.cwiseProduct(x));
  };
  return bicgstab(apply, by_itself, answer(impulses), tolerance, most);
}

/// Changes of the velocities of the bodies that a film touches under impulses on them.
Eigen::VectorXd LubricationForces::answer(const Eigen::VectorXd& impulses) const {
  const auto n = static_cast<Eigen::Index>(axes_.size());
  Eigen::VectorXd all = Eigen::VectorXd::Zero(inertia_.n_rows()), change(n_rows_);
  const auto each_row = [&](auto visit) {
    for (std::uint32_t i = 0; i < row_.size(); ++i)
      if (row_[i] >= 0) visit(row_[i], inertia_.row(i));
  };
  each_row([&](Eigen::Index here, Eigen::Index there) { all.segment(there, n) = impulses.segment(here, n); });
  all = inertia_.accelerations(all);
  each_row([&](Eigen::Index here, Eigen::Index there) { change.segment(here, n) = all.segment(there, n); });
  return change;
}

void LubricationForces::force(const std::vector<double>& impulses, std::vector<Vec3>& velocity,
                              std::vector<Vec3>& spin) const {
  if (inertia_.empty()) {
    for (std::size_t d = 0; d < dampers_.size(); ++d)
      each_body(dampers_[d], [&](std::uint32_t i, const Vec6& along) {
        velocity[i] += model_.bodies.inverse_mass[i] * impulses[d] * along.head<3>();
        spin[i] += model_.bodies.inverse_inertia[i] * impulses[d] * along.tail<3>();
      });
    return;
  }
  Eigen::VectorXd all = Eigen::VectorXd::Zero(inertia_.n_rows());
  for (std::size_t d = 0; d < dampers_.size(); ++d)
    each_body(dampers_[d], [&](std::uint32_t i, const Vec6& along) {
      if (const Eigen::Index at = inertia_.row(i); at >= 0)
        all.segment<3>(at) += impulses[d] * Vec3(along[0], along[1], along[5]);
    });
  all = inertia_.accelerations(all);
  inertia_.each_body([&](std::uint32_t i, Eigen::Index at) {
    velocity[i].head<2>() += all.segment<2>(at);
    if (model_.bodies.inverse_inertia[i] > 0) spin[i].z() += all[at + 2];
  });
}

}  // namespace fpi::dem
