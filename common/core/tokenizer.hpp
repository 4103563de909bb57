/// White-space separated words of a mesh file, with the line number for errors. What a word must be is asked
/// for where it is read, so that hostile text ends in a sentence.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "core/number.hpp"
#include "core/utf8.hpp"

namespace fpi {

class Tokenizer {
 public:
  /// `name` stands for the text in errors, which end with the `remedy`.
  Tokenizer(std::string_view text, const std::string& name, const std::string& remedy)
      : text_(without_byte_order_mark(text)), name_(name), remedy_(remedy) {}

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
    if (first_bad_byte(out) != out.size() || out.find('\n') != std::string::npos)
      bad("a name in UTF-8 on one line", printable(out));
    position_ = end + 1;
    return out;
  }
  template <class Number>
  Number number() {
    const std::string_view w = word();
    const auto value = to_number<Number>(w);
    if (!value) bad("a number", printable(w));
    return *value;
  }
  /// A coordinate [m], or another real: of a size that can be computed with.
  double real() {
    const std::string_view w = word();
    const auto value = to_number<double>(w);
    if (!value) bad("a number", printable(w));
    if (std::abs(*value) > largest_real) bad(fmt::format("a number up to {:g}", largest_real), printable(w));
    return *value;
  }
  /// Takes the word `wanted`, in capitals or not.
  void expect(std::string_view wanted) {
    const std::string_view w = word();
    if (!same(w, wanted)) bad(std::string(wanted), printable(w));
  }
  /// Whether `word` is `wanted`, in capitals or not.
  static bool same(std::string_view word, std::string_view wanted) {
    return std::ranges::equal(word, wanted, [](char a, char b) {
      return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
    });
  }
  /// A count, which cannot exceed what is left of the file.
  std::size_t count() {
    const auto n = number<std::int64_t>();
    if (n < 0 || static_cast<std::size_t>(n) > text_.size() - position_)
      bad("a count that the rest of the file can hold", std::to_string(n));
    return static_cast<std::size_t>(n);
  }
  void skip(int words) {
    for (; words > 0; --words) word();
  }
  void skip_line() {
    while (position_ < text_.size() && text_[position_] != '\n' && text_[position_] != '\r') ++position_;
  }
  void skip_to(std::string_view word) {
    const std::size_t found = text_.find(word, position_);
    if (found == std::string_view::npos) bad(std::string(word), "the end of the file");
    while (position_ < found + word.size()) line_ += text_[position_++] == '\n';
  }
  [[noreturn]] void bad(const std::string& wanted, const std::string& got) const {
    fail("{}:{}: {} is required; got {}: {}", name_, line_, wanted, got, remedy_);
  }

 private:
  static bool is_space(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }
  void skip_space() {
    while (position_ < text_.size() && is_space(text_[position_])) line_ += text_[position_++] == '\n';
  }
  std::string_view text_;
  std::string name_, remedy_;
  std::size_t position_ = 0;
  std::size_t line_ = 1;
};

}  // namespace fpi
