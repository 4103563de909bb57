/// What the fluid resolves of a narrow gap, and what the law of films adds to it: Stokes flow around discs
/// of radius 1 with prescribed velocities, against the theory of the whole gap.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "dem/lubrication/lubrication_law.hpp"
#include "stress/fluid_case.hpp"

namespace fpi {
namespace {

using namespace fluid;
using namespace fluid::testing;
constexpr double pi = std::numbers::pi;

/// Distances from a place to beyond `farthest`, in steps of `finest` within `narrow`, h within `core`,
/// growing away from both.
std::vector<double> distances(double farthest, double finest, double narrow, double h, double core) {
  std::vector<double> out;
  for (double d = 0; d < farthest; out.push_back(d)) {
    const double near = finest + 0.25 * std::max(0.0, d - narrow);
    d += std::min(near, h + 0.25 * std::max(0.0, d - core));
  }
  return out;
}

/// Lines at these distances on both sides of the middle.
std::vector<double> lines_around(double middle, std::vector<double> distance, double farthest) {
  distance.back() = farthest;
  std::vector<double> lines{middle};
  for (const double d : distance) lines.insert(lines.end(), {middle - d, middle + d});
  std::ranges::sort(lines);
  return lines;
}

constexpr double arc_ratio = scene::Embedding{}.arc_ratio;

/// A disc of radius 1 whose arcs suit elements that are `finest` at its bottom and grow to h.
Interface disc(Index body, const Vec2& centre, double finest, double narrow, double h, const Vec2& velocity,
               double spin) {
  Interface out;
  out.body = body;
  out.surface = Disc{centre, 1};
  out.rigid = {centre, velocity, spin};
  std::vector<double> angle = distances(pi, arc_ratio * finest, narrow, arc_ratio * h, pi);
  const double last = angle.back();
  for (double& a : angle) a *= pi / last;
  const std::vector<double> ends = lines_around(-0.5 * pi + 0.3 * body * h, angle, pi);
  out.start.assign(ends.begin(), std::prev(ends.end()));
  out.end.assign(std::next(ends.begin()), ends.end());
  return out;
}

BodyTraction first_traction(Mesh mesh, const std::vector<Interface>& discs) {
  Settings s =
      settings(1, 1, {{"left", no_slip()}, {"right", no_slip()}, {"bottom", no_slip()}, {"top", no_slip()}});
  s.fluid.convection = false;
  NavierStokes solver(std::move(mesh), s);
  const Result result = solve_steady(solver, discs);
  EXPECT_TRUE(result.newton.converged) << result.newton.reason;
  return result.tractions[0];
}

/// A disc over the bottom of a box, mesh size h, `finest` near the gap.
BodyTraction over_wall(double gap, double h, double finest, const Vec2& velocity) {
  const double narrow = 3 * std::sqrt(gap);
  std::vector<double> y = lines_around(0, distances(16, finest, gap + 0.5 * narrow * narrow, h, 2.5), 16);
  y.erase(y.begin(), std::ranges::lower_bound(y, 0.0));
  return first_traction(make_rectangle(lines_around(0.137 * h, distances(8, finest, narrow, h, 1.5), 8), y),
                        {disc(0, {0, 1 + gap}, finest, narrow, h, velocity, 0)});
}

/// Two discs one above the other, approaching with speed 1, or with given spins.
BodyTraction two_discs(double gap, double h, double speed, double spin, double other_spin) {
  const double y = 0.231 * h;
  return first_traction(make_rectangle(lines_around(0.137 * h, distances(8, h, 0, h, 1.5), 8),
                                       lines_around(0, distances(9, h, 0, h, 2.5), 9)),
                        {disc(0, {0, y - 1 - gap / 2}, h, 0, h, {0, 0.5 * speed}, spin),
                         disc(1, {0, y + 1 + gap / 2}, h, 0, h, {0, -0.5 * speed}, other_spin)});
}

const dem::GapShape wall_gap = dem::gap_shape(1, std::numeric_limits<double>::infinity());
const dem::GapShape disc_gap = dem::gap_shape(1, 1);

TEST(Lubrication, of_a_disc_at_a_wall_is_what_the_fluid_finds_with_ten_times_finer_elements) {
  const double h = 0.25;
  for (const double gap : {0.25 * h, 0.5 * h}) {
    const double force = over_wall(gap, h, h / 10, {0, -1}).force.y();
    const double alpha = std::acosh(1 + gap);
    EXPECT_NEAR(force / (4 * pi / (alpha - std::tanh(alpha))), 1, 1e-3) << gap;
    EXPECT_NEAR(force / dem::disc_film(1, wall_gap, gap).normal, 1, 2e-3) << gap;
  }
}

TEST(Lubrication, of_fluid_and_law_together_is_the_theory_within_6_percent_from_2h_to_h_over_100) {
  for (const double h : {0.25, 0.125})
    for (const double part : {2.0, 1.0, 0.7, 0.5, 0.25, 0.1, 0.03, 0.01}) {
      const double gap = part * h;
      const double wall = over_wall(gap, h, h, {0, -1}).force.y();
      const double law = dem::unresolved(dem::disc_film, 1, wall_gap, gap, h).normal;
      const double theory = dem::disc_film(1, wall_gap, gap).normal;
      const double pair = -two_discs(gap, h, 1, 0, 0).force.y();
      const double pair_law = dem::unresolved(dem::disc_film, 1, disc_gap, gap, h).normal;
      const double pair_theory = dem::disc_film(1, disc_gap, gap).normal;
      std::cout << fmt::format(
          "D/h {:2} gap/h {:.2f}: wall fluid {:.3f} law {:.3f} together {:.3f}; discs {:.3f} {:.3f} {:.3f}\n",
          2 / h, part, wall / theory, law / theory, (wall + law) / theory, pair / pair_theory,
          pair_law / pair_theory, (pair + pair_law) / pair_theory);
      EXPECT_NEAR((wall + law) / theory, 1, 0.06) << part;
      EXPECT_NEAR((pair + pair_law) / pair_theory, 1, 0.06) << part;
    }
}

/// Along the surfaces the theory leaves a constant open, which the outer flow decides: the change from a gap
/// of h is what it says.
TEST(Lubrication, along_the_surfaces_changes_with_the_gap_as_the_theory_says) {
  const double h = 0.125;
  const auto together = [&](double gap, double spin, double other_spin) {
    const dem::Resistance law = dem::unresolved(dem::disc_film, 1, disc_gap, gap, h);
    return -two_discs(gap, h, 0, spin, other_spin).torque + law.sliding * (spin + other_spin) +
           law.rolling * (spin - other_spin);
  };
  const auto theory = [&](double gap, double spin, double other_spin) {
    const dem::Resistance film = dem::disc_film(1, disc_gap, gap);
    return film.sliding * (spin + other_spin) + film.rolling * (spin - other_spin);
  };
  for (const double other : {1.0, -1.0}) {
    const double open = together(h, 1, other) - theory(h, 1, other);
    for (const double part : {0.5, 0.25, 0.1, 0.03, 0.01}) {
      const double found = together(part * h, 1, other), wanted = theory(part * h, 1, other) + open;
      std::cout << fmt::format("{} gap/h {:.2f}: torque {:.3f} of theory\n",
                               other > 0 ? "sliding" : "rolling", part, found / wanted);
      EXPECT_NEAR(found / wanted, 1, 0.1) << part;
    }
  }
}

}  // namespace
}  // namespace fpi
