/// The system of equations: its unknowns, and its matrix as the derivative of its residual.
#include "fluid/discretisation/system.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "cut_case.hpp"

namespace fpi::fluid {
namespace {

/// A square [-1, 1]² with a disc that the fluid moves and one that is held; `right` is the type of that side.
struct Setting {
  scene::Fluid parameters;
  std::unique_ptr<Space> space;
  std::unique_ptr<System> system;
  Timers timers;

  explicit Setting(const std::string& right, const std::string& level = "no_slip", bool with_discs = true) {
    parameters.density = 2;
    parameters.dynamic_viscosity = 0.1;
    parameters.boundaries["left"].type = parameters.boundaries["right"].type = right;
    parameters.boundaries["bottom"].type = parameters.boundaries["top"].type = level;
    space = std::make_unique<Space>(make_rectangle(uniform_lines(-1, 1, 10), uniform_lines(-1, 1, 10)),
                                    parameters.boundaries);
    std::vector<Interface> discs;
    if (with_discs) {
      discs = {circle({-0.4, 0.1}, 0.27, 16), circle({0.45, -0.2}, 0.23, 16)};
      discs[0].balance = Balance{3, 0.2, {0.3, -1}, 0.2};
      discs[1].body = 1;
    }
    system = std::make_unique<System>(*space, parameters, discs, CutMesh{}, timers);
  }

  /// Any fields at all, every component of them.
  Fields fields(unsigned seed) const {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-1, 1);
    auto [u, p, lambda, rigid, drive] = system->no_residual();
    for (Vector* part : {&u, &p, &lambda, &rigid, &drive})
      for (double& value : *part) value = number(random);
    return {u, p, lambda, rigid, drive};
  }
};

/// All equations that are named, in order.
std::vector<Index> named(const Numbering& numbering) {
  std::vector<Index> all;
  for (const auto* of : {&numbering.velocity, &numbering.pressure, &numbering.multiplier, &numbering.rigid})
    std::ranges::copy_if(*of, std::back_inserter(all), [](Index equation) { return equation >= 0; });
  std::ranges::sort(all);
  return all;
}

TEST(Numbering, names_every_equation_once_and_clusters_hold_all_of_them) {
  const Setting setting("traction");
  const Numbering& numbering = setting.system->numbering();
  std::vector<Index> all(numbering.n_equations);
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(named(numbering), all);
  Index end = 0;
  for (const Cluster& cluster : numbering.clusters) {
    EXPECT_EQ(cluster.first, end);
    EXPECT_GT(cluster.end, cluster.first);
    end = cluster.end;
  }
  EXPECT_EQ(end, numbering.n_equations);
}

TEST(Numbering, leaves_out_what_is_inside_bodies_or_given_and_has_bodies_that_the_fluid_moves) {
  const Setting setting("traction");
  const Numbering& numbering = setting.system->numbering();
  const Mesh& mesh = setting.space->mesh;
  int solid = 0;
  for (Index node = 0; node < mesh.n_nodes(); ++node) {
    const Vec2 x = mesh.node_position(node);
    const bool is_deep = (x - Vec2(-0.4, 0.1)).norm() < 0.04;
    const bool is_given = std::abs(x.y()) == 1;
    const bool is_active = numbering.node_is_active[node] != 0;
    EXPECT_FALSE(is_deep && is_active);
    EXPECT_EQ(numbering.velocity[2 * node] >= 0, is_active && !is_given);
    EXPECT_EQ(numbering.velocity[2 * node + 1] >= 0, is_active && !is_given);
    solid += is_deep;
  }
  EXPECT_GT(solid, 0);
  ASSERT_EQ(numbering.rigid.size(), 6u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_GE(numbering.rigid[i], 0);       // free
    EXPECT_EQ(numbering.rigid[3 + i], -1);  // held
  }
}

TEST(Numbering, pins_one_pressure_where_no_side_is_open_and_none_else) {
  EXPECT_EQ(Setting("no_slip").system->numbering().pinned.size(), 1u);
  EXPECT_EQ(Setting("traction").system->numbering().pinned.size(), 0u);
}

TEST(Numbering, a_flow_between_slip_walls_is_not_held_along_them) {
  const Setting held("traction"), slips("traction", "slip", false);
  EXPECT_FALSE(unheld_direction(held.space->boundary, held.system->numbering()));
  const auto direction = unheld_direction(slips.space->boundary, slips.system->numbering());
  ASSERT_TRUE(direction);
  EXPECT_NEAR(std::abs(direction->x()), 1, 1e-14);
}

/// The residual is a quadratic function of the unknowns, so that central differences have no error of their
/// own.
TEST(System, its_matrix_is_the_derivative_of_its_residual) {
  for (const bool symmetric : {true, false}) {
    for (const double convection : {0.0, 1.0}) {
      Setting setting("traction");
      System& system = *setting.system;
      const Flow flow{2, 0.1, convection, symmetric};
      TimeTerms time = TimeTerms::steady(setting.space->mesh.n_nodes());
      time.inertia = 7;
      Fields fields = setting.fields(1);
      system.assemble(flow, fields, time, true);
      std::mt19937 random(2);
      std::uniform_real_distribution<double> number(-1, 1);
      const Vector along = Vector::NullaryExpr(system.n_unknowns(), [&] { return number(random); });
      const Vector expected = system.matrix().view() * along;
      system.add(along, 0.5, fields);
      const Vector ahead = system.gather(system.assemble(flow, fields, time, false));
      system.add(along, -1, fields);
      const Vector behind = system.gather(system.assemble(flow, fields, time, false));
      EXPECT_LT((ahead - behind - expected).norm(), 1e-11 * expected.norm())
          << "symmetric " << symmetric << ", convection " << convection;
    }
  }
}

TEST(System, what_is_added_to_the_unknowns_is_gathered_from_the_fields) {
  const Setting setting("traction");
  const System& system = *setting.system;
  auto [u, p, lambda, rigid, drive] = system.no_residual();
  Fields fields{u, p, lambda, rigid, drive};
  const Vector update = Vector::LinSpaced(system.n_unknowns(), 1, 2);
  system.add(update, 1, fields);
  EXPECT_EQ(system.gather({fields.u, fields.p, fields.lambda, fields.rigid, fields.drive}), update);
}

}  // namespace
}  // namespace fpi::fluid
