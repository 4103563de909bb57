/// Solves A x = b for an unsymmetric matrix of which only products are known: the stabilised bi-conjugate
/// gradients of van der Vorst (1992), preconditioned from the right.
#pragma once

#include <Eigen/Core>
#include <utility>

namespace fpi::dem {

/// x with |b − A x| ≤ tolerance |b|, or as near as `most` steps come. `apply` gives A x, `precondition` about
/// A⁻¹ x.
template <class Apply, class Precondition>
Eigen::VectorXd bicgstab(Apply apply, Precondition precondition, const Eigen::VectorXd& b, double tolerance,
                         int most) {
  using Vector = Eigen::VectorXd;
  Vector x = Vector::Zero(b.size()), r = b, p = b;
  const Vector shadow = b;
  double rho = shadow.dot(r);
  for (int k = 0; k < most && r.norm() > tolerance * b.norm(); ++k) {
    const Vector p_hat = precondition(p), v = apply(p_hat);
    const double alpha = rho / shadow.dot(v);
    const Vector s = r - alpha * v, s_hat = precondition(s), t = apply(s_hat);
    const double omega = t.squaredNorm() > 0 ? t.dot(s) / t.squaredNorm() : 0;
    const Vector next = x + alpha * p_hat + omega * s_hat;
    if (!next.allFinite()) break;
    x = next;
    r = s - omega * t;
    const double rho_before = std::exchange(rho, shadow.dot(r));
    p = r + rho / rho_before * alpha / omega * (p - omega * v);
  }
  return x;
}

}  // namespace fpi::dem
