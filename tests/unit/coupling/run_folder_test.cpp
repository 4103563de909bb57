/// What a run folder says of its run: whether it is under way, and how it ended.
#include "run_folder.hpp"

#include <gtest/gtest.h>

#include "../temporary_folder.hpp"
#include "core/error.hpp"
#include "json.hpp"

namespace fpi {
namespace {

TEST(FolderLock, a_folder_belongs_to_one_run_until_it_ends) {
  const TemporaryFolder folder;
  {
    const FolderLock lock(folder.path());
    EXPECT_THROW(FolderLock{folder.path()}, Error);
  }
  EXPECT_NO_THROW(FolderLock{folder.path()});
}

TEST(Json, a_summary_says_null_for_a_lost_participant_and_zero_for_one_not_needed) {
  Summary summary;
  summary.figures["fluid"] = {};
  const std::string text = to_json(summary);
  EXPECT_NE(text.find("\"fluid_server\": null"), std::string::npos) << text;
  EXPECT_NE(text.find("\"dem_server\": 0"), std::string::npos) << text;
  EXPECT_NE(text.find("\"status\": \"failed\""), std::string::npos) << text;
}

TEST(Json, only_the_summary_of_a_completed_run_says_so) {
  Summary summary;
  EXPECT_FALSE(says_completed(to_json(summary)));
  summary.status = "completed";
  EXPECT_TRUE(says_completed(to_json(summary)));
  for (const char* text : {"", "{", "[]", "{\"status\": 1}"}) EXPECT_FALSE(says_completed(text)) << text;
}

}  // namespace
}  // namespace fpi
