#include "fluid/discretisation/boundary.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/error.hpp"
#include "fluid/mesh/rectangle.hpp"

namespace fpi::fluid {
namespace {

const Mesh mesh = make_rectangle(uniform_lines(0, 2, 4), uniform_lines(0, 1, 4));

scene::Boundary condition(const std::string& type, std::vector<std::string> values = {"0", "0"}) {
  scene::Boundary b;
  b.type = type;
  (type == "traction" ? b.traction : b.velocity) = std::move(values);
  return b;
}

TEST(Boundary, velocities_are_imposed_and_no_slip_goes_first_in_corners) {
  const Boundary boundary(mesh, {{"left", condition("velocity", {"1 + t", "y"})},
                                 {"right", condition("traction")},
                                 {"bottom", condition("no_slip")},
                                 {"top", condition("slip")}});
  Vector u = Vector::Constant(2 * mesh.n_nodes(), 7);
  boundary.impose(2, u);
  for (Index n = 0; n < mesh.n_nodes(); ++n) {
    const Vec2 x = mesh.node_position(n), value = u.segment<2>(2 * n);
    if (x.y() == 0)
      EXPECT_EQ(value, Vec2(0, 0));
    else if (x.x() == 0)
      EXPECT_EQ(value, Vec2(3, x.y()));
    else if (x.y() == 1)
      EXPECT_EQ(value, Vec2(7, 0));
    else
      EXPECT_EQ(value, Vec2(7, 7));
  }
}

TEST(Boundary, a_node_between_two_slip_sides_is_held) {
  const Boundary boundary(mesh, {{"left", condition("slip")},
                                 {"right", condition("slip")},
                                 {"bottom", condition("slip")},
                                 {"top", condition("slip")}});
  EXPECT_EQ(boundary.constraint(0), Constraint::both);
  EXPECT_EQ(boundary.constraint(1), Constraint::normal);
}

TEST(Boundary, tractions_add_up_to_their_integral) {
  const Boundary boundary(mesh, {{"left", condition("no_slip")},
                                 {"right", condition("traction", {"3*y^2", "t"})},
                                 {"bottom", condition("no_slip")},
                                 {"top", condition("no_slip")}});
  Vector load = Vector::Zero(2 * mesh.n_nodes());
  boundary.add_tractions(5, {}, load);
  double x = 0, y = 0;
  for (Index n = 0; n < mesh.n_nodes(); ++n) {
    x += load[2 * n];
    y += load[2 * n + 1];
  }
  EXPECT_NEAR(x, 1, 1e-14);
  EXPECT_NEAR(y, 5, 1e-13);
}

TEST(Boundary, a_missing_or_unknown_name_is_refused_with_a_hint) {
  try {
    Boundary(mesh, {{"left", condition("no_slip")}, {"rigth", condition("no_slip")}});
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("did you mean right"), std::string::npos) << e.what();
  }
  EXPECT_THROW(Boundary(mesh, {{"left", condition("no_slip")}}), Error);
}

}  // namespace
}  // namespace fpi::fluid
