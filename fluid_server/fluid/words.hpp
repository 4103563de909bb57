/// White-space separated words of a mesh file, with the line number for errors. What a word must be is asked
/// for where it is read, so that hostile text ends in a sentence.
#pragma once

#include <charconv>
#include <string>
#include <string_view>

#include "core/error.hpp"

namespace fpi::fluid {

class Words {
 public:
  /// `name` stands for the text in errors.
  Words(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  bool at_end() {
    skip_space();
    return position_ == text_.size();
  }
  std::string_view word() {
    skip_space();
    const std::size_t begin = position_;
    while (position_ < text_.size() && !is_space(text_[position_])) ++position_;
    if (begin == position_) bad("more text", "the end of the file");
    return text_.substr(begin, position_ - begin);
  }
  std::string quoted() {
    skip_space();
    const std::size_t end =
        position_ < text_.size() ? text_.find('"', position_ + 1) : std::string_view::npos;
    if (end == std::string_view::npos || text_[position_] != '"') bad("a name in quotes", "something else");
    std::string out(text_.substr(position_ + 1, end - position_ - 1));
    position_ = end + 1;
    return out;
  }
  template <class Number>
  Number number() {
    const std::string_view w = word();
    Number value{};
    const auto [end, error] = std::from_chars(w.data(), w.data() + w.size(), value);
    if (error != std::errc{} || end != w.data() + w.size()) bad("a number", std::string(w));
    return value;
  }
  /// A count, which cannot exceed what is left of the file.
  std::size_t count() {
    const auto n = number<std::int64_t>();
    if (n < 0 || static_cast<std::size_t>(n) > text_.size() - position_)
      bad("a count that the rest of the file can hold", std::to_string(n));
    return static_cast<std::size_t>(n);
  }
  void skip_line() {
    while (position_ < text_.size() && text_[position_] != '\n') ++position_;
  }
  void skip_to(std::string_view word) {
    const std::size_t found = text_.find(word, position_);
    if (found == std::string_view::npos) bad(std::string(word), "the end of the file");
    while (position_ < found + word.size()) line_ += text_[position_++] == '\n';
  }
  [[noreturn]] void bad(const std::string& wanted, const std::string& got) const {
    fail("{}:{}: {} is required; got {}: write the mesh anew with Gmsh (ASCII, format 2.2 or 4.1)", name_,
         line_, wanted, got);
  }

 private:
  static bool is_space(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }
  void skip_space() {
    while (position_ < text_.size() && is_space(text_[position_])) line_ += text_[position_++] == '\n';
  }
  std::string_view text_;
  std::string name_;
  std::size_t position_ = 0;
  std::size_t line_ = 1;
};

}  // namespace fpi::fluid
