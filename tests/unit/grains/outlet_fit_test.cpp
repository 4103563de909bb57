#include "grains/outlet_fit.hpp"

#include <gtest/gtest.h>

#include "spheres.hpp"

namespace fpi::grains {
namespace {

std::string disc(const std::string& name, const std::string& x, const std::string& radius) {
  return "[[bodies]]\nname = \"" + name + "\"\nradius = " + radius + "\ndensity = 1\nposition = [" + x +
         ", 0]\n";
}

const std::string outlet = "[[outlets]]\nname = \"out\"\nlower = [5, -1]\nupper = [5.05, 1]\n";

TEST(OutletFit, an_outlet_that_no_body_fits_in_is_refused_with_the_numbers) {
  EXPECT_EQ(error_of(outlet + disc("a", "0", "0.03")),
            "outlet out must hold a body as a whole, which then leaves; along x it is 0.05 m wide, and the "
            "smallest "
            "free body, a, is 0.06 m: make it wider");
  EXPECT_EQ(error_of(outlet + disc("a", "0", "0.03") + disc("b", "1", "0.02")), "") << "one fits";
}

TEST(OutletFit, bodies_that_never_leave_are_told) {
  const auto sentences = [](const std::string& text) {
    return narrow_outlets(scene::read_text(text, "test"));
  };
  const std::string rest = "[time]\nstep = 1\nend = 1\n[[materials]]\nname = \"m\"\nyoungs_modulus = 1e7\n" +
                           disc("b", "1", "0.02");
  const auto found = sentences(outlet + rest + disc("a", "0", "0.03"));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].find("1 of the free bodies never leave through outlet out"), 0u) << found[0];
  EXPECT_TRUE(sentences(outlet + rest).empty());
  const std::string all =
      "[[outlets]]\nname = \"out\"\nlower = [0, -1]\nupper = [0.01, 1]\n[periodic]\nx = [0, 0.01]\n";
  EXPECT_TRUE(sentences(all + rest).empty()) << "it has no ends along x";
}

}  // namespace
}  // namespace fpi::grains
