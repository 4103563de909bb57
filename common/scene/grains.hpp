/// [[grains]]: groups of discs or spheres that a generator places (grains/expand.hpp makes bodies of them),
/// so that a scene of many grains stays a few lines.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "scene/bodies.hpp"

namespace fpi::scene {

struct Grains {
  std::string name;
  std::string shape = "disc";        ///< disc | sphere
  std::string generator;             ///< square | hexagonal | cubic | hcp | random | csv | scene
  std::vector<double> lower, upper;  ///< corners of the box that the grains fill [m]
  double radius = 0;                 ///< of all grains [m]; 0: one of the next three
  std::vector<double> radius_range;  ///< [smallest, largest] [m]
  std::vector<double> sieve_sizes;   ///< of a grading curve: diameters [m], ascending
  std::vector<double> passing;       ///< percentage of the mass that passes each, from 0 to 100
  double solid_fraction = 0;         ///< of a random packing
  double spacing = 0;                ///< of a lattice [m]; 0: the largest diameter and the gap
  double gap = 0;                    ///< least gap between grains at the start [m]
  std::int64_t seed = 1;
  std::string file;  ///< beside the scene: CSV of generator = "csv", TOML of "scene"
  double density = 0;
  std::vector<double> velocity{0, 0};
  std::vector<double> spin{0};
  std::string motion = "free";
  std::vector<std::string> prescribed_velocity;
  std::string prescribed_spin = "0";
  std::string material;
  std::size_t count = 0;  ///< bodies that it stands for; 0 until they are made

  static constexpr std::array<std::string_view, 2> shapes{"disc", "sphere"};
  static constexpr std::array<std::string_view, 7> generators{"square", "hexagonal", "cubic", "hcp",
                                                              "random", "csv",       "scene"};
  static constexpr std::size_t most_sieves = 100;

  bool is_plane() const { return shape == "disc"; }
  std::size_t axes() const { return is_plane() ? 2 : 3; }
  bool is_free() const { return motion == "free"; }
  bool changes_place() const { return is_free() || travels(*this); }
  /// The end of another scene's run is a table too.
  bool is_table() const { return generator == "csv" || is_staged(); }
  bool is_staged() const { return generator == "scene"; }
  bool is_random() const { return generator == "random"; }
  double largest_radius() const {
    return sieve_sizes.empty() ? std::max(radius, radius_range.empty() ? 0 : radius_range[1])
                               : sieve_sizes.back() / 2;
  }

  void declare(ParameterVisitor& v) {
    v.text({"name", "", "the grains are NAME.0, NAME.1 …; unique", true}, name);
    v.choice({"shape", "", "disc in a plane scene, sphere in space"}, shape, shapes);
    v.choice({"generator", "",
              "lattices: square or hexagonal in the plane, cubic or hcp in space; random: a packing without "
              "overlap; csv: the rows of a table; scene: where the free bodies of another scene are at the "
              "end of its "
              "run, which comes first",
              true},
             generator, generators);
    declare_places(v);
    declare_sizes(v);
    declare_motion(v, *this);
  }

 private:
  void declare_places(ParameterVisitor& v) {
    const bool in_plane = generator == "square" || generator == "hexagonal";
    const bool in_space = generator == "cubic" || generator == "hcp";
    v.require(!(in_plane && !is_plane()) && !(in_space && is_plane()), "generator",
              is_plane() ? "must be square, hexagonal, random, csv or scene for discs"
                         : "must be cubic, hcp, random, csv or scene for spheres");
    v.reals({"lower", "m", "lowest corner of the box that whole grains fill"}, lower, {0, 3}, any_number());
    v.reals({"upper", "m", "highest corner"}, upper, {0, 3}, any_number());
    const std::size_t entries = is_table() ? 0 : axes();
    for (const auto& [key, corner] : {std::pair("lower", &lower), std::pair("upper", &upper)})
      v.require(corner->size() == entries, key,
                is_table() ? "must be left out: the table says where grains are"
                           : "must have an entry for each axis: two of discs, three of spheres");
    v.require(lower.size() != upper.size() || std::ranges::equal(lower, upper, std::less()), "upper",
              "must be above lower along every axis");
    v.real({"solid_fraction", "", "volume of the grains of a random packing over that of the box"},
           solid_fraction, between(0, 1));
    v.require(is_random() == (solid_fraction > 0), "solid_fraction",
              is_random() ? "must be > 0 for a random packing" : "goes with generator = \"random\" only");
    v.real({"spacing", "m",
            "between the centres of neighbours in a lattice; 0: the largest diameter and the gap"},
           spacing, not_negative());
    v.require(spacing == 0 || !(is_random() || is_table()), "spacing", "goes with lattices only");
    v.real({"gap", "m", "least gap between grains of a random packing, and in a lattice without spacing"},
           gap, not_negative());
    v.integer({"seed", "", "other seeds give other random packings and other orders of sizes"}, seed,
              not_negative());
    v.text({"file", "",
            "of csv: a table beside the scene whose first line names its columns: x, y, z in space, radius, "
            "and, where given, vx, vy, vz and spin (spin_x, spin_y, spin_z in space); SI units; of scene: a "
            "scene "
            "file that stands beside this one"},
           file);
    v.require(is_table() == !file.empty(), "file",
              is_table() ? "must name the CSV file, or the scene"
                         : "goes with generator = \"csv\" or \"scene\" only");
  }

  void declare_sizes(ParameterVisitor& v) {
    v.real({"radius", "m", "contact radius of all grains"}, radius, not_negative());
    v.reals({"radius_range", "m", "[smallest, largest]: as many small grains as large ones"}, radius_range,
            {0, 2}, positive());
    v.require(radius_range.empty() || (radius_range.size() == 2 && radius_range[0] < radius_range[1]),
              "radius_range", "must be [smallest, largest]");
    v.reals({"sieve_sizes", "m", "of a grading curve: diameters, ascending"}, sieve_sizes, {0, most_sieves},
            positive());
    v.reals({"passing", "%",
             "mass that passes each sieve, from 0 to 100; between sieves linear in the logarithm of size"},
            passing, {0, most_sieves}, between(0, 100));
    v.require(sieve_sizes.empty() || (sieve_sizes.size() > 1 && is_ascending(sieve_sizes)), "sieve_sizes",
              "must be two sizes or more, ascending");
    const bool whole_curve = passing.size() == sieve_sizes.size() &&
                             (passing.empty() || (passing.front() == 0 && passing.back() == 100 &&
                                                  std::ranges::is_sorted(passing)));
    v.require(whole_curve, "passing", "must rise from 0 to 100 with an entry for each of sieve_sizes");
    const int ways = (radius > 0) + !radius_range.empty() + !sieve_sizes.empty();
    v.require(ways == (is_table() ? 0 : 1), "radius",
              is_table() ? "must be left out, and radius_range and sieve_sizes: the table has the radii"
                         : "must be given, or else radius_range, or sieve_sizes with passing: one of them");
  }

  static bool is_ascending(const std::vector<double>& values) {
    return std::ranges::adjacent_find(values, std::greater_equal()) == values.end();
  }
};

}  // namespace fpi::scene
