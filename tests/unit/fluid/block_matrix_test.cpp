#include "fluid/linear/block_matrix.hpp"

#include <gtest/gtest.h>

#include <random>

namespace fpi::fluid {
namespace {

/// Random overlapping blocks, beside the dense matrix they add up to.
struct RandomBlocks {
  static constexpr int n = 40, size = 6;
  BlockMask mask = BlockMask::dense(size);
  BlockMatrix matrix{n};
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);

  RandomBlocks() {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> value(-1, 1);
    std::uniform_int_distribution<Index> equation(-1, n - 1);
    mask.coupled[3] = 0;
    std::vector<std::array<Index, size>> blocks;
    for (int b = 0; b < 60; ++b) {
      std::array<Index, size> e;
      for (int i = 0; i < size; ++i) do
          e[i] = b < n / size && i < size ? (b * size + i) % n : equation(random);
        while (e[i] >= 0 && std::find(e.begin(), e.begin() + i, e[i]) != e.begin() + i);
      blocks.push_back(e);
      matrix.declare(e, mask);
    }
    matrix.finish();
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      Eigen::Matrix<double, size, size> block;
      for (double& x : block.reshaped()) x = value(random);
      block.diagonal().array() += 4;
      matrix.add(static_cast<Index>(b), block.data());
      for (int i = 0; i < size; ++i)
        for (int j = 0; j < size; ++j)
          if (blocks[b][i] >= 0 && blocks[b][j] >= 0 && mask.coupled[i + size * j])
            dense(blocks[b][i], blocks[b][j]) += block(i, j);
    }
    for (int i = 36; i < n; ++i) EXPECT_NE(dense(i, i), 0);
  }
};

Vector multiply(const BlockMatrix& matrix, const Vector& x) {
  Vector y = Vector::Zero(matrix.n());
  for (Index c = 0; c < matrix.n(); ++c)
    for (Index k = matrix.column_start()[c]; k < matrix.column_start()[c + 1]; ++k)
      y[matrix.row()[k]] += matrix.values()[k] * x[c];
  return y;
}

TEST(BlockMatrix, is_the_sum_of_its_blocks_without_masked_and_absent_entries) {
  const RandomBlocks r;
  for (int j = 0; j < RandomBlocks::n; ++j) {
    const Vector unit = Vector::Unit(RandomBlocks::n, j);
    EXPECT_LT((multiply(r.matrix, unit) - r.dense.col(j)).norm(), 1e-14);
  }
}

TEST(BlockMatrix, rows_of_a_column_ascend) {
  const RandomBlocks r;
  for (Index c = 0; c < r.matrix.n(); ++c)
    for (Index k = r.matrix.column_start()[c] + 1; k < r.matrix.column_start()[c + 1]; ++k)
      EXPECT_LT(r.matrix.row()[k - 1], r.matrix.row()[k]);
}

}  // namespace
}  // namespace fpi::fluid
