/// Bodies at a few random places in the mesh keep their accuracy; every_offset_test.cpp has more of them and
/// finer meshes.
#include <gtest/gtest.h>

#include "offset_cases.hpp"

namespace fpi::fluid::testing {
namespace {

TEST(Offsets, drag_lift_and_pressure_difference_of_dfg_2d_1) {
  const Worst worst = dfg_errors(8, 3);
  EXPECT_LT(worst.at("cd"), 3e-3);
  EXPECT_LT(worst.at("cl"), 4e-3);
  EXPECT_LT(worst.at("dp"), 3e-2);
}

TEST(Offsets, torque_of_taylor_couette_has_order_4_and_traction_and_pressure_beside_the_disc_nearly_2) {
  const Worst coarse = couette_errors(8, 3), fine = couette_errors(16, 3);
  EXPECT_LT(coarse.at("torque"), 4e-4);
  EXPECT_LT(fine.at("torque"), 3e-5);
  EXPECT_LT(coarse.at("traction"), 2e-2);
  EXPECT_LT(fine.at("traction"), 1e-2);
  EXPECT_GT(std::log2(coarse.at("torque") / fine.at("torque")), 3.5);
  EXPECT_GT(std::log2(coarse.at("traction") / fine.at("traction")), 1.5);
  EXPECT_GT(std::log2(coarse.at("pressure") / fine.at("pressure")), 1.3);
}

TEST(Offsets, stokes_drag_hardly_changes_while_a_disc_slides_over_two_elements) {
  EXPECT_LT(sliding_noise(8, 8), 1e-4);
}

}  // namespace
}  // namespace fpi::fluid::testing
