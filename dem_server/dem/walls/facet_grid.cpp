#include "dem/walls/facet_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace fpi::dem {
namespace {

constexpr std::size_t few = 8;       ///< facets that are not worth a grid
constexpr double cells_a_facet = 8;  ///< a surface leaves most cells of a box empty

}  // namespace

FacetGrid::FacetGrid(const std::vector<Facet>& facets)
    : n_facets_(static_cast<std::uint32_t>(facets.size())) {
  if (facets.size() <= few) return;
  for (const Facet& facet : facets) all_.extend(bounds(facet));
  choose_cells(all_.sizes(), cells_a_facet * static_cast<double>(facets.size()));
  start_.assign(n_[0] * n_[1] * n_[2] + 1, 0);
  for (const Facet& facet : facets) each_cell(bounds(facet), [&](std::size_t cell) { ++start_[cell + 1]; });
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  facet_.resize(start_.back());
  std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
  for (std::uint32_t f = 0; f < n_facets_; ++f)
    each_cell(bounds(facets[f]), [&](std::size_t cell) { facet_[next[cell]++] = f; });
}

void FacetGrid::find(const Box& box, std::vector<std::uint32_t>& found) const {
  found.clear();
  if (size_ == 0) {
    found.resize(n_facets_);
    std::iota(found.begin(), found.end(), 0u);
    return;
  }
  if (!all_.intersects(box)) return;
  each_cell(box, [&](std::size_t cell) {
    found.insert(found.end(), facet_.begin() + static_cast<std::ptrdiff_t>(start_[cell]),
                 facet_.begin() + static_cast<std::ptrdiff_t>(start_[cell + 1]));
  });
  std::ranges::sort(found);
  found.erase(std::ranges::unique(found).begin(), found.end());
}

/// Cubes, as small as `most` of them allow.
void FacetGrid::choose_cells(const Vec3& extent, double most) {
  for (size_ = extent.maxCoeff() / most;; size_ *= 1.25) {
    double product = 1;
    for (int d = 0; d < 3; ++d) product *= std::floor(extent[d] / size_) + 1;
    if (product > most) continue;
    for (int d = 0; d < 3; ++d) n_[d] = static_cast<std::size_t>(extent[d] / size_) + 1;
    return;
  }
}

FacetGrid::Cells FacetGrid::cells_of(const Box& box) const {
  Cells cells{};
  const auto index = [&](double x, int d) {
    const double i = std::floor((x - all_.min()[d]) / size_);
    return static_cast<std::size_t>(std::clamp(i, 0.0, static_cast<double>(n_[d] - 1)));
  };
  for (int d = 0; d < 3; ++d) {
    cells.first[d] = index(box.min()[d], d);
    cells.last[d] = index(box.max()[d], d);
  }
  return cells;
}

template <class Visit>
void FacetGrid::each_cell(const Box& box, Visit visit) const {
  const auto [first, last] = cells_of(box);
  for (std::size_t k = first[2]; k <= last[2]; ++k)
    for (std::size_t j = first[1]; j <= last[1]; ++j)
      for (std::size_t i = first[0]; i <= last[0]; ++i) visit((k * n_[1] + j) * n_[0] + i);
}

}  // namespace fpi::dem
