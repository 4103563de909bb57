#include "fluid/mesh/gmsh.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "core/error.hpp"
#include "fluid/discretisation/scene_mesh.hpp"

namespace fpi::fluid {
namespace {

// Two triangles over the unit square, in both formats; vertex 9 belongs to none.
const std::string names =
    "$PhysicalNames\n3\n1 1 \"wall\"\n1 2 \"the inlet\"\n2 3 \"fluid\"\n$EndPhysicalNames\n";
const std::string format_2 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + names +
                             "$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n9 5 5 0\n$EndNodes\n"
                             "$Elements\n7\n1 15 2 0 1 1\n2 1 2 1 1 1 2\n3 1 2 1 2 2 3\n4 1 2 1 3 3 4\n5 1 2 "
                             "2 4 4 1\n6 2 2 3 1 1 2 3\n"
                             "7 2 2 3 1 1 3 4\n$EndElements\n";
const std::string format_4 =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n" + names +
    "$Entities\n1 4 1 0\n1 0 0 0 0 \n1 0 0 0 1 0 0 1 1 2 1 -2 \n2 1 0 0 1 1 0 1 1 2 2 -3 \n3 0 1 0 1 1 0 1 1 "
    "2 3 -4 \n"
    "4 0 0 0 0 1 0 1 2 2 4 -1 \n1 0 0 0 1 1 0 1 3 4 1 2 3 4 \n$EndEntities\n"
    "$Nodes\n1 5 1 9\n2 1 0 5\n1\n2\n3\n4\n9\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n5 5 0\n$EndNodes\n"
    "$Elements\n6 7 1 7\n0 1 15 1\n1 1\n1 1 1 1\n2 1 2\n1 2 1 1\n3 2 3\n1 3 1 1\n4 3 4\n1 4 1 1\n5 4 1\n2 1 "
    "2 2\n"
    "6 1 2 3\n7 1 3 4\n$EndElements\n";

std::string with(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

std::string error_of(const std::string& text, const std::vector<std::string>& conditions = {}) {
  try {
    read_gmsh(text, "m.msh", conditions);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(Gmsh, both_formats_give_the_same_mesh) {
  for (const std::string& text : {format_2, format_4}) {
    const Mesh mesh = read_gmsh(text, "square.msh");
    EXPECT_EQ(mesh.n_vertices(), 4);
    EXPECT_EQ(mesh.n_cells(), 2);
    EXPECT_EQ(mesh.n_edges(), 5);
    ASSERT_EQ(mesh.boundary_names, (std::vector<std::string>{"wall", "the inlet"}));
    ASSERT_EQ(mesh.boundary.size(), 4u);
    int on_inlet = 0;
    for (const BoundaryEdge& b : mesh.boundary) {
      const Vec2 middle = mesh.node_position(mesh.n_vertices() + b.edge);
      EXPECT_EQ(b.boundary == 1, middle.x() == 0);
      on_inlet += b.boundary == 1;
    }
    EXPECT_EQ(on_inlet, 1);
  }
}

// The same square with a parabolic left side: triangle 1 2 3 of first order, triangle 1 3 4 of second order
// with the middles 10 of 1–3, 11 of 3–4, 12 of 4–1.
std::string curved(std::string text) {
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  if (text[14] == '2') {
    replace("$Nodes\n5\n", "$Nodes\n8\n10 .5 .5 0\n11 .5 1 0\n12 -.1 .5 0\n");
    replace("5 1 2 2 4 4 1\n", "5 8 2 2 4 4 1 12\n");
    replace("7 2 2 3 1 1 3 4\n", "7 9 2 3 1 1 3 4 10 11 12\n");
  } else {
    replace("1 5 1 9\n", "2 8 1 12\n2 1 0 3\n10\n11\n12\n.5 .5 0\n.5 1 0\n-.1 .5 0\n");
    replace("$Elements\n6 7 1 7", "$Elements\n7 7 1 7");
    replace("1 4 1 1\n5 4 1\n", "1 4 8 1\n5 4 1 12\n");
    replace("2 1 2 2\n6 1 2 3\n7 1 3 4\n", "2 1 2 1\n6 1 2 3\n2 1 9 1\n7 1 3 4 10 11 12\n");
  }
  return text;
}

TEST(Gmsh, second_order_triangles_have_their_middles_where_the_file_says) {
  for (const std::string& text : {format_2, format_4}) {
    const Mesh mesh = read_gmsh(curved(text), "curved.msh");
    EXPECT_EQ(mesh.n_vertices(), 4);
    EXPECT_EQ(mesh.n_cells(), 2);
    for (const BoundaryEdge& b : mesh.boundary) EXPECT_EQ(mesh.is_curved_edge(b.edge), b.boundary == 1);
    for (Index e = 0; e < mesh.n_edges(); ++e) {
      if (!mesh.is_curved_edge(e)) continue;
      EXPECT_EQ(mesh.middles[e], Vec2(-0.1, 0.5));
    }
  }
}

TEST(Gmsh, lines_without_a_name_may_lie_anywhere) {
  std::string text = curved(format_2);
  text.replace(text.find("$Elements\n7\n"), 12, "$Elements\n8\n8 8 2 0 9 2 4 9\n");
  EXPECT_EQ(read_gmsh(text, "line.msh").n_cells(), 2);
}

TEST(Gmsh, a_curve_in_several_groups_takes_the_first_that_has_a_name) {
  std::string text = format_4;
  text.replace(text.find("3 0 1 0 1 1 0 1 1 "), 18, "3 0 1 0 1 1 0 3 9 2 1 ");
  const Mesh mesh = read_gmsh(text, "groups.msh");
  for (const BoundaryEdge& b : mesh.boundary) {
    const Vec2 middle = mesh.middles[b.edge];
    EXPECT_EQ(b.boundary == 1, middle.x() == 0 || middle.y() == 1);
  }
}

TEST(Gmsh, a_circle_of_the_scene_is_put_on_its_boundary) {
  scene::Fluid fluid;
  fluid.mesh.file = "square.msh";
  for (const char* boundary : {"wall", "the inlet"}) fluid.boundaries[boundary].type = "no_slip";
  fluid.mesh.circles.push_back({"the inlet", {0.5, 0.5}, std::sqrt(0.5)});
  const Mesh mesh = scene_mesh(fluid, {}, format_4);
  for (const BoundaryEdge& b : mesh.boundary) {
    EXPECT_EQ(mesh.is_curved_edge(b.edge), b.boundary == 1);
    if (b.boundary == 1) {
      EXPECT_NEAR(mesh.middles[b.edge].x(), 0.5 - std::sqrt(0.5), 1e-15);
    }
  }
}

TEST(Gmsh, a_mesh_whose_z_changes_is_refused_with_a_word_on_z) {
  const std::string tilted = with(format_2, "2 1 0 0\n3 1 1 0\n", "2 1 0 .75\n3 1 1 .75\n");
  EXPECT_EQ(error_of(tilted),
            "m.msh: a mesh in a plane of constant z is required, as the flow is in x and y; got nodes from z "
            "= 0 to z "
            "= 0.75 m: turn the geometry into the x-y plane");
  const std::string upright = with(format_2, "3 1 1 0\n4 0 1 0\n", "3 1 0 1\n4 0 0 1\n");  // in x and z
  EXPECT_NE(error_of(upright).find("constant z"), std::string::npos) << error_of(upright);
  const std::string middle = with(curved(format_2), "12 -.1 .5 0", "12 -.1 .5 .1");
  EXPECT_NE(error_of(middle).find("constant z"), std::string::npos) << error_of(middle);
}

TEST(Gmsh, a_mesh_may_lie_at_any_constant_z_and_nodes_that_no_element_uses_anywhere) {
  std::string text =
      with(format_2, "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n", "1 0 0 5\n2 1 0 5\n3 1 1 5\n4 0 1 5\n");
  EXPECT_EQ(read_gmsh(text, "m.msh").n_cells(), 2);
}

TEST(Gmsh, groups_of_one_name_are_one_boundary) {
  for (const std::string& text : {format_2, format_4}) {
    const Mesh mesh = read_gmsh(with(text, "the inlet", "wall"), "m.msh");
    EXPECT_EQ(mesh.boundary_names, std::vector<std::string>{"wall"});
    EXPECT_EQ(mesh.boundary.size(), 4u);
  }
}

// The upper side is in the groups of both names: twice in the file of format 2.2.
const std::string both_2 = with(format_2, "$Elements\n7\n", "$Elements\n8\n8 1 2 2 3 4 3\n");
const std::string both_4 = with(format_4, "3 0 1 0 1 1 0 1 1 ", "3 0 1 0 1 1 0 2 1 2 ");

TEST(Gmsh, an_edge_in_two_groups_belongs_to_the_one_that_the_scene_names) {
  for (const std::string& text : {both_2, both_4}) {
    for (const char* name : {"wall", "the inlet"}) {
      const Mesh mesh = read_gmsh(text, "m.msh", {name});
      for (const BoundaryEdge& b : mesh.boundary) {
        if (mesh.middles[b.edge].y() == 1) {
          EXPECT_EQ(mesh.boundary_names[b.boundary], name);
        }
      }
    }
    const std::string error = error_of(text, {"wall", "the inlet"});
    EXPECT_NE(error.find("m.msh: one condition for each edge of the boundary is required"), std::string::npos)
        << error;
  }
}

TEST(Gmsh, a_group_of_which_another_takes_every_edge_is_no_boundary) {
  std::string text = with(format_4, "1 0 0 0 1 0 0 1 1 ", "1 0 0 0 1 0 0 2 1 2 ");
  text = with(text, "4 0 0 0 0 1 0 1 2 ", "4 0 0 0 0 1 0 1 1 ");
  EXPECT_EQ(read_gmsh(text, "m.msh", {"wall"}).boundary_names, std::vector<std::string>{"wall"});
}

TEST(Gmsh, a_triangle_that_stands_there_for_each_of_its_groups_is_one) {
  const std::string text =
      with(format_2, "$Elements\n7\n", "$Elements\n9\n8 2 2 4 1 2 3 1\n9 2 2 4 1 1 3 4\n");
  EXPECT_EQ(read_gmsh(text, "m.msh").n_cells(), 2);
}

std::string shipped(const std::string& name) {
  std::ifstream file(FPI_GMSH_FILES "/" + name);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Gmsh, a_partitioned_mesh_is_the_mesh_as_a_whole) {
  const Mesh whole = read_gmsh(shipped("version_4.msh"), "whole.msh");
  const Mesh parts = read_gmsh(shipped("partitioned.msh"), "parts.msh");
  EXPECT_EQ(parts.n_cells(), whole.n_cells());
  EXPECT_EQ(parts.n_edges(), whole.n_edges());
  EXPECT_EQ(parts.boundary_names, whole.boundary_names);
  ASSERT_EQ(parts.boundary.size(), whole.boundary.size());
  const auto edges_of = [](const Mesh& mesh, Index boundary) {
    return std::ranges::count(mesh.boundary, boundary, &BoundaryEdge::boundary);
  };
  for (Index b = 0; b < 3; ++b) EXPECT_EQ(edges_of(parts, b), edges_of(whole, b));
}

TEST(Gmsh, one_partition_of_several_is_refused) {
  const std::string text =
      with(shipped("partitioned.msh"), "$PartitionedEntities\n2\n", "$PartitionedEntities\n3\n");
  EXPECT_NE(error_of(text).find("all its partitions in one file"), std::string::npos) << error_of(text);
}

TEST(Gmsh, every_error_names_the_file) {
  EXPECT_NE(error_of(with(format_2, "3 1 1 0", "3 2 0 0")).find("m.msh: triangles must have an area"),
            std::string::npos);
  EXPECT_NE(error_of(with(format_2, "2 1 2 1 1 1 2", "2 1 2 9 1 1 2")).find("m.msh: every outer edge"),
            std::string::npos);
  EXPECT_NE(error_of(with(format_2, "9 5 5 0", "1 5 5 0"))
                .find("m.msh:16: one place of node 1 is required; got two"),
            std::string::npos)
      << error_of(with(format_2, "9 5 5 0", "1 5 5 0"));
  EXPECT_NE(error_of(with(format_2, "the inlet", "\xf6"))
                .find("a name in UTF-8 on one line is required; got \\xF6"),
            std::string::npos)
      << error_of(with(format_2, "the inlet", "\xf6"));
}

TEST(Gmsh, a_mesh_cut_open_by_doubled_nodes_gets_a_hint) {
  const std::string text = with(with(format_2, "9 5 5 0", "9 0 0 0"), "7 2 2 3 1 1 3 4", "7 2 2 3 1 9 3 4");
  EXPECT_NE(error_of(with(text, "2 2 4 4 1", "2 2 4 4 9")).find("Coherence Mesh"), std::string::npos)
      << error_of(text);
}

TEST(Gmsh, a_boundary_without_a_condition_is_said_with_the_file) {
  scene::Fluid fluid;
  fluid.mesh.file = "square.msh";
  fluid.boundaries["wall"].type = "no_slip";
  try {
    scene_mesh(fluid, {}, format_4);
    FAIL();
  } catch (const Error& e) {
    EXPECT_STREQ(e.what(),
                 "square.msh: the boundary \"the inlet\" of the mesh needs a condition: add "
                 "[fluid.boundaries.the inlet]");
  }
}

TEST(Gmsh, a_file_cut_short_anywhere_is_refused_or_read_and_never_crashes) {
  for (const std::string& text : {format_2, format_4, curved(format_2), curved(format_4)})
    for (std::size_t n = 0; n + 14 < text.size(); ++n)
      EXPECT_THROW(read_gmsh(text.substr(0, n), "cut.msh"), Error) << n;
}

TEST(Gmsh, what_cannot_be_read_is_said_with_file_and_line) {
  const auto message = [](std::string text, const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
    try {
      read_gmsh(text, "m.msh");
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string("read");
  };
  EXPECT_NE(message(format_2, "2.2 0 8", "2.2 1 8").find("m.msh:2: an ASCII file"), std::string::npos);
  EXPECT_NE(message(format_2, "2.2 0 8", "3.0 0 8").find("format 2.2 or 4.1"), std::string::npos);
  EXPECT_NE(message(format_2, "6 2 2 3 1 1 2 3", "6 3 2 3 1 1 2 3").find("ElementOrder = 1 or 2"),
            std::string::npos);
  EXPECT_NE(message(format_2, "2 1 0 0", "2 one 0 0").find("a number is required; got one"),
            std::string::npos);
  EXPECT_NE(message(format_2, "$Elements\n7", "$Elements\n99999999999").find("a count"), std::string::npos);
}

}  // namespace
}  // namespace fpi::fluid
