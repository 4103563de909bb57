#include "fluid/discretisation/kernel.hpp"

namespace fpi::fluid {
namespace {

constexpr int n_u = 6, n_all = element_unknowns, first_p = 2 * n_u;

template <class T>
using Nodes = std::array<T, n_u>;

/// Adds one quadrature point after another.
template <class T, bool with_jacobian>
class Sum {
 public:
  Sum(const Flow& flow, const ElementState<T>& state, ElementSystem<T>& system)
      : s_(state),
        system_(system),
        rho_(flow.density),
        mu_(flow.viscosity),
        sym_(flow.symmetric ? 1 : 0),
        convection_(flow.convection) {
    system_.residual.fill(T{});
    if constexpr (with_jacobian) system_.jacobian.fill(T{});
  }

  void add(const Shape& shape, double weight, const Metric<T>& metric) {
    const Padded& n = shape.n;
    const T w = weight * metric.area;
    Nodes<T> nx, ny;
    for (int i = 0; i < n_u; ++i) {
      nx[i] = shape.dn[0][i] * metric.gx[0] + shape.dn[1][i] * metric.gx[1] + shape.dn[2][i] * metric.gx[2];
      ny[i] = shape.dn[0][i] * metric.gy[0] + shape.dn[1][i] * metric.gy[1] + shape.dn[2][i] * metric.gy[2];
    }
    T ux{}, uy{}, ax{}, ay{}, wx{}, wy{}, ux_x{}, ux_y{}, uy_x{}, uy_y{};
    for (int i = 0; i < n_u; ++i) {
      ux += n[i] * s_.ux[i];
      uy += n[i] * s_.uy[i];
      ax += n[i] * s_.ax[i];
      ay += n[i] * s_.ay[i];
      wx += n[i] * s_.wx[i];
      wy += n[i] * s_.wy[i];
      ux_x += nx[i] * s_.ux[i];
      ux_y += ny[i] * s_.ux[i];
      uy_x += nx[i] * s_.uy[i];
      uy_y += ny[i] * s_.uy[i];
    }
    const T p = shape.l[0] * s_.p[0] + shape.l[1] * s_.p[1] + shape.l[2] * s_.p[2];
    const T cx = convection_ * ux - wx, cy = convection_ * uy - wy;
    ax += cx * ux_x + cy * ux_y;  // (∇u)(u − w)
    ay += cx * uy_x + cy * uy_y;

    // w·ρ(∂u/∂t + (∇u)(u − w)) + μ(∇u + ∇uᵀ):∇w − p ∇·w
    const T fx = w * rho_ * ax, fy = w * rho_ * ay;
    const T s_xx = w * (mu_ * (1 + sym_) * ux_x - p), s_xy = w * mu_ * (ux_y + sym_ * uy_x);
    const T s_yy = w * (mu_ * (1 + sym_) * uy_y - p), s_yx = w * mu_ * (uy_x + sym_ * ux_y);
    for (int i = 0; i < n_u; ++i) {
      system_.residual[i] += fx * n[i] + s_xx * nx[i] + s_xy * ny[i];
      system_.residual[n_u + i] += fy * n[i] + s_yx * nx[i] + s_yy * ny[i];
    }
    // −q ∇·u
    const T divergence = w * (ux_x + uy_y);
    for (int k = 0; k < 3; ++k) system_.residual[first_p + k] -= shape.l[k] * divergence;

    if constexpr (with_jacobian) {
      for (int c = 0; c < n_u; ++c) {
        // Derivative by u_c of what N_i multiplies: ρ(N_c/(γΔt) + (u − w)·∇N_c) + ρ N_c ∇u
        const T inertia = w * rho_ * (n[c] * s_.inertia + cx * nx[c] + cy * ny[c]);
        const T reaction = w * (rho_ * convection_ * n[c]);
        const T mx = w * mu_ * nx[c], my = w * mu_ * ny[c];
        const T c_xx = inertia + reaction * ux_x, c_yx = reaction * uy_x;
        const T c_yy = inertia + reaction * uy_y, c_xy = reaction * ux_y;
        T* by_x = system_.jacobian.data() + n_all * c;
        T* by_y = system_.jacobian.data() + n_all * (n_u + c);
        for (int i = 0; i < n_u; ++i) {
          by_x[i] += c_xx * n[i] + (1 + sym_) * mx * nx[i] + my * ny[i];
          by_x[n_u + i] += c_yx * n[i] + sym_ * my * nx[i];
          by_y[i] += c_xy * n[i] + sym_ * mx * ny[i];
          by_y[n_u + i] += c_yy * n[i] + mx * nx[i] + (1 + sym_) * my * ny[i];
        }
        const T of_x = w * nx[c], of_y = w * ny[c];
        for (int k = 0; k < 3; ++k) {
          by_x[first_p + k] -= shape.l[k] * of_x;
          by_y[first_p + k] -= shape.l[k] * of_y;
        }
      }
    }
  }

  /// The gradient's columns are the transpose of the divergence's rows.
  void mirror_gradient() {
    if constexpr (with_jacobian)
      for (int k = first_p; k < n_all; ++k)
        for (int j = 0; j < first_p; ++j) system_.jacobian[n_all * k + j] = system_.jacobian[n_all * j + k];
  }

 private:
  const ElementState<T>& s_;
  ElementSystem<T>& system_;
  double rho_, mu_, sym_, convection_;
};

template <class T, bool with_jacobian>
void compute(const Flow& flow, std::span<const ElementPoint> points, std::span<const Metric<T>> metrics,
             const ElementState<T>& state, ElementSystem<T>& system) {
  Sum<T, with_jacobian> sum(flow, state, system);
  const std::size_t stride = metrics.size() == 1 ? 0 : 1;
  for (std::size_t q = 0; q < points.size(); ++q)
    sum.add(points[q].shape, points[q].weight, metrics[q * stride]);
  sum.mirror_gradient();
}

}  // namespace

template <class T>
void element_system(const Flow& flow, std::span<const ElementPoint> points,
                    std::span<const Metric<T>> metrics, const ElementState<T>& state,
                    ElementSystem<T>& system, bool with_jacobian) {
  if (with_jacobian)
    compute<T, true>(flow, points, metrics, state, system);
  else
    compute<T, false>(flow, points, metrics, state, system);
}

template void element_system(const Flow&, std::span<const ElementPoint>, std::span<const Metric<double>>,
                             const ElementState<double>&, ElementSystem<double>&, bool);
template void element_system(const Flow&, std::span<const ElementPoint>, std::span<const Metric<Lanes>>,
                             const ElementState<Lanes>&, ElementSystem<Lanes>&, bool);

}  // namespace fpi::fluid
