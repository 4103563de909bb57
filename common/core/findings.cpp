#include "core/findings.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <tuple>

namespace fpi {
namespace {

/// File and line of "drop.toml:12"; what has no line comes before what has one.
std::pair<std::string, long> file_and_line(const std::string& place) {
  const std::size_t colon = place.rfind(':');
  const bool has_line = colon != std::string::npos && colon + 1 < place.size() && place.size() - colon < 12 &&
                        std::all_of(place.begin() + static_cast<std::ptrdiff_t>(colon) + 1, place.end(),
                                    [](unsigned char c) { return std::isdigit(c) != 0; });
  if (!has_line) return {place, 0};
  return {place.substr(0, colon), std::stol(place.substr(colon + 1))};
}

/// What findings of many bodies have in common: "bodies.*.radius".
std::string kind_of(const Finding& finding) {
  std::string kind(finding.is_error ? "error " : "warning ");
  for (const char c : finding.key) {
    const bool digit = std::isdigit(static_cast<unsigned char>(c)) != 0;
    if (!digit) kind += c;
    if (digit && kind.back() != '*') kind += '*';
  }
  return kind;
}

}  // namespace

std::string to_text(const Finding& finding) {
  return finding.place.empty() ? finding.text : finding.place + ": " + finding.text;
}

bool Findings::has_errors() const { return std::ranges::any_of(all_, &Finding::is_error); }

void Findings::sort() {
  std::ranges::stable_sort(all_, {}, [](const Finding& finding) { return file_and_line(finding.place); });
}

void Findings::raise() const {
  std::vector<Finding> errors;
  std::ranges::copy_if(all_, std::back_inserter(errors), &Finding::is_error);
  if (!errors.empty()) fail("{}", fmt::join(to_lines(errors), "\n"));
}

std::vector<std::string> to_lines(const std::vector<Finding>& findings) {
  constexpr int most_of_a_kind = 5;
  std::map<std::string, int> total, told;
  for (const Finding& finding : findings) ++total[kind_of(finding)];
  std::vector<std::string> lines;
  for (const Finding& finding : findings) {
    const std::string kind = kind_of(finding);
    const int number = ++told[kind], all = total[kind];
    // One left over is told as well: the word on it would be as long.
    const bool cut = all > most_of_a_kind + 1 && !finding.key.empty();
    if (!cut || number <= most_of_a_kind) lines.push_back(to_text(finding));
    if (cut && number == most_of_a_kind)
      lines.push_back(fmt::format("… and {} more like this", all - most_of_a_kind));
  }
  return lines;
}

}  // namespace fpi
