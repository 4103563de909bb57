/// [fluid]: the flow, its mesh, its boundaries, its solver and the way bodies are embedded in it.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/parameters.hpp"

namespace fpi::scene {

/// [[fluid.mesh.refinements]]: triangles of at most size + growth · distance from a region.
struct Refinement {
  double size = 0;             ///< h = √(2·area) in the region [m]
  double growth = 0.25;        ///< of the size with the distance from the region
  std::vector<double> box;     ///< [x0, y0, x1, y1] [m]
  std::vector<double> centre;  ///< of a circle line [m]
  double radius = 0;           ///< [m]
  std::vector<double> line;    ///< [x0, y0, x1, y1, …] of a polyline [m]

  void declare(ParameterVisitor& v) {
    v.real({"size", "m", "largest short side of the triangles that touch the region", true}, size,
           positive());
    v.real({"growth", "", "by how much the size may grow with the distance from the region"}, growth,
           between(0, 10));
    v.reals({"box", "m", "region: [x0, y0, x1, y1]"}, box, {0, 4}, any_number());
    v.reals({"centre", "m", "region: the circle line of this centre and radius"}, centre, {0, 2},
            any_number());
    v.real({"radius", "m", "of the circle; 0: the point"}, radius, not_negative());
    v.reals({"line", "m", "region: the line through the points [x0, y0, x1, y1, …]"}, line, {}, any_number());
    v.require(
        box.empty() + centre.empty() + line.empty() == 2, "size",
        "must come with one region: box = [x0, y0, x1, y1], centre = [x, y] and radius, or line = [x0, y0, "
        "x1, y1, …]");
    v.require(box.empty() || (box.size() == 4 && box[0] <= box[2] && box[1] <= box[3]), "box",
              "must be [x0, y0, x1, y1] with x0 <= x1 and y0 <= y1");
    v.require(centre.size() != 1, "centre", "must be [x, y]");
    v.require(line.empty() || (line.size() >= 4 && line.size() % 2 == 0), "line",
              "must have two points or more, each x, y");
  }
};

/// [[fluid.mesh.circles]]: a boundary of a Gmsh mesh that is a circle.
struct Circle {
  std::string boundary;
  std::vector<double> centre;  ///< [m]
  double radius = 0;           ///< [m]

  void declare(ParameterVisitor& v) {
    v.text({"boundary", "", "name of the boundary that is put on the circle, its edges as parabolas", true},
           boundary);
    v.reals({"centre", "m", "of the circle", true}, centre, {2, 2}, any_number());
    v.real({"radius", "m", "of the circle", true}, radius, positive());
  }
};

/// [fluid.mesh]: a Gmsh file, or a rectangle made here.
struct Mesh {
  std::string file;                       ///< Gmsh .msh (2.2 or 4.1); the coupler reads its bytes
  std::vector<double> lower, upper;       ///< corners of the rectangle [m]
  std::int64_t cells_x = 0, cells_y = 0;  ///< uniform division
  double crowding = 0;                    ///< of its lines at the sides
  double cell_size = 0;                   ///< [m] graded division: size inside fine_region
  std::vector<double> fine_region;        ///< [x0, y0, x1, y1] [m]; empty: everywhere
  double growth = 1.15;                   ///< ratio of neighbouring cell sizes outside fine_region
  double largest_cell_size = 0;           ///< [m]; 0: no limit
  double elements_per_diameter = 0;       ///< D/h near bodies; 0: they are not looked at
  std::vector<double> free_bodies_box;    ///< [x0, y0, x1, y1] [m]; empty: as their weight says
  std::vector<Refinement> refinements;    ///< of the rectangle
  std::vector<Circle> circles;            ///< of the Gmsh mesh

