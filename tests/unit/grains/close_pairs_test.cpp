#include "grains/close_pairs.hpp"

#include <gtest/gtest.h>

#include <set>

#include "spheres.hpp"

namespace fpi::grains {
namespace {

/// Radii between 1 and `ratio`, spread over an edge of 60.
std::vector<Sphere> spheres(std::size_t n, double ratio, std::size_t axes) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> place(-30, 30), size(0, 1);
  std::vector<Sphere> out(n);
  for (Sphere& s : out) {
    for (std::size_t k = 0; k < axes; ++k) s.centre[k] = place(random);
    s.radius = std::pow(ratio, size(random));
  }
  return out;
}

void expect_all_pairs(const std::vector<Sphere>& all, double margin, const Periods& periods) {
  std::set<IndexPair> expected;
  for (std::uint32_t i = 0; i < all.size(); ++i)
    for (std::uint32_t j = i + 1; j < all.size(); ++j)
      if (gap(all[i], all[j], periods) <= margin) expected.insert({i, j});
  const std::vector<IndexPair> found = close_pairs(all, margin, periods);
  EXPECT_EQ(found.size(), expected.size()) << "each pair once";
  EXPECT_EQ(std::set(found.begin(), found.end()), expected);
}

TEST(ClosePairs, are_those_of_a_comparison_of_all_with_all) {
  for (const std::size_t axes : {2, 3})
    for (const double ratio : {1.0, 20.0})
      for (const double margin : {0.0, 0.5}) expect_all_pairs(spheres(400, ratio, axes), margin, {});
}

TEST(ClosePairs, reach_through_periodic_sides_of_wide_and_narrow_cells) {
  for (const double period : {60.0, 9.0, 5.0})
    expect_all_pairs(spheres(100, 1.2, 3), 0.1, {period, 0, period});
}

TEST(ClosePairs, stand_an_outlier_far_away) {
  std::vector<Sphere> all = spheres(20000, 1, 3);
  all.push_back({{1e12, -1e30, 0}, 1});
  EXPECT_GT(close_pairs(all, 0, {}).size(), 100u);
}

}  // namespace
}  // namespace fpi::grains
