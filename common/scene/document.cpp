#include "scene/document.hpp"

#include <algorithm>
#include <sstream>
#include <toml.hpp>

#include "core/error.hpp"
#include "core/utf8.hpp"
#include "scene/toml_text.hpp"

namespace fpi::scene {
namespace {

constexpr int deepest_nesting = 64;  // toml11 recurses; a hostile file must not exhaust the stack
constexpr const char* override_prefix = "--set ";

/// Index of the last character of the string literal that opens at `begin`; a single-line one ends with its
/// line.
std::size_t end_of_string(std::string_view text, std::size_t begin) {
  const char quote = text[begin];
  const bool multi_line = text.substr(begin, 3) == std::string(3, quote);
  const std::string delimiter(multi_line ? 3 : 1, quote);
  for (std::size_t i = begin + delimiter.size(); i < text.size(); ++i) {
    if (text[i] == '\\' && quote == '"') {
      ++i;
    } else if (text.substr(i).starts_with(delimiter)) {
      return i + delimiter.size() - 1;
    } else if (text[i] == '\n' && !multi_line) {
      return i - 1;
    }
  }
  return text.size();
}

/// Refuses brackets and dotted keys nested deeper than any scene needs; strings and comments do not count.
void check_nesting(const std::string& text, const std::string& name) {
  int depth = 0, dots = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"' || c == '\'') i = end_of_string(text, i);
    if (c == '#') i = std::min(text.find('\n', i), text.size()) - 1;
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (c == '.') ++dots;
    if (c == '\n' || c == '=' || c == ',' || c == '{') dots = 0;
    if (depth <= deepest_nesting && dots <= deepest_nesting) continue;
    fail(
        "{}:{}: at most {} levels of nested brackets or dotted keys are allowed; got more: close the "
        "brackets",
        name, 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(i), '\n'),
        deepest_nesting);
  }
}

std::string place_of(const toml::value& v) {
  const toml::source_location where = v.location();
  if (where.file_name().starts_with(override_prefix)) return where.file_name();
  return fmt::format("{}:{}", where.file_name(), where.line());
}

Node to_node(const toml::value& v) {
  Node node{.value = {}, .place = place_of(v)};
  switch (v.type()) {
    case toml::value_t::boolean:
      node.value = v.as_boolean();
      break;
    case toml::value_t::integer:
      node.value = static_cast<std::int64_t>(v.as_integer());
      break;
    case toml::value_t::floating:
      node.value = static_cast<double>(v.as_floating());
      break;
    case toml::value_t::string:
      node.value = v.as_string().str;
      break;
    case toml::value_t::array: {
      Node::List list;
      for (const toml::value& entry : v.as_array()) list.push_back(to_node(entry));
      node.value = std::move(list);
      break;
    }
    case toml::value_t::table: {
      Node::Table table;
      for (const auto& [key, entry] : v.as_table()) table.emplace(key, to_node(entry));
      node.value = std::move(table);
      break;
    }
    default:
      break;
  }
  return node;
}

Node parse(const std::string& text, const std::string& name) {
  check_nesting(text, name);
  std::istringstream stream(text);
  try {
    return to_node(toml::parse(stream, name));
  } catch (const toml::exception& e) {
    fail("{}:{}: valid TOML is required; correct this:\n{}", name, e.location().line(), e.what());
  } catch (const std::exception& e) {  // toml11 lets some of the standard library's through
    fail("{}: valid TOML is required; it cannot be read: {}", name, e.what());
  }
}

/// The right side of an override: a TOML value, or else a bare word taken as a string.
Node override_value(const std::string& text, const std::string& name) {
  try {
    Node document = parse("value = " + text, name);
    if (document.as<Node::Table>()->size() == 1) return *document.find("value");
  } catch (const Error&) {
    return {.value = text, .place = name};
  }
  return {.value = text, .place = name};
}

/// The entry `key` below `parent`; tables grow, lists do not.
Node& entry_for_override(Node& parent, const std::string& key, const std::string& name) {
  if (Node* found = parent.find(key)) return *found;
  if (const auto* list = parent.as<Node::List>()) {
    fail("{}: the index must be a number below {} (entries count from 0); got \"{}\"", name, list->size(),
         key);
  }
  auto* table = std::get_if<Node::Table>(&parent.value);
  require(table != nullptr, "{}: \"{}\" must belong to a table or a list; got {} there", name, key,
          parent.quoted());
  return table->emplace(key, Node{.value = Node::Table{}, .place = name}).first->second;
}

void apply_override(Node& root, const std::string& text) {
  const std::string name = override_prefix + text;
  const std::size_t equals = text.find('=');
  require(equals != std::string::npos && equals > 0, "{}: an override must be written key=value; got \"{}\"",
          name, text);
  Node* node = &root;
  for (const std::string& key : split_key(text.substr(0, equals)))
    node = &entry_for_override(*node, key, name);
  *node = override_value(text.substr(equals + 1), name);
}

}  // namespace

const Node* Node::find(const std::string& key) const {
  if (const auto* table = as<Table>()) {
    const auto entry = table->find(key);
    return entry == table->end() ? nullptr : &entry->second;
  }
  const auto* list = as<List>();
  const bool digits =
      !key.empty() && key.size() < 9 && std::ranges::all_of(key, [](char c) { return c >= '0' && c <= '9'; });
  if (list == nullptr || !digits || std::stoul(key) >= list->size()) return nullptr;
  return &(*list)[std::stoul(key)];
}

Node* Node::find(const std::string& key) { return const_cast<Node*>(std::as_const(*this).find(key)); }

std::string Node::quoted() const {
  constexpr std::size_t longest = 60;
  if (const auto* b = as<bool>()) return *b ? "true" : "false";
  if (const auto* i = as<std::int64_t>()) return fmt::format("{}", *i);
  if (const auto* d = as<double>()) return toml_text(*d);
  if (const auto* s = as<std::string>()) {
    if (s->size() <= longest) return toml_text(*s);
    const std::string begin = s->substr(0, longest);
    return toml_text(begin.substr(0, first_bad_byte(begin))) + "…";  // whole characters
  }
  if (as<Table>()) return "a table";
  if (const auto* list = as<List>()) {
    std::string out = "[";
    for (const Node& entry : *list) {
      if (out.size() > longest) return out + ", …]";
      out += (out.size() > 1 ? ", " : "") + entry.quoted();
    }
    return out + "]";
  }
  return "a date";
}

std::vector<std::string> split_key(const std::string& key) {
  std::vector<std::string> parts(1);
  for (const char c : key) {
    if (c == '.') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

Node parse_document(const std::string& text, const std::string& name,
                    const std::vector<std::string>& overrides) {
  require_utf8(text, name);
  Node root = parse(text, name);
  for (const std::string& text_of_one : overrides) {
    require_utf8(text_of_one, override_prefix + printable(text_of_one));
    apply_override(root, text_of_one);
  }
  return root;
}

}  // namespace fpi::scene