  void declare(ParameterVisitor& v) {
    v.text({"file", "", "Gmsh mesh (.msh, format 2.2 or 4.1), beside the scene; else a rectangle is made"},
           file);
    v.reals({"lower", "m", "lower left corner of the rectangle"}, lower, {0, 2}, any_number());
    v.reals({"upper", "m", "upper right corner of the rectangle"}, upper, {0, 2}, any_number());
    v.integer({"cells_x", "", "uniform division: cells along x, each of two triangles"}, cells_x,
              between(0, 100000));
    v.integer({"cells_y", "", "uniform division: cells along y"}, cells_y, between(0, 100000));
    v.real({"crowding", "", "uniform division: its lines crowd at the sides; 0: not at all, 1: as a cosine"},
           crowding, between(0, 1));
    v.require(crowding == 0 || cells_x > 0, "crowding", "goes with cells_x and cells_y only");
    v.real({"cell_size", "m", "graded division: short side of the triangles inside fine_region"}, cell_size,
           not_negative());
    v.reals({"fine_region", "m", "graded division: [x0, y0, x1, y1] kept at cell_size; empty: everywhere"},
            fine_region, {0, 4}, any_number());
    v.real({"growth", "", "graded division: ratio of neighbouring sizes outside fine_region"}, growth,
           between(1, 2));
    v.real({"largest_cell_size", "m", "graded division: upper limit of the size; 0: none"}, largest_cell_size,
           not_negative());
    v.real({"elements_per_diameter", "",
            "triangles of the rectangle are halved around each body, where it starts and wherever its "
            "prescribed motion takes it, to a short side of its diameter over this (a polygon's: of the disc "
            "of equal area); 0: they are not"},
           elements_per_diameter, between(0, 1000));
    v.reals(
        {"free_bodies_box", "m",
         "where free bodies need triangles of that size: [x0, y0, x1, y1]; empty: in the column that each "
         "falls or rises through, with half a diameter on both sides, or everywhere without gravity"},
        free_bodies_box, {0, 4}, any_number());
    v.tables({"refinements", "", "where triangles of the rectangle are halved until they are small enough"},
             refinements);
    v.tables({"circles", "", "boundaries of a Gmsh mesh of straight triangles that are circles"}, circles);
    const bool rectangle = lower.size() == 2 && upper.size() == 2;
    v.require(
        file.empty() ? rectangle : lower.empty() && upper.empty(), file.empty() ? "lower" : "file",
        "must name a mesh, or else lower = [x, y] and upper = [x, y] must give the corners of a rectangle");
    v.require(!rectangle || (lower[0] < upper[0] && lower[1] < upper[1]), "upper",
              "must lie right of and above lower");
    const bool uniform = cells_x > 0 && cells_y > 0, divided = cells_x > 0 || cells_y > 0;
    v.require(!rectangle || (cell_size > 0 ? !divided : uniform), cell_size > 0 ? "cell_size" : "cells_x",
              "must go without the other: a rectangle has either cells_x and cells_y, or cell_size");
    v.require(rectangle || (cell_size == 0 && !divided), "file",
              "has its own cells: remove cells_x, cells_y and cell_size");
    v.require(rectangle || refinements.empty(), "file", "has its own triangles: remove the refinements");
    v.require(rectangle || elements_per_diameter == 0, "file",
              "has its own triangles: remove elements_per_diameter");
    v.require(free_bodies_box.empty() ||
                  (free_bodies_box.size() == 4 && elements_per_diameter > 0 &&
                   free_bodies_box[0] < free_bodies_box[2] && free_bodies_box[1] < free_bodies_box[3]),
              "free_bodies_box",
              "must be [x0, y0, x1, y1] with x0 < x1 and y0 < y1, beside elements_per_diameter");
    v.require(!rectangle || circles.empty(), "lower",
              "must not be given with circles, which are for a mesh file");
    v.require(fine_region.empty() || fine_region.size() == 4, "fine_region",
              "must be [x0, y0, x1, y1] or empty");
  }
};

/// [fluid.boundaries.NAME]: the condition on a named part of the outer boundary.
struct Boundary {
  std::string type;
  std::vector<std::string> velocity{"0", "0"};
  std::vector<std::string> traction{"0", "0"};
  std::optional<std::string> flow_rate;  ///< into the fluid, a metre of thickness [m²/s]

