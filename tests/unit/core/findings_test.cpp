/// Findings: gathered, sorted by file and line, told with their places, cut where many are alike.
#include "core/findings.hpp"

#include <gtest/gtest.h>

namespace fpi {
namespace {

TEST(Findings, are_sorted_by_file_and_the_number_of_the_line) {
  Findings findings;
  for (const char* place : {"b.toml:2", "a.toml:10", "a.toml:9", "--set x=1", "a.toml"})
    findings.add({.key = "k", .text = "t", .place = place});
  findings.sort();
  std::string order;
  for (const Finding& finding : findings.all()) order += finding.place + " ";
  EXPECT_EQ(order, "--set x=1 a.toml a.toml:9 a.toml:10 b.toml:2 ");
}

TEST(Findings, raise_all_errors_with_their_places_and_no_warning) {
  Findings findings;
  findings.warn("a", "a warning");
  EXPECT_NO_THROW(findings.raise());
  findings.error("b", "must be {}", 1);
  findings.attempt("c", [] { fail("must be {}", 2); });
  findings.all().back().place = "a.toml:3";
  try {
    findings.raise();
    FAIL() << "nothing was thrown";
  } catch (const Error& e) {
    EXPECT_STREQ(e.what(), "must be 1\na.toml:3: must be 2");
  }
}

TEST(Findings, of_one_kind_are_told_five_times_and_then_counted) {
  Findings findings;
  for (int i = 0; i < 20; ++i) findings.warn(fmt::format("bodies.{}.radius", i), "body {} is coarse", i);
  findings.error("bodies.3.radius", "an error is another kind");
  const std::vector<std::string> lines = to_lines(findings.all());
  ASSERT_EQ(lines.size(), 7u);
  EXPECT_EQ(lines[4], "body 4 is coarse");
  EXPECT_EQ(lines[5], "… and 15 more like this");
  EXPECT_EQ(lines[6], "an error is another kind");
}

}  // namespace
}  // namespace fpi
