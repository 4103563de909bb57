#include "mutator.hpp"

namespace fpi::fuzz {
namespace {

const std::vector<std::string> numbers{
    "0",          "-1",     "1",     "3",   "-0.0", "1e308",
    "-1e308",     "1e-310", "1e400", "nan", "inf",  "9223372036854775807",
    "4294967296", "65536",  "1e7",   "0.1", "+2",   "99999999999999999999"};

std::ptrdiff_t offset(std::size_t at) { return static_cast<std::ptrdiff_t>(at); }

/// [first, last) of the bytes around `at` for which `belongs` holds.
template <class Belongs>
std::pair<std::size_t, std::size_t> run_around(const Bytes& bytes, std::size_t at, Belongs belongs) {
  std::size_t first = at, last = at;
  while (first > 0 && belongs(bytes[first - 1])) --first;
  while (last < bytes.size() && belongs(bytes[last])) ++last;
  return {first, last};
}

bool in_number(std::uint8_t c) {
  return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+' || c == 'e';
}
bool in_line(std::uint8_t c) { return c != '\n'; }

void replace(Bytes& bytes, std::pair<std::size_t, std::size_t> range, std::string_view text) {
  const auto at = bytes.erase(bytes.begin() + offset(range.first), bytes.begin() + offset(range.second));
  bytes.insert(at, text.begin(), text.end());
}

}  // namespace

Mutator::Mutator(std::vector<Bytes> seeds, std::vector<std::string> words)
    : seeds_(std::move(seeds)), words_(std::move(words)) {}

Bytes Mutator::input(std::uint64_t number) {
  random_.seed(number);
  Bytes bytes = any(seeds_);
  for (std::size_t changes = 1 + below(8); changes > 0; --changes) change(bytes);
  return bytes;
}

Bytes Mutator::piece() {
  const Bytes& seed = any(seeds_);
  const std::size_t from = below(seed.size());
  const std::size_t length = std::min(1 + below(64), seed.size() - from);
  return {seed.begin() + offset(from), seed.begin() + offset(from + length)};
}

void Mutator::change(Bytes& bytes) {
  if (bytes.empty()) bytes = piece();
  if (bytes.empty()) return;
  below(2) == 0 ? change_bytes(bytes) : change_text(bytes);
}

void Mutator::change_bytes(Bytes& bytes) {
  const std::size_t at = below(bytes.size());
  const auto here = bytes.begin() + offset(at);
  const Bytes other = piece();
  switch (below(6)) {
    case 0:
      *here = static_cast<std::uint8_t>(random_());
      break;
    case 1:
      *here ^= static_cast<std::uint8_t>(1u << below(8));
      break;
    case 2:
      bytes.resize(1 + at);
      break;
    case 3:
      bytes.erase(here, here + offset(1 + below(std::min<std::size_t>(64, bytes.size() - at))));
      break;
    case 4:
      std::copy_n(other.begin(), std::min(other.size(), bytes.size() - at), here);
      break;
    default:
      bytes.insert(here, other.begin(), other.end());
  }
}

void Mutator::change_text(Bytes& bytes) {
  std::size_t at = below(bytes.size());
  const auto line = run_around(bytes, at, in_line);
  const std::string line_text(bytes.begin() + offset(line.first), bytes.begin() + offset(line.second));
  switch (below(4)) {
    case 0:
      while (at < bytes.size() && !in_number(bytes[at])) ++at;
      replace(bytes, run_around(bytes, at, in_number), any(numbers));
      break;
    case 1:
      replace(bytes, {line.first, std::min(line.second + 1, bytes.size())}, "");
      break;
    case 2: {
      const std::size_t other = run_around(bytes, below(bytes.size()), in_line).first;
      replace(bytes, {other, other}, line_text + "\n");
      break;
    }
    default:
      if (!words_.empty()) replace(bytes, {at, at}, any(words_));
  }
}

}  // namespace fpi::fuzz