  static constexpr std::array<std::string_view, 4> types{"no_slip", "velocity", "slip", "traction"};

  /// False where the velocity is free, so that no force of the fluid is to be found.
  bool holds_fluid() const { return type != "traction"; }

  void declare(ParameterVisitor& v) {
    v.choice({"type", "", "no_slip (u = 0), velocity (u given), slip (u·n = 0), traction (σn given; 0: open)",
              true},
             type, types);
    v.formulas({"velocity", "m/s", "formulas of x, y, t, for type = \"velocity\""}, velocity, {2, 2});
    v.formulas({"traction", "Pa", "σn as formulas of x, y, t, for type = \"traction\""}, traction, {2, 2});
    v.formula({"flow_rate", "m²/s",
               "flow into the fluid, a metre of thickness, as a formula of t, for type = \"traction\": the "
               "pressure that it takes is found and comes on top of the traction; none: the traction is all"},
              flow_rate);
    const std::vector<std::string> zero{"0", "0"};
    v.require(type == "velocity" || velocity == zero, "velocity", "goes with type = \"velocity\" only");
    v.require(type == "traction" || traction == zero, "traction", "goes with type = \"traction\" only");
    v.require(type == "traction" || !flow_rate, "flow_rate", "goes with type = \"traction\" only");
  }
};

/// [fluid.newton]
struct Newton {
  double relative_tolerance = 1e-8;  ///< of what is left of the error, against the velocity
  std::int64_t max_iterations = 100;

  void declare(ParameterVisitor& v) {
    v.real({"relative_tolerance", "",
            "Newton ends when the error that is left is estimated below this fraction of the velocity"},
           relative_tolerance, above_up_to(0, 0.1));
    v.integer(
        {"max_iterations", "",
         "corrections (residual and back-solve) before the step is given up; only some have a factor of "
         "their own"},
        max_iterations, between(1, 1000));
  }
};

/// [fluid.embedding]: numerics.md section 1. The defaults suit every scene measured so far.
struct Embedding {
  double arc_ratio = 1.25;       ///< H/h
  double ghost_viscous = 0.1;    ///< γ_u
  double ghost_pressure = 0.02;  ///< γ_p
  double ghost_inertia = 0.1;    ///< γ_m

  void declare(ParameterVisitor& v) {
    v.real({"arc_ratio", "", "H/h: length of a multiplier arc over the local element size"}, arc_ratio,
           between(0.75, 2));
    v.real({"ghost_viscous", "", "γ_u of the ghost penalty on the velocity"}, ghost_viscous, positive());
    v.real({"ghost_pressure", "", "γ_p of the ghost penalty on the pressure"}, ghost_pressure, positive());
    v.real({"ghost_inertia", "", "γ_m of the ghost penalty on the inertia"}, ghost_inertia, positive());
  }
};

/// How the program of a role is started; part of [fluid] and [dem].
struct Launch {
  std::string command;    ///< "" takes our own solver
  bool external = false;  ///< started by hand

