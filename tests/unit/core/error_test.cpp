/// Errors and their hints.
#include "core/error.hpp"

#include <gtest/gtest.h>

#include <array>

namespace fpi {
namespace {

TEST(Error, carries_the_formatted_sentence) {
  try {
    fail("a step > 0 s is required; got {}", -0.5);
  } catch (const Error& e) {
    EXPECT_STREQ(e.what(), "a step > 0 s is required; got -0.5");
    return;
  }
  FAIL() << "fail() returned";
}

TEST(Error, require_throws_only_where_the_condition_fails) {
  EXPECT_NO_THROW(require(true, "never told"));
  EXPECT_THROW(require(false, "told"), Error);
}

TEST(EditDistance, counts_insertions_deletions_and_substitutions) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("density", "densty"), 1u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("sitting", "kitten"), 3u);
}

TEST(DidYouMean, finds_the_nearest_word_and_stays_silent_where_none_is_near) {
  constexpr std::array<std::string_view, 3> words{"density", "viscosity", "radius"};
  EXPECT_EQ(did_you_mean("raduis", words), "radius");
  EXPECT_EQ(did_you_mean("viscocity", words), "viscosity");
  EXPECT_EQ(did_you_mean("temperature", words), "");
  EXPECT_EQ(did_you_mean("density", std::array<std::string_view, 0>{}), "");
}

TEST(DidYouMean, prefers_the_nearer_of_two_words) {
  constexpr std::array<std::string_view, 2> words{"cells_x", "cells_y"};
  EXPECT_EQ(did_you_mean("cell_y", words), "cells_y");
}

}  // namespace
}  // namespace fpi
