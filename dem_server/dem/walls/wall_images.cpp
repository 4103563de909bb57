#include "dem/walls/wall_images.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace fpi::dem {
namespace {

constexpr double tolerance = 1e-6;  ///< of the box: STL files in single precision know no better

bool is_plane(const Wall& wall) { return std::isinf(wall.extent); }

/// Whether it reaches from one side of the box to the other, or farther.
bool spans(const PeriodicBox& box, const Wall& wall, int axis) {
  return wall.box.sizes()[axis] >= (1 - tolerance) * box.length[axis];
}

/// The box around a wall where it is now.
Box box_now(const Wall& wall, const WallMotion& motion) {
  if (!wall.moves) return wall.box;
  Box box;
  for (int corner = 0; corner < 8; ++corner)
    box.extend(motion.orientation * (wall.box.corner(static_cast<Box::CornerType>(corner)) - wall.centre) +
               motion.position);
  return box;
}

/// Places of a facet that tell where it is: corners, ends, and the middle of an arc.
std::vector<Vec3> marks(const Facet& facet) {
  if (const auto* segment = std::get_if<Segment>(&facet))
    return {segment->from, segment->from + segment->length * segment->along};
  if (const auto* triangle = std::get_if<Triangle>(&facet))
    return {triangle->corners.begin(), triangle->corners.end()};
  const auto& arc = std::get<Arc>(facet);
  std::vector<Vec3> places;
  for (const double share : {-1, 0, 1})
    places.push_back(arc.centre +
                     arc.radius * (Eigen::AngleAxisd(share * arc.half_span, Vec3::UnitZ()) * arc.middle));
  return places;
}

void check_plane(const PeriodicBox& box, const Plane& plane, const scene::Wall& declared) {
  constexpr double parallel = 1e-12;
  for (int axis = 0; axis < 3; ++axis) {
    const char name = "xyz"[axis];
    require(box.length[axis] == 0 || std::abs(plane.normal[axis]) <= parallel,
            "wall {} must go on beyond the planes of periodic.{} as it does in the box: its normal must have "
            "{} = 0; "
            "got {:g}. Turn gravity in place of the wall, or make it a polyline or mesh that ends in the box",
            declared.name, name, name, plane.normal[axis]);
  }
}

/// Every mark that is within the wall's own length when it is moved by a box must lie on the wall there.
void check_goes_on(const PeriodicBox& box, const Wall& wall, std::span<const Facet> facets, int axis) {
  const double length = box.length[axis], near = tolerance * length;
  std::vector<std::uint32_t> found;
  const auto is_on_wall = [&](const Vec3& x) {
    wall.grid.find({x - Vec3::Constant(near), x + Vec3::Constant(near)}, found);
    return std::ranges::any_of(
        found, [&](std::uint32_t f) { return std::abs(nearest(facets[f], x).distance) <= near; });
  };
  for (const Facet& facet : facets)
    for (const Vec3& mark : marks(facet))
      for (const double way : {-length, length}) {
        Vec3 x = mark;
        x[axis] += way;
        if (x[axis] < wall.box.min()[axis] - near || x[axis] > wall.box.max()[axis] + near) continue;
        require(
            is_on_wall(x),
            "wall {} reaches through the box along periodic.{} and must go on as its own image; {} m, the "
            "image of {} m, is not on it: let both ends meet, or make it shorter than the box, {:g} m",
            wall.name, "xyz"[axis], text(x), text(mark), length);
      }
}

/// A turn keeps its own axis only.
bool turns_out_of(const scene::Wall& declared, int axis) {
  if (declared.spin.size() == 1) return axis != 2 && declared.turns();
  for (int other = 0; other < 3; ++other)
    if (other != axis && declared.spin[static_cast<std::size_t>(other)] != "0") return true;
  return false;
}

/// How far [m] it reaches from where it turns about, at most.
double reach(const Wall& wall, std::span<const Facet> facets) {
  if (is_plane(wall)) return wall.extent;
  double farthest = 0;
  for (const Facet& facet : facets) {
    if (const auto* arc = std::get_if<Arc>(&facet))
      farthest = std::max(farthest, (arc->centre - wall.centre).norm() + arc->radius);
    else
      for (const Vec3& mark : marks(facet)) farthest = std::max(farthest, (mark - wall.centre).norm());
  }
  return farthest;
}

void check_turn(const PeriodicBox& box, const Wall& wall, std::span<const Facet> facets,
                const scene::Wall& declared, int axis) {
  if (!turns_out_of(declared, axis)) return;
  const double farthest = reach(wall, facets);
  require(
      2 * farthest <= (1 + tolerance) * box.length[axis],
      "wall {} turns and must stay within half of periodic.{}, {:g} m, of its centre; got {:g} m: make it "
      "shorter, the box wider, or leave its spin out",
      wall.name, "xyz"[axis], 0.5 * box.length[axis], farthest);
}

/// A number that stays one for a body however far away.
std::int64_t boxes(double number) {
  constexpr double farthest = 1e15;
  return static_cast<std::int64_t>(std::clamp(number, -farthest, farthest));
}

}  // namespace

ImageRange images_near(const PeriodicBox& box, const Wall& wall, const WallMotion& motion, const Vec3& x,
                       double within) {
  ImageRange range;
  if (!box.repeats() || is_plane(wall)) return range;
  const Box now = box_now(wall, motion);
  for (int axis = 0; axis < 3; ++axis) {
    const double length = box.length[axis];
    if (length == 0) continue;
    double low = now.min()[axis], high = now.max()[axis];
    if (spans(box, wall, axis)) {
      const double middle = 0.5 * (low + high);
      low = std::max(low, middle - 0.5 * length);
      high = std::min(high, middle + 0.5 * length);
    }
    range.first[axis] = boxes(std::ceil((x[axis] - within - high) / length));
    range.last[axis] = boxes(std::floor((x[axis] + within - low) / length));
  }
  return range;
}

void check_fit(const PeriodicBox& box, const Wall& wall, std::span<const Facet> facets,
               const scene::Wall& declared) {
  if (!box.repeats()) return;
  if (is_plane(wall)) check_plane(box, std::get<Plane>(facets[0]), declared);
  for (int axis = 0; axis < 3; ++axis) {
    if (box.length[axis] == 0) continue;
    check_turn(box, wall, facets, declared, axis);
    if (!is_plane(wall) && spans(box, wall, axis)) check_goes_on(box, wall, facets, axis);
  }
}

}  // namespace fpi::dem
