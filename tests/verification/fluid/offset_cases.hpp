/// Flows around a disc that is placed at random within the mesh: the worst errors that its place makes.
/// Steady flows, each with a mesh or a centre of its own.
#pragma once

#include <random>

#include "stress/fluid_case.hpp"

namespace fpi::fluid::testing {

/// Numbers in [0, 1), the same in every run.
class Places {
 public:
  double operator()() { return uniform_(engine_); }

 private:
  std::mt19937 engine_{7};
  std::uniform_real_distribution<double> uniform_{0, 1};
};

/// The largest sizes of what was noted, by name.
using Worst = std::map<std::string, double>;
inline void note(Worst& worst, const std::string& name, double error) {
  worst[name] = std::max(worst[name], std::abs(error));
}

inline std::string text(const Worst& worst) {
  std::string out;
  for (const auto& [name, error] : worst) out += fmt::format("  {} {:.2e}", name, error);
  return out;
}

inline Interface disc_for(const NavierStokes& solver, const Disc& disc, double turn) {
  return circle(0, disc.centre, disc.radius, solver.arc_length(disc), turn);
}

/// DFG 2D-1 (Schäfer & Turek; paper section 5.1, eqs. 24–26), the cylinder embedded, the inner grid lines
/// moved by up to h along x and y: drag and pressure difference relatively, lift absolutely.
inline Worst dfg_errors(int elements_per_diameter, int n_places) {
  constexpr double drag = 5.57953523384, lift = 0.010618948146, difference = 0.11752016697;
  const double h = 0.1 / elements_per_diameter;
  std::vector<scene::Refinement> refinements(2);
  refinements[0].size = h;  // on the circle
  refinements[0].growth = 0.07;
  refinements[0].centre = {0.2, 0.2};
  refinements[0].radius = 0.05;
  refinements[1].size = 0.02;  // in the wake
  refinements[1].growth = 0.1;
  refinements[1].box = {0.1, 0.1, 0.6, 0.3};
  const Settings s = dfg_2d_1();
  Worst worst;
  Places random;
  for (int k = 0; k < n_places; ++k) {
    const auto moved = [&](double upper, Index cells) {
      std::vector<double> lines = uniform_lines(0, upper, cells);
      const double by = h * random();
      for (std::size_t i = 1; i + 1 < lines.size(); ++i) lines[i] += by;
      return lines;
    };
    const auto x = moved(2.2, 46), y = moved(0.41, 8);
    NavierStokes solver(make_rectangle(x, y, refinements), s);
    const Result result = solve_steady(solver, {disc_for(solver, {{0.2, 0.2}, 0.05}, random())});
    require(result.newton.converged, "place {}: {}", k, result.newton.reason);
    const Vec2 coefficients = 2 / (0.2 * 0.2 * 0.1) * result.tractions[0].force;
    const double pressures = solver.at({0.15, 0.2})->second - solver.at({0.25, 0.2})->second;
    note(worst, "cd", coefficients.x() / drag - 1);
    note(worst, "cl", coefficients.y() - lift);
    note(worst, "dp", pressures / difference - 1);
  }
  std::cout << fmt::format("DFG 2D-1, D/h {}, {} places:{}\n", elements_per_diameter, n_places, text(worst));
  return worst;
}

/// Taylor–Couette flow: a disc r1 = 1 turns with Ω = 1, the outer circle r2 = 2 is given on the sides of a
/// square by the exact solution. Torque −4πμ B, B = Ω r1² r2²/(r2² − r1²); traction −2μB/r1² along the circle
/// and a constant across it; pressure that rises as ρu²/r. Errors of the traction at the arcs' middles and of
/// the pressure beside the disc are relative to the traction.
inline Worst couette_errors(int elements_per_diameter, int n_places) {
  constexpr double r1 = 1, r2 = 2, mu = 0.3, pi = std::numbers::pi;
  constexpr double b = r1 * r1 * r2 * r2 / (r2 * r2 - r1 * r1), a = -r1 * r1 / (r2 * r2 - r1 * r1);
  constexpr double shear = -2 * mu * b / (r1 * r1);
  Worst worst;
  Places random;
  for (int k = 0; k < n_places; ++k) {
    const double h = 2.0 / elements_per_diameter;
    const Vec2 centre(h * random(), h * random());
    const std::string x = fmt::format("(x-{:.17g})", centre.x()), y = fmt::format("(y-{:.17g})", centre.y());
    const std::string factor = fmt::format("({:.17g}+{:.17g}/({}^2+{}^2))", a, b, x, y);
    const auto given = velocity("-" + y + "*" + factor, x + "*" + factor);
    NavierStokes solver(
        square(2 * elements_per_diameter, -2, 2),
        settings(1, mu, {{"left", given}, {"right", given}, {"bottom", given}, {"top", given}}));
    Interface disc = disc_for(solver, {centre, r1}, random());
    disc.rigid.spin = 1;
    const Result result = solve_steady(solver, {disc});
    require(result.newton.converged, "place {}: {}", k, result.newton.reason);
    note(worst, "torque", result.tractions[0].torque / (-4 * pi * mu * b) - 1);

    double level = 0;  // of the pressure, which is free
    std::vector<Vec2> tractions;
    for (Index i = 0; i < disc.n_arcs(); ++i) {
      const Vec2 out = disc.surface.at(0.5 * (disc.start[i] + disc.end[i])) - centre;
      tractions.push_back(result.tractions[0].lambda[i] - shear * Vec2(-out.y(), out.x()));
      level += tractions.back().dot(out) / disc.n_arcs();
    }
    for (Index i = 0; i < disc.n_arcs(); ++i) {
      const Vec2 out = disc.surface.at(0.5 * (disc.start[i] + disc.end[i])) - centre;
      note(worst, "traction", (tractions[i] - level * out).norm() / shear);
    }
    for (int i = 0; i < 100; ++i) {
      const Vec2 beside = Disc{centre, r1 + 1e-9}.at(2 * pi * i / 100);
      note(worst, "pressure", (solver.at(beside)->second + level) / shear);
    }
  }
  std::cout << fmt::format("Taylor-Couette, D/h {}, {} places:{}\n", elements_per_diameter, n_places,
                           text(worst));
  return worst;
}

/// Stokes flow between walls two diameters apart past a disc that slides along over 2h: root mean square of
/// the drag's deviation from its mean, relatively.
inline double sliding_noise(int elements_per_diameter, int n_places) {
  const auto through = velocity("1-y^2", "0");
  auto s = settings(1, 1, {{"left", through}, {"right", through}, {"bottom", no_slip()}, {"top", no_slip()}});
  s.fluid.convection = false;
  const Mesh mesh = make_rectangle(uniform_lines(-4, 4, 8 * elements_per_diameter),
                                   uniform_lines(-1, 1, 2 * elements_per_diameter));
  double sum = 0, squares = 0;
  for (int k = 0; k < n_places; ++k) {
    NavierStokes solver(mesh, s);
    const Disc disc{{2.0 / elements_per_diameter * k / n_places, 0.1}, 0.5};
    const double drag = solve_steady(solver, {disc_for(solver, disc, 0)}).tractions[0].force.x();
    sum += drag;
    squares += drag * drag;
  }
  const double mean = sum / n_places, noise = std::sqrt(squares / n_places - mean * mean) / mean;
  std::cout << fmt::format("sliding disc, D/h {}: drag {:.6f} N/m, noise {:.2e}\n", elements_per_diameter,
                           mean, noise);
  return noise;
}

}  // namespace fpi::fluid::testing
