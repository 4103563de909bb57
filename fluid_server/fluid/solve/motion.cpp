#include "fluid/solve/motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "fluid/cut/cut_mesh.hpp"

namespace fpi::fluid {
namespace {

/// 1 at 0, 0 from 1 on, once differentiable.
double fade(double t) { return t >= 1 ? 0 : 1 - t * t * (3 - 2 * t); }

/// A body, or its image in a periodic flow, that takes nodes along.
struct Mover {
  Surface surface;
  Vec2 centre, shift;  ///< of the centroid: at the end of the step, and in the step [m]
  double turn;         ///< in the step, counter-clockwise [rad]
  double reach;        ///< of its influence [m]

  Vec2 lower() const { return surface.lower() - Vec2::Constant(reach); }
  Vec2 upper() const { return surface.upper() + Vec2::Constant(reach); }
  bool moves() const { return turn != 0 || !shift.isZero(0); }
  double distance(const Vec2& x) const { return std::max(surface.distance(x), 0.0); }
  /// Of the point of the body that ends at x.
  Vec2 displacement(const Vec2& x) const {
    const Vec2 arm = x - centre;
    const double c = std::cos(turn), s = std::sin(turn);
    return shift + arm - Vec2(c * arm.x() + s * arm.y(), c * arm.y() - s * arm.x());
  }
};

/// The displacement fades out over the size of the body, over more where elements are coarse or the step is
/// large, lest paths cross.
Mover mover(const Space& space, const Interface& interface, std::span<const BodyPlace> before,
            double time_step) {
  const BodyPlace now = place_of(interface);
  const Surface& surface = interface.surface;
  const auto known = std::find_if(before.begin(), before.end(),
                                  [&](const BodyPlace& place) { return place.body == now.body; });
  Mover m{surface, now.centre, time_step * interface.rigid(now.centre), 0, 0};
  if (!surface.disc()) m.turn = time_step * interface.rigid.spin;
  if (known != before.end()) {
    m.shift = now.centre - known->centre;
    m.turn = std::remainder(now.angle - known->angle, 2 * std::numbers::pi);
  }
  constexpr double fewest_elements = 4, fewest_displacements = 3;
  const double size = 0.5 * (surface.upper() - surface.lower()).maxCoeff();
  m.reach = std::max({size, wanted_arc_length(space.mesh, space.locator, surface, fewest_elements),
                      fewest_displacements * (m.shift.norm() + std::abs(m.turn) * size)});
  return m;
}

void add_images(const Mover& mover, const Period& period, std::vector<Mover>& movers) {
  for (const Vec2& shift : period.shifts(mover.lower(), mover.upper())) {
    movers.push_back(mover);
    movers.back().surface = mover.surface.moved(shift);
    movers.back().centre += shift;
  }
}

/// What stands in the way of a mover: other bodies and the outer boundary.
class Surroundings {
 public:
  Surroundings(const Mesh& mesh, std::span<const Mover> movers, const Mover& own) : mesh_(mesh) {
    const Vec2 low = own.lower(), high = own.upper();
    const auto is_close = [&](const Vec2& lower, const Vec2& upper) {
      return (lower.array() < high.array()).all() && (upper.array() > low.array()).all();
    };
    for (const Mover& mover : movers)
      if (&mover != &own && is_close(mover.surface.lower(), mover.surface.upper())) bodies_.push_back(&mover);
    for (const BoundaryEdge& b : mesh.boundary) {
      const Vec2 &from = mesh.vertices[mesh.edges[b.edge][0]], &to = mesh.vertices[mesh.edges[b.edge][1]];
      if (is_close(from.cwiseMin(to), from.cwiseMax(to))) edges_.push_back(b.edge);
    }
  }

  /// Of the nearest thing to x [m].
  double distance(const Vec2& x) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Mover* body : bodies_) least = std::min(least, body->distance(x));
    for (Index e : edges_) {
      const auto [a, b] = mesh_.edges[e];
      least = std::min(least, distance_to_segment(mesh_.vertices[a], mesh_.vertices[b], x));
    }
    return least;
  }

 private:
  const Mesh& mesh_;
  std::vector<const Mover*> bodies_;
  std::vector<Index> edges_;
};

std::vector<Index> nodes_near(const Space& space, const Mover& mover) {
  std::vector<Index> nodes;
  for (Index c : space.locator.near(mover.lower(), mover.upper()))
    for (Index node : space.mesh.cell_nodes(c)) nodes.push_back(node);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace

BodyPlace place_of(const Interface& interface) {
  const Vec2 centre = interface.surface.centroid();
  if (interface.surface.disc()) return {interface.body, centre, 0};
  const Vec2 arm = interface.surface.at(0) - centre;
  return {interface.body, centre, std::atan2(arm.y(), arm.x())};
}

Vector displacement(const Space& space, std::span<const Interface> interfaces,
                    std::span<const BodyPlace> before, double time_step) {
  std::vector<Mover> movers;
  for (const Interface& interface : interfaces)
    add_images(mover(space, interface, before, time_step), space.mesh.period, movers);
  Vector out = Vector::Zero(2 * static_cast<Eigen::Index>(space.mesh.n_nodes()));
  for (const Mover& mover : movers) {
    if (!mover.moves()) continue;
    const Surroundings surroundings(space.mesh, movers, mover);
    for (Index node : nodes_near(space, mover)) {
      const Vec2 x = space.mesh.node_position(node);
      const double own = mover.distance(x);
      if (own >= mover.reach) continue;
      const double other = surroundings.distance(x);
      if (other == 0) continue;
      // Beside a body its share is whole, beside anything else nothing.
      const double share = fade(own / mover.reach) * fade(own / (own + other));
      out.segment<2>(2 * node) += share * mover.displacement(x);
    }
  }
  return out;
}

}  // namespace fpi::fluid
