#include "dem/neighbours/cells.hpp"

#include <algorithm>
#include <cmath>

namespace fpi::dem {
namespace {

constexpr std::size_t cells_a_place = 4;
constexpr double outliers = 0.01;  ///< share of the places on either side that need no cells of their own

/// Between the quantiles of each axis, and half as far again on either side.
void leave_out_outliers(const std::vector<Record>& places, Vec3& lower, Vec3& upper) {
  std::vector<double> along(places.size());
  const auto quantile = [&](double share) {
    const auto nth =
        along.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(along.size() - 1));
    std::nth_element(along.begin(), nth, along.end());
    return *nth;
  };
  for (int d = 0; d < 3; ++d) {
    std::ranges::transform(places, along.begin(), [&](const Record& x) { return x[d]; });
    const double low = quantile(outliers), high = quantile(1 - outliers), margin = 0.5 * (high - low);
    lower[d] = std::max(lower[d], low - margin);
    upper[d] = std::min(upper[d], high + margin);
  }
}

}  // namespace

Cells::Cells(const std::vector<Record>& places, double size) {
  Vec3 lower = places[0].head<3>(), upper = lower;
  for (const Record& x : places) {
    lower = lower.cwiseMin(x.head<3>());
    upper = upper.cwiseMax(x.head<3>());
  }
  const std::size_t most = cells_a_place * places.size();
  if (fit(lower, upper, size, most)) return;
  leave_out_outliers(places, lower, upper);
  for (double width = size; !fit(lower, upper, width, most);) width *= 1.25;
}

bool Cells::fit(const Vec3& lower, const Vec3& upper, double width, std::size_t most) {
  const Vec3 n = ((upper - lower) / width).array().floor() + 1;
  if (!(n.prod() <= static_cast<double>(most))) return false;
  lower_ = lower;
  width_ = width;
  for (int d = 0; d < 3; ++d) n_[d] = static_cast<std::size_t>(n[d]);
  return true;
}

Cells::Index Cells::coordinates(const Record& x) const {
  Index c;
  for (int d = 0; d < 3; ++d) {
    const double at = std::clamp((x[d] - lower_[d]) / width_, 0.0, static_cast<double>(n_[d] - 1));
    c[d] = static_cast<std::size_t>(at);
  }
  return c;
}

Sorted::Sorted(const std::vector<std::uint32_t>& values, std::size_t n_keys)
    : start(n_keys + 1, 0), entry(values.size()) {
  for (const std::uint32_t value : values) ++start[value + 1];
  for (std::size_t k = 0; k < n_keys; ++k) start[k + 1] += start[k];
  std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
  for (std::uint32_t i = 0; i < values.size(); ++i) entry[next[values[i]]++] = i;
}

namespace {

std::vector<Record> select(const std::vector<Record>& places, const std::vector<std::uint32_t>& members) {
  std::vector<Record> selected;
  selected.reserve(members.size() + n_lanes);
  for (const std::uint32_t i : members) selected.push_back(places[i]);
  return selected;
}

}  // namespace

Level::Level(const std::vector<Record>& places, std::vector<std::uint32_t> members, double width)
    : cells_(select(places, members), width) {
  std::vector<std::uint32_t> cell;
  for (const std::uint32_t i : members)
    cell.push_back(static_cast<std::uint32_t>(cells_.index(cells_.coordinates(places[i]))));
  Sorted sorted(cell, cells_.size());
  start_ = std::move(sorted.start);
  for (std::uint32_t& k : sorted.entry) k = members[k];
  members_ = std::move(sorted.entry);
  places_ = select(places, members_);
  places_.resize(members_.size() + n_lanes, Record::Zero());
}

}  // namespace fpi::dem
