/// A sparse matrix in compressed columns that is the sum of small dense blocks (element matrices and the
/// like). The pattern and the place of every block entry in it are found once; adding a block is then a
/// gather-free loop.
#pragma once

#include <Eigen/SparseCore>
#include <span>
#include <vector>

#include "fluid/base/types.hpp"

namespace fpi::fluid {

/// Which entries of an n × n block can differ from zero, column by column. Lives as long as the matrix.
struct BlockMask {
  int n;
  std::vector<std::uint8_t> coupled;  ///< n · n
  static BlockMask dense(int n) { return {n, std::vector<std::uint8_t>(static_cast<std::size_t>(n) * n, 1)}; }
};

class BlockMatrix {
 public:
  explicit BlockMatrix(Index n_equations) : n_(n_equations) {}

  /// Declares a block by its equations (−1: not in the system). Blocks are numbered from 0.
  void declare(std::span<const Index> equations, const BlockMask& mask);
  /// Finds the pattern. To be called once, after the last `declare`.
  void finish();

  void set_zero() { std::fill(values_.begin(), values_.end(), 0.0); }
  /// Adds a dense block, column by column; entry k is dense[k · stride]. Blocks without a common equation may
  /// be added at the same time.
  void add(Index block, const double* dense, std::ptrdiff_t stride = 1) {
    const std::size_t begin = first_entry_[block], end = first_entry_[block + 1];
    for (std::size_t k = begin; k < end; ++k, dense += stride)
      if (place_[k] >= 0) values_[place_[k]] += *dense;
  }

  /// The rows and columns of these equations, in their order, as a matrix of its own without blocks.
  BlockMatrix part(std::span<const Index> equations) const;
  Eigen::Map<const Eigen::SparseMatrix<double>> view() const {
    return {n_, n_, non_zeros(), column_start_.data(), row_.data(), values_.data()};
  }

  Index n() const { return n_; }
  Index n_blocks() const { return static_cast<Index>(mask_.size()); }
  Index non_zeros() const { return static_cast<Index>(row_.size()); }
  const std::vector<Index>& column_start() const { return column_start_; }
  const std::vector<Index>& row() const { return row_; }
  const double* values() const { return values_.data(); }

 private:
  Index n_;
  std::vector<const BlockMask*> mask_;
  std::vector<Index> equations_;                // of all blocks, one after another
  std::vector<std::size_t> first_equation_{0};  // of each block
  std::vector<std::size_t> first_entry_{0};     // of each block in place_
  std::vector<Index> place_;                    // of each block entry in values_, −1 where it has none
  std::vector<Index> column_start_, row_;
  std::vector<double> values_;
};

}  // namespace fpi::fluid
