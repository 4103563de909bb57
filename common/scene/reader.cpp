/// From a document to a scene. Each declared parameter looks up its value beside it in the document; what the
/// document has and nothing declares is an unknown key.
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/expression.hpp"
#include "core/number.hpp"
#include "core/read_file.hpp"
#include "scene/document.hpp"
#include "scene/reading.hpp"
#include "scene/toml_text.hpp"

namespace fpi::scene {
namespace {

/// What is found under a key; a single table stands for a list of one.
const Node* part_of(const Node& node, const std::string& key) {
  const Node* found = node.find(key);
  return found == nullptr && key == "0" && node.as<Node::Table>() ? &node : found;
}

/// Whether one dotted key is the other, or a table around it.
bool is_within(std::string_view key, std::string_view table) {
  return key.starts_with(table) && (key.size() == table.size() || key[table.size()] == '.');
}

/// Walks the declarations beside the document. Goes on after a problem, so that all are found, but for those
/// that only follow from one told before.
class Reader : public ParameterVisitor {
 public:
  explicit Reader(const Node& root) { frames_.push_back({&root, root.place, "", {}, false}); }

  /// All problems, by file and line.
  Findings finish() {
    report_unknown_keys();
    std::erase_if(problems_.all(), [this](const Finding& problem) { return is_misspelt(problem.key); });
    problems_.append(unknown_);
    problems_.sort();
    return std::move(problems_);
  }
  /// Whether nothing but unknown keys is wrong.
  bool has_all_values() const { return !problems_.has_errors(); }

  void real(const Parameter& p, double& value, Bounds bounds) override {
    if (const Node* node = get(p, number_text(p, bounds))) take_real(p, *node, p.key, value, bounds);
  }
  void real(const Parameter& p, std::optional<double>& value, Bounds bounds) override {
    double number = 0;
    const Node* node = get(p, number_text(p, bounds));
    if (node != nullptr && take_real(p, *node, p.key, number, bounds)) value = number;
  }
  void integer(const Parameter& p, std::int64_t& value, Bounds bounds) override {
    const std::string required = join("a whole number", describe(bounds), p.unit);
    const Node* node = get(p, required);
    if (node == nullptr) return;
    const std::int64_t* number = node->as<std::int64_t>();
    if (number == nullptr || !within(static_cast<double>(*number), bounds))
      return refuse(p, *node, p.key, required);
    value = *number;
  }
  void boolean(const Parameter& p, bool& value) override { take(p, value, "true or false"); }
  void text(const Parameter& p, std::string& value) override { take(p, value, "a string in quotes"); }
  void formula(const Parameter& p, std::string& value) override {
    if (const Node* node = get(p, "a formula")) take_formula(p, *node, p.key, value);
  }
  void formula(const Parameter& p, std::optional<std::string>& value) override {
    std::string text;
    const Node* node = get(p, "a formula");
    if (node != nullptr && take_formula(p, *node, p.key, text)) value = text;
  }
  void choice(const Parameter& p, std::string& value, std::span<const std::string_view> choices) override {
    const std::string required = "one of " + describe(choices);
    const Node* node = get(p, required);
    if (node == nullptr) return;
    const std::string* word = node->as<std::string>();
    if (word != nullptr && std::ranges::find(choices, *word) != choices.end()) {
      value = *word;
    } else {
      const std::string near = word == nullptr ? "" : did_you_mean(*word, choices);
      refuse(p, *node, p.key,
             near.empty() ? required : fmt::format("{} (did you mean \"{}\"?)", required, near));
    }
  }

  void reals(const Parameter& p, std::vector<double>& values, Count count, Bounds bounds) override {
    take_list(p, values, count, "numbers", [&](const Node& node, const std::string& key, double& value) {
      return take_real(p, node, key, value, bounds);
    });
  }
  void texts(const Parameter& p, std::vector<std::string>& values, Count count) override {
    take_list(p, values, count, "strings", [&](const Node& node, const std::string& key, std::string& value) {
      if (const auto* text = node.as<std::string>()) {
        value = *text;
        return true;
      }
      refuse(p, node, key, "a string in quotes");
      return false;
    });
  }
  void formulas(const Parameter& p, std::vector<std::string>& values, Count count) override {
    take_list(p, values, count, "formulas",
              [&](const Node& node, const std::string& key, std::string& value) {
                return take_formula(p, node, key, value);
              });
  }

  void require(bool condition, std::string_view key, std::string_view required) override {
    if (condition || follows_from_another(path(key))) return;
    const Node* node = frame().table;
    std::string place = frame().place;
    for (const std::string& part : split_key(std::string(key))) {
      node = node == nullptr ? nullptr : part_of(*node, part);
      if (node != nullptr) place = node->place;
    }
    problems_.add({.key = path(key),
                   .text = fmt::format("{} {}; got {}", path(key), required,
                                       node == nullptr ? "nothing" : node->quoted()),
                   .place = place});
  }

