/// The token of a run: who shows it takes part, nobody else, and nobody else can read it.
#include "proto/token.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "../temporary_folder.hpp"
#include "parties.hpp"
#include "proto/transport/tally.hpp"

namespace fpi::proto {
namespace {

using namespace parties;
namespace fs = std::filesystem;

mode_t mode_of(const std::string& path) {
  struct stat status {};
  EXPECT_EQ(stat(path.c_str(), &status), 0) << path;
  return status.st_mode & 0777;
}

std::string refusal(const std::string& path) {
  try {
    read_token(path);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(Token, is_another_one_each_time) {
  EXPECT_EQ(make_token().size(), 64u);
  EXPECT_NE(make_token(), make_token());
}

TEST(Token, is_in_a_file_for_its_owner_alone_while_the_run_lives) {
  const TemporaryFolder folder;
  std::string path;
  {
    const TokenFile file(folder.path());
    path = file.path();
    EXPECT_EQ(path, fs::path(folder.path()) / ".token");
    EXPECT_EQ(mode_of(path), 0600u);
    EXPECT_EQ(read_token(path), file.token());
  }
  EXPECT_FALSE(fs::exists(path));
}

TEST(Token, replaces_what_a_killed_coupler_left) {
  const TemporaryFolder folder;
  std::ofstream(folder / ".token") << "old";
  fs::permissions(folder / ".token", fs::perms::all);
  const TokenFile file(folder.path());
  EXPECT_EQ(mode_of(file.path()), 0600u);
  EXPECT_EQ(read_token(file.path()), file.token());
}

TEST(Token, that_others_may_read_is_refused_with_the_remedy) {
  const TemporaryFolder folder;
  const TokenFile file(folder.path());
  for (const mode_t mode : {0640u, 0604u, 0620u, 0777u}) {
    ASSERT_EQ(chmod(file.path().c_str(), mode), 0);
    EXPECT_EQ(
        refusal(file.path()),
        fmt::format("a secret that its owner alone can read is required; {0} has mode {1:04o}: chmod 600 {0}",
                    file.path(), mode));
  }
}

TEST(Token, file_must_be_a_file_with_a_token) {
  const TemporaryFolder folder;
  EXPECT_NE(refusal(folder / "missing").find("missing is required and cannot be read"), std::string::npos);
  EXPECT_NE(refusal(folder.path()).find("a regular file is required"), std::string::npos);
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_NE(refusal(folder / "pipe").find("a regular file is required"), std::string::npos);
  for (const std::string& text : {std::string("short"), std::string(64, 'x'), std::string(5000, 'a')}) {
    const std::string path = folder / "other";
    std::ofstream(path) << text;
    fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
    EXPECT_NE(refusal(path), "") << text.size();
  }
}

/// Exit status of a fluid that shows `shown` to a coupler that waits for one with the token.
int joined(const std::string& shown) {
  Host host(with_token());
  Fluid fluid;
  Connection connection = connection_to(host.address());
  connection.token = shown;
  auto status = serve_in_thread(fluid, connection);
  host.while_waiting = [&] {
    if (status.wait_for(std::chrono::seconds(0)) == std::future_status::ready) Host::interrupt();
  };
  try {
    host.admit({"fluid"}, {false});
    host.while_waiting = nullptr;
    host.dismiss("done");
  } catch (const Interrupted&) {
  }
  return status.get();
}

TEST(Token, of_the_run_alone_lets_a_participant_in) {
  EXPECT_EQ(joined(token), 0);
  std::string other = token;
  other.back() = '8';
  for (const std::string& wrong : {other, token + "7", token.substr(1), std::string("x"), std::string()})
    EXPECT_EQ(joined(wrong), 2) << wrong;
}

TEST(Token, is_asked_of_every_client_before_its_first_message_is_read) {
  HostOptions options = with_token();
  options.join_timeout = 1.5;
  Host host(options);
  const Hello hello{.role = "fluid", .program = "thief", .schema_fingerprint = schema_fingerprint()};
  Client wrong(host.address(), std::string(64, '0'));
  zmq::context_t context;
  zmq::socket_t none(context, ZMQ_DEALER);
  none.set(zmq::sockopt::linger, 0);
  none.connect(host.address());
  wrong.send(encode({{}, hello}));
  none.send(zmq::message_t(encode({{}, hello})), zmq::send_flags::none);
  try {
    host.admit({"fluid"}, {false});
    ADD_FAILURE() << "a role was taken without the token";
  } catch (const ParticipantLost& e) {
    EXPECT_NE(std::string(e.what()).find("fluid did not join"), std::string::npos) << e.what();
  }
}

TEST(Token, is_required_of_the_coupler_too) { EXPECT_THROW(Host host(HostOptions{}), Error); }

TEST(Tally, speaks_ever_more_rarely) {
  Tally tally;
  int lines = 0;
  for (int i = 0; i < 100'000; ++i) lines += tally.add();
  EXPECT_EQ(lines, 17);  // 1, 2, 4, … 65536
}

}  // namespace
}  // namespace fpi::proto
