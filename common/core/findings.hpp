/// What is wrong with a scene, or doubtful, found before a run: gathered instead of thrown at the first, so
/// that all of it is told at once.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace fpi {

struct Finding {
  bool is_error = true;  ///< the run is refused; else it is only worth a word
  std::string key{};     ///< dotted key of the scene, "bodies.3.radius"; "": the scene as a whole
  std::string text{};    ///< what was required, what came, what to do
  std::string place{};   ///< "drop.toml:12"; "": not known
};

/// "drop.toml:12: the text".
std::string to_text(const Finding& finding);

class Findings {
 public:
  Findings() = default;
  Findings(std::vector<Finding> all) : all_(std::move(all)) {}

  void add(Finding finding) { all_.push_back(std::move(finding)); }
  void append(const std::vector<Finding>& others) { all_.insert(all_.end(), others.begin(), others.end()); }

  template <class... Args>
  void error(std::string key, fmt::format_string<Args...> format, Args&&... args) {
    add({.is_error = true, .key = std::move(key), .text = fmt::format(format, std::forward<Args>(args)...)});
  }
  template <class... Args>
  void warn(std::string key, fmt::format_string<Args...> format, Args&&... args) {
    add({.is_error = false, .key = std::move(key), .text = fmt::format(format, std::forward<Args>(args)...)});
  }
  /// Keeps what `check` throws as an error of `key`. Returns whether it threw nothing.
  template <class Check>
  bool attempt(std::string key, Check&& check) {
    try {
      check();
      return true;
    } catch (const Error& e) {
      add({.is_error = true, .key = std::move(key), .text = e.what()});
      return false;
    }
  }

  const std::vector<Finding>& all() const { return all_; }
  std::vector<Finding>& all() { return all_; }
  bool has_errors() const;
  /// By file, then line; those of one place stay in their order.
  void sort();
  /// Throws Error with all errors, a line each; not where there are none.
  void raise() const;

 private:
  std::vector<Finding> all_;
};

/// As lines, of each kind (one key but for its numbers) the first few and how many more there are.
std::vector<std::string> to_lines(const std::vector<Finding>& findings);

}  // namespace fpi
