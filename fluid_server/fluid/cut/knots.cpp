#include "fluid/cut/knots.hpp"

#include <algorithm>

namespace fpi::fluid {
namespace {

constexpr double least_distance = 0.8;  ///< of knots over the element size

/// Arcs in the order in which they follow one another, those of a polygon from a corner on.
std::vector<Index> in_order(const Interface& interface) {
  std::vector<Index> arcs(interface.n_arcs());
  for (Index a = 0; a < interface.n_arcs(); ++a) arcs[a] = a;
  const auto first = std::find_if(arcs.begin(), arcs.end(),
                                  [&](Index a) { return interface.outline.is_corner(interface.start[a]); });
  if (first != arcs.end()) std::rotate(arcs.begin(), first, arcs.end());
  return arcs;
}

}  // namespace

Knots::Knots(const Interface& interface, const std::function<double(const Vec2&)>& element_size)
    : spans_(interface.n_arcs()) {
  std::vector<Index> side, knots;  // a knot is named by the arc that ends there
  double length = 0;
  for (const Index a : in_order(interface)) {
    side.push_back(a);
    length += interface.length(a);
    if (interface.outline.is_corner(interface.end[a])) {
      add(interface, side, knots, false);
      side.clear();
      knots.clear();
      length = 0;
    } else if (length >= least_distance * element_size(interface.outline.at(interface.end[a]))) {
      knots.push_back(a);
      length = 0;
    }
  }
  if (!side.empty()) add(interface, side, knots, true);
  for (Index a = 0; a < interface.n_arcs(); ++a) {
    const auto weight = hats(a, 0.5 * (interface.start[a] + interface.end[a]));
    lengths_[spans_[a].left] += weight[0] * interface.length(a);
    lengths_[spans_[a].right] += weight[1] * interface.length(a);
  }
}

void Knots::add(const Interface& interface, const std::vector<Index>& arcs, const std::vector<Index>& knots,
                bool closed) {
  const Index first = size(), n = std::max<Index>(1, static_cast<Index>(knots.size()));
  lengths_.resize(first + n, 0);
  Index next = 0;  // knot at the end of this arc or later
  for (const Index a : arcs) {
    const Index left = closed ? (next + n - 1) % n : std::max(next - 1, 0);
    const Index right = closed ? next % n : std::min(next, n - 1);
    Span& span = spans_[a] = {first + left, first + right, 0, 0};
    if (left != right) {
      const double period = interface.outline.period(),
                   middle = 0.5 * (interface.start[a] + interface.end[a]);
      span.from = interface.end[knots[left]];
      span.to = interface.end[knots[right]];
      if (span.from > middle) span.from -= period;
      if (span.to < middle) span.to += period;
    }
    if (!knots.empty() && next < n && knots[next] == a) ++next;
  }
}

std::array<double, 2> Knots::hats(Index arc, double parameter) const {
  const Span& span = spans_[arc];
  if (span.left == span.right) return {1, 0};
  const double s = (parameter - span.from) / (span.to - span.from);
  return {1 - s, s};
}

}  // namespace fpi::fluid
