/// Where the multiplier of a body has its values: at ends of arcs that lie far enough apart for the elements
/// there, so that bodies with short arcs, or smaller than an element, do not ask more of the velocity than it
/// can do (the pair would not be inf-sup stable). Between the multiplier nodes it is linear.
#pragma once

#include <functional>

#include "fluid/geometry/interface.hpp"

namespace fpi::fluid {

/// The multiplier is continuous around a circle. At a corner of a polygon, where tractions are singular, it
/// jumps: it is constant from there to the next multiplier node. A circle or a side without a multiplier node
/// has one constant.
class MultiplierNodes {
 public:
  /// `element_size` is that of the element at a point [m], 0 where there is none.
  MultiplierNodes(const Interface& interface, const std::function<double(const Vec2&)>& element_size);

  /// Number of values.
  Index size() const { return static_cast<Index>(lengths_.size()); }
  /// The two values (or one, twice) that the multiplier has on an arc lies between, from 0.
  std::array<Index, 2> values(Index arc) const { return {spans_[arc].left, spans_[arc].right}; }
  /// The functions of these two at a parameter of the arc; they add up to 1.
  std::array<double, 2> hats(Index arc, double parameter) const;
  /// Integral of each value's function along the whole surface [m].
  const std::vector<double>& lengths() const { return lengths_; }

 private:
  /// An arc between two multiplier nodes: their numbers and parameters.
  struct Span {
    Index left, right;
    double from, to;
  };
  /// Takes arcs that follow one another, all of a circle or those of one side, and the arcs that end in
  /// multiplier nodes.
  void add(const Interface& interface, const std::vector<Index>& arcs,
           const std::vector<Index>& multiplier_nodes, bool closed);

  std::vector<Span> spans_;  // of every arc
  std::vector<double> lengths_;
};

}  // namespace fpi::fluid
