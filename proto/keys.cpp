#include "proto/keys.hpp"

#include <zmq.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <system_error>

#include "core/error.hpp"
#include "proto/secret_file.hpp"

namespace fpi::proto {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t key_length = 40;  ///< characters of Z85 for 32 bytes
constexpr mode_t for_all_to_read = 0644;
constexpr std::array owners{"coupler", "participant"};

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
    write_new(fs::path(folder) / (owner + ".secret"), secret.data(), owner_only);
    write_new(fs::path(folder) / (owner + ".public"), open.data(), for_all_to_read);
  }
}

std::string read_key(const std::string& folder, const std::string& file) {
  const fs::path path = fs::path(folder) / file;
  std::error_code unknown;
  require(fs::exists(path, unknown),
          "key file {} is required and cannot be found: make keys with ./fpi keys {}, or copy it",
          path.string(), folder);
  const std::string key = path.extension() == ".secret" ? read_secret(path) : read_public(path);
  std::array<std::uint8_t, 32> bytes{};
  require(key.size() == key_length && zmq_z85_decode(bytes.data(), key.c_str()) != nullptr,
          "a key is {} characters of Z85; {} holds something else: make keys anew with ./fpi keys",
          key_length, path.string());
  return key;
}

}  // namespace fpi::proto
