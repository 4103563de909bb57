/// Bodies at twenty random places in meshes of 8, 16 and 32 elements a diameter: the table of
/// docs/numerics.md.
#include <gtest/gtest.h>

#include "offset_cases.hpp"

namespace fpi::fluid::testing {
namespace {

constexpr int n_places = 20;
constexpr std::array<int, 3> resolutions{8, 16, 32};

/// Every error must be below its limits at 8, 16 and 32 elements a diameter; prints the mean order.
void expect_below(const std::array<Worst, 3>& worst,
                  const std::map<std::string, std::array<double, 3>>& limits) {
  for (const auto& [name, limit] : limits) {
    for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(worst[i].at(name), limit[i]) << name << resolutions[i];
    std::cout << fmt::format("order of {}: {:.2f}\n", name,
                             0.5 * std::log2(worst[0].at(name) / worst[2].at(name)));
  }
}

template <class F>
std::array<Worst, 3> at_all_resolutions(F errors) {
  return {errors(resolutions[0], n_places), errors(resolutions[1], n_places),
          errors(resolutions[2], n_places)};
}

TEST(EveryOffset, dfg_2d_1) {
  expect_below(at_all_resolutions(dfg_errors),
               {{"cd", {3e-3, 1e-4, 2e-5}}, {"cl", {4e-3, 1.5e-4, 2e-5}}, {"dp", {3e-2, 6e-3, 2e-3}}});
}

TEST(EveryOffset, taylor_couette) {
  expect_below(
      at_all_resolutions(couette_errors),
      {{"torque", {4e-4, 3e-5, 2e-6}}, {"traction", {2e-2, 1e-2, 4e-3}}, {"pressure", {5e-2, 2e-2, 5e-3}}});
}

TEST(EveryOffset, sliding_disc) {
  EXPECT_LT(sliding_noise(8, n_places), 1e-4);
  EXPECT_LT(sliding_noise(16, n_places), 1e-5);
}

}  // namespace
}  // namespace fpi::fluid::testing
