/// The inertia that bodies have together with the fluid between them: who pushes one of them over a step
/// pushes its neighbours, and two of them resist being squeezed together far more than each of them by
/// itself.
#pragma once

#include <Eigen/LU>
#include <cstdint>
#include <vector>

#include "dem/contact/particles.hpp"

namespace fpi::dem {

class SharedInertia {
 public:
  using Vector = Eigen::VectorXd;
  using Matrix = Eigen::MatrixXd;

  /// Each body by itself.
  SharedInertia() = default;
  /// `matrix` [kg, kg m, kg m²] has three rows and columns for each of `bodies` of a plane scene: x, y and
  /// spin.
  SharedInertia(std::vector<std::uint32_t> bodies, Matrix matrix);

  bool empty() const { return bodies_.empty(); }
  Eigen::Index n_rows() const { return matrix_.rows(); }
  bool is(const std::vector<std::uint32_t>& bodies, const Matrix& matrix) const {
    return bodies == bodies_ && matrix == matrix_;
  }
  /// The first row of a body, or −1.
  Eigen::Index row(std::uint32_t body) const { return body < row_.size() ? row_[body] : -1; }
  /// Calls visit(body, first row) for every body.
  template <class Visit>
  void each_body(Visit visit) const {
    for (std::size_t k = 0; k < bodies_.size(); ++k) visit(bodies_[k], 3 * static_cast<Eigen::Index>(k));
  }
  /// [m/s², rad/s²] of all bodies together under forces [N, N m] on some.
  Vector accelerations(const Vector& forces) const { return factor_.solve(forces); }
  /// Turns what pushes each body into what would push it as much by itself.
  void answer(Particles& particles) const;

 private:
  std::vector<std::uint32_t> bodies_;
  Matrix matrix_;
  std::vector<Eigen::Index> row_;
  Eigen::PartialPivLU<Matrix> factor_;
};

}  // namespace fpi::dem
