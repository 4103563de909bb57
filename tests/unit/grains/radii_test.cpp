#include "grains/radii.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace fpi::grains {
namespace {

double volume(const std::vector<double>& radii, double axes, double below = 1e300) {
  double sum = 0;
  for (const double r : radii)
    if (r < below) sum += std::pow(r, axes);
  return sum;
}

scene::Grains graded(const std::string& shape) {
  scene::Grains group;
  group.shape = shape;
  group.sieve_sizes = {0.5e-3, 1e-3, 2e-3, 4e-3, 8e-3};
  group.passing = {0, 15, 40, 80, 100};
  return group;
}

TEST(Radii, follow_a_grading_curve_at_its_sieves_and_between_them) {
  for (const std::string shape : {"disc", "sphere"}) {
    const scene::Grains group = graded(shape);
    const auto axes = static_cast<double>(group.axes());
    const double total = unit_volume(group.axes()) * 300 * std::pow(4e-3, axes);
    const std::vector<double> radii = radii_of_volume(size_classes(group), group.axes(), total);
    const double all = volume(radii, axes);
    EXPECT_NEAR(unit_volume(group.axes()) * all / total, 1, 0.01);
    for (std::size_t i = 0; i < group.passing.size(); ++i)
      EXPECT_NEAR(volume(radii, axes, group.sieve_sizes[i] / 2) / all, group.passing[i] / 100, 0.003)
          << shape;
    // Half way up a class in the logarithm of size half of its mass has passed.
    EXPECT_NEAR(volume(radii, axes, std::sqrt(2e-3 * 4e-3) / 2) / all, 0.60, 0.003) << shape;
  }
}

TEST(Radii, of_a_range_are_as_many_small_as_large) {
  scene::Grains group;
  group.radius_range = {1, 3};
  const std::vector<double> radii = radii_of_count(size_classes(group), 2, 1000);
  ASSERT_EQ(radii.size(), 1000u);
  EXPECT_NEAR(std::accumulate(radii.begin(), radii.end(), 0.0) / 1000, 2, 1e-9);
  EXPECT_NEAR(volume(radii, 2) / 1000, 13.0 / 3, 1e-3);  // mean of r²
  EXPECT_TRUE(std::ranges::all_of(radii, [](double r) { return r >= 1 && r <= 3; }));
}

TEST(Radii, of_a_count_follow_the_grading_curve_too) {
  const scene::Grains group = graded("sphere");
  const std::vector<double> radii = radii_of_count(size_classes(group), 3, 100000);
  ASSERT_EQ(radii.size(), 100000u);
  for (std::size_t i = 0; i < group.passing.size(); ++i)
    EXPECT_NEAR(volume(radii, 3, group.sieve_sizes[i] / 2) / volume(radii, 3), group.passing[i] / 100, 0.01);
}

}  // namespace
}  // namespace fpi::grains
