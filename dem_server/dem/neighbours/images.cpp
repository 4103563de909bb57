#include "dem/neighbours/images.hpp"

#include <algorithm>
#include <array>

namespace fpi::dem {
namespace {

using Shift = std::array<int, 3>;

/// Whether a place that was moved by a shift is within `reach` of the box.
bool is_near(const PeriodicBox& box, const Shift& shift, double reach, const Record& x) {
  for (int d = 0; d < 3; ++d) {
    if (shift[d] > 0 && x[d] > box.lower[d] + box.length[d] + reach) return false;
    if (shift[d] < 0 && x[d] < box.lower[d] - reach) return false;
  }
  return true;
}

/// One of every two opposite ones along the axes that repeat themselves.
std::vector<Shift> shifts(const PeriodicBox& box) {
  std::vector<Shift> found;
  for (int code = 14; code < 27; ++code) {  // the upper half of three digits −1, 0, 1
    const Shift shift{code / 9 - 1, code / 3 % 3 - 1, code % 3 - 1};
    if (std::ranges::none_of(std::array{0, 1, 2}, [&](int d) { return shift[d] && box.length[d] == 0; }))
      found.push_back(shift);
  }
  return found;
}

}  // namespace

Images::Images(const PeriodicBox& box, double reach, int slabs_axis, std::vector<Record>& places) {
  const auto n = static_cast<std::uint32_t>(places.size());
  for (const Shift& shift : shifts(box)) {
    for (std::uint32_t i = 0; i < n; ++i) {
      Record image = places[i];
      for (int d = 0; d < 3; ++d) image[d] += shift[d] * box.length[d];
      if (!is_near(box, shift, reach, image)) continue;
      places.push_back(image);
      particle.push_back(i);
      along.push_back(shift[slabs_axis]);
    }
  }
}

void Images::resolve(std::uint32_t n, std::vector<Pair>& pairs) const {
  std::erase_if(pairs, [n](const Pair& pair) { return pair.a >= n; });
  for (Pair& pair : pairs) {
    if (pair.b < n) continue;
    const std::uint32_t image = pair.b - n, other = particle[image];
    const bool first = along[image] == 0 ? pair.a < other : along[image] > 0;
    pair = first ? Pair{pair.a, other} : Pair{other, pair.a};
  }
}

}  // namespace fpi::dem
