/// Files that the user names: what is read, and what is refused instead of waited for.
#include "core/read_file.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "../temporary_folder.hpp"
#include "core/error.hpp"

namespace fpi {
namespace {

std::string refusal(const std::string& path) {
  try {
    read_file(path, 100, "a scene file");
  } catch (const Error& error) {
    return error.what();
  }
  return "read";
}

TEST(ReadFile, a_regular_file_is_read_byte_by_byte) {
  const TemporaryFolder folder;
  const std::string bytes("a\0b\r\n\xff", 6);
  std::ofstream(folder / "file", std::ios::binary) << bytes;
  std::filesystem::create_symlink("file", folder / "link");
  EXPECT_EQ(read_file(folder / "file", 6, "a file"), bytes);
  EXPECT_EQ(read_file(folder / "link", 6, "a file"), bytes);
}

TEST(ReadFile, what_is_no_regular_file_is_named_and_not_waited_for) {
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
  (folder / "socket").copy(static_cast<char*>(address.sun_path), sizeof address.sun_path - 1);
  ASSERT_EQ(bind(socket, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  EXPECT_EQ(refusal(folder / "pipe"), "a scene file is required; " + (folder / "pipe") + " is a pipe");
  EXPECT_EQ(refusal(folder / "socket"), "a scene file is required; " + (folder / "socket") + " is a socket");
  EXPECT_EQ(refusal(folder.path()), "a scene file is required; " + folder.path() + " is a folder");
  EXPECT_EQ(refusal("/dev/zero"), "a scene file is required; /dev/zero is a device");
  close(socket);
}

TEST(ReadFile, a_missing_an_empty_an_endless_and_a_large_file_are_refused) {
  const TemporaryFolder folder;
  std::ofstream(folder / "empty");
  std::ofstream(folder / "large") << std::string(101, ' ');
  std::filesystem::create_symlink("nowhere", folder / "link");
  EXPECT_NE(refusal(folder / "none").find("No such file"), std::string::npos);
  EXPECT_NE(refusal(folder / "link").find("No such file"), std::string::npos);
  EXPECT_NE(refusal(folder / "empty").find("is empty"), std::string::npos);
  EXPECT_NE(refusal(folder / "large").find("at most 100 bytes"), std::string::npos);
  EXPECT_NE(refusal("/proc/self/mem").find("is empty"), std::string::npos) << "its size is not known";
}

}  // namespace
}  // namespace fpi
