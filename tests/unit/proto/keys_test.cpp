/// Keys: who has the right ones takes part, everybody else is told what is wrong.
#include "proto/keys.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "../temporary_folder.hpp"
#include "parties.hpp"
#include "proto/transport/address.hpp"

namespace fpi::proto {
namespace {

using namespace parties;
namespace fs = std::filesystem;

class Keys : public testing::Test {
 protected:
  std::string made(const std::string& name) const {
    make_keys(folder_ / name);
    return folder_ / name;
  }
  /// A folder with participant keys of `own` and the coupler's key of `coupler`, as a remote machine has it.
  std::string mixed(const std::string& own, const std::string& coupler) const {
    const fs::path folder = folder_ / "mixed";
    fs::create_directories(folder);
    for (const char* file : {"participant.secret", "participant.public"})
      fs::copy(fs::path(own) / file, folder / file);
    fs::copy(fs::path(coupler) / "coupler.public", folder / "coupler.public");
    return folder;
  }
  /// Exit status of a fluid with `participant_keys` at a coupler with `coupler_keys` that has everything
  /// else.
  int joined(const std::string& coupler_keys, const std::string& participant_keys) {
    HostOptions options = with_token();
    options.keys = coupler_keys;
    Host host(options);
    Fluid fluid;
    Connection connection = connection_to(host.address());
    connection.keys = participant_keys;
    connection.join_timeout = 30;
    auto status = serve_in_thread(fluid, connection);
    const auto start = std::chrono::steady_clock::now();
    host.while_waiting = [&] {
      if (status.wait_for(std::chrono::seconds(0)) == std::future_status::ready) Host::interrupt();
    };
    try {
      host.admit({"fluid"}, {false});
      host.while_waiting = nullptr;
      host.ask<Configured>("fluid", {}, Configure{});
      host.dismiss("done");
    } catch (const Interrupted&) {
    }
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5)) << "an error, not a timeout";
    return status.get();
  }
  TemporaryFolder folder_;
};

TEST_F(Keys, are_made_once_and_secrets_are_private) {
  const std::string keys = made("a");
  for (const char* file : {"coupler.secret", "coupler.public", "participant.secret", "participant.public"})
    EXPECT_EQ(read_key(keys, file).size(), 40u) << file;
  for (const char* secret : {"coupler.secret", "participant.secret"}) {
    struct stat status {};
    ASSERT_EQ(stat((fs::path(keys) / secret).c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, 0600u) << secret;
  }
  const std::string before = read_key(keys, "coupler.secret");
  EXPECT_THROW(make_keys(keys), Error);
  EXPECT_EQ(read_key(keys, "coupler.secret"), before);
}

TEST_F(Keys, that_are_missing_or_damaged_are_named) {
  const std::string keys = made("a");
  std::ofstream(fs::path(keys) / "coupler.public") << "too short";
  for (const char* file : {"coupler.public", "no_such_file"}) {
    try {
      read_key(keys, file);
      ADD_FAILURE() << file;
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find(file), std::string::npos) << e.what();
    }
  }
}

TEST_F(Keys, that_others_may_read_are_refused_with_the_remedy) {
  const std::string keys = made("a");
  for (const char* secret : {"coupler.secret", "participant.secret"}) {
    const std::string path = fs::path(keys) / secret;
    ASSERT_EQ(chmod(path.c_str(), 0640), 0);
    try {
      read_key(keys, secret);
      ADD_FAILURE() << secret;
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find("has mode 0640: chmod 600 " + path), std::string::npos)
          << e.what();
    }
  }
  EXPECT_NO_THROW(read_key(keys, "coupler.public"));
}

TEST_F(Keys, of_one_pair_let_a_participant_in) {
  const std::string keys = made("a");
  EXPECT_EQ(joined(keys, keys), 0);
  EXPECT_EQ(joined(keys, mixed(keys, keys)), 0);
}

TEST_F(Keys, of_another_participant_are_refused) {
  const std::string a = made("a"), b = made("b");
  EXPECT_EQ(joined(a, mixed(b, a)), 2);
}

TEST_F(Keys, of_another_coupler_are_refused) {
  const std::string a = made("a"), b = made("b");
  EXPECT_EQ(joined(a, mixed(a, b)), 2);
}

TEST_F(Keys, are_needed_on_both_sides_or_on_none) {
  const std::string keys = made("a");
  EXPECT_EQ(joined(keys, ""), 2);
  EXPECT_EQ(joined("", keys), 2);
}

TEST_F(Keys, are_needed_beyond_this_machine) {
  for (const char* address : {"tcp://0.0.0.0:*", "tcp://*:5555", "tcp://192.168.1.5:5555", "tcp://[::]:5555",
                              "tcp://127.0.0.1.example.com:5555", "tcp://eth0:5555"}) {
    HostOptions options = with_token();
    options.address = address;
    try {
      Host host(options);
      ADD_FAILURE() << address << " was taken without keys";
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find("./fpi keys"), std::string::npos) << e.what();
    }
    Fluid fluid;
    EXPECT_EQ(serve(fluid, connection_to(address)), 2);
  }
  EXPECT_NO_THROW(require_usable("tcp://192.168.1.5:5555", "keys"));
}

TEST_F(Keys, are_not_needed_on_this_machine) {
  for (const char* address : {"tcp://127.0.0.1:5555", "tcp://127.1.2.3:*", "tcp://localhost:1",
                              "tcp://[::1]:5555", "ipc:///tmp/fpi"})
    EXPECT_TRUE(is_local(address)) << address;
}

}  // namespace
}  // namespace fpi::proto