 protected:
  bool begin_table(const Parameter& p, bool exists) override {
    const Node* node = find(p);
    if (node == nullptr && p.required)
      tell(path(p.key), frame().place,
           fmt::format("the table [{}] is required; got nothing: add it ({})", path(p.key), p.text));
    if (node == nullptr && !exists) return false;
    enter(p, node, p.key);
    return true;
  }
  std::size_t begin_tables(const Parameter& p, std::size_t) override {
    const Node* node = find(p);
    if (node == nullptr) return 0;
    if (node->as<Node::Table>()) return 1;  // a single [key] will do
    const auto* list = node->as<Node::List>();
    if (list != nullptr) return list->size();
    refuse(p, *node, p.key, fmt::format("tables [[{}]]", path(p.key)));
    return 0;
  }
  void begin_entry(const Parameter& p, std::size_t index) override {
    const Node& tables = *frame().table->find(std::string(p.key));
    const auto* list = tables.as<Node::List>();
    enter(p, list ? &(*list)[index] : &tables, fmt::format("{}.{}", p.key, index));
  }
  std::vector<std::string> begin_named(const Parameter& p, const std::vector<std::string>&) override {
    enter(p, find(p), p.key);
    frame().any_key = true;
    std::vector<std::string> names;
    if (frame().table != nullptr) {
      for (const auto& [name, node] : *frame().table->as<Node::Table>()) names.push_back(name);
    }
    return names;
  }
  void begin_name(const Parameter& p, const std::string& name) override {
    enter(p, frame().table->find(name), name);
  }
  void end_table() override {
    report_unknown_keys();
    frames_.pop_back();
  }

 private:
  struct Frame {
    const Node* table;  ///< null where the document has no such table
    std::string place, path;
    std::vector<std::string> known;  ///< keys declared so far
    bool any_key = false;            ///< the user names the keys
  };

  Frame& frame() { return frames_.back(); }

  std::string path(std::string_view key) {
    return frame().path.empty() ? std::string(key) : fmt::format("{}.{}", frame().path, key);
  }

  static std::string join(std::string_view what, const std::string& bounds, std::string_view unit) {
    return fmt::format("{}{}{}{}", what, bounds.empty() ? "" : " " + bounds, unit.empty() ? "" : " ", unit);
  }
  static std::string number_text(const Parameter& p, Bounds b) {
    return join("a finite number", describe(b), p.unit);
  }

  void enter(const Parameter& p, const Node* node, std::string_view key) {
    if (node != nullptr && !node->as<Node::Table>()) {
      refuse(p, *node, key, "a table");
      node = nullptr;
    }
    frames_.push_back({node, node == nullptr ? frame().place : node->place, path(key), {}, false});
  }

  void report_unknown_keys() {
    if (frame().table == nullptr || frame().any_key) return;
    for (const auto& [key, node] : *frame().table->as<Node::Table>()) {
      if (std::ranges::find(frame().known, key) != frame().known.end()) continue;
      const std::string near = did_you_mean(key, frame().known);
      unknown_.push_back(
          {.key = path(key),
           .text = fmt::format("the key \"{}\" is not known; {}", path(key),
                               near.empty() ? fmt::format("known here: {}", fmt::join(frame().known, ", "))
                                            : fmt::format("did you mean \"{}\"?", near)),
           .place = node.place});
      if (!near.empty()) meant_.push_back(path(near));
    }
  }

  /// Whether a value is missed only since its key, or that of its table, is misspelt.
  bool is_misspelt(const std::string& key) const {
    return std::ranges::any_of(meant_, [&](const std::string& meant) { return is_within(key, meant); });
  }
  /// Whether something is told of this key already, or, for a condition between values of one table, of any
  /// of that table.
  bool follows_from_another(const std::string& key) {
    return std::ranges::any_of(problems_.all(), [&](const Finding& told) {
      return is_within(key, told.key) || is_within(told.key, key) ||
             (!frame().path.empty() && is_within(told.key, frame().path));
    });
  }
  /// Of a value by itself.
  void tell(const std::string& key, const std::string& place, std::string text) {
    const auto is_told = [&](const Finding& told) {
      return is_within(key, told.key) || is_within(told.key, key);
    };
    if (std::ranges::any_of(problems_.all(), is_told)) return;
    problems_.add({.key = key, .text = std::move(text), .place = place});
  }

  void refuse(const Parameter& p, const Node& node, std::string_view key, std::string_view required) {
    tell(path(key), node.place,
         fmt::format("{} must be {}; got {}: correct it ({})", path(key), required, node.quoted(), p.text));
  }

  /// The document's value of p, noting that p is a known key.
  const Node* find(const Parameter& p) {
    frame().known.emplace_back(p.key);
    return frame().table == nullptr ? nullptr : frame().table->find(std::string(p.key));
  }
  /// The same; a required one must be there.
  const Node* get(const Parameter& p, const std::string& required) {
    const Node* node = find(p);
    if (node == nullptr && p.required)
      tell(path(p.key), frame().place,
           fmt::format("{} is required, {}; got nothing: add {} = … ({})", path(p.key), required, p.key,
                       p.text));
    return node;
  }

