#include "fluid/kernel.hpp"

namespace fpi::fluid {
namespace {

template <bool with_jacobian>
void compute(const Flow& flow, const Triangle& triangle, std::span<const ElementPoint> points, double scale,
             const ElementState& s, ElementResidual& r, ElementJacobian* jacobian) {
  const double rho = flow.density, mu = flow.viscosity, sym = flow.symmetric ? 1 : 0;
  r.x.setZero();
  r.y.setZero();
  r.q = {0, 0, 0};
  if constexpr (with_jacobian) {
    jacobian->xx.setZero();
    jacobian->xy.setZero();
    jacobian->yx.setZero();
    jacobian->yy.setZero();
    for (int k = 0; k < 3; ++k) {
      jacobian->xp[k].setZero();
      jacobian->yp[k].setZero();
    }
  }
  const auto& g = triangle.gradient;
  for (const ElementPoint& point : points) {
    const Shape& shape = point.shape;
    const double w = scale * point.weight;
    const Padded& n = shape.n;
    const Padded nx = g[0].x() * shape.dn[0] + g[1].x() * shape.dn[1] + g[2].x() * shape.dn[2];
    const Padded ny = g[0].y() * shape.dn[0] + g[1].y() * shape.dn[1] + g[2].y() * shape.dn[2];

    const double ux = n.dot(s.ux), uy = n.dot(s.uy);
    const double ux_x = nx.dot(s.ux), ux_y = ny.dot(s.ux), uy_x = nx.dot(s.uy), uy_y = ny.dot(s.uy);
    const double p = shape.l[0] * s.p[0] + shape.l[1] * s.p[1] + shape.l[2] * s.p[2];
    double ax = n.dot(s.ax), ay = n.dot(s.ay);
    if (flow.convection) {  // (∇u)u
      ax += ux * ux_x + uy * ux_y;
      ay += ux * uy_x + uy * uy_y;
    }
    // w·ρ(∂u/∂t + (∇u)u) + μ(∇u + ∇uᵀ):∇w − p ∇·w
    r.x += w * (rho * ax * n + (mu * (1 + sym) * ux_x - p) * nx + mu * (ux_y + sym * uy_x) * ny);
    r.y += w * (rho * ay * n + mu * (uy_x + sym * ux_y) * nx + (mu * (1 + sym) * uy_y - p) * ny);
    // −q ∇·u
    const double divergence = ux_x + uy_y;
    for (int k = 0; k < 3; ++k) r.q[k] -= w * shape.l[k] * divergence;

    if constexpr (with_jacobian) {
      // Derivative by u_j of the part that is multiplied by N_i: ρ(N_j/(γΔt) + u·∇N_j) + ρ N_j ∇u
      Padded inertia = n.cwiseProduct(s.inertia);
      if (flow.convection) inertia += ux * nx + uy * ny;
      inertia *= w * rho;
      const Padded reaction = (flow.convection ? w * rho : 0.0) * n;
      const double m = w * mu;
      ElementJacobian& j = *jacobian;
      for (int c = 0; c < 6; ++c) {
        const double mx = m * nx[c], my = m * ny[c];
        j.xx.col(c) += (inertia[c] + reaction[c] * ux_x) * n + (1 + sym) * mx * nx + my * ny;
        j.xy.col(c) += reaction[c] * ux_y * n + sym * mx * ny;
        j.yx.col(c) += reaction[c] * uy_x * n + sym * my * nx;
        j.yy.col(c) += (inertia[c] + reaction[c] * uy_y) * n + mx * nx + (1 + sym) * my * ny;
      }
      for (int k = 0; k < 3; ++k) {
        j.xp[k] -= w * shape.l[k] * nx;
        j.yp[k] -= w * shape.l[k] * ny;
      }
    }
  }
}

}  // namespace

void element_system(const Flow& flow, const Triangle& triangle, std::span<const ElementPoint> points,
                    double scale, const ElementState& state, ElementResidual& residual,
                    ElementJacobian* jacobian) {
  if (jacobian)
    compute<true>(flow, triangle, points, scale, state, residual, jacobian);
  else
    compute<false>(flow, triangle, points, scale, state, residual, nullptr);
}

}  // namespace fpi::fluid
