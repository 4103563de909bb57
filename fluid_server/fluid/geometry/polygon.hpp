/// A polygon, and its sides as a surface run through by one parameter: k + s is the point a fraction s along
/// side k, which runs from corner k to corner k + 1, counter-clockwise (the body on the left).
#pragma once

#include <vector>

#include "fluid/base/types.hpp"
#include "fluid/geometry/disc.hpp"

namespace fpi::fluid {

struct Segment {
  Vec2 from, to;
};

struct Polygon {
  std::vector<Vec2> corners;  ///< [m]

  int size() const { return static_cast<int>(corners.size()); }
  double period() const { return static_cast<double>(corners.size()); }
  Segment side(int k) const { return {corners[k], corners[(k + 1) % corners.size()]}; }
  /// Number of the side that holds a parameter.
  int side_of(double parameter) const;
  Vec2 at(double parameter) const;
  /// Unit normal out of the body.
  Vec2 normal(double parameter) const;
  double length(double from, double to) const;  ///< [m] of a stretch of one side
  double area() const;
  Vec2 centroid() const;
  bool contains(const Vec2& x) const;
  double nearest(const Vec2& x) const;  ///< parameter of the point nearest to x
  /// Signed distance of x from the surface [m], negative inside.
  double distance(const Vec2& x) const;
  /// A length well above the round-off of coordinates and far below all that matters [m].
  double tolerance() const { return 1e-12 * (lower().norm() + upper().norm() + (upper() - lower()).norm()); }
  Vec2 lower() const;
  Vec2 upper() const;
  bool operator==(const Polygon&) const = default;
  Polygon moved(const Vec2& shift) const;
};

/// A polygon through vertices some of which lie within its sides.
struct Subdivided {
  Polygon polygon;
  std::vector<double> parameters;  ///< of each vertex, ascending
};
Subdivided merge_collinear(const std::vector<Vec2>& vertices);

/// Appends the parameters at which the segment from a to b meets the surface. A side nearer than two
/// tolerances to an end of the segment counts as met there, so that one that runs along mesh edges is split
/// at every node: a needless split does no harm, a missing one would.
void add_crossings(const Polygon& polygon, const Vec2& a, const Vec2& b, std::vector<double>& parameters);
void add_crossings(const Polygon& polygon, const Disc& disc, std::vector<double>& parameters);

}  // namespace fpi::fluid
