/// How a parameter is declared, once. A group of parameters is a struct with `void
/// declare(ParameterVisitor&)` that names every member with its unit, bounds and sentence; reading the scene,
/// checking it, writing it back with its defaults filled in, "did you mean" and the scene reference all walk
/// that one declaration.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace fpi {

/// What is said of a parameter besides its type.
struct Parameter {
  std::string_view key;
  std::string_view unit;  ///< "" where it has none
  std::string_view text;  ///< a sentence for the reference
  bool required = false;  ///< the member's initial value is the default otherwise
};

/// Interval of allowed values, each end open or closed.
struct Bounds {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_open = false, upper_open = false;
};
constexpr Bounds any_number() { return {}; }
constexpr Bounds positive() { return {.lower = 0, .lower_open = true}; }
constexpr Bounds not_negative() { return {.lower = 0}; }
constexpr Bounds between(double lower, double upper) { return {.lower = lower, .upper = upper}; }
constexpr Bounds above_up_to(double lower, double upper) {
  return {.lower = lower, .upper = upper, .lower_open = true};
}

/// Allowed number of entries of a list.
struct Count {
  std::size_t least = 0, most = std::numeric_limits<std::size_t>::max();
};

class ParameterVisitor {
 public:
  virtual ~ParameterVisitor() = default;

  // One value. Numbers in the scene may be written as integers; reals must be finite.
  virtual void real(const Parameter&, double& value, Bounds) = 0;
  virtual void real(const Parameter&, std::optional<double>& value, Bounds) = 0;
  virtual void integer(const Parameter&, std::int64_t& value, Bounds) = 0;
  virtual void boolean(const Parameter&, bool& value) = 0;
  virtual void text(const Parameter&, std::string& value) = 0;
  /// A formula (core/expression.hpp) may be written as a number; it arrives as its text.
  virtual void formula(const Parameter&, std::string& value) = 0;
  virtual void formula(const Parameter&, std::optional<std::string>& value) = 0;
  /// A word out of `choices`.
  virtual void choice(const Parameter&, std::string& value, std::span<const std::string_view> choices) = 0;

  // Lists.
  virtual void reals(const Parameter&, std::vector<double>& values, Count, Bounds) = 0;
  virtual void texts(const Parameter&, std::vector<std::string>& values, Count) = 0;
  virtual void formulas(const Parameter&, std::vector<std::string>& values, Count) = 0;

  /// A condition between several members. Where it does not hold the reader fails with `required`, the place
  /// of `key` (which may be dotted, "bodies.0.material") and what came there.
  virtual void require(bool condition, std::string_view key, std::string_view required) = 0;

  /// A table [key] that always exists (its members have defaults, or are required one by one).
  template <class Group>
  void table(const Parameter& p, Group& group) {
    if (!begin_table(p, true)) return;
    group.declare(*this);
    end_table();
  }
  /// A table [key] that may be absent.
  template <class Group>
  void table(const Parameter& p, std::optional<Group>& group) {
    if (!begin_table(p, group.has_value())) return;
    if (!group) group.emplace();
    group->declare(*this);
    end_table();
  }
  /// Tables [[key]], any number.
  template <class Group>
  void tables(const Parameter& p, std::vector<Group>& groups) {
    const std::size_t n = begin_tables(p, groups.size());
    groups.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      begin_entry(p, i);
      groups[i].declare(*this);
      end_table();
    }
  }
  /// Tables [key.NAME], named by the user.
  template <class Group>
  void named_tables(const Parameter& p, std::map<std::string, Group>& groups) {
    std::vector<std::string> names;
    for (const auto& [name, group] : groups) names.push_back(name);
    for (const std::string& name : begin_named(p, names)) {
      begin_name(p, name);
      groups[name].declare(*this);
      end_table();
    }
    end_table();
  }

 protected:
  /// True where the table is to be walked: a reader says whether the file has it (or `exists` by default, for
  /// a plain table, with every member absent), a writer says `exists`, the reference says yes.
  virtual bool begin_table(const Parameter&, bool exists) = 0;
  virtual std::size_t begin_tables(const Parameter&, std::size_t count) = 0;
  virtual void begin_entry(const Parameter&, std::size_t index) = 0;
  virtual std::vector<std::string> begin_named(const Parameter&, const std::vector<std::string>& names) = 0;
  virtual void begin_name(const Parameter&, const std::string& name) = 0;
  virtual void end_table() = 0;
};

}  // namespace fpi
