#include "fluid/discretisation/drives.hpp"

namespace fpi::fluid {

void Drives::set_time(double t) {
  flows_.resize(size());
  for (Index k = 0; k < size(); ++k) flows_[k] = drives_[k].unit * drives_[k].given(0, 0, t);
}

Vector Drives::excess(const Vector& u, const Vector& motions) const {
  Vector out = -flows_;
  for (Index k = 0; k < size(); ++k)
    out[k] += drives_[k].load.dot(u) + drives_[k].load_on_bodies.dot(motions);
  return out;
}

void Drives::add(const Vector& sizes, Vector& load, Vector& load_on_bodies) const {
  for (Index k = 0; k < size(); ++k) {
    load += sizes[k] * drives_[k].load;
    load_on_bodies += sizes[k] * drives_[k].load_on_bodies;
  }
}

Vec2 Drives::force_at(const std::string& boundary, const Vector& sizes) const {
  return force(sizes, [&](const Drive& drive) { return drive.boundary == boundary; });
}

Vec2 Drives::force_density(const Vector& sizes) const {
  return force(sizes, [](const Drive& drive) { return drive.axis >= 0; });
}

Vec2 Drives::force(const Vector& sizes, const std::function<bool(const Drive&)>& counts) const {
  Vec2 out = Vec2::Zero();
  for (Index k = 0; k < size(); ++k)
    if (counts(drives_[k]))
      out += sizes[k] * drives_[k].load.reshaped(2, drives_[k].load.size() / 2).rowwise().sum();
  return out;
}

Vec2 Drives::pressure_drop(const Vector& sizes) const {
  Vec2 drop = Vec2::Zero();
  for (Index k = 0; k < size(); ++k)
    if (drives_[k].axis >= 0) drop[drives_[k].axis] += sizes[k];
  return drop;
}

}  // namespace fpi::fluid
