#include "grains/packing.hpp"

#include <gtest/gtest.h>

#include "grains/radii.hpp"
#include "spheres.hpp"

namespace fpi::grains {
namespace {

struct Packed {
  Box box;
  std::vector<double> radii;
};

/// `n` grains of radii 1 to `ratio` and the cube or square that they fill to `solid_fraction`.
Packed to_pack(std::size_t axes, std::size_t n, double ratio, double solid_fraction) {
  Packed out;
  double volume = 0;
  for (std::size_t i = 0; i < n; ++i) {
    out.radii.push_back(1 + (ratio - 1) * static_cast<double>(i) / static_cast<double>(n));
    volume += unit_volume(axes) * std::pow(out.radii.back(), static_cast<double>(axes));
  }
  const double side = std::pow(volume / solid_fraction, 1 / static_cast<double>(axes));
  out.box = {
      .lower = {-1, -2, 0}, .upper = {side - 1, side - 2, axes == 2 ? 0 : side}, .axes = axes, .periods = {}};
  return out;
}

void expect_packed(const Packed& asked, double least, std::span<const Sphere> obstacles = {}) {
  const auto centres = pack(asked.box, asked.radii, least, obstacles, 1);
  ASSERT_TRUE(centres.has_value());
  std::vector<Sphere> spheres;
  for (std::size_t i = 0; i < centres->size(); ++i) {
    spheres.push_back({(*centres)[i], asked.radii[i]});
    for (std::size_t k = 0; k < asked.box.axes; ++k) {
      const double margin = asked.box.periods[k] > 0 ? 0 : asked.radii[i];
      EXPECT_GE((*centres)[i][k], asked.box.lower[k] + margin);
      EXPECT_LE((*centres)[i][k], asked.box.upper[k] - margin);
    }
  }
  spheres.insert(spheres.end(), obstacles.begin(), obstacles.end());
  EXPECT_GE(narrowest_gap(spheres, asked.box.periods), least);
}

/// Without sides, which take some of the room.
Packed periodic(Packed packed) {
  for (std::size_t k = 0; k < packed.box.axes; ++k)
    packed.box.periods[k] = packed.box.upper[k] - packed.box.lower[k];
  return packed;
}

TEST(Packing, has_no_overlap_up_to_82_per_cent_of_discs) {
  for (const double solid_fraction : {0.02, 0.5, 0.75})
    expect_packed(to_pack(2, 600, 1.4, solid_fraction), 0);
  expect_packed(periodic(to_pack(2, 600, 1.4, 0.82)), 0);
}

TEST(Packing, has_no_overlap_up_to_60_per_cent_of_spheres) {
  for (const double solid_fraction : {0.02, 0.3, 0.5}) expect_packed(to_pack(3, 600, 1.2, solid_fraction), 0);
  expect_packed(periodic(to_pack(3, 600, 1.2, 0.6)), 0);
}

TEST(Packing, keeps_the_gap_asked_for_and_clear_of_what_is_there) {
  const Packed asked = to_pack(2, 200, 5, 0.5);
  const Sphere post{{asked.box.upper[0] / 2, asked.box.upper[1] / 2, 0}, 10};
  expect_packed(asked, 0.2, std::span(&post, 1));
}

TEST(Packing, is_the_same_for_the_same_seed_only) {
  const Packed asked = to_pack(2, 100, 1, 0.6);
  EXPECT_EQ(pack(asked.box, asked.radii, 0, {}, 1), pack(asked.box, asked.radii, 0, {}, 1));
  EXPECT_NE(pack(asked.box, asked.radii, 0, {}, 1), pack(asked.box, asked.radii, 0, {}, 2));
}

TEST(Packing, gives_up_where_grains_jam) {
  for (const auto& [axes, solid_fraction] : {std::pair{2, 0.9}, {3, 0.68}, {2, 1.0}}) {
    const Packed asked = to_pack(static_cast<std::size_t>(axes), 150, 1.4, solid_fraction);
    EXPECT_FALSE(pack(asked.box, asked.radii, 0, {}, 1).has_value());
  }
}

}  // namespace
}  // namespace fpi::grains
