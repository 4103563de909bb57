#include "fluid/mesh/gmsh.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>

#include "core/context.hpp"
#include "core/error.hpp"
#include "core/tokenizer.hpp"

namespace fpi::fluid {
namespace {

using Tag = std::int64_t;  // Gmsh's own number of a node, curve or group

enum ElementType { line = 1, triangle = 2, curved_line = 8, curved_triangle = 9, point = 15 };

/// What the file says, before it becomes a mesh.
struct Contents {
  struct Node {
    Vec2 place;
    double z;
  };
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
  std::unordered_map<Tag, Node> nodes;
  std::vector<std::array<Tag, 3>> triangles;
  std::vector<Line> lines;
  std::vector<Middle> middles;
};

void read_names(Tokenizer& in, Contents& out) {
  for (std::size_t n = in.count(); n > 0; --n) {
    const int dimension = in.number<int>();
    const auto tag = in.number<Tag>();
    std::string name = in.quoted();
    if (dimension == 1) out.names[tag] = std::move(name);
  }
}

/// Nodes come as the vertices, then the middles: of a triangle those of edges 01, 12, 20.
void read_element(Tokenizer& in, Contents& out, int type, Tag curve) {
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

void read_place(Tokenizer& in, Contents& out, Tag tag) {
  Contents::Node node;
  for (double* coordinate : {&node.place.x(), &node.place.y(), &node.z}) *coordinate = in.real();
  const auto [it, is_new] = out.nodes.try_emplace(tag, node);
  if (!is_new && (it->second.place != node.place || it->second.z != node.z))
    in.bad(fmt::format("one place of node {}", tag), "two");
}

void read_nodes_2(Tokenizer& in, Contents& out) {
  for (std::size_t n = in.count(); n > 0; --n) read_place(in, out, in.number<Tag>());
}

void read_elements_2(Tokenizer& in, Contents& out) {
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

void read_entities_4(Tokenizer& in, Contents& out) {
  const std::size_t n_points = in.count(), n_curves = in.count();
  in.skip(2);
  for (std::size_t i = 0; i < n_points; ++i) {
    in.number<Tag>();
    in.skip_line();
  }
  for (std::size_t i = 0; i < n_curves; ++i) {
    const auto tag = in.number<Tag>();
    in.skip(6);
    for (std::size_t n = in.count(); n > 0; --n)
      out.groups[tag].push_back(std::abs(in.number<Tag>()));  // negative: reversed
    in.skip_line();
  }
}

/// The head of a part of a point, curve or surface, up to its box.
struct Part {
  Tag tag;
  int parent_dimension;
  std::vector<Tag> partitions;
};

Part read_part(Tokenizer& in) {
  Part part{.tag = in.number<Tag>(), .parent_dimension = in.number<int>(), .partitions = {}};
  in.number<Tag>();
  part.partitions.resize(in.count());
  for (Tag& partition : part.partitions) partition = in.number<Tag>();
  return part;
}

/// In a partitioned mesh elements belong to parts of curves and surfaces, and these to groups. What separates
/// two parts of a surface has the surface's groups, which are none of curves.
void read_partitioned_entities_4(Tokenizer& in, Contents& out) {
  const std::size_t n_partitions = in.count();
  const std::size_t n_ghosts = in.count();
  for (std::size_t i = 0; i < n_ghosts; ++i) in.skip(2);
  const std::size_t n_points = in.count(), n_curves = in.count(), n_surfaces = in.count();
  in.skip(1);
  for (std::size_t i = 0; i < n_points; ++i) {
    read_part(in);
    in.skip_line();
  }
  out.groups.clear();
  for (std::size_t i = 0; i < n_curves; ++i) {
    const Part part = read_part(in);
    in.skip(6);
    for (std::size_t n = in.count(); n > 0; --n) {
      const Tag group = std::abs(in.number<Tag>());
      if (part.parent_dimension == 1) out.groups[part.tag].push_back(group);
    }
    in.skip_line();
  }
  std::set<Tag> there;
  for (std::size_t i = 0; i < n_surfaces; ++i) {
    const Part part = read_part(in);
    there.insert(part.partitions.begin(), part.partitions.end());
    in.skip_line();
  }
  if (there.size() < n_partitions)
    in.bad("a mesh with all its partitions in one file (Mesh.PartitionSplitMeshFiles = 0)",
           fmt::format("{} of {}", there.size(), n_partitions));
}

void read_nodes_4(Tokenizer& in, Contents& out) {
  const std::size_t n_blocks = in.count();
  for (int k = 0; k < 3; ++k) in.number<Tag>();
  for (std::size_t b = 0; b < n_blocks; ++b) {
    in.number<int>();
    in.number<Tag>();
    if (in.number<int>() != 0) in.bad("nodes without parametric coordinates", "parametric ones");
    std::vector<Tag> tags(in.count());
    for (auto& tag : tags) tag = in.number<Tag>();
    for (const auto tag : tags) read_place(in, out, tag);
  }
}

void read_elements_4(Tokenizer& in, Contents& out) {
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

Contents read_contents(Tokenizer& in) {
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
    } else if (section == "$PartitionedEntities") {
      read_partitioned_entities_4(in, out);
    } else if (section == "$Nodes") {
      *is_4 ? read_nodes_4(in, out) : read_nodes_2(in, out);
    } else if (section == "$Elements") {
      *is_4 ? read_elements_4(in, out) : read_elements_2(in, out);
    }
    in.skip_to("$End" + section.substr(1));
  }
  return out;
}

/// Makes a mesh of what the file says.
class Assembler {
 public:
  Assembler(const Contents& contents, const std::string& name, const std::vector<std::string>& conditions)
      : contents_(contents), name_(name), conditions_(conditions) {}

  Mesh mesh() {
    add_triangles();
    add_lines();
    check_plane();
    const std::vector<NamedEdge> edges = named_edges();
    return in_context(name_, [&] {
      return make_mesh(std::move(vertices_), std::move(cells_), edges, std::move(boundary_names_), middles_);
    });
  }

 private:
  /// An edge with the boundaries that its lines belong to, in the order of the file.
  using Groups = std::map<std::array<Index, 2>, std::vector<Index>>;

  Vec2 place(Tag tag) {
    const auto node = contents_.nodes.find(tag);
    require(node != contents_.nodes.end(),
            "{}: an element names node {}, which is not there: write the mesh anew", name_, tag);
    z_.push_back(node->second.z);
    return node->second.place;
  }

  Index vertex(Tag tag) {
    const auto [it, is_new] = number_.try_emplace(tag, static_cast<Index>(vertices_.size()));
    if (is_new) vertices_.push_back(place(tag));
    return it->second;
  }

  /// Gmsh writes a triangle once for each of its groups.
  void add_triangles() {
    require(!contents_.triangles.empty(), "{}: triangles are required; got none: mesh the surface (gmsh -2)",
            name_);
    std::set<std::array<Tag, 3>> known;
    for (const auto& triangle : contents_.triangles) {
      auto sorted = triangle;
      std::ranges::sort(sorted);
      if (!known.insert(sorted).second) continue;
      cells_.push_back({vertex(triangle[0]), vertex(triangle[1]), vertex(triangle[2])});
    }
    for (const auto& [ends, node] : contents_.middles)
      middles_.push_back({{vertex(ends[0]), vertex(ends[1])}, place(node)});
  }

  /// Groups of one name are one boundary.
  std::map<Tag, Index> number_boundaries() {
    std::map<Tag, Index> number;
    for (const auto& [tag, boundary] : contents_.names) {
      const auto found = std::ranges::find(boundary_names_, boundary);
      number[tag] = static_cast<Index>(found - boundary_names_.begin());
      if (found == boundary_names_.end()) boundary_names_.push_back(boundary);
    }
    return number;
  }

  void add_lines() {
    const std::map<Tag, Index> boundary = number_boundaries();
    for (const auto& [ends, curve, middle] : contents_.lines) {
      const auto groups = contents_.groups.find(curve);
      if (groups == contents_.groups.end()) continue;
      for (const Tag group : groups->second)
        if (boundary.contains(group)) add_line(ends, middle, boundary.at(group));
    }
  }

  void add_line(const std::array<Tag, 2>& ends, const std::optional<Tag>& middle, Index boundary) {
    std::array<Index, 2> edge{vertex(ends[0]), vertex(ends[1])};
    if (middle) middles_.push_back({edge, place(*middle)});
    std::ranges::sort(edge);
    std::vector<Index>& of_edge = groups_[edge];
    if (std::ranges::find(of_edge, boundary) == of_edge.end()) of_edge.push_back(boundary);
  }

  /// The flow is plane: a mesh that is not would be squeezed into the plane without a word.
  void check_plane() const {
    const auto [lowest, highest] = std::ranges::minmax(z_);
    Vec2 low = vertices_.front(), high = low;
    for (const Vec2& x : vertices_) {
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
    }
    require(
        highest - lowest <= flat * (high - low).norm(),
        "{}: a mesh in a plane of constant z is required, as the flow is in x and y; got nodes from z = {:g} "
        "to z = {:g} m: turn the geometry into the x-y plane",
        name_, lowest, highest);
  }

  /// Each edge with one boundary; a name of which another takes every edge is no boundary.
  std::vector<NamedEdge> named_edges() {
    std::vector<NamedEdge> edges;
    std::vector<std::uint8_t> has_lost(boundary_names_.size(), 0);
    for (const auto& [edge, groups] : groups_) {
      edges.push_back({edge, chosen(edge, groups)});
      for (const Index group : groups) has_lost[group] = 1;
    }
    for (const NamedEdge& edge : edges) has_lost[edge.boundary] = 0;
    remove_boundaries(has_lost, edges);
    return edges;
  }

  /// Of the boundaries of an edge the one that the scene has a condition for, or else the first.
  Index chosen(const std::array<Index, 2>& edge, const std::vector<Index>& groups) const {
    std::optional<Index> found;
    for (const Index group : groups) {
      if (std::ranges::find(conditions_, boundary_names_[group]) == conditions_.end()) continue;
      const Vec2 &a = vertices_[edge[0]], &b = vertices_[edge[1]];
      require(
          !found,
          "{}: one condition for each edge of the boundary is required; the edge from ({:g}, {:g}) to ({:g}, "
          "{:g}) m is in the groups \"{}\" and \"{}\", and the scene has a condition for both: remove one of "
          "the conditions, or take the edge out of one of the groups",
          name_, a.x(), a.y(), b.x(), b.y(), boundary_names_[found.value_or(0)], boundary_names_[group]);
      found = group;
    }
    return found.value_or(groups.front());
  }

  void remove_boundaries(const std::vector<std::uint8_t>& removed, std::vector<NamedEdge>& edges) {
    std::vector<std::string> kept;
    std::vector<Index> number;
    for (std::size_t b = 0; b < boundary_names_.size(); ++b) {
      number.push_back(static_cast<Index>(kept.size()));
      if (removed[b] == 0) kept.push_back(boundary_names_[b]);
    }
    for (NamedEdge& edge : edges) edge.boundary = number[edge.boundary];
    boundary_names_ = std::move(kept);
  }

  static constexpr double flat = 1e-8;  // of the mesh: mesh files are written to some ten digits

  const Contents& contents_;
  const std::string& name_;
  const std::vector<std::string>& conditions_;  // boundaries that the scene names
  std::vector<Vec2> vertices_;
  std::vector<double> z_;  // of all nodes that elements use [m]
  std::unordered_map<Tag, Index> number_;
  std::vector<std::array<Index, 3>> cells_;
  std::vector<EdgeMiddle> middles_;
  std::vector<std::string> boundary_names_;
  Groups groups_;
};

}  // namespace

Mesh read_gmsh(std::string_view text, const std::string& name, const std::vector<std::string>& conditions) {
  Tokenizer in(text, name, "write the mesh anew with Gmsh (ASCII, format 2.2 or 4.1)");
  const Contents contents = read_contents(in);
  return Assembler(contents, name, conditions).mesh();
}

}  // namespace fpi::fluid
