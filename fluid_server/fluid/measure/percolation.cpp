#include "fluid/measure/percolation.hpp"

#include <algorithm>
#include <functional>

#include "fluid/cut/cut.hpp"

namespace fpi::fluid {
namespace {

/// A quadrature point of the fluid.
struct Point {
  double weight;  ///< [m²]
  Vec2 place, velocity;
  double pressure;
};

void for_each_point(const System& system, const Vector& u, const Vector* p,
                    const std::function<void(const Point&)>& visit) {
  const Mesh& mesh = system.space().mesh;
  for (std::size_t k = 0; k < system.active_cells().size(); ++k) {
    const Index c = system.active_cells()[k];
    const Quadrature rule = system.quadrature(k);
    const auto nodes = mesh.cell_nodes(c);
    const auto vertices = mesh.cell_vertices(c);
    const auto places = mesh.cell_places(c);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const Shape& shape = rule.points[q].shape;
      Point point{rule.weight(q), position_at(places, shape.n), value_at(nodes, shape.n, u), 0};
      for (int i = 0; p != nullptr && i < 3; ++i) point.pressure += shape.l[i] * (*p)[vertices[i]];
      visit(point);
    }
  }
}

/// Area [m²] and centroid of the part of a surface in a box.
struct Part {
  double area = 0;
  Vec2 centroid = Vec2::Zero();
};

Part part_in(const Box& box, const Surface& surface) {
  const Vec2 low = surface.lower().cwiseMax(box.lower), high = surface.upper().cwiseMin(box.upper);
  if ((low.array() >= high.array()).any()) return {};
  if (low == surface.lower() && high == surface.upper()) return {surface.area(), surface.centroid()};
  const Vec2 right(high.x(), low.y()), left(low.x(), high.y());
  std::vector<PlanePoint> outside;
  const Surface* const body = &surface;
  for (const Corners& half : {Corners{low, right, high}, Corners{low, high, left}})
    cut_quadrature(half, {&body, 1}, outside);
  Part part{Box{low, high}.area()};
  Vec2 moment = part.area * 0.5 * (low + high);
  for (const PlanePoint& point : outside) {
    part.area -= point.weight;
    moment -= point.weight * point.x;
  }
  if (part.area <= 0) return {};
  part.centroid = moment / part.area;
  return part;
}

/// ∫ of the bodies' velocities over what of them is in a box [m³/s a metre of thickness].
Vec2 flux_of_bodies(const System& system, const Box& box) {
  Vec2 flux = Vec2::Zero();
  for (const Image& image : system.cut().images) {
    const RigidVelocity& motion = system.interfaces()[image.interface].rigid;
    if (motion.translation.isZero(0) && motion.spin == 0) continue;
    const Part part = part_in(box, image.surface());
    flux += part.area * motion(part.centroid - image.shift);
  }
  return flux;
}

}  // namespace

PoreFlow pore_flow(const System& system, const Vector& u) {
  PoreFlow out;
  out.box = system.space().mesh.box().area();
  out.surface = system.wetted_length();
  out.flux_of_bodies = flux_of_bodies(system, system.space().mesh.box());
  for_each_point(system, u, nullptr, [&](const Point& point) {
    const double speed = point.velocity.norm();
    out.fluid += point.weight;
    out.flux += point.weight * point.velocity;
    out.speed += point.weight * speed;
    out.largest_speed = std::max(out.largest_speed, speed);
  });
  return out;
}

std::vector<Section> sections(const System& system, const Vector& u, const Vector& p, int axis, int n,
                              double drop) {
  const Box box = system.space().mesh.box();
  const double lower = box.lower[axis], length = (box.upper[axis] - lower) / n;
  std::vector<Section> out(static_cast<std::size_t>(n));
  std::vector<double> fluid(out.size());
  for_each_point(system, u, &p, [&](const Point& point) {
    const double along = point.place[axis] - lower;
    const auto s = static_cast<std::size_t>(std::clamp(along / length, 0.0, n - 0.5));
    fluid[s] += point.weight;
    out[s].pressure += point.weight * (point.pressure - drop * along);
    out[s].velocity += point.weight * point.velocity[axis];
  });
  for (std::size_t s = 0; s < out.size(); ++s) {
    const double volume = box.area() / n, start = lower + static_cast<double>(s) * length;
    Box slab = box;
    slab.lower[axis] = start;
    slab.upper[axis] = start + length;
    out[s].place = start + 0.5 * length;
    out[s].porosity = fluid[s] / volume;
    out[s].pressure /= fluid[s];
    out[s].velocity = (out[s].velocity + flux_of_bodies(system, slab)[axis]) / volume;
  }
  return out;
}

std::vector<SpeedBin> speed_histogram(const System& system, const Vector& u, int axis, int n) {
  double least = 0, largest = 0, fluid = 0;
  for_each_point(system, u, nullptr, [&](const Point& point) {
    least = std::min(least, point.velocity[axis]);
    largest = std::max(largest, point.velocity[axis]);
    fluid += point.weight;
  });
  const double width = (largest - least) / n;
  std::vector<SpeedBin> out(static_cast<std::size_t>(n));
  for (std::size_t b = 0; b < out.size(); ++b)
    out[b] = {least + static_cast<double>(b) * width, least + static_cast<double>(b + 1) * width, 0};
  if (width == 0) return out;
  for_each_point(system, u, nullptr, [&](const Point& point) {
    const double bin = std::clamp((point.velocity[axis] - least) / width, 0.0, n - 0.5);
    out[static_cast<std::size_t>(bin)].share += point.weight / fluid;
  });
  return out;
}

Eigen::Matrix2d permeability(const System& system, const Factor& stokes, double viscosity) {
  const Mesh& mesh = system.space().mesh;
  std::array<Vector, 2> loads, answers;
  for (const int axis : {0, 1}) {
    Residual unit = system.no_residual();
    system.add_force_density([axis](const Vec2&) { return Vec2(Vec2::Unit(axis)); }, unit.u);
    loads[axis] = system.gather(unit).head(system.numbering().n_equations);
    if (mesh.period.along[axis]) answers[axis] = stokes.solve(loads[axis]);
  }
  Eigen::Matrix2d k = Eigen::Matrix2d::Zero();
  for (const int i : {0, 1})
    for (const int j : {0, 1})
      if (mesh.period.along[i] && mesh.period.along[j])
        k(i, j) = viscosity * loads[i].dot(answers[j]) / mesh.box().area();
  return k;
}

}  // namespace fpi::fluid
