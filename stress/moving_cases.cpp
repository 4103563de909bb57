/// Bodies that move for some steps from rest: through the mesh, past and towards one another, along and out
/// of walls. Speeds, times and sizes are in units of the first body's diameter and fastest point.
#include <algorithm>

#include "bodies.hpp"
#include "cases.hpp"
#include "fluid_case.hpp"

namespace fpi::fluid::testing {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double coarsest = 4;  ///< D/h
constexpr int rising_steps = 6;

/// What all these cases draw: the mesh's size, the fluid and the walls.
struct Setting {
  double h, reynolds;
  Settings settings;

  Setting(Random& random, const Effort& effort, Outcome& outcome) {
    h = 1 / random.over_decades(coarsest, effort.finest);
    reynolds = random.over_decades(1e-2, 300);
    settings =
        testing::settings(1, 1 / reynolds, {{"left", no_slip()}, {"bottom", no_slip()}, {"top", no_slip()}});
    const bool closed = random.below(2) == 0;
    settings.fluid.boundaries["right"] = closed ? no_slip() : open();
    settings.bodies_move = true;
    outcome.parameters["D/h"] = 1 / h;
    outcome.parameters["Re"] = reynolds;
    outcome.parameters["closed"] = closed;
  }
};

/// A rectangle, fine where bodies come.
Mesh mesh_around(const Vec2& lower, const Vec2& upper, const Vec2& fine_lower, const Vec2& fine_upper,
                 double h) {
  constexpr double growth = 1.35;
  const Vec2 a = fine_lower - Vec2::Constant(2 * h), b = fine_upper + Vec2::Constant(2 * h);
  return make_rectangle(graded_lines(lower.x(), upper.x(), a.x(), b.x(), h, growth, 0.5),
                        graded_lines(lower.y(), upper.y(), a.y(), b.y(), h, growth, 0.5));
}

/// A generous multiple of what speeds of 1 at lengths of 1 can do: viscous and inertial drag, the added mass
/// of the start, and what squeezing through a gap of a quarter of h adds (references.md, "Lubrication").
Bounds bounds(const Setting& setting, double time_step, bool has_gaps) {
  const double resolved = setting.h / 4;
  const double squeeze = has_gaps ? std::pow(0.5 / resolved, 1.5) : 1;
  return {10 * (has_gaps ? 0.5 / resolved : 1),
          20 * (1 + 15 / setting.reynolds * squeeze + 1 / (rising_steps * time_step))};
}

Outcome run(Outcome outcome, const Setting& setting, Mesh mesh, const std::vector<MovingBody>& bodies,
            double time_step, int steps, bool has_gaps = true) {
  NavierStokes solver(std::move(mesh), setting.settings);
  const History history = march(solver, moving_together(bodies, {rising_steps * time_step}), time_step, steps,
                                bounds(setting, time_step, has_gaps));
  outcome.failure = history.failure;
  outcome.refused = history.refused;
  outcome.parameters["corrections"] = history.corrections;
  if (history.loads.empty()) return outcome;
  outcome.condition = solver.condition();
  for (std::size_t body = 0; body < bodies.size() && outcome.failure.empty(); ++body)
    outcome.noise = std::max(outcome.noise, noise(forces(history, body), rising_steps + 3).worst);
  return outcome;
}

/// Velocity and spin of a body of diameter 1 whose fastest point has speed 1.
void set_going(MovingBody& body, Random& random, double direction) {
  const double spin = random.below(2) == 0 ? 0 : random.between(-1, 1);
  body.velocity = (1 - std::abs(spin)) * Vec2(std::cos(direction), std::sin(direction));
  body.spin = 2 * spin;
}

/// One body that crosses many elements a step, or few.
Outcome slide(Random& random, const Effort& effort) {
  Outcome outcome;
  const Setting setting(random, effort, outcome);
  const double courant = random.below(3) == 0 ? random.over_decades(0.01, 0.1) : random.over_decades(0.1, 2);
  const double time_step = courant * setting.h, way = effort.steps * time_step;
  outcome.parameters["CFL"] = courant;
  MovingBody body{random_shape(random, 1), {}, random.between(0, 2 * pi), {}, 0};
  set_going(body, random, random.between(-0.3, 0.3));
  body.start = Vec2(-0.5 * way, 0) + setting.h * Vec2(random.between(-0.5, 0.5), random.between(-0.5, 0.5));
  outcome.parameters["corners"] = static_cast<double>(body.shape.corners.size());
  outcome.parameters["spin"] = body.spin;
  const Vec2 reach(0.5 * way + 0.5, 0.5 + 0.15 * way);
  return run(outcome, setting,
             mesh_around(-reach - Vec2(1.5, 1.5), reach + Vec2(1.5, 1.5), -reach, reach, setting.h), {body},
             time_step, effort.steps, false);
}

/// The least distance of a polygon's corners, or of points of a circle, from a surface; below 0 they
/// overlap.
double gap(const Surface& a, const Surface& b) {
  constexpr int points = 400;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < points; ++i) {
    least = std::min(least, b.distance(a.at(a.period() * i / points)));
    least = std::min(least, a.distance(b.at(b.period() * i / points)));
  }
  return least;
}

Surface outline_of(const MovingBody& body) {
  if (body.shape.corners.empty()) return Disc{body.start, body.shape.diameter / 2};
  return polygon(body.start, body.shape.corners, body.shape.diameter, body.angle).surface;
}

