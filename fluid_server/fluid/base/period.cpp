#include "fluid/base/period.hpp"

namespace fpi::fluid {

Vec2 Period::wrapped(Vec2 x) const {
  for (int axis : {0, 1})
    if (along[axis]) x[axis] -= std::floor((x[axis] - lower[axis]) / length(axis)) * length(axis);
  return x;
}

std::vector<Vec2> Period::shifts(const Vec2& low, const Vec2& high) const {
  constexpr double round_off = 1e-9;  // of a period: what only touches a side is seen at both
  std::array<std::vector<double>, 2> along_axis{{{0.0}, {0.0}}};
  for (int axis : {0, 1}) {
    if (!along[axis]) continue;
    along_axis[axis].clear();
    const double first = std::ceil((lower[axis] - high[axis]) / length(axis) - round_off);
    const double last = std::floor((upper[axis] - low[axis]) / length(axis) + round_off);
    for (double n = first; n <= last; ++n) along_axis[axis].push_back(n * length(axis));
  }
  std::vector<Vec2> out;
  for (const double x : along_axis[0])
    for (const double y : along_axis[1]) out.emplace_back(x, y);
  return out;
}

}  // namespace fpi::fluid
