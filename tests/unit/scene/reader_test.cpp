/// Reading a scene: values, defaults, and the wording of each kind of error.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "scenes.hpp"

namespace fpi::scene {
namespace {

TEST(Reader, reads_values_and_fills_in_defaults) {
  const Scene s = read_text(settling, "drop.toml");
  EXPECT_EQ(s.gravity, (std::vector<double>{0, -9.81}));
  EXPECT_EQ(s.fluid->density, 1000);
  EXPECT_DOUBLE_EQ(s.fluid->viscosity(), 1e-2);
  EXPECT_EQ(s.fluid->boundaries.at("top").type, "no_slip");
  EXPECT_EQ(s.bodies.at(0).velocity, (std::vector<double>{0, 0}));
  EXPECT_EQ(s.coupling.acceleration, "iqn-imvj");
  EXPECT_TRUE(s.dem) << "a free body brings [dem] with its defaults";
  EXPECT_TRUE(s.moves_freely());
  EXPECT_TRUE(s.coefficients.empty());
}

TEST(Reader, takes_whole_numbers_for_reals_and_numbers_for_formulas) {
  const Scene s = read_text(
      with(settling, "top.type = \"no_slip\"", "top = {type = \"velocity\", velocity = [1, \"x*t\"]}"),
      "drop.toml");
  EXPECT_EQ(s.time.end, 1.0);
  EXPECT_EQ(s.fluid->boundaries.at("top").velocity, (std::vector<std::string>{"1", "x*t"}));
}

TEST(Reader, gives_a_sphere_three_components) {
  const Scene s = read_text(R"(
gravity = [0, 0, -9.81]
[time]
step = 1e-3
end = 1
[[bodies]]
name = "ball"
shape = "sphere"
radius = 1
density = 1
position = [0, 0, 5]
)",
                            "ball.toml");
  EXPECT_EQ(s.bodies[0].velocity.size(), 3u);
  EXPECT_EQ(s.bodies[0].spin.size(), 3u);
}

TEST(Reader, finds_every_unknown_key_and_suggests_the_near_ones) {
  const std::string text =
      with(with(settling, "density = 1000", "densty = 1000"), "[fluid.mesh]", "[fluid.mehs]");
  EXPECT_EQ(error_of(text + "colour = \"red\"\n"),
            "drop.toml:9: the key \"fluid.densty\" is not known; did you mean \"density\"?\n"
            "drop.toml:12: the key \"fluid.mehs\" is not known; did you mean \"mesh\"?\n"
            "drop.toml:38: the key \"walls.0.colour\" is not known; known here: name, shape, point, "
            "normal, vertices, closed, centre, radius, start, end, file, scale, velocity, spin, material");
}

TEST(Reader, tells_every_problem_by_line_and_none_that_only_follows_from_another) {
  std::string text = with(settling, "density = 1000", "densty = 1000");  // so that a density is missed
  text = with(text, "step = 0.001", "step = -1");                        // so that none is > 0
  text = with(text, "youngs_modulus = 1e6", "youngs_modulus = \"soft\"");
  const std::string told = error_of(text + "[[probes]]\nname = \"time\"\npoint = [0, 0]\n");
  EXPECT_EQ(std::ranges::count(told, '\n'), 3) << told;
  EXPECT_EQ(told.find("drop.toml:5: time.step must be a finite number ≥ 0 s; got -1"), 0u) << told;
  const std::size_t density = told.find("\ndrop.toml:9: the key \"fluid.densty\" is not known"),
                    modulus = told.find("\ndrop.toml:32: materials.0.youngs_modulus must be"),
                    probe = told.find("\ndrop.toml:39: probes.0.name must not be the name of another column");
  EXPECT_TRUE(0 < density && density < modulus && modulus < probe && probe != std::string::npos) << told;
}

TEST(Reader, refuses_a_periodic_rectangle_without_a_corner_and_half_a_superficial_velocity) {
  const std::string periodic = "[periodic]\nx = [0, 1]\n";
  const std::size_t corner = settling.find("lower = "), end = settling.find('\n', corner);
  std::string text = settling + periodic;
  text.erase(corner, end - corner + 1);
  EXPECT_NE(error_of(text).find("fluid.mesh.lower must name a mesh, or else"), std::string::npos)
      << error_of(text);
  const std::string half = with(settling, "density = 1000", "density = 1000\nsuperficial_velocity = [\"1\"]");
  EXPECT_NE(error_of(half).find("fluid.superficial_velocity must be two formulas or empty"),
            std::string::npos)
      << error_of(half);
}

TEST(Reader, finds_an_unknown_table) {
  EXPECT_EQ(error_of(settling + "[outptu]\n"),
            "drop.toml:38: the key \"outptu\" is not known; did you mean \"output\"?");
}

TEST(Reader, says_bounds_unit_and_what_came) {
  EXPECT_EQ(
      error_of(with(settling, "density = 1000", "density = -1")),
      "drop.toml:9: fluid.density must be a finite number > 0 kg/m³; got -1: correct it (fluid density ρ)");
}

TEST(Reader, refuses_numbers_that_are_not_finite_or_too_large) {
  for (const char* number : {"nan", "inf", "-inf", "1e999", "99999999999999999999"}) {
    EXPECT_NE(error_of(with(settling, "end = 1", std::string("end = ") + number))
                  .find("drop.toml:6: time.end must be a finite number ≥ 0 s"),
              std::string::npos)
        << number << ": " << error_of(with(settling, "end = 1", std::string("end = ") + number));
  }
}

TEST(Reader, refuses_numbers_with_which_volumes_and_energies_overflow) {
  const auto of_radius = [](const std::string& radius) {
    return error_of(with(settling, "radius = 0.00125", "radius = " + radius));
  };
  for (const char* radius : {"1e307", "1e51"})
    EXPECT_NE(
        of_radius(radius).find(
            "drop.toml:26: bodies.0.radius must be a finite number > 0 m, up to 1e+50 in magnitude; got 1e"),
        std::string::npos)
        << of_radius(radius);
  for (const char* radius : {"1e-310", "5e-324"})
    EXPECT_NE(of_radius(radius).find("a finite number > 0 m, at least 1e-50; got "), std::string::npos)
        << of_radius(radius);
  const auto of_height = [](const std::string& height) {
    return error_of(with(settling, "[0.01, 0.04]", "[0.01, " + height + "]"));
  };
  EXPECT_NE(of_height("-1e60").find("bodies.0.position.1 must be a finite number"), std::string::npos);
  EXPECT_EQ(of_height("1e-60"), "");
}

TEST(Reader, refuses_text_that_is_not_utf8) {
  EXPECT_EQ(error_of(with(settling, "a disc settles",
                          "Gr\xf6\xdf"
                          "e")),
            "drop.toml:1: text in UTF-8 is required; got the byte 0xF6, as Latin-1 and other encodings have "
            "it: save "
            "the file in UTF-8");
  std::string wide = "\xff\xfe";
  for (const char c : settling) wide += {c, '\0'};
  EXPECT_EQ(error_of(wide), "drop.toml:1: text in UTF-8 is required; got UTF-16: save the file in UTF-8");
  EXPECT_EQ(error_of("\xef\xbb\xbf" + settling), "");
  EXPECT_NE(error_of(settling, {"title=\xf6"}).find("--set title=\\xF6"), std::string::npos)
      << error_of(settling, {"title=\xf6"});
}

TEST(Reader, quotes_whole_characters_of_a_long_text) {
  std::string word(59, 'a');
  word += "\u00e9\u00e9";
  const std::string error = error_of(with(settling, "\"no_slip\"", "\"" + word + "\""));
  EXPECT_NE(error.find("got \"" + word.substr(0, 59) + "\"…"), std::string::npos) << error;
}

TEST(Reader, says_what_a_periodic_rectangle_without_a_corner_lacks) {
  const std::string periodic = with(settling, "[fluid]", "[periodic]\nx = [0, 0.02]\n[fluid]");
  for (const char* corner : {"lower = [0, 0]\n", "upper = [0.02, 0.06]\n"})
    EXPECT_NE(error_of(with(periodic, corner, ""))
                  .find(": fluid.mesh.lower must name a mesh, or else lower = [x, y] and upper = [x, y]"),
              std::string::npos)
        << error_of(with(periodic, corner, ""));
  EXPECT_NE(error_of(with(periodic, "lower = [0, 0]", "lower = [0]")), "");
  EXPECT_NE(error_of(with(periodic, "density = 1000", "density = 1000\nsuperficial_velocity = [\"1\"]")), "");
}

TEST(Reader, refuses_lists_and_assignments_as_formulas_with_their_key) {
  const auto moving = [](const std::string& velocity) {
    return error_of(with(settling, "top.type = \"no_slip\"",
                         "top = {type = \"velocity\", velocity = [" + velocity + ", 0]}"));
  };
  EXPECT_EQ(moving("\"0.5\""), "");
  EXPECT_EQ(moving("\"0,5\""),
            "drop.toml:22: fluid.boundaries.top.velocity.0: a formula of one value is required; got \"0,5\", "
            "a list of "
            "2: write decimals with a point, as in 0.5");
  EXPECT_EQ(
      moving("\"x=5\""),
      "drop.toml:22: fluid.boundaries.top.velocity.0: a formula without = is required; got \"x=5\": give the "
      "right side only, or compare with ==");
}

TEST(Reader, says_what_a_missing_key_would_be) {
  EXPECT_EQ(error_of(with(settling, "density = 1000\n", "")),
            "drop.toml:8: fluid.density is required, a finite number > 0 kg/m³; got nothing: add density = … "
            "(fluid density ρ)");
}

TEST(Reader, refuses_the_wrong_type_and_quotes_what_came) {
  EXPECT_EQ(error_of(with(settling, "density = 1000", "density = \"water\"")),
            "drop.toml:9: fluid.density must be a finite number > 0 kg/m³; got \"water\": correct it (fluid "
            "density ρ)");
  EXPECT_NE(error_of(with(settling, "cells_x = 4", "cells_x = 4.5"))
                .find("must be a whole number in [0, 100000]; got 4.5"),
            std::string::npos);
  EXPECT_NE(error_of(with(settling, "title = \"a disc settles\"", "title = 1979-05-27")).find("got a date"),
            std::string::npos);
  EXPECT_NE(error_of(with(settling, "[time]\nstep = 0.001\nend = 1\n", "time = 3\n"))
                .find("time must be a table; got 3"),
            std::string::npos);
  EXPECT_NE(error_of("bodies = 3\n[time]\nstep = 1\nend = 1\n")
                .find("drop.toml:1: bodies must be tables [[bodies]]; got 3"),
            std::string::npos);
}

TEST(Reader, suggests_the_near_choice) {
  EXPECT_EQ(
      error_of(settling + "[coupling]\nacceleration = \"aitkn\"\n"),
      "drop.toml:39: coupling.acceleration must be one of \"constant\", \"aitken\", \"iqn-ils\", "
      "\"iqn-imvj\" (did you mean \"aitken\"?); got \"aitkn\": correct it (how the next iterate is "
      "found: constant or Aitken's relaxation, or interface quasi-Newton with least squares over the last "
      "steps (iqn-ils) or with an inverse Jacobian that is carried on (iqn-imvj))");
}

TEST(Reader, checks_the_length_and_the_entries_of_a_list) {
  EXPECT_NE(error_of(with(settling, "position = [0.01, 0.04]", "position = [0.01]"))
                .find("drop.toml:28: bodies.0.position must be a list [...] of 2 numbers m; got [0.01]"),
            std::string::npos);
  EXPECT_NE(error_of(with(settling, "position = [0.01, 0.04]", "position = [0.01, nan]"))
                .find("bodies.0.position.1"),
            std::string::npos);
}

TEST(Reader, reads_formulas_when_it_reads_the_scene) {
  const std::string text =
      with(settling, "top.type = \"no_slip\"", "top = {type = \"velocity\", velocity = [\"4*z\", 0]}");
  EXPECT_NE(error_of(text).find("drop.toml:22: fluid.boundaries.top.velocity.0: a formula in x, y, t"),
            std::string::npos)
      << error_of(text);
}

TEST(Reader, turns_a_syntax_error_into_a_sentence_with_its_line) {
  const std::string message = error_of(with(settling, "step = 0.001", "step = = 0.001"));
  EXPECT_EQ(message.find("drop.toml:5: valid TOML is required"), 0u) << message;
}

TEST(Reader, refuses_hostile_nesting_without_exhausting_the_stack) {
  EXPECT_NE(error_of("a = " + std::string(200000, '[')).find("nested"), std::string::npos);
  std::string dotted = "a";
  for (int i = 0; i < 100000; ++i) dotted += ".a";
  EXPECT_NE(error_of(dotted + " = 1").find("nested"), std::string::npos);
  std::string hidden = "a = [";
  for (int i = 0; i < 1000; ++i) hidden += "\"\"\"\n]\"\"\", [";
  EXPECT_NE(error_of(hidden).find("nested"), std::string::npos);
}

TEST(Reader, accepts_many_brackets_side_by_side) {
  std::string text = settling;
  for (int i = 0; i < 100; ++i) {
    text +=
        fmt::format("[[bodies]]\nname = \"b{}\"\nradius = 1\ndensity = 1\nposition = [0.5, {}.5]\n", i, i);
  }
  EXPECT_EQ(read_text(text, "many.toml").bodies.size(), 101u);
}

TEST(Reader, says_which_file_cannot_be_read) {
  for (const std::string path : {"no/such/scene.toml", "/"}) {
    try {
      read_file(path);
      FAIL() << "read " << path;
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find("a scene file is required; " + path), std::string::npos)
          << e.what();
    }
  }
}

TEST(Reader, names_the_file_in_its_errors) {
  const std::string path = testing::TempDir() + "fpi_reader_test.toml";
  std::ofstream(path) << with(settling, "density = 1000", "density = 0");
  try {
    read_file(path);
    FAIL() << "read";
  } catch (const Error& e) {
    EXPECT_EQ(std::string(e.what()).find(path + ":9: fluid.density"), 0u) << e.what();
  }
  std::filesystem::remove(path);
}

TEST(Reader, takes_a_single_table_for_a_list_of_one) {
  const std::string one = "on = \"top\"\nvelocity = 2\nlength = 1\n";
  const Scene single = read_text(settling + "[coefficients]\n" + one, "drop.toml");
  const Scene list = read_text(settling + "[[coefficients]]\n" + one, "drop.toml");
  EXPECT_EQ(single.coefficients.at(0).velocity, 2);
  EXPECT_EQ(write_text(single), write_text(list));
}

}  // namespace
}  // namespace fpi::scene
