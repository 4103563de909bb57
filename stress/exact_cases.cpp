/// Steady flows that are known exactly, or by symmetry, wherever the body lies in the mesh.
#include "bodies.hpp"
#include "cases.hpp"
#include "fluid_case.hpp"

namespace fpi::fluid::testing {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double coarsest = 4;  ///< D/h

/// Where a body may lie relative to the nodes: anywhere, or as near as round-off to a place that is special
/// for the cut. In elements.
Vec2 offset(Random& random) {
  const Vec2 anywhere(random.between(-0.5, 0.5), random.between(-0.5, 0.5));
  const double near = random.sign() * random.over_decades(1e-15, 1e-2);
  switch (random.below(4)) {
    case 0:
      return {near, 0};  // a node at the centre, nodes on the circle
    case 1:
      return {near, anywhere.y()};  // tangent to upright edges
    case 2:
      return {near, 0.5};  // between nodes
    default:
      return anywhere;
  }
}

/// Elements across the square [−1.5, 1.5]² for a disc of diameter 2, and where it lies.
struct Placement {
  int cells;
  double h;
  Vec2 centre;

  Placement(Random& random, double coarsest_one, double finest_one, Outcome& outcome) {
    cells = 2 * static_cast<int>(std::lround(0.75 * random.over_decades(coarsest_one, finest_one)));
    h = 3.0 / cells;
    const Vec2 shift = offset(random);
    centre = h * shift;
    outcome.parameters["D/h"] = 2 / h;
    outcome.parameters["offset_x/h"] = shift.x();
    outcome.parameters["offset_y/h"] = shift.y();
  }
};

/// One steady solve; ends the case where it fails.
std::vector<BodyTraction> solve(NavierStokes& solver, std::vector<Interface> bodies, Outcome& outcome) {
  const Result result = solve_steady(solver, std::move(bodies));
  outcome.fail_unless(result.newton.converged, result.newton.reason);
  if (result.newton.converged) outcome.condition = std::max(outcome.condition, solver.condition());
  return result.tractions;
}

/// A case that is farther off than any mesh explains has failed.
void set_error(Outcome& outcome, double error, double limit) {
  outcome.error = error;
  outcome.fail_unless(error < limit,
                      fmt::format("it is {:.2g} off what is known; below {:g} was expected", error, limit));
}

std::map<std::string, scene::Boundary> on_all_sides(const scene::Boundary& b) {
  return {{"left", b}, {"right", b}, {"bottom", b}, {"top", b}};
}

/// Taylor–Couette flow outside a disc that spins: u = Ω × x (a + b/r²), at rest at r = 2. Its torque per
/// length is −4πμb.
Outcome couette_flow(const Placement& place, double viscosity, double reynolds, double limit,
                     Outcome outcome) {
  outcome.parameters["Re"] = reynolds;
  outcome.parameters["viscosity"] = viscosity;
  const double omega = reynolds * viscosity, a = -omega / 3, b = omega * 4 / 3;
  const std::string x = fmt::format("(x-({:.17g}))", place.centre.x()),
                    y = fmt::format("(y-({:.17g}))", place.centre.y());
  const std::string factor = fmt::format("({:.17g}+({:.17g})/({}^2+{}^2))", a, b, x, y);
  NavierStokes solver(
      square(place.cells, -1.5, 1.5),
      settings(1, viscosity, on_all_sides(velocity("-" + y + "*" + factor, x + "*" + factor))));
  Interface disc = circle(0, place.centre, 1, solver.arc_length(Disc{place.centre, 1}));
  disc.rigid.spin = omega;
  if (const auto tractions = solve(solver, {disc}, outcome); !tractions.empty())
    set_error(outcome, std::abs(tractions[0].torque / (-4 * pi * viscosity * b) - 1), limit);
  return outcome;
}

/// On meshes of all sizes, spinning either way.
Outcome couette(Random& random, const Effort& effort) {
  Outcome outcome;
  const Placement place(random, coarsest, effort.finest, outcome);
  const double viscosity = random.over_decades(1e-2, 1e2);
  return couette_flow(place, viscosity, random.sign() * random.over_decades(1e-2, 1e2), 0.25, outcome);
}

/// On one mesh in one flow, so that nothing but the cut differs from case to case.
Outcome cuts(Random& random, const Effort&) {
  Outcome outcome;
  const Placement place(random, 8, 8, outcome);
  return couette_flow(place, 1, 1, 1e-3, outcome);
}

/// Stokes flow outside a disc of radius 1 that moves with velocity V along x: a Stokeslet, a dipole and a
/// stream, u = A [e (½ − ln r) + x (e·x)/r² + ½ e/r² − (e·x) x/r⁴] + e (V − A). On r = 1 it is V e; the force
/// per length is −4πμA.
Outcome stokes(Random& random, const Effort& effort) {
  Outcome outcome;
  const Placement place(random, coarsest, effort.finest, outcome);
  const double mu = random.over_decades(1e-2, 1e2), strength = random.sign() * random.over_decades(0.1, 10);
  const double speed = random.between(-2, 2);
  outcome.parameters["viscosity"] = mu;
  outcome.parameters["strength"] = strength;
  outcome.parameters["speed"] = speed;
  const std::string x = fmt::format("(x-({:.17g}))", place.centre.x()),
                    y = fmt::format("(y-({:.17g}))", place.centre.y());
  const std::string r2 = fmt::format("({}^2+{}^2)", x, y);
  const std::string along = fmt::format("{:.17g}*(0.5-0.5*ln({})+{}^2/{}+0.5/{}-{}^2/{}^2)+({:.17g})",
                                        strength, r2, x, r2, r2, x, r2, speed - strength);
  const std::string across = fmt::format("{:.17g}*{}*{}*(1/{}-1/{}^2)", strength, x, y, r2, r2);
  auto s = settings(1, mu, on_all_sides(velocity(along, across)));
  s.fluid.convection = false;
  NavierStokes solver(square(place.cells, -1.5, 1.5), s);
  Interface disc = circle(0, place.centre, 1, solver.arc_length(Disc{place.centre, 1}));
  disc.rigid.translation = {speed, 0};
  if (const auto tractions = solve(solver, {disc}, outcome); !tractions.empty()) {
    const double drag = -4 * pi * mu * strength;
    set_error(outcome, (tractions[0].force - Vec2(drag, 0)).norm() / std::abs(drag), 0.1);
  }
  return outcome;
}

Vec2 mirrored(const Vec2& x) { return {-x.x(), x.y()}; }

/// The same interface seen in a mirror at x = 0.
Interface mirrored(const Interface& body) {
  Interface out;
  out.body = body.body;
  if (const Disc* disc = body.surface.disc()) {
    out.surface = Disc{mirrored(disc->centre), disc->radius};
    for (Index a = body.n_arcs(); a-- > 0;) {
      out.start.push_back(pi - body.end[a]);
      out.end.push_back(pi - body.start[a]);
    }
  } else {
    std::vector<Vec2> vertices;
    for (Index a = body.n_arcs(); a-- > 0;) vertices.push_back(mirrored(body.surface.at(body.start[a])));
    set_edges(out, vertices);
  }
  out.rigid = {mirrored(body.rigid.centre), mirrored(body.rigid.translation), -body.rigid.spin};
  return out;
}

/// Two bodies of any shape that move and spin in a box, and the same in a mirror: the mesh is its own mirror
/// image, so forces are mirrored to round-off.
Outcome mirror(Random& random, const Effort& effort) {
  Outcome outcome;
  const int half = static_cast<int>(std::lround(random.over_decades(coarsest, 0.6 * effort.finest)));
  const double mu = random.over_decades(0.02, 10);
  outcome.parameters["D/h"] = half;
  outcome.parameters["viscosity"] = mu;
  std::vector<MovingBody> pair;
  for (const double side : {-1, 1}) {
    MovingBody body{random_shape(random, 1), {}, random.between(0, 2 * pi), {}, random.between(-2, 2)};
    body.start = {side * random.between(0.55, 0.8), random.between(-0.3, 0.3)};
    body.velocity = {random.between(-0.5, 0.5), random.between(-0.5, 0.5)};
    pair.push_back(body);
  }
  const auto s =
      settings(1, mu, {{"left", no_slip()}, {"right", no_slip()}, {"bottom", no_slip()}, {"top", open()}});
  NavierStokes solver(make_rectangle(uniform_lines(-2, 2, 4 * half), uniform_lines(-1, 1, 2 * half)), s);
  const auto bodies = moving_together(pair, {1e-9})(1e-9, solver);
  const auto tractions = solve(solver, bodies, outcome);
  std::vector<Interface> reflection;
  for (const Interface& body : bodies) reflection.push_back(mirrored(body));
  NavierStokes other(make_rectangle(uniform_lines(-2, 2, 4 * half), uniform_lines(-1, 1, 2 * half)), s);
  const auto seen = solve(other, reflection, outcome);
  if (tractions.empty() || seen.empty()) return outcome;
  double scale = 0, error = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    scale = std::max(scale, tractions[i].force.norm());
    error = std::max({error, (mirrored(tractions[i].force) - seen[i].force).norm(),
                      std::abs(tractions[i].torque + seen[i].torque)});
  }
  set_error(outcome, error / scale, 1e-6);
  return outcome;
}

}  // namespace

std::vector<Family> exact_families() {
  return {{"couette", "a disc that spins, Taylor-Couette flow", 0.15, couette},
          {"cuts", "the same on one mesh, D/h = 8", 0.15, cuts},
          {"stokes", "a disc that moves in Stokes flow", 0.15, stokes},
          {"mirror", "two bodies, and the same in a mirror", 0.08, mirror}};
}

}  // namespace fpi::fluid::testing
