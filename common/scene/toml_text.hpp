/// Values as canonical TOML text: shortest digits that read back to the same bits, strings escaped. The
/// writer, the reference and error messages share it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/parameters.hpp"

namespace fpi::scene {

std::string toml_text(double value);
std::string toml_text(std::int64_t value);
std::string toml_text(bool value);
std::string toml_text(const std::string& value);
std::string toml_text(const std::vector<double>& values);
std::string toml_text(const std::vector<std::string>& values);
/// A key, quoted only where TOML needs it.
std::string toml_key(const std::string& key);

/// "> 0", "in (0, 1]", or "" where any number is allowed.
std::string describe(const Bounds& bounds);
/// "2", "2 to 3", "at least 1", or "" where any number of entries is allowed.
std::string describe(const Count& count);
/// "\"a\", \"b\"".
std::string describe(std::span<const std::string_view> choices);

}  // namespace fpi::scene
