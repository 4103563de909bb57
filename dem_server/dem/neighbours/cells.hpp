/// Space in boxes of equal size. What lies beyond the outermost ones counts as in them, so that a body far
/// away costs nothing: bodies within a box of each other are in the same box or in boxes side by side.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "core/lanes.hpp"
#include "dem/base/record.hpp"

namespace fpi::dem {

class Cells {
 public:
  using Index = std::array<std::size_t, 3>;

  /// Boxes of at least `size` [m] around `places`, not more than a few a place.
  Cells(const std::vector<Record>& places, double size);

  std::size_t size() const { return n_[0] * n_[1] * n_[2]; }
  const Index& along() const { return n_; }
  const Vec3& lower() const { return lower_; }
  double width() const { return width_; }
  Index coordinates(const Record& x) const;
  /// The first axis runs fastest.
  std::size_t index(const Index& c) const { return (c[2] * n_[1] + c[1]) * n_[0] + c[0]; }

 private:
  bool fit(const Vec3& lower, const Vec3& upper, double width, std::size_t most);

  Vec3 lower_;
  double width_ = 0;
  Index n_{};
};

/// `values` of 0 … n_keys − 1 sorted by counting: where each value starts, and the entries in order.
struct Sorted {
  std::vector<std::uint32_t> start, entry;
  Sorted(const std::vector<std::uint32_t>& values, std::size_t n_keys);
};

/// Bodies of about one size, sorted by the cells that they are in, to look for those near a place.
class Level {
 public:
  /// `members` are those of `places` with radii that ask for cells of `width` [m].
  Level(const std::vector<Record>& places, std::vector<std::uint32_t> members, double width);

  double width() const { return cells_.width(); }
  /// Number k of the level is the body member(k).
  std::size_t size() const { return members_.size(); }
  std::uint32_t member(std::size_t k) const { return members_[k]; }

  /// Calls visit(j) for every member j from number `from` on whose gap to a sphere is at most `widest`, where
  /// that is no more than the width of a cell. Returns how many distances it looked at.
  template <class Visit>
  std::size_t near(const Record& sphere, double widest, std::size_t from, Visit visit) const {
    const Cells::Index c = cells_.coordinates(sphere), &n = cells_.along();
    const auto first = [&](int d) { return c[d] - std::min<std::size_t>(c[d], 1); };
    const auto last = [&](int d) { return std::min(c[d] + 1, n[d] - 1); };
    std::size_t looked = 0;
    for (std::size_t z = first(2); z <= last(2); ++z) {
      for (std::size_t y = first(1); y <= last(1); ++y) {
        const std::size_t row = cells_.index({0, y, z});
        const std::size_t begin = std::max<std::size_t>(from, start_[row + first(0)]);
        const std::size_t end = start_[row + last(0) + 1];
        if (begin >= end) continue;
        looked += end - begin;
        near_in(begin, end, sphere, widest, visit);
      }
    }
    return looked;
  }

 private:
  template <class Visit>
  void near_in(std::size_t begin, std::size_t end, const Record& sphere, double widest, Visit visit) const {
    for (std::size_t k = begin; k < end; k += n_lanes) {
      Lanes x = load(places_[k].data()), y = load(places_[k + 1].data()), z = load(places_[k + 2].data()),
            R = load(places_[k + 3].data());
      transpose(x, y, z, R);
      const Lanes dx = x - sphere[0], dy = y - sphere[1], dz = z - sphere[2], sum = R + (sphere[3] + widest);
      unsigned found = bits(dx * dx + dy * dy + dz * dz <= sum * sum);
      if (end - k < n_lanes) found &= (1u << (end - k)) - 1;
      for (; found; found &= found - 1) visit(members_[k + static_cast<unsigned>(std::countr_zero(found))]);
    }
  }

  Cells cells_;
  std::vector<std::uint32_t> start_, members_;
  std::vector<Record> places_;  ///< of the members, padded
};

}  // namespace fpi::dem
