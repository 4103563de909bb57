#include "scene/toml_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace fpi::scene {
namespace {

template <class T>
std::string list_text(const std::vector<T>& values) {
  std::vector<std::string> texts;
  for (const T& value : values) texts.push_back(toml_text(value));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

}  // namespace

std::string toml_text(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_not_of("-0123456789") == std::string::npos) text += ".0";
  return text;
}

std::string toml_text(std::int64_t value) { return fmt::format("{}", value); }
std::string toml_text(bool value) { return value ? "true" : "false"; }

std::string toml_text(const std::string& value) {
  std::string out = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') {
      out += {'\\', c};
    } else if (c == '\n') {
      out += "\\n";
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      out += fmt::format("\\u{:04X}", static_cast<unsigned char>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string toml_text(const std::vector<double>& values) { return list_text(values); }
std::string toml_text(const std::vector<std::string>& values) { return list_text(values); }

std::string toml_key(const std::string& key) {
  const bool bare = !key.empty() && std::ranges::all_of(key, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  return bare ? key : toml_text(key);
}

std::string describe(const Bounds& b) {
  const bool below = std::isfinite(b.lower), above = std::isfinite(b.upper);
  if (below && above) {
    return fmt::format("in {}{}, {}{}", b.lower_open ? '(' : '[', b.lower, b.upper, b.upper_open ? ')' : ']');
  }
  if (below) return fmt::format("{} {}", b.lower_open ? ">" : "≥", b.lower);
  if (above) return fmt::format("{} {}", b.upper_open ? "<" : "≤", b.upper);
  return "";
}

std::string describe(const Count& count) {
  if (count.least == count.most) return fmt::format("{}", count.least);
  if (count.most != Count{}.most) return fmt::format("{} to {}", count.least, count.most);
  return count.least > 0 ? fmt::format("at least {}", count.least) : "";
}

std::string describe(std::span<const std::string_view> choices) {
  std::vector<std::string> quoted;
  for (const std::string_view choice : choices) quoted.push_back(fmt::format("\"{}\"", choice));
  return fmt::format("{}", fmt::join(quoted, ", "));
}

}  // namespace fpi::scene
