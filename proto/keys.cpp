#include "proto/keys.hpp"

#include <fcntl.h>
#include <unistd.h>
#include <zmq.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/error.hpp"

namespace fpi::proto {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t key_length = 40;  ///< characters of Z85 for 32 bytes
constexpr std::array owners{"coupler", "participant"};

/// Writes a new file that nobody but its owner ever could read, where it is a secret.
void write_new(const fs::path& file, const char* key, mode_t mode) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  require(descriptor >= 0, "a key file that can be made is required; got {} ({})", file.string(),
          std::strerror(errno));
  const ssize_t written = ::write(descriptor, key, key_length);
  const bool closed = ::close(descriptor) == 0;
  require(written == static_cast<ssize_t>(key_length) && closed, "key file {} could not be written: {}",
          file.string(), std::strerror(errno));
}

}  // namespace

void make_keys(const std::string& folder) {
  for (const std::string owner : owners)
    for (const char* kind : {".secret", ".public"})
      require(!fs::exists(fs::path(folder) / (owner + kind)),
              "keys are made in a folder without any; {} has {} already: take another folder or remove it",
              folder, owner + kind);
  std::error_code failed;
  fs::create_directories(folder, failed);
  require(!failed, "a folder for the keys is required; {} cannot be made: {}", folder, failed.message());
  for (const std::string owner : owners) {
    std::array<char, key_length + 1> open{}, secret{};
    require(zmq_curve_keypair(open.data(), secret.data()) == 0,
            "keys need a ZeroMQ library with CURVE; this one said: {}", zmq_strerror(zmq_errno()));
    write_new(fs::path(folder) / (owner + ".secret"), secret.data(), S_IRUSR | S_IWUSR);
    write_new(fs::path(folder) / (owner + ".public"), open.data(), S_IRUSR | S_IWUSR | S_IRGRP | S_IROTH);
  }
}

std::string read_key(const std::string& folder, const std::string& file) {
  const fs::path path = fs::path(folder) / file;
  std::ifstream in(path);
  require(in.good(), "key file {} is required and cannot be read: make keys with ./fpi keys {}, or copy it",
          path.string(), folder);
  std::string key;
  in >> key;
  std::array<std::uint8_t, 32> bytes{};
  require(key.size() == key_length && zmq_z85_decode(bytes.data(), key.c_str()) != nullptr,
          "a key is {} characters of Z85; {} holds something else: make keys anew with ./fpi keys",
          key_length, path.string());
  return key;
}

}  // namespace fpi::proto
