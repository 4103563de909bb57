/// Runs cases of the stress sweep, one JSON line each; `./fpi stress interface` starts a process a case, so
/// that none takes others with it.
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <span>

#include "cases.hpp"
#include "core/error.hpp"

namespace fpi::fluid::testing {
namespace {

std::vector<Family> families() {
  std::vector<Family> all = exact_families();
  for (Family& family : moving_families()) all.push_back(std::move(family));
  return all;
}

/// `text` as a JSON string.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (c == '\n')
      out += "\\n";
    else
      out += c;
  }
  return out + '"';
}

void list(const Family& family, int cases) {
  for (int k = 0; k < std::max(1, static_cast<int>(std::lround(family.share * cases))); ++k)
    std::cout << fmt::format("{}-{}\t{}\n", family.name, k, family.title);
}

/// A case is named family-number.
Outcome run(const std::string& name, std::uint64_t seed, const Effort& effort) {
  const std::string family_name = name.substr(0, name.rfind('-'));
  for (const Family& family : families()) {
    if (family.name != family_name) continue;
    Random random(seed, name);
    try {
      return family.run(random, effort);
    } catch (const Error& e) {
      Outcome refusal;
      refusal.failure = e.what();
      refusal.refused = true;
      return refusal;
    }
  }
  fail("a case named as --list does is required; got {}", name);
}

void print(const std::string& name, const Outcome& outcome, double seconds) {
  std::cout << fmt::format(R"({{"case": {}, "failure": {}, "refused": {})", quoted(name),
                           quoted(outcome.failure), outcome.refused);
  for (const auto& [key, value] : {std::pair{"error", outcome.error},
                                   {"noise", outcome.noise},
                                   {"condition", outcome.condition},
                                   {"seconds", seconds}})
    if (value >= 0) std::cout << fmt::format(R"(, "{}": {:.6g})", key, value);
  std::cout << R"(, "parameters": {)";
  const char* separator = "";
  for (const auto& [key, value] : outcome.parameters)
    std::cout << fmt::format("{}{}: {:.6g}", std::exchange(separator, ", "), quoted(key), value);
  std::cout << "}}\n" << std::flush;
}

int main(std::span<char*> words) {
  std::uint64_t seed = 1;
  int cases = 0;
  Effort effort{32, 18};
  std::vector<std::string> names;
  for (std::size_t i = 1; i < words.size(); ++i) {
    const std::string word = words[i];
    const bool has_value = i + 1 < words.size();
    if (word == "--quick")
      effort = {8, 12};
    else if (word == "--seed" && has_value)
      seed = std::strtoull(words[++i], nullptr, 10);
    else if (word == "--list" && has_value)
      cases = std::atoi(words[++i]);
    else
      names.push_back(word);
  }
  for (const Family& family : families())
    if (cases > 0) list(family, cases);
  for (const std::string& name : names) {
    const auto start = std::chrono::steady_clock::now();
    const Outcome outcome = run(name, seed, effort);
    print(name, outcome, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return 0;
}

}  // namespace
}  // namespace fpi::fluid::testing

int main(int count, char** words) {
  try {
    return fpi::fluid::testing::main({words, static_cast<std::size_t>(count)});
  } catch (const std::exception& e) {
    std::cerr << "interface_stress: " << e.what() << '\n';
    return 2;
  }
}
