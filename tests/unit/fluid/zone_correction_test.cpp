/// A factor corrected in the zone of the bodies that moved: its zone holds all that differs, and what it
/// solves with converges to what a factor of the matrix itself gives.
#include "fluid/discretisation/zone_correction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "cut_case.hpp"
#include "fluid/discretisation/system.hpp"
#include "fluid/linear/anderson.hpp"

namespace fpi::fluid {
namespace {

/// A square of 32 × 32 cells, open at the right, with discs of 6.4 cells a diameter.
struct Flows {
  static constexpr double radius = 0.2;
  scene::Fluid parameters = [] {
    scene::Fluid fluid;
    fluid.density = 1;
    fluid.dynamic_viscosity = 0.1;
    for (const char* side : {"left", "bottom", "top"}) fluid.boundaries[side].type = "no_slip";
    fluid.boundaries["right"].type = "traction";
    return fluid;
  }();
  Space space{make_rectangle(uniform_lines(-1, 1, 32), uniform_lines(-1, 1, 32)), parameters.boundaries};
  Timers timers;

  static constexpr double inertia = 50;
  TimeTerms time = [this] {
    TimeTerms terms = TimeTerms::steady(space.mesh.n_nodes());
    terms.inertia = inertia;
    return terms;
  }();

  /// Discs that the fluid moves, or that have a given motion; its Jacobian is assembled in a shear flow.
  std::unique_ptr<System> system(const std::vector<Vec2>& places, bool are_free) {
    std::vector<Interface> discs;
    for (const Vec2& place : places) {
      discs.push_back(circle(place, radius, 20));
      discs.back().body = static_cast<Index>(discs.size());
      if (are_free) discs.back().balance = Balance{2, 0.1, {0.3, -1}, 0.2};
    }
    auto system = std::make_unique<System>(space, parameters, discs, CutMesh{}, timers);
    const auto [u, p, lambda, rigid, drive] = system->no_residual();
    Fields fields{u, p, lambda, rigid, drive};
    for (Index node = 0; node < space.mesh.n_nodes(); ++node)
      fields.u[2 * node] = 1 - std::pow(space.mesh.node_position(node).y(), 2);
    system->assemble({1, 0.1, 1, true}, fields, time, true);
    return system;
  }

