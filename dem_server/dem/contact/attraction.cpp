#include "dem/contact/attraction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace fpi::dem {
namespace {

/// A pull that is constant while the surfaces touch and falls linearly to zero at a gap of `range`.
struct Adhesion {
  double most;   ///< [N]
  double range;  ///< [m]
};

Adhesion adhesion(const Model& model, const Near& near) {
  const double Ra = model.bodies.radius[near.a];
  const double radius = near.wall() ? Ra : 1 / (1 / Ra + 1 / model.bodies.radius[near.b]);
  return {1.5 * std::numbers::pi * near.law.adhesion * radius, model.adhesion_range * radius};
}

double sum_of_radii(const Model& model, const Near& near) {
  return model.bodies.radius[near.a] + model.bodies.radius[near.b];
}

/// ∫ κ r^(−a) dr from d to the cut-off.
double work_to(double cut_off, double d, double coefficient, double exponent) {
  if (exponent == 1) return coefficient * std::log(cut_off / d);
  return coefficient * (std::pow(cut_off, 1 - exponent) - std::pow(d, 1 - exponent)) / (1 - exponent);
}

}  // namespace

double attraction(const Model& model, const Near& near) {
  const Adhesion pull = adhesion(model, near);
  const double held = std::clamp(1 - near.at.gap / pull.range, 0.0, 1.0);
  double force = pull.most * held;
  const scene::NearField& f = model.near_field;
  if (near.wall()) return force;
  const double d = near.at.gap + sum_of_radii(model, near);
  if (d < f.cut_off)
    force +=
        f.attraction * std::pow(d, -f.attraction_exponent) - f.repulsion * std::pow(d, -f.repulsion_exponent);
  return force;
}

double attraction_energy(const Model& model, const Near& near) {
  const Adhesion pull = adhesion(model, near);
  const double gap = near.at.gap, left = std::clamp(pull.range - gap, 0.0, pull.range);
  double energy = -pull.most * (0.5 * left * left / pull.range + std::max(-gap, 0.0));
  const scene::NearField& f = model.near_field;
  if (near.wall()) return energy;
  const double d = gap + sum_of_radii(model, near);
  if (d < f.cut_off)
    energy -= work_to(f.cut_off, d, f.attraction, f.attraction_exponent) -
              work_to(f.cut_off, d, f.repulsion, f.repulsion_exponent);
  return energy;
}

double attraction_stiffness(const Model& model, const Near& near) {
  const Adhesion pull = adhesion(model, near);
  double stiffness = pull.most / pull.range;
  if (near.wall()) return stiffness;
  const scene::NearField& f = model.near_field;
  const double d = sum_of_radii(model, near);
  if (d < f.cut_off)
    stiffness += f.attraction * f.attraction_exponent * std::pow(d, -f.attraction_exponent - 1) +
                 f.repulsion * f.repulsion_exponent * std::pow(d, -f.repulsion_exponent - 1);
  return stiffness;
}

double attraction_reach(const Model& model, const Near& near) {
  double reach = -std::numeric_limits<double>::infinity();
  if (near.law.adhesion > 0) reach = adhesion(model, near).range;
  if (model.near_field.acts() && !near.wall())
    reach = std::max(reach, model.near_field.cut_off - sum_of_radii(model, near));
  return reach;
}

double widest_attraction(const Model& model) {
  const auto [smallest, largest] = std::ranges::minmax(model.bodies.radius);
  double widest = 0;
  if (model.laws.adhesive()) widest = model.adhesion_range * largest;
  if (model.near_field.acts()) widest = std::max(widest, model.near_field.cut_off - 2 * smallest);
  return widest;
}

void add_attractions(const Model& model, const State& state, Forces& forces, ContactCount& count) {
  if (!model.near_field.acts() && !model.laws.adhesive()) return;
  each_acting(model, state, widest_attraction(model), [&](const Near& near) {
    const double pull = attraction(model, near);
    const Vec3 force = pull * near.at.normal;
    if (model.accounts_energy)
      count.forces.push_back({.a = near.a,
                              .b = near.b,
                              .normal = near.at.normal,
                              .elastic = -pull,
                              .wall_velocity = near.frame.velocity,
                              .wall_spin = near.frame.spin});
    forces.force[near.a] += force;
    if (!near.wall()) forces.force[near.b] -= force;
  });
}

}  // namespace fpi::dem