/// Moves `body` along x until its gap to the other is the one wanted.
void put_beside(MovingBody& body, const MovingBody& other, double wanted) {
  double near = other.start.x(), far = other.start.x() + 2;
  for (int halving = 0; halving < 50; ++halving) {
    body.start.x() = 0.5 * (near + far);
    (gap(outline_of(body), outline_of(other)) < wanted ? near : far) = body.start.x();
  }
}

double random_gap(Random& random) {
  const std::vector<double> gaps{2, 1, 0.5, 0.1, 1e-3, 0, -0.02};  // in h
  return gaps[random.below(gaps.size())];
}

/// Two bodies close to each other: one approaches, leaves, or slides past the other.
Outcome pair(Random& random, const Effort& effort) {
  Outcome outcome;
  const Setting setting(random, effort, outcome);
  const double h = setting.h, smaller = random.between(0.5, 1);
  MovingBody still{random_shape(random, 1), {}, random.between(0, 2 * pi), {}, 0};
  MovingBody other{random_shape(random, smaller), {}, random.between(0, 2 * pi), {}, 0};
  still.start = h * Vec2(random.between(-0.5, 0.5), random.between(-0.5, 0.5)) - Vec2(0.5, 0);
  other.start.y() = still.start.y() + random.between(-0.2, 0.2);
  const double wanted = h * random_gap(random), courant = random.over_decades(0.05, 0.5);
  put_beside(other, still, wanted);
  const double time_step = courant * h, way = effort.steps * time_step;
  const std::size_t manner = random.below(3);
  if (manner == 0) other.start.x() += way;  // so that the gap is the wanted one at the end, or a little more
  const Vec2 direction = manner == 0 ? Vec2(-1, 0) : manner == 1 ? Vec2(1, 0) : Vec2(0, 1);
  other.velocity = direction;
  still.spin = random.below(2) == 0 && still.shape.corners.empty() ? 2 * random.sign() : 0;
  outcome.parameters["gap/h"] = wanted / h;
  outcome.parameters["manner"] = static_cast<double>(manner);
  outcome.parameters["CFL"] = courant;
  const Vec2 lower(-1.1, -0.6),
      upper(other.start.x() + 0.5 + (manner == 1 ? way : 0), 0.6 + (manner == 2 ? way : 0));
  return run(outcome, setting, mesh_around(Vec2(-2, -2), Vec2(3, 2).cwiseMax(upper), lower, upper, h),
             {still, other}, time_step, effort.steps);
}

/// A body beside, in or through the lower wall or the right end.
Outcome wall(Random& random, const Effort& effort) {
  Outcome outcome;
  const Setting setting(random, effort, outcome);
  const double h = setting.h, courant = random.over_decades(0.05, 1), time_step = courant * h;
  const double way = effort.steps * time_step;
  const bool leaves =
      random.below(3) == 0 && setting.settings.fluid.boundaries.at("right").type == "traction";
  MovingBody body{random_shape(random, 1), {}, random.between(0, 2 * pi), {}, 0};
  const double wanted = leaves ? 0 : h * random_gap(random);
  body.start.y() = leaves ? 1.5 + h * random.between(-0.5, 0.5) : wanted - outline_of(body).lower().y();
  if (leaves) body.start.x() = 1 + random.between(-0.5, 0.5);
  body.velocity = {1, 0};
  outcome.parameters["gap/h"] = wanted / h;
  outcome.parameters["leaves"] = leaves;
  outcome.parameters["CFL"] = courant;
  const Vec2 lower(body.start.x() - 0.5, leaves ? 1 : 0), upper(body.start.x() + 0.5 + way, leaves ? 2 : 1.1);
  const double end = leaves ? 1.5 : upper.x() + 1.5;
  return run(outcome, setting, mesh_around({-2, 0}, {end, 3}, lower, upper.cwiseMin(Vec2(end, 3)), h), {body},
             time_step, effort.steps);
}

/// Some bodies anywhere, touching and overlapping a little, each with its own motion.
Outcome crowd(Random& random, const Effort& effort) {
  Outcome outcome;
  const Setting setting(random, effort, outcome);
  const double h = std::max(setting.h, 1 / 12.0), courant = random.over_decades(0.05, 0.5);
  std::vector<MovingBody> bodies;
  const std::size_t wanted = 3 + random.below(4);
  for (int attempt = 0; attempt < 200 && bodies.size() < wanted; ++attempt) {
    MovingBody body{random_shape(random, random.between(0.6, 1)), {}, random.between(0, 2 * pi), {}, 0};
    body.start = {random.between(-1.3, 1.3), random.between(-1.3, 1.3)};
    set_going(body, random, random.between(0, 2 * pi));
    const auto overlaps = [&](const MovingBody& other) {
      return gap(outline_of(body), outline_of(other)) < -0.02 * body.shape.diameter;
    };
    if (std::ranges::none_of(bodies, overlaps)) bodies.push_back(body);
  }
  outcome.parameters["D/h"] = 1 / h;
  outcome.parameters["bodies"] = static_cast<double>(bodies.size());
  outcome.parameters["CFL"] = courant;
  return run(outcome, setting, mesh_around({-2, -2}, {2, 2}, {-2, -2}, {2, 2}, h), bodies, courant * h,
             effort.steps);
}

}  // namespace

std::vector<Family> moving_families() {
  return {{"slide", "a body that crosses the mesh", 0.24, slide},
          {"pair", "two bodies that meet, part or pass", 0.12, pair},
          {"wall", "a body along, in or out of a side", 0.08, wall},
          {"crowd", "bodies that touch and overlap", 0.05, crowd}};
}

}  // namespace fpi::fluid::testing
