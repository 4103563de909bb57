/// The surface of a body: a circle or a polygon, run through counter-clockwise by one periodic parameter.
/// What cuts the mesh, carries multipliers or moves nodes asks a surface and does not know which it is.
#pragma once

#include <cmath>
#include <span>
#include <variant>
#include <vector>

#include "fluid/base/types.hpp"
#include "fluid/geometry/disc.hpp"
#include "fluid/geometry/polygon.hpp"

namespace fpi::fluid {

class Surface {
  template <class F>
  auto visit(F f) const {
    return std::visit(f, shape_);
  }

 public:
  Surface() : shape_(Disc{Vec2::Zero(), 0}) {}
  Surface(Disc disc) : shape_(disc) {}
  Surface(Polygon polygon) : tolerance_(polygon.tolerance()), shape_(std::move(polygon)) {}

  /// Null where it is of the other kind.
  const Disc* disc() const { return std::get_if<Disc>(&shape_); }
  const Polygon* polygon() const { return std::get_if<Polygon>(&shape_); }

  double period() const {
    return visit([](const auto& s) { return s.period(); });
  }
  Vec2 at(double parameter) const {
    return visit([=](const auto& s) { return s.at(parameter); });
  }
  /// [m] of a stretch that turns no corner.
  double length(double from, double to) const {
    return visit([=](const auto& s) { return s.length(from, to); });
  }
  double area() const {
    return visit([](const auto& s) { return s.area(); });
  }
  Vec2 centroid() const {
    return visit([](const auto& s) { return s.centroid(); });
  }
  Vec2 normal(double parameter) const {  ///< of length 1, out of the body
    return visit([=](const auto& s) { return s.normal(parameter); });
  }
  bool contains(const Vec2& x) const {
    return visit([&](const auto& s) { return s.contains(x); });
  }
  double nearest(const Vec2& x) const {  ///< parameter of the point nearest to x
    return visit([&](const auto& s) { return s.nearest(x); });
  }
  /// Signed distance from the surface [m], negative inside.
  double distance(const Vec2& x) const {
    return visit([&](const auto& s) { return s.distance(x); });
  }
  /// True for what the body contains and, for straight sides, for the surface itself.
  bool covers(const Vec2& x) const { return contains(x) || (tolerance_ > 0 && distance(x) < 2 * tolerance_); }
  double tolerance() const { return tolerance_; }  ///< see Polygon::tolerance; 0 for a circle
  Vec2 lower() const {
    return visit([](const auto& s) { return s.lower(); });
  }
  Vec2 upper() const {
    return visit([](const auto& s) { return s.upper(); });
  }
  bool operator==(const Surface&) const = default;
  Surface moved(const Vec2& shift) const {
    return visit([&](const auto& s) { return Surface(s.moved(shift)); });
  }

  /// The point by which a stretch is given to an element: on a circle; a tolerance outside a straight side,
  /// which may run along mesh edges and then belongs to the fluid beside it.
  Vec2 beside(double parameter) const;
  /// Number of corners; they are at the parameters 0, 1, 2, …
  int n_corners() const { return polygon() ? polygon()->size() : 0; }
  bool is_corner(double parameter) const { return polygon() && parameter == std::floor(parameter); }
  /// Appends the parameters at which a segment, or another surface, meets this one. For the same segment they
  /// are the same to the bit, whichever element asks.
  void add_crossings(const Vec2& a, const Vec2& b, std::vector<double>& parameters) const;
  void add_crossings(const Surface& other, std::vector<double>& parameters) const;

 private:
  double tolerance_ = 0;
  std::variant<Disc, Polygon> shape_;
};

/// Parameters of a stretch of the segment a + t (b − a).
struct Stretch {
  double start, end;
};
/// What bodies leave of a segment: the stretches of it outside all surfaces, longer than 1e-9 of it.
std::vector<Stretch> uncovered(const Vec2& a, const Vec2& b, std::span<const Surface> surfaces);

}  // namespace fpi::fluid