  std::shared_ptr<const Background> reference(System& system) {
    return std::make_shared<Background>(system.factor_of_matrix(timers), layout(system));
  }
  Layout layout(const System& system) const {
    return {system.interfaces(), system.cut(), system.numbering(), time.mesh_velocity, inertia};
  }
};

Vector random_vector(Eigen::Index n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-1, 1);
  return Vector::NullaryExpr(n, [&](Eigen::Index) { return value(random); });
}

/// Corrections, mixed as Newton's iteration does, until the error in the velocities is a part 1e-8 of what it
/// was.
int corrections(const System& system, const Factor& corrected, const Factor& own) {
  const auto a = system.matrix().view();
  const Vector b = random_vector(a.rows(), 5), exact = own.solve(b), weight = system.velocity_weight();
  const auto error = [&](const Vector& x) { return weight.cwiseProduct(x - exact).norm(); };
  Anderson anderson;
  Vector x = Vector::Zero(a.rows());
  const double first = error(x);
  int n = 0;
  for (; n < 30 && error(x) > 1e-8 * first; ++n) x += anderson.step(corrected.solve(b - a * x), weight);
  return n;
}

TEST(ZoneCorrection, converges_as_fast_however_far_a_body_went) {
  for (const bool is_free : {false, true}) {
    Flows flows;
    const auto before = flows.system({{-0.4, 0.3}, {0.5, -0.4}}, is_free);
    const auto reference = flows.reference(*before);
    for (const double distance : {0.01, 0.1, 0.4}) {
      const auto after = flows.system({{-0.4 + distance, 0.3 - 0.5 * distance}, {0.5, -0.4}}, is_free);
      const auto corrected =
          with_zone_correction(reference, flows.space.mesh, flows.layout(*after), after->matrix(), "auto");
      ASSERT_TRUE(corrected) << distance;
      EXPECT_LE(corrections(*after, *corrected, *after->factor_of_matrix(flows.timers)), 10) << distance;
    }
  }
}

TEST(ZoneCorrection, solves_with_the_transposed_too) {
  Flows flows;
  const auto before = flows.system({{-0.4, 0.3}}, true), after = flows.system({{-0.3, 0.2}}, true);
  const auto corrected = with_zone_correction(flows.reference(*before), flows.space.mesh,
                                              flows.layout(*after), after->matrix(), "auto");
  ASSERT_TRUE(corrected);
  const Vector b = random_vector(after->matrix().n(), 1), c = random_vector(after->matrix().n(), 2);
  const double one = c.dot(corrected->solve(b)), other = b.dot(corrected->solve_transposed(c));
  EXPECT_NEAR(one, other, 1e-9 * std::abs(one));
}

/// Expects all rows outside the zone to be the same to this part.
void expect_zone_holds_what_differs(const Layout& from, const System& before, const Layout& to,
                                    const System& after, double part) {
  const std::vector<Index> shared = shared_equations(from, to),
                           zone = changed_zone(after.space().mesh, from, to, 2);
  EXPECT_TRUE(std::ranges::is_sorted(zone));
  EXPECT_FALSE(zone.empty());
  EXPECT_LT(zone.size(), 0.4 * after.matrix().n());
  const Eigen::SparseMatrix<double, Eigen::RowMajor> a = before.matrix().view(), b = after.matrix().view();
  for (Index row = 0; row < b.rows(); ++row) {
    if (std::ranges::binary_search(zone, row)) continue;
    ASSERT_GE(shared[row], 0);
    Vector mapped = Vector::Zero(a.cols());
    for (decltype(b)::InnerIterator entry(b, row); entry; ++entry) {
      if (entry.value() == 0) continue;
      ASSERT_GE(shared[entry.col()], 0);
      mapped[shared[entry.col()]] = entry.value();
    }
    EXPECT_LE((Vector(a.row(shared[row])) - mapped).lpNorm<Eigen::Infinity>(),
              part * mapped.lpNorm<Eigen::Infinity>())
        << row;
  }
}

TEST(ZoneCorrection, its_zone_holds_every_row_that_differs) {
  Flows flows;
  const auto before = flows.system({{-0.4, 0.3}, {0.5, -0.4}}, true),
             after = flows.system({{-0.3, 0.2}, {0.5, -0.4}}, true);
  expect_zone_holds_what_differs(flows.layout(*before), *before, flows.layout(*after), *after, 1e-12);
}

TEST(ZoneCorrection, its_zone_holds_what_a_body_that_begins_to_creep_changes) {
  Flows flows;
  const std::vector<Vec2> places{{-0.4, 0.3}, {0.5, -0.4}};
  const auto before = flows.system(places, true);
  const Layout from = flows.layout(*before);
  flows.time.mesh_velocity = Vector::Zero(2 * flows.space.mesh.n_nodes());
  for (Index node = 0; node < flows.space.mesh.n_nodes(); ++node)
    if (flows.space.mesh.node_position(node).x() < 0) flows.time.mesh_velocity[2 * node] = 1e-9;
  const auto after = flows.system(places, true);
  expect_zone_holds_what_differs(from, *before, flows.layout(*after), *after, 1e-6);
}

TEST(ZoneCorrection, goes_on_without_a_body_that_left) {
  Flows flows;
  const auto before = flows.system({{-0.4, 0.3}, {0.5, -0.4}}, false),
             after = flows.system({{-0.4, 0.3}}, false);
  const auto corrected = with_zone_correction(flows.reference(*before), flows.space.mesh,
                                              flows.layout(*after), after->matrix(), "auto");
  ASSERT_TRUE(corrected);
  EXPECT_LE(corrections(*after, *corrected, *after->factor_of_matrix(flows.timers)), 10);
}

TEST(ZoneCorrection, is_declined_where_nearly_all_moved_or_the_pressure_is_given_elsewhere) {
  Flows flows;
  std::vector<Vec2> places{{-0.6, -0.6}, {0, -0.6},   {0.6, -0.6}, {-0.6, 0},
                           {0.6, 0},     {-0.6, 0.6}, {0.6, 0.6}};
  const auto before = flows.system(places, false);
  for (Vec2& place : places) place += Vec2(0.02, 0.01);
  const auto after = flows.system(places, false);
  const auto reference = flows.reference(*before);
  EXPECT_FALSE(
      with_zone_correction(reference, flows.space.mesh, flows.layout(*after), after->matrix(), "auto"));

  Layout elsewhere = flows.layout(*flows.system({{-0.4, 0.3}}, false));
  const auto one = flows.system({{-0.4, 0.3}}, false), moved = flows.system({{-0.3, 0.3}}, false);
  elsewhere.numbering.pinned.push_back(3);
  const auto pinned = std::make_shared<Background>(one->factor_of_matrix(flows.timers), elsewhere);
  EXPECT_FALSE(with_zone_correction(pinned, flows.space.mesh, flows.layout(*moved), moved->matrix(), "auto"));
}

}  // namespace
}  // namespace fpi::fluid
