/// A fuzz target: one function that takes any bytes, and the good inputs that mutations start from. libFuzzer
/// drives it where FPI_LIBFUZZER is on (clang); else main.cpp does, with seeded mutations, so that it is a
/// test.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"

/// Reads `data` as the code under test would. Ends the process where that code does what it must not.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace fpi::fuzz {

using Bytes = std::vector<std::uint8_t>;

/// Good inputs; each target defines them.
std::vector<Bytes> seeds();
/// What mutations insert besides pieces of the seeds; each target defines them, often none.
std::vector<std::string> words();

inline std::string_view text(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// The content of the files of a folder, in the order of their names.
inline std::vector<Bytes> files(const std::filesystem::path& folder, std::string_view extension = "") {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (extension.empty() || entry.path().extension() == extension) paths.push_back(entry.path());
  std::ranges::sort(paths);
  std::vector<Bytes> contents;
  for (const auto& path : paths) {
    std::ifstream file(path, std::ios::binary);
    contents.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return contents;
}

/// Says what is wrong, and ends the process as a crash does.
[[noreturn]] inline void fault(const std::string& what) {
  std::fprintf(stderr, "fuzz: %s\n", what.c_str());
  std::abort();
}

/// Runs `read`, which may refuse its input only by an Error that names `where`: a file, or a key.
template <class Read>
void takes_or_refuses(std::string_view where, Read read) {
  try {
    read();
  } catch (const Error& e) {
    if (std::string_view(e.what()).find(where) == std::string_view::npos)
      fault(fmt::format("an error that names {} is required; got: {}", where, e.what()));
  }
}

}  // namespace fpi::fuzz
