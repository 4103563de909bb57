#include "fluid/linear/block_matrix.hpp"

#include <algorithm>
#include <limits>

#include "core/error.hpp"

namespace fpi::fluid {

void BlockMatrix::declare(std::span<const Index> equations, const BlockMask& mask) {
  equations_.insert(equations_.end(), equations.begin(), equations.end());
  mask_.push_back(&mask);
  first_equation_.push_back(equations_.size());
  first_entry_.push_back(first_entry_.back() + equations.size() * equations.size());
}

void BlockMatrix::finish() {
  // For every equation, the blocks that have it and where.
  struct Use {
    Index block;
    int local;
  };
  std::vector<std::size_t> first_use(n_ + 1, 0);
  for (Index e : equations_)
    if (e >= 0) ++first_use[e + 1];
  for (Index e = 0; e < n_; ++e) first_use[e + 1] += first_use[e];
  std::vector<Use> uses(first_use.back());
  std::vector<std::size_t> next(first_use.begin(), first_use.end() - 1);
  for (Index b = 0; b < n_blocks(); ++b)
    for (std::size_t k = first_equation_[b]; k < first_equation_[b + 1]; ++k)
      if (equations_[k] >= 0) uses[next[equations_[k]]++] = {b, static_cast<int>(k - first_equation_[b])};

  place_.assign(first_entry_.back(), -1);
  column_start_.assign(1, 0);
  row_.clear();
  row_.reserve(static_cast<std::size_t>(n_) * 24);
  std::vector<Index> seen_in(n_, -1), place_of_row(n_);
  std::vector<Index> rows;
  for (Index column = 0; column < n_; ++column) {
    rows.clear();
    for (std::size_t u = first_use[column]; u < first_use[column + 1]; ++u) {
      const auto [b, local] = uses[u];
      const BlockMask& mask = *mask_[b];
      const Index* equation = equations_.data() + first_equation_[b];
      const std::uint8_t* coupled = mask.coupled.data() + static_cast<std::size_t>(local) * mask.n;
      for (int i = 0; i < mask.n; ++i) {
        const Index row = equation[i];
        if (row >= 0 && coupled[i] && seen_in[row] != column) {
          seen_in[row] = column;
          rows.push_back(row);
        }
      }
    }
    std::sort(rows.begin(), rows.end());
    require(row_.size() + rows.size() < std::numeric_limits<Index>::max(),
            "a matrix of fewer than {} entries is required; {} unknowns have more: take a coarser mesh",
            std::numeric_limits<Index>::max(), n_);
    for (Index row : rows) {
      place_of_row[row] = static_cast<Index>(row_.size());
      row_.push_back(row);
    }
    column_start_.push_back(static_cast<Index>(row_.size()));
    for (std::size_t u = first_use[column]; u < first_use[column + 1]; ++u) {
      const auto [b, local] = uses[u];
      const int n = mask_[b]->n;
      const Index* equation = equations_.data() + first_equation_[b];
      const std::size_t offset = static_cast<std::size_t>(local) * n;
      for (int i = 0; i < n; ++i)
        if (equation[i] >= 0 && mask_[b]->coupled[offset + i])
          place_[first_entry_[b] + offset + i] = place_of_row[equation[i]];
    }
  }
  values_.assign(row_.size(), 0.0);
  equations_ = {};
}

BlockMatrix BlockMatrix::part(std::span<const Index> equations) const {
  BlockMatrix out(static_cast<Index>(equations.size()));
  std::vector<Index> place(n_, -1);
  for (Index k = 0; k < out.n_; ++k) place[equations[k]] = k;
  out.column_start_.assign(1, 0);
  for (const Index column : equations) {
    for (Index k = column_start_[column]; k < column_start_[column + 1]; ++k) {
      if (place[row_[k]] < 0) continue;
      out.row_.push_back(place[row_[k]]);
      out.values_.push_back(values_[k]);
    }
    out.column_start_.push_back(out.non_zeros());
  }
  return out;
}

}  // namespace fpi::fluid