  static bool within(double value, const Bounds& b) {
    return std::isfinite(value) && (b.lower_open ? value > b.lower : value >= b.lower) &&
           (b.upper_open ? value < b.upper : value <= b.upper);
  }

  /// What arithmetic overflows with: large numbers, and small ones where they must be above zero. toml11
  /// reads a number too large for its type as the largest of the type, which is out of range too.
  static bool is_out_of_range(double number, const Bounds& b) {
    const bool is_too_small = b.lower == 0 && b.lower_open && number > 0 && number < smallest_positive_real;
    return std::isfinite(number) && (std::abs(number) > largest_real || is_too_small);
  }

  bool take_real(const Parameter& p, const Node& node, std::string_view key, double& value, Bounds bounds) {
    double number = std::nan("");
    if (const auto* d = node.as<double>()) number = *d;
    if (const auto* i = node.as<std::int64_t>()) number = static_cast<double>(*i);
    const bool is_saturated = node.as<std::int64_t>() != nullptr && std::abs(number) >= 0x1p63;
    if (!is_saturated && is_out_of_range(number, bounds)) {
      refuse(p, node, key,
             number_text(p, bounds) + (std::abs(number) < 1
                                           ? fmt::format(", at least {:g}", smallest_positive_real)
                                           : fmt::format(", up to {:g} in magnitude", largest_real)));
      return false;
    }
    if (is_saturated || !within(number, bounds)) {
      refuse(p, node, key, number_text(p, bounds));
      return false;
    }
    value = number;
    return true;
  }

  bool take_formula(const Parameter& p, const Node& node, std::string_view key, std::string& value) {
    double number = 0;
    if (!node.as<std::string>()) {
      if (!take_real(p, node, key, number, any_number())) return false;
      value = fmt::format("{}", number);
      return true;
    }
    try {
      value = Expression(*node.as<std::string>()).formula();
      return true;
    } catch (const Error& e) {
      tell(path(key), node.place, fmt::format("{}: {}", path(key), e.what()));
      return false;
    }
  }

  template <class T>
  void take(const Parameter& p, T& value, const std::string& required) {
    const Node* node = get(p, required);
    if (node == nullptr) return;
    if (const T* found = node->as<T>()) {
      value = *found;
    } else {
      refuse(p, *node, p.key, required);
    }
  }

  template <class T, class Take>
  void take_list(const Parameter& p, std::vector<T>& values, Count count, std::string_view what,
                 Take take_entry) {
    const std::string number = describe(count);
    const std::string required =
        join(fmt::format("a list [...] of {}{}{}", number, number.empty() ? "" : " ", what), "", p.unit);
    const Node* node = get(p, required);
    if (node == nullptr) return;
    const auto* list = node->as<Node::List>();
    if (list == nullptr || list->size() < count.least || list->size() > count.most) {
      return refuse(p, *node, p.key, required);
    }
    std::vector<T> taken(list->size());
    bool good = true;
    for (std::size_t i = 0; i < taken.size(); ++i) {
      good = take_entry((*list)[i], fmt::format("{}.{}", p.key, i), taken[i]) && good;
    }
    if (good) values = std::move(taken);
  }

  std::vector<Frame> frames_;
  std::vector<Finding> unknown_;
  std::vector<std::string> meant_;  ///< keys that unknown ones stand for, by their look
  Findings problems_;
};

std::string read_bytes(const std::string& path) {
  constexpr std::size_t largest = 16 << 20;
  return fpi::read_file(path, largest, "a scene file");
}

}  // namespace

std::string Reading::place_of(const std::string& key) const {
  const Node* node = document.get();
  std::string place = document->place;
  for (const std::string& part : split_key(key)) {
    node = node == nullptr ? nullptr : part_of(*node, part);
    if (node != nullptr) place = node->place;
  }
  return place;
}

Reading read_all(const std::string& path, const std::vector<std::string>& overrides) {
  return read_all(read_bytes(path), path, overrides);
}

Reading read_all(const std::string& text, const std::string& name,
                 const std::vector<std::string>& overrides) {
  Reading reading;
  reading.document = std::make_shared<const Node>(parse_document(text, name, overrides));
  Reader reader(*reading.document);
  reading.scene.declare(reader);
  reading.has_all_values = reader.has_all_values();
  reading.findings = reader.finish();
  if (reading.scene.moves_freely() && !reading.scene.dem) reading.scene.dem.emplace();
  return reading;
}

Scene read_text(const std::string& text, const std::string& name, const std::vector<std::string>& overrides) {
  Reading reading = read_all(text, name, overrides);
  reading.findings.raise();
  return std::move(reading.scene);
}

Scene read_file(const std::string& path, const std::vector<std::string>& overrides) {
  return read_text(read_bytes(path), path, overrides);
}

}  // namespace fpi::scene