  void declare(ParameterVisitor& v) {
    v.text({"command", "", "another program for this role, with its arguments; empty takes ours"}, command);
    v.boolean({"external", "", "the program is started by hand; the coupler prints its address and waits"},
              external);
    v.require(command.empty() || !external, "external", "must not be true where command names a program");
  }
};

/// [fluid]
struct Fluid {
  Launch launch;
  double density = 0;                         ///< ρ [kg/m³]
  std::optional<double> dynamic_viscosity;    ///< μ [Pa s]
  std::optional<double> kinematic_viscosity;  ///< ν [m²/s]
  bool convection = true;
  std::string viscous_form = "symmetric";
  std::string linear_solver = "auto";
  double newmark_gamma = 0.5;                           ///< γ of paper eq. (10)
  std::vector<std::string> body_force{"0", "0"};        ///< ρb [N/m³], besides gravity
  std::vector<std::string> pressure_drop{"0", "0"};     ///< −∇ of the mean pressure [Pa/m]
  std::vector<std::string> superficial_velocity;        ///< [m/s] for which the pressure drop is found
  std::vector<std::string> initial_velocity{"0", "0"};  ///< [m/s]
  Mesh mesh;
  std::map<std::string, Boundary> boundaries;
  Newton newton;
  Embedding embedding;

  static constexpr std::array<std::string_view, 2> viscous_forms{"symmetric", "gradient"};
  static constexpr std::array<std::string_view, 3> linear_solvers{"auto", "umfpack", "mumps"};

  void declare(ParameterVisitor& v) {
    launch.declare(v);
    v.real({"density", "kg/m³", "fluid density ρ", true}, density, positive());
    v.real({"dynamic_viscosity", "Pa s", "μ; either this or kinematic_viscosity"}, dynamic_viscosity,
           positive());
    v.real({"kinematic_viscosity", "m²/s", "ν = μ/ρ; either this or dynamic_viscosity"}, kinematic_viscosity,
           positive());
    v.require(dynamic_viscosity.has_value() != kinematic_viscosity.has_value(), "dynamic_viscosity",
              "must be given, or kinematic_viscosity, and not both");
    v.boolean({"convection", "", "false: Stokes flow; the system is linear"}, convection);
    v.choice(
        {"viscous_form", "",
         "symmetric: 2μ ε(u):ε(w), traction σn at open boundaries; gradient: μ ∇u:∇w, as the DFG references"},
        viscous_form, viscous_forms);
    v.choice(
        {"linear_solver", "",
         "direct solver: umfpack; mumps, where the build has it (libmumps-seq-dev); auto: mumps from 30 000 "
         "unknowns on, where it is the faster one, and in steps in which bodies touch, as it tells the "
         "grains how the fluid resists them; else umfpack"},
        linear_solver, linear_solvers);
    v.real({"newmark_gamma", "",
            "γ of Newmark's method: 0.5 second order, 1 backward Euler; where bodies move, any below 1 means "
            "BDF2"},
           newmark_gamma, between(0.5, 1));
    v.formulas({"body_force", "N/m³", "force density besides gravity, formulas of x, y, t"}, body_force,
               {2, 2});
    v.formulas(
        {"pressure_drop", "Pa/m",
         "by how much the mean pressure falls a metre along periodic axes, formulas of t: a force density "
         "on fluid and bodies alike; the pressure in results is without it"},
        pressure_drop, {2, 2});
    v.formulas(
        {"superficial_velocity", "m/s",
         "mean of the velocity over the rectangle around the mesh, bodies included, as formulas of t: the "
         "fall "
         "of the mean pressure along periodic axes that it takes is found; empty: pressure_drop is given"},
        superficial_velocity, {0, 2});
    v.require(superficial_velocity.size() != 1, "superficial_velocity", "must be two formulas or empty");
    v.formulas({"initial_velocity", "m/s", "velocity at the start, formulas of x, y"}, initial_velocity,
               {2, 2});
    v.table({"mesh", "", "the fixed Eulerian mesh"}, mesh);
    v.named_tables({"boundaries", "",
                    "a table a named boundary; a rectangle has left, right, bottom, top, a Gmsh mesh its "
                    "physical names"},
                   boundaries);
    v.table({"newton", "", "the nonlinear iteration"}, newton);
    v.table({"embedding", "", "bodies in the non-matching mesh"}, embedding);
  }

  double viscosity() const { return dynamic_viscosity ? *dynamic_viscosity : *kinematic_viscosity * density; }
};

}  // namespace fpi::scene
