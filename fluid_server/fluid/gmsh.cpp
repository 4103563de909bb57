#include "fluid/gmsh.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <optional>
#include <unordered_map>

#include "core/error.hpp"
#include "fluid/words.hpp"

namespace fpi::fluid {
namespace {

using Tag = std::int64_t;  // Gmsh's own number of a node, curve or group

enum ElementType { line = 1, triangle = 2, curved_line = 8, curved_triangle = 9, point = 15 };

/// What the file says, before it becomes a mesh.
struct Contents {
  struct Line {
    std::array<Tag, 2> ends;
    Tag curve;
    std::optional<Tag> middle;
  };
  struct Middle {  // of an edge of a triangle
    std::array<Tag, 2> ends;
    Tag node;
  };
  std::map<Tag, std::string> names;                  // of groups of curves
  std::unordered_map<Tag, std::vector<Tag>> groups;  // of each curve
  std::unordered_map<Tag, Vec2> nodes;
  std::vector<std::array<Tag, 3>> triangles;
  std::vector<Line> lines;
  std::vector<Middle> middles;
};

void read_names(Words& in, Contents& out) {
  for (std::size_t n = in.count(); n > 0; --n) {
    const int dimension = in.number<int>();
    const auto tag = in.number<Tag>();
    std::string name = in.quoted();
    if (dimension == 1) out.names[tag] = std::move(name);
  }
}

/// Nodes come as the vertices, then the middles: of a triangle those of edges 01, 12, 20.
void read_element(Words& in, Contents& out, int type, Tag curve) {
  if (type == point) {
    in.number<Tag>();
  } else if (type == line || type == curved_line) {
    std::array<Tag, 2> v;
    for (Tag& tag : v) tag = in.number<Tag>();
    out.lines.push_back({v, curve, {}});
    if (type == curved_line) out.lines.back().middle = in.number<Tag>();
  } else if (type == triangle || type == curved_triangle) {
    std::array<Tag, 3> v;
    for (Tag& tag : v) tag = in.number<Tag>();
    out.triangles.push_back(v);
    for (int k = 0; k < 3 && type == curved_triangle; ++k)
      out.middles.push_back({{v[k], v[(k + 1) % 3]}, in.number<Tag>()});
  } else {
    in.bad("triangles and lines of first or second order only (Mesh.ElementOrder = 1 or 2)",
           fmt::format("element type {}", type));
  }
}

void read_nodes_2(Words& in, Contents& out) {
  for (std::size_t n = in.count(); n > 0; --n) {
    const auto tag = in.number<Tag>();
    const double x = in.number<double>();
    out.nodes[tag] = {x, in.number<double>()};
    in.number<double>();
  }
}

void read_elements_2(Words& in, Contents& out) {
  for (std::size_t n = in.count(); n > 0; --n) {
    in.number<Tag>();
    const int type = in.number<int>();
    Tag group = 0;
    const std::size_t n_tags = in.count();
    for (std::size_t i = 0; i < n_tags; ++i) {
      const auto tag = in.number<Tag>();
      if (i == 0) group = tag;
    }
    out.groups[group] = {group};  // one stands for its curves
    read_element(in, out, type, group);
  }
}

void read_entities_4(Words& in, Contents& out) {
  const std::size_t n_points = in.count(), n_curves = in.count();
  in.count();
  in.count();
  for (std::size_t i = 0; i < n_points; ++i) {
    in.number<Tag>();
    in.skip_line();
  }
  for (std::size_t i = 0; i < n_curves; ++i) {
    const auto tag = in.number<Tag>();
    for (int k = 0; k < 6; ++k) in.number<double>();
    for (std::size_t n = in.count(); n > 0; --n)
      out.groups[tag].push_back(std::abs(in.number<Tag>()));  // negative: reversed
    in.skip_line();
  }
}

void read_nodes_4(Words& in, Contents& out) {
  const std::size_t n_blocks = in.count();
  for (int k = 0; k < 3; ++k) in.number<Tag>();
  for (std::size_t b = 0; b < n_blocks; ++b) {
    in.number<int>();
    in.number<Tag>();
    if (in.number<int>() != 0) in.bad("nodes without parametric coordinates", "parametric ones");
    std::vector<Tag> tags(in.count());
    for (auto& tag : tags) tag = in.number<Tag>();
    for (const auto tag : tags) {
      const double x = in.number<double>();
      out.nodes[tag] = {x, in.number<double>()};
      in.number<double>();
    }
  }
}

void read_elements_4(Words& in, Contents& out) {
  const std::size_t n_blocks = in.count();
  for (int k = 0; k < 3; ++k) in.number<Tag>();
  for (std::size_t b = 0; b < n_blocks; ++b) {
    in.number<int>();
    const auto entity = in.number<Tag>();
    const int type = in.number<int>();
    for (std::size_t n = in.count(); n > 0; --n) {
      in.number<Tag>();
      read_element(in, out, type, entity);
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

  const auto place = [&](Tag tag) {
    const auto node = contents.nodes.find(tag);
    require(node != contents.nodes.end(),
            "{}: an element names node {}, which is not there: write the mesh anew", name, tag);
    return node->second;
  };
  std::vector<Vec2> vertices;
  std::unordered_map<Tag, Index> number;
  const auto vertex = [&](Tag tag) {
    const auto [it, is_new] = number.try_emplace(tag, static_cast<Index>(vertices.size()));
    if (is_new) vertices.push_back(place(tag));
    return it->second;
  };

  std::vector<std::array<Index, 3>> cells;
  for (const auto& t : contents.triangles) cells.push_back({vertex(t[0]), vertex(t[1]), vertex(t[2])});

  std::vector<std::string> boundary_names;
  std::map<Tag, Index> boundary_number;
  for (const auto& [tag, boundary_name] : contents.names) {
    boundary_number[tag] = static_cast<Index>(boundary_names.size());
    boundary_names.push_back(boundary_name);
  }
  std::vector<EdgeMiddle> middles;
  for (const auto& [ends, node] : contents.middles)
    middles.push_back({{vertex(ends[0]), vertex(ends[1])}, place(node)});
  std::vector<NamedEdge> edges;
  for (const auto& [ends, curve, middle] : contents.lines) {
    const auto groups = contents.groups.find(curve);
    if (groups == contents.groups.end()) continue;
    const auto named =
        std::ranges::find_if(groups->second, [&](Tag tag) { return contents.names.contains(tag); });
    if (named == groups->second.end()) continue;
    edges.push_back({{vertex(ends[0]), vertex(ends[1])}, boundary_number.at(*named)});
    if (middle) middles.push_back({edges.back().vertices, place(*middle)});
  }
  return make_mesh(std::move(vertices), std::move(cells), edges, std::move(boundary_names), middles);
}

}  // namespace fpi::fluid
