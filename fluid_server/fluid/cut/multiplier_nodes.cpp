#include "fluid/cut/multiplier_nodes.hpp"

#include <algorithm>

namespace fpi::fluid {
namespace {

constexpr double least_distance = 0.8;  ///< of multiplier nodes over the element size

/// Arcs in the order in which they follow one another, those of a polygon from a corner on.
std::vector<Index> in_order(const Interface& interface) {
  std::vector<Index> arcs(interface.n_arcs());
  for (Index a = 0; a < interface.n_arcs(); ++a) arcs[a] = a;
  const auto first = std::find_if(arcs.begin(), arcs.end(),
                                  [&](Index a) { return interface.surface.is_corner(interface.start[a]); });
  if (first != arcs.end()) std::rotate(arcs.begin(), first, arcs.end());
  return arcs;
}

}  // namespace

MultiplierNodes::MultiplierNodes(const Interface& interface,
                                 const std::function<double(const Vec2&)>& element_size)
    : spans_(interface.n_arcs()) {
  std::vector<Index> side, multiplier_nodes;  // a multiplier node is named by the arc that ends there
  double length = 0;
  for (const Index a : in_order(interface)) {
    side.push_back(a);
    length += interface.length(a);
    if (interface.surface.is_corner(interface.end[a])) {
      add(interface, side, multiplier_nodes, false);
      side.clear();
      multiplier_nodes.clear();
      length = 0;
    } else if (length >= least_distance * element_size(interface.surface.at(interface.end[a]))) {
      multiplier_nodes.push_back(a);
      length = 0;
    }
  }
  if (!side.empty()) add(interface, side, multiplier_nodes, true);
  for (Index a = 0; a < interface.n_arcs(); ++a) {
    const auto weight = hats(a, 0.5 * (interface.start[a] + interface.end[a]));
    lengths_[spans_[a].left] += weight[0] * interface.length(a);
    lengths_[spans_[a].right] += weight[1] * interface.length(a);
  }
}

void MultiplierNodes::add(const Interface& interface, const std::vector<Index>& arcs,
                          const std::vector<Index>& multiplier_nodes, bool closed) {
  const Index first = size(), n = std::max<Index>(1, static_cast<Index>(multiplier_nodes.size()));
  lengths_.resize(first + n, 0);
  Index next = 0;  // multiplier node at the end of this arc or later
  for (const Index a : arcs) {
    const Index left = closed ? (next + n - 1) % n : std::max(next - 1, 0);
    const Index right = closed ? next % n : std::min(next, n - 1);
    Span& span = spans_[a] = {first + left, first + right, 0, 0};
    if (left != right) {
      const double period = interface.surface.period(),
                   middle = 0.5 * (interface.start[a] + interface.end[a]);
      span.from = interface.end[multiplier_nodes[left]];
      span.to = interface.end[multiplier_nodes[right]];
      if (span.from > middle) span.from -= period;
      if (span.to < middle) span.to += period;
    }
    if (!multiplier_nodes.empty() && next < n && multiplier_nodes[next] == a) ++next;
  }
}

std::array<double, 2> MultiplierNodes::hats(Index arc, double parameter) const {
  const Span& span = spans_[arc];
  if (span.left == span.right) return {1, 0};
  const double s = (parameter - span.from) / (span.to - span.from);
  return {1 - s, s};
}

}  // namespace fpi::fluid
