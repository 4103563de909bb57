#include "dem/contact/particles.hpp"

namespace fpi::dem {
namespace {

std::size_t padded(std::size_t n) { return (n + n_lanes - 1) / n_lanes * n_lanes; }

bool is_weight_only(const Model& model, const Forces& loads) {
  for (std::size_t i = 0; i < loads.force.size(); ++i) {
    if (loads.force[i] != model.bodies.mass[i] * model.gravity || !loads.torque[i].isZero(0)) return false;
  }
  return true;
}

template <class T>
void permute(const std::vector<std::uint32_t>& order, std::vector<T>& values) {
  std::vector<T> permuted(values.size());
  for (std::size_t k = 0; k < order.size(); ++k) permuted[k] = values[order[k]];
  values.swap(permuted);
}

}  // namespace

Particles::Particles(const Model& model, const Motions& motions, const Forces& loads,
                     const std::vector<std::uint32_t>& order)
    : body(order), gravity(join(model.gravity, 0)) {
  const Bodies& bodies = model.bodies;
  const std::size_t n = padded(order.size());
  place.assign(n, Record::Zero());
  half.resize(n);
  now.resize(n);
  force.resize(n);
  turned.assign(n, Record::Zero());
  material.resize(n);
  for (std::size_t k = 0; k < order.size(); ++k) {
    const std::uint32_t i = order[k];
    const double im = bodies.inverse_mass[i], inertia = bodies.inverse_inertia[i], R = bodies.radius[i];
    place[k] = join(motions.position[i], R);
    half[k] = {join(motions.velocity[i], im), join(motions.spin[i], inertia)};
    now[k] = {join(motions.velocity[i], im), join(motions.spin[i], R)};
    turned[k] = join(motions.orientation[i].since, 0);
    material[k] = static_cast<std::uint16_t>(bodies.material[i]);
  }
  set_loads(model, loads);
}

void Particles::set_loads(const Model& model, const Forces& loads) {
  load.resize(is_weight_only(model, loads) ? 0 : place.size());
  if (load.empty()) return;
  for (std::size_t k = 0; k < size(); ++k) {
    const std::uint32_t i = body[k];
    load[k] = {join(model.bodies.inverse_mass[i] * loads.force[i], 0),
               join(model.bodies.inverse_inertia[i] * loads.torque[i], 0)};
  }
}

void Particles::reorder(const std::vector<std::uint32_t>& order) {
  permute(order, body);
  permute(order, place);
  permute(order, half);
  permute(order, now);
  permute(order, force);
  if (!load.empty()) permute(order, load);
  if (!contact_force.empty()) permute(order, contact_force);
  permute(order, turned);
  permute(order, material);
}

void Particles::write(std::size_t i, Motions& motions) const {
  const std::uint32_t to = body[i];
  motions.position[to] = place[i].head<3>();
  motions.velocity[to] = half[i].linear.head<3>();
  motions.spin[to] = half[i].angular.head<3>();
  motions.orientation[to].since = turned[i].head<3>();
}

void Particles::write(Motions& motions) const {
  for (std::size_t i = 0; i < size(); ++i) write(i, motions);
}

}  // namespace fpi::dem
