#include "fluid/gmsh.hpp"

#include <charconv>
#include <cstdlib>
#include <map>
#include <optional>
#include <unordered_map>

#include "core/error.hpp"

namespace fpi::fluid {
namespace {

/// White-space separated words of the file, with the line number for errors.
class Words {
 public:
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

constexpr int line_type = 1, triangle_type = 2, point_type = 15;

/// What the file says, before it becomes a mesh. Tags are Gmsh's own numbers.
struct Contents {
  std::map<std::int64_t, std::string> curve_names;                // physical tag → name
  std::unordered_map<std::int64_t, std::int64_t> curve_physical;  // 4.1: entity → physical tag
  std::unordered_map<std::int64_t, Vec2> nodes;
  std::vector<std::array<std::int64_t, 3>> triangles;
  std::vector<std::pair<std::array<std::int64_t, 2>, std::int64_t>> lines;  // nodes, physical tag
};

void read_names(Words& in, Contents& out) {
  for (std::size_t n = in.count(); n > 0; --n) {
    const int dimension = in.number<int>();
    const auto tag = in.number<std::int64_t>();
    std::string name = in.quoted();
    if (dimension == 1) out.curve_names[tag] = std::move(name);
  }
}

void read_element(Words& in, Contents& out, int type, std::int64_t physical) {
  const auto node = [&] { return in.number<std::int64_t>(); };
  if (type == point_type) {
    node();
  } else if (type == line_type) {
    const auto a = node();
    out.lines.push_back({{a, node()}, physical});
  } else if (type == triangle_type) {
    const auto a = node();
    const auto b = node();
    out.triangles.push_back({a, b, node()});
  } else {
    in.bad("first-order triangles and lines only (Mesh.ElementOrder = 1)",
           fmt::format("element type {}", type));
  }
}

void read_nodes_2(Words& in, Contents& out) {
  for (std::size_t n = in.count(); n > 0; --n) {
    const auto tag = in.number<std::int64_t>();
    const double x = in.number<double>();
    out.nodes[tag] = {x, in.number<double>()};
    in.number<double>();
  }
}

void read_elements_2(Words& in, Contents& out) {
  for (std::size_t n = in.count(); n > 0; --n) {
    in.number<std::int64_t>();
    const int type = in.number<int>();
    std::int64_t physical = 0;
    const std::size_t n_tags = in.count();
    for (std::size_t i = 0; i < n_tags; ++i) {
      const auto tag = in.number<std::int64_t>();
      if (i == 0) physical = tag;
    }
    read_element(in, out, type, physical);
  }
}

void read_entities_4(Words& in, Contents& out) {
  const std::size_t n_points = in.count(), n_curves = in.count();
  in.count();
  in.count();
  for (std::size_t i = 0; i < n_points; ++i) {
    in.number<std::int64_t>();
    in.skip_line();
  }
  for (std::size_t i = 0; i < n_curves; ++i) {
    const auto tag = in.number<std::int64_t>();
    for (int k = 0; k < 6; ++k) in.number<double>();
    if (in.count() > 0) out.curve_physical[tag] = std::abs(in.number<std::int64_t>());  // negative: reversed
    in.skip_line();
  }
}

void read_nodes_4(Words& in, Contents& out) {
  const std::size_t n_blocks = in.count();
  for (int k = 0; k < 3; ++k) in.number<std::int64_t>();
  for (std::size_t b = 0; b < n_blocks; ++b) {
    in.number<int>();
    in.number<std::int64_t>();
    if (in.number<int>() != 0) in.bad("nodes without parametric coordinates", "parametric ones");
    std::vector<std::int64_t> tags(in.count());
    for (auto& tag : tags) tag = in.number<std::int64_t>();
    for (const auto tag : tags) {
      const double x = in.number<double>();
      out.nodes[tag] = {x, in.number<double>()};
      in.number<double>();
    }
  }
}

void read_elements_4(Words& in, Contents& out) {
  const std::size_t n_blocks = in.count();
  for (int k = 0; k < 3; ++k) in.number<std::int64_t>();
  for (std::size_t b = 0; b < n_blocks; ++b) {
    const int dimension = in.number<int>();
    const auto entity = in.number<std::int64_t>();
    const int type = in.number<int>();
    const auto it = out.curve_physical.find(entity);
    const std::int64_t physical = dimension == 1 && it != out.curve_physical.end() ? it->second : 0;
    for (std::size_t n = in.count(); n > 0; --n) {
      in.number<std::int64_t>();
      read_element(in, out, type, physical);
    }
  }
}

Contents read_contents(Words& in) {
  Contents out;
  std::optional<bool> is_4;
  while (!in.at_end()) {
    const std::string section(in.word());
    if (section.size() < 2 || section[0] != '$') in.bad("a section such as $Nodes", section);
    if (section != "$MeshFormat" && !is_4) in.bad("$MeshFormat at the start", section);
    if (section == "$MeshFormat") {
      const std::string version(in.word());
      if (version != "2.2" && version != "4.1") in.bad("format 2.2 or 4.1", version);
      if (in.number<int>() != 0) in.bad("an ASCII file", "a binary one");
      is_4 = version == "4.1";
    } else if (section == "$PhysicalNames") {
      read_names(in, out);
    } else if (section == "$Entities") {
      read_entities_4(in, out);
    } else if (section == "$Nodes") {
      *is_4 ? read_nodes_4(in, out) : read_nodes_2(in, out);
    } else if (section == "$Elements") {
      *is_4 ? read_elements_4(in, out) : read_elements_2(in, out);
    }
    in.skip_to("$End" + section.substr(1));
  }
  return out;
}

}  // namespace

Mesh read_gmsh(std::string_view text, const std::string& name) {
  Words in(text, name);
  const Contents contents = read_contents(in);
  require(!contents.triangles.empty(), "{}: triangles are required; got none: mesh the surface (gmsh -2)",
          name);

  std::vector<Vec2> vertices;
  std::unordered_map<std::int64_t, Index> number;
  const auto vertex = [&](std::int64_t tag) {
    const auto [it, is_new] = number.try_emplace(tag, static_cast<Index>(vertices.size()));
    if (is_new) {
      const auto node = contents.nodes.find(tag);
      require(node != contents.nodes.end(),
              "{}: an element names node {}, which is not there: write the mesh anew", name, tag);
      vertices.push_back(node->second);
    }
    return it->second;
  };

  std::vector<std::array<Index, 3>> cells;
  for (const auto& t : contents.triangles) cells.push_back({vertex(t[0]), vertex(t[1]), vertex(t[2])});

  std::vector<std::string> boundary_names;
  std::map<std::int64_t, Index> boundary_number;
  for (const auto& [tag, boundary_name] : contents.curve_names) {
    boundary_number[tag] = static_cast<Index>(boundary_names.size());
    boundary_names.push_back(boundary_name);
  }
  std::vector<NamedEdge> edges;
  for (const auto& [nodes, physical] : contents.lines) {
    const auto it = boundary_number.find(physical);
    if (it != boundary_number.end()) edges.push_back({{vertex(nodes[0]), vertex(nodes[1])}, it->second});
  }
  return make_mesh(std::move(vertices), std::move(cells), edges, std::move(boundary_names));
}

}  // namespace fpi::fluid
