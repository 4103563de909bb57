/// Checkpoints: what is damaged is refused, the one before it is taken, and what the run rests on is named.
#include "run/checkpoint.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "../temporary_folder.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"

namespace fpi {
namespace {

proto::Bytes bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

scene::Scene a_scene() {
  scene::Scene scene;
  scene.time.step = 0.1;
  scene.time.end = 1;
  return scene;
}

/// After so many steps.
Checkpoint a_checkpoint(double steps, const Files& files = {}) {
  return {.inputs = inputs_up_to_any_end(a_scene(), files),
          .time = 0.1 * steps,
          .problem = {{"steps", {steps}}, {"position", {0.1, -2, 3e-300}}, {"none", {}}},
          .time_window = {1, 2, 3},
          .statistics = {4, std::nan("")},
          .file_sizes = {5},
          .participants = {{"dem", bytes_of(std::string(500, 'd'))},
                           {"fluid", bytes_of(std::string(900, '\0'))}}};
}

double steps_in(const std::string& folder, const Files& files = {}) {
  return read_checkpoint(folder, inputs_up_to_any_end(a_scene(), files)).problem.at("steps").front();
}

std::string refusal(const std::string& folder, const Inputs& inputs) {
  try {
    read_checkpoint(folder, inputs);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

void flip_bit(const std::string& path, std::uint64_t bit) {
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekg(static_cast<std::streamoff>(bit / 8));
  const int byte = file.get() ^ (1 << bit % 8);
  file.seekp(static_cast<std::streamoff>(bit / 8));
  file.put(static_cast<char>(byte));
}

TEST(Checkpoint, comes_back_to_the_bit) {
  const Checkpoint before = a_checkpoint(7, {{"t.csv", bytes_of("x,y\n")}});
  const proto::Bytes bytes = to_bytes(before);
  const Checkpoint after = checkpoint_from_bytes(bytes);
  EXPECT_EQ(to_bytes(after), bytes);
  EXPECT_EQ(after.inputs, before.inputs);
  EXPECT_EQ(after.problem, before.problem);
  EXPECT_EQ(after.participants, before.participants);
  EXPECT_EQ(after.time, before.time);
}

TEST(Checkpoint, of_which_any_single_bit_is_another_is_refused) {
  proto::Bytes bytes = to_bytes(a_checkpoint(7));
  ASSERT_GT(8 * bytes.size(), 1000u);
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    const auto mask = static_cast<std::uint8_t>(1 << bit % 8);
    bytes[bit / 8] ^= mask;
    EXPECT_THROW(checkpoint_from_bytes(bytes), Error) << bit;
    bytes[bit / 8] ^= mask;
  }
}

TEST(Checkpoint, that_is_cut_or_longer_is_refused) {
  const proto::Bytes bytes = to_bytes(a_checkpoint(7));
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(checkpoint_from_bytes(std::span(bytes).first(size)), Error) << size;
  proto::Bytes longer = bytes;
  longer.push_back(0);
  EXPECT_THROW(checkpoint_from_bytes(longer), Error);
}

TEST(Checkpoint, that_is_damaged_is_replaced_by_the_one_before_it_in_a_thousand_cases) {
  const TemporaryFolder folder;
  std::mt19937_64 random(5);
  const std::size_t bits = 8 * to_bytes(a_checkpoint(20)).size();
  for (int trial = 0; trial < 1000; ++trial) {
    for (const double steps : {10., 20.}) {
      const proto::Bytes bytes = to_bytes(a_checkpoint(steps));
      std::ofstream((steps == 10 ? previous_checkpoint_file : checkpoint_file)(folder.path()),
                    std::ios::binary)
          .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    }
    flip_bit(checkpoint_file(folder.path()), random() % bits);
    ASSERT_EQ(steps_in(folder.path()), 10);
    ASSERT_EQ(steps_in(folder.path()), 10) << "it took the place of the damaged one";
  }
}

TEST(Checkpoint, the_last_two_are_kept) {
  const TemporaryFolder folder;
  EXPECT_FALSE(has_checkpoint(folder.path()));
  for (const double steps : {10., 20., 30.}) write_checkpoint(folder.path(), a_checkpoint(steps));
  EXPECT_EQ(steps_in(folder.path()), 30);
  std::filesystem::remove(checkpoint_file(folder.path()));
  EXPECT_TRUE(has_checkpoint(folder.path()));
  EXPECT_EQ(steps_in(folder.path()), 20) << "a kill between two renamings leaves the previous one alone";
}

TEST(Checkpoint, where_both_are_damaged_both_are_named) {
  const TemporaryFolder folder;
  for (const double steps : {10., 20.}) write_checkpoint(folder.path(), a_checkpoint(steps));
  flip_bit(checkpoint_file(folder.path()), 100);
  flip_bit(previous_checkpoint_file(folder.path()), 100);
  const std::string words = refusal(folder.path(), inputs_up_to_any_end(a_scene(), {}));
  EXPECT_NE(words.find("/checkpoint.bin: "), std::string::npos) << words;
  EXPECT_NE(words.find("/checkpoint.previous.bin: "), std::string::npos) << words;
}

TEST(Checkpoint, names_the_input_file_that_was_changed_since) {
  const TemporaryFolder folder;
  const Files files{{"a.msh", bytes_of("mesh")}, {"t.csv", bytes_of("x,y\n1,2\n")}};
  write_checkpoint(folder.path(), a_checkpoint(10, files));
  EXPECT_EQ(steps_in(folder.path(), files), 10);
  Files edited = files;
  edited[1].bytes.back() = ' ';
  const std::string words = refusal(folder.path(), inputs_up_to_any_end(a_scene(), edited));
  EXPECT_NE(words.find("t.csv was changed"), std::string::npos) << words;
  EXPECT_EQ(words.find("a.msh"), std::string::npos) << words;
}

TEST(Inputs, are_the_values_and_the_bytes_and_nothing_else) {
  scene::Scene scene = a_scene();
  scene.fluid.emplace();
  const Files files{{"a.msh", bytes_of("mesh")}};
  const auto of = [](const scene::Scene& s, const Files& f) { return fingerprint(inputs_of(s, f)); };
  const std::uint64_t before = of(scene, files);
  EXPECT_NE(of(scene, {{"a.msh", bytes_of("mash")}}), before);
  EXPECT_NE(of(scene, {{"b.msh", bytes_of("mesh")}}), before);
  EXPECT_NE(of(scene, {}), before);
  scene::Scene same = scene;
  same.title = "another title";
  same.fluid->launch.command = "/opt/fluid --fast";
  same.dem.emplace().launch.external = true;
  same.coupling.participant_timeout = 600;
  same.output.checkpoint_interval = 5;
  EXPECT_EQ(of(same, files), before);
  same.output.checkpoint_every = 5;
  EXPECT_NE(of(same, files), before) << "factors are made anew there";
  scene.time.end = 2;
  EXPECT_NE(of(scene, files), before);
  const Inputs to_two = inputs_up_to_any_end(scene, files);
  scene.time.end = 3;
  EXPECT_EQ(inputs_up_to_any_end(scene, files), to_two);
}

}  // namespace
}  // namespace fpi
