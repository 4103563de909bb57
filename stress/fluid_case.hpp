/// What the verification cases share: a flow set up in a few lines, error norms, and the fit of an order.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <iostream>
#include <numbers>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "fluid/mesh/rectangle.hpp"
#include "fluid/navier_stokes.hpp"

namespace fpi::fluid::testing {

inline scene::Boundary velocity(const std::string& x, const std::string& y) {
  scene::Boundary b;
  b.type = "velocity";
  b.velocity = {x, y};
  return b;
}
inline scene::Boundary no_slip() {
  scene::Boundary b;
  b.type = "no_slip";
  return b;
}
inline scene::Boundary slip() {
  scene::Boundary b;
  b.type = "slip";
  return b;
}
inline scene::Boundary open(const std::string& x = "0", const std::string& y = "0") {
  scene::Boundary b;
  b.type = "traction";
  b.traction = {x, y};
  return b;
}

/// Density and viscosity; all else by default.
inline Settings settings(double density, double viscosity,
                         std::map<std::string, scene::Boundary> boundaries) {
  Settings s;
  s.fluid.density = density;
  s.fluid.dynamic_viscosity = viscosity;
  s.fluid.boundaries = std::move(boundaries);
  return s;
}

/// The channel of DFG 2D-1 (Schäfer & Turek; paper section 5.1), 2.2 × 0.41 m, with the references' open end.
inline Settings dfg_2d_1() {
  auto s = settings(1, 1e-3,
                    {{"left", velocity("4*0.3*y*(0.41-y)/0.41^2", "0")},
                     {"right", open()},
                     {"bottom", no_slip()},
                     {"top", no_slip()}});
  s.fluid.viscous_form = "gradient";
  return s;
}

inline Mesh square(int n, double lower = 0, double upper = 1) {
  return make_rectangle(uniform_lines(lower, upper, n), uniform_lines(lower, upper, n));
}

/// A circle of arcs near `length` long; the first starts at `turn`.
inline Interface circle(Index body, const Vec2& centre, double radius, double length, double turn = 0) {
  Interface out;
  out.body = body;
  out.surface = Disc{centre, radius};
  out.rigid.centre = centre;
  const double two_pi = 2 * std::numbers::pi;
  const int n = std::max(4, static_cast<int>(std::lround(two_pi * radius / length)));
  for (int a = 0; a < n; ++a) {
    out.start.push_back(turn + two_pi * a / n);
    out.end.push_back(turn + two_pi * (a + 1) / n);
  }
  return out;
}

/// A polygon about its centre, turned, its sides cut into edges near `length` long.
inline Interface polygon(const Vec2& centre, std::vector<Vec2> corners, double length, double angle = 0) {
  const Eigen::Rotation2Dd turn(angle);
  for (Vec2& x : corners) x = centre + turn * x;
  std::vector<Vec2> vertices;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec2 along = corners[(k + 1) % corners.size()] - corners[k];
    const int n = std::max(1, static_cast<int>(std::lround(along.norm() / length)));
    for (int e = 0; e < n; ++e) vertices.push_back(corners[k] + along * (static_cast<double>(e) / n));
  }
  Interface out;
  out.rigid.centre = centre;
  set_edges(out, vertices);
  return out;
}

using Field = std::function<Vec2(const Vec2&)>;
using Scalar = std::function<double(const Vec2&)>;

struct Errors {
  double velocity_l2, velocity_h1, pressure_l2;
};

/// Errors of the accepted state over all elements; the means of both pressures are taken off.
inline Errors errors(const NavierStokes& solver, const Field& u,
                     const std::function<Eigen::Matrix2d(const Vec2&)>& du, const Scalar& p) {
  const Mesh& mesh = solver.mesh();
  double l2 = 0, h1 = 0, area = 0, mean = 0, square_sum = 0;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const CellNodes places = mesh.cell_places(c);
    const auto nodes = mesh.cell_nodes(c);
    for (const ElementPoint& point : curved_points()) {
      const Vec2 x = position_at(places, point.shape.n);
      const Metric<double> metric = metric_at(places, point.shape);
      const double w = metric.area * point.weight;
      Vec2 value = Vec2::Zero();
      Eigen::Matrix2d gradient = Eigen::Matrix2d::Zero();
      for (int i = 0; i < 6; ++i) {
        const Vec2 nodal = solver.state().u.segment<2>(2 * nodes[i]);
        value += point.shape.n[i] * nodal;
        for (int k = 0; k < 3; ++k)
          gradient += point.shape.dn[k][i] * nodal * Vec2(metric.gx[k], metric.gy[k]).transpose();
      }
      double pressure = 0;
      for (int k = 0; k < 3; ++k) pressure += point.shape.l[k] * solver.state().p[mesh.cells[c][k]];
      l2 += w * (value - u(x)).squaredNorm();
      h1 += w * (gradient - du(x)).squaredNorm();
      const double difference = pressure - p(x);
      area += w;
      mean += w * difference;
      square_sum += w * difference * difference;
    }
  }
  return {std::sqrt(l2), std::sqrt(h1), std::sqrt(std::max(0.0, square_sum - mean * mean / area))};
}

/// Order that the last two of a series of errors show when the size halves from one to the next.
inline double order(const std::vector<double>& e) { return std::log2(e[e.size() - 2] / e.back()); }

/// One steady solve of a scene, accepted.
inline Result solve_steady(NavierStokes& solver, std::vector<Interface> interfaces = {}) {
  Request request;
  request.interfaces = std::move(interfaces);
  Result result = solver.advance(request);
  if (result.newton.converged) solver.accept();
  return result;
}

}  // namespace fpi::fluid::testing
