#include "grains/close_pairs.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace fpi::grains {
namespace {

using Cell = std::array<std::int64_t, 3>;

/// The spheres of one size class by cell. Cells are found by a hash, so that far outliers cost nothing.
class Grid {
 public:
  Grid(double reach, const Periods& periods) {
    for (std::size_t k = 0; k < 3; ++k) {
      around_[k] =
          periods[k] > 0 ? std::max<std::int64_t>(1, static_cast<std::int64_t>(periods[k] / reach)) : 0;
      size_[k] = around_[k] > 0 ? periods[k] / static_cast<double>(around_[k]) : reach;
    }
  }

  void add(std::uint32_t sphere, const Vec3& centre) {
    entries_.push_back({key_of(cell_of(centre)), sphere});
  }

  /// Sorts what was added into buckets.
  void finish() {
    const std::size_t n_buckets = std::bit_ceil(2 * entries_.size() + 1);
    mask_ = n_buckets - 1;
    begin_.assign(n_buckets + 1, 0);
    for (const Entry& entry : entries_) ++begin_[bucket(entry.key) + 1];
    for (std::size_t b = 0; b < n_buckets; ++b) begin_[b + 1] += begin_[b];
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    std::vector<Entry> sorted(entries_.size());
    for (const Entry& entry : entries_) sorted[next[bucket(entry.key)]++] = entry;
    entries_ = std::move(sorted);
  }

  bool empty() const { return entries_.empty(); }

  /// Visits the spheres in the cells around a place.
  template <class Visit>
  void around(const Vec3& centre, const Visit& visit) const {
    const Cell middle = cell_of(centre);
    const std::array<Range, 3> ranges{range(0), range(1), range(2)};
    for (std::int64_t i = ranges[0].first; i <= ranges[0].last; ++i)
      for (std::int64_t j = ranges[1].first; j <= ranges[1].last; ++j)
        for (std::int64_t k = ranges[2].first; k <= ranges[2].last; ++k)
          in_cell(wrapped({middle[0] + i, middle[1] + j, middle[2] + k}), visit);
  }

 private:
  struct Entry {
    std::uint64_t key;  ///< of the cell
    std::uint32_t sphere;
  };
  struct Range {
    std::int64_t first, last;
  };

  /// Neighbours along an axis; of one or two cells around a period none is met twice.
  Range range(std::size_t k) const {
    return {around_[k] == 1 || around_[k] == 2 ? 0 : -1, around_[k] == 1 ? 0 : 1};
  }
  Cell wrapped(Cell cell) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (around_[k] > 0) cell[k] = (cell[k] % around_[k] + around_[k]) % around_[k];
    return cell;
  }
  Cell cell_of(const Vec3& centre) const {
    constexpr double farthest = 1e15;  // still exact as a whole number
    Cell cell;
    for (std::size_t k = 0; k < 3; ++k)
      cell[k] = static_cast<std::int64_t>(std::clamp(std::floor(centre[k] / size_[k]), -farthest, farthest));
    return wrapped(cell);
  }
  /// Cells 2^21 apart share a key, neighbours never do.
  static std::uint64_t key_of(const Cell& cell) {
    constexpr int bits = 21;
    constexpr std::uint64_t low = (std::uint64_t{1} << bits) - 1;
    std::uint64_t key = 0;
    for (const std::int64_t c : cell) key = (key << bits) | (static_cast<std::uint64_t>(c) & low);
    return key;
  }
  std::size_t bucket(std::uint64_t key) const {
    const std::uint64_t h = key * 0x9E3779B97F4A7C15u;
    return (h ^ (h >> 32)) & mask_;
  }
  template <class Visit>
  void in_cell(const Cell& cell, const Visit& visit) const {
    const std::uint64_t key = key_of(cell);
    const std::size_t b = bucket(key);
    for (std::uint32_t e = begin_[b]; e < begin_[b + 1]; ++e)
      if (entries_[e].key == key) visit(entries_[e].sphere);
  }

  std::array<std::int64_t, 3> around_{};  ///< cells around each period, 0 where there is none
  Vec3 size_{};                           ///< of a cell [m]
  std::size_t mask_ = 0;
  std::vector<std::uint32_t> begin_;  ///< of each bucket in `entries_`, and the end
  std::vector<Entry> entries_;
};

}  // namespace

/// A sphere is kept in the finest grid whose cells are as wide as its diameter and the margin, and looks for
/// partners in its own and all coarser ones: there a cell is at least as wide as the pair's reach.
std::vector<IndexPair> close_pairs(std::span<const Sphere> spheres, double margin, const Periods& periods) {
  std::vector<IndexPair> pairs;
  if (spheres.empty()) return pairs;
  static constexpr double farthest =
      std::numeric_limits<double>::max();  // of the widest spheres, which overflow
  const auto reach = [margin](const Sphere& sphere) {
    return std::min(2 * sphere.radius + margin, farthest);
  };
  const double finest = reach(*std::ranges::min_element(spheres, {}, &Sphere::radius));
  const auto level_of = [&](const Sphere& sphere) {
    return static_cast<std::size_t>(
        std::max(0.0, std::ceil(std::log2(reach(sphere)) - std::log2(finest) - 1e-9)));
  };
  std::vector<Grid> grids;
  const std::size_t n_levels = 1 + level_of(*std::ranges::max_element(spheres, {}, &Sphere::radius));
  for (std::size_t level = 0; level < n_levels; ++level)
    grids.emplace_back(std::ldexp(finest, static_cast<int>(level)) * (1 + 1e-9), periods);
  std::vector<std::size_t> levels(spheres.size());
  for (std::uint32_t i = 0; i < spheres.size(); ++i) {
    levels[i] = level_of(spheres[i]);
    grids[levels[i]].add(i, spheres[i].centre);
  }
  for (Grid& grid : grids) grid.finish();
  for (std::uint32_t i = 0; i < spheres.size(); ++i) {
    for (std::size_t level = levels[i]; level < n_levels; ++level) {
      if (grids[level].empty()) continue;
      grids[level].around(spheres[i].centre, [&](std::uint32_t j) {
        if (levels[j] == levels[i] && j <= i) return;
        const Vec3 d = difference(spheres[i].centre, spheres[j].centre, periods);
        const double limit = spheres[i].radius + spheres[j].radius + margin;
        if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] <= limit * limit)
          pairs.push_back({std::min(i, j), std::max(i, j)});
      });
    }
  }
  return pairs;
}

}  // namespace fpi::grains
