/// Force noise of cylinders that swing through the mesh (issue: motion; references.md, "Force noise"): a line
/// for each step size, given by how many elements the cylinder crosses in a step at its fastest.
#include <cstdlib>
#include <cstring>

#include "fluid_case.hpp"
#include "march.hpp"

namespace fpi::fluid::testing {
namespace {

constexpr double pi = std::numbers::pi;

/// A cylinder that swings as centre + swing · cos(2π f t), at rest at t = 0.
struct Swing {
  Settings settings;
  std::vector<double> x, y;  ///< grid lines [m]
  double diameter, element;  ///< D and h near it [m]
  Vec2 centre, amplitude;    ///< [m]
  double frequency;          ///< [1/s]
  double swings;             ///< that are looked at, in periods

  double fastest() const { return 2 * pi * frequency * amplitude.norm(); }
  Interface at(double t, const NavierStokes& solver) const {
    const double phase = 2 * pi * frequency * t;
    const Vec2 place = centre + amplitude * std::cos(phase);
    const Disc disc{place, diameter / 2};
    Interface out = circle(0, place, disc.radius, solver.arc_length(disc));
    out.rigid.translation = -2 * pi * frequency * std::sin(phase) * amplitude;
    return out;
  }
};

/// Oscillating cylinder in fluid at rest (Dütsch, Durst, Becker, Lienhart, J. Fluid Mech. 360, 1998): KC = 5,
/// Re = 100, here between walls 8 diameters apart, with D/h = 10.
Swing oscillating() {
  const double h = 0.1, amplitude = 5 / (2 * pi);
  return {settings(1, 0.01, {{"left", open()}, {"right", open()}, {"bottom", slip()}, {"top", slip()}}),
          graded_lines(-6, 6, -1.5, 1.5, h, 1.25, 1),
          graded_lines(-4, 4, -0.8, 0.8, h, 1.25, 1),
          1,
          h,
          {0.013, 0.027},
          {amplitude, 0},
          0.2,
          0.5};
}

/// Cylinder that swings across a stream (von Wahl, Richter, Lehrenfeld): D/h = 10. Its Reynolds number and
/// start were not retrieved; here it is 100, and the stream rises within a second.
Swing across_a_stream() {
  const double h = 0.2;
  return {
      settings(
          1, 0.02,
          {{"left", velocity("1-exp(-2*t)", "0")}, {"right", open()}, {"bottom", slip()}, {"top", slip()}}),
      graded_lines(-10, 10, -6.5, -2, h, 1.2, 1),
      graded_lines(-5, 5, -2, 2, h, 1.2, 1),
      2,
      h,
      {-5, 0},
      {0, 0.5},
      0.2237,
      1.5};
}

/// The first swings, of which a quarter of the time is left out.
bool measure(const Swing& swing, double courant) {
  Settings settings = swing.settings;
  settings.bodies_move = true;
  NavierStokes solver(make_rectangle(swing.x, swing.y), settings);
  const double end = swing.swings / swing.frequency;
  const int steps = static_cast<int>(std::ceil(end * swing.fastest() / (courant * swing.element)));
  const double time_step = end / steps;
  const History history = march(
      solver, [&](double t, const NavierStokes& s) { return std::vector{swing.at(t, s)}; }, time_step, steps);
  const std::vector<Vec2> force = forces(history, 0);
  const Noise found = noise(force, steps / 4);
  double bend = 0;
  for (std::size_t k = steps / 4; k + 1 < force.size(); ++k)
    bend = std::max(bend, (force[k - 1] - 2 * force[k] + force[k + 1]).norm() / found.largest_force);
  std::cout << fmt::format("{:9.4f} {:9.5f} {:6d} {:10.5f} {:10.1e} {:10.1e} {:10.1e} {:8.2f}  {}\n", courant,
                           time_step, force.size(), found.largest_force, found.rms, found.worst, bend,
                           history.corrections, history.failure)
            << std::flush;
  return history.failure.empty();
}

int run(int count, char** words) {
  const std::vector<std::pair<std::string, Swing (*)()>> swings{{"oscillating", oscillating},
                                                                {"stream", across_a_stream}};
  std::vector<std::string> names;
  std::vector<double> courants;
  for (int i = 1; i < count; ++i) {
    if (const double courant = std::atof(words[i]); courant > 0)
      courants.push_back(courant);
    else
      names.emplace_back(words[i]);
  }
  if (courants.empty()) courants = {2, 1, 0.5, 0.25, 0.125, 0.03125};
  bool good = true;
  for (const auto& [name, swing] : swings) {
    if (!names.empty() && std::ranges::find(names, name) == names.end()) continue;
    const Swing what = swing();
    std::cout << fmt::format("{}\n{:>9} {:>9} {:>6} {:>10} {:>10} {:>10} {:>10} {:>8}\n", name, "CFL", "dt/s",
                             "steps", "F_max", "noise rms", "noise max", "2nd diff.", "corr.");
    for (const double courant : courants) good = measure(what, courant) && good;
  }
  return good ? 0 : 1;
}

}  // namespace
}  // namespace fpi::fluid::testing

int main(int count, char** words) { return fpi::fluid::testing::run(count, words); }
