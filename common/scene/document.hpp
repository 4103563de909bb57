/// A scene file as a tree of values, each with its place for error messages. Overrides are applied while the
/// tree is made, so whoever reads it need not know of them; toml11 stays in the source.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace fpi::scene {

struct Node {
  using List = std::vector<Node>;
  using Table = std::map<std::string, Node>;

  std::variant<std::monostate, bool, std::int64_t, double, std::string, List, Table> value;  ///< mono: a date
  std::string place;  ///< "drop.toml:12", or the override "--set fluid.density=2"

  template <class T>
  const T* as() const {
    return std::get_if<T>(&value);
  }
  /// The entry `key` of a table, or entry number `key` of a list; null where there is none.
  const Node* find(const std::string& key) const;
  Node* find(const std::string& key);
  /// The value as a message quotes it, long ones cut.
  std::string quoted() const;
};

/// The parts of a dotted key: "bodies.0.radius" has three.
std::vector<std::string> split_key(const std::string& key);

/// Reads TOML. Throws Error with the place of a syntax error, or naming the override that cannot be applied.
Node parse_document(const std::string& text, const std::string& name,
                    const std::vector<std::string>& overrides);

}  // namespace fpi::scene
