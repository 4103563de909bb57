/// Bodies that the fluid moves: velocity and spin of each are unknowns beside those of the fluid, so that the
/// coupling of all bodies through the fluid is solved in one factor. The no-slip condition refers to them
/// (paper, eq. 20), and the balance of momentum over the step (eq. 21) closes them:
/// (m/Δt) V = load + ∫λ, (J/Δt) ω = torque + ∫(x − c) × λ.
#pragma once

#include <vector>

#include "fluid/cut/cut_mesh.hpp"
#include "fluid/discretisation/numbering.hpp"
#include "fluid/linear/block_matrix.hpp"

namespace fpi::fluid {

class FreeBodies {
 public:
  FreeBodies() = default;
  /// The bodies among `interfaces` that have a balance, with their multipliers in the system.
  FreeBodies(const std::vector<Interface>& interfaces, const CutMesh& cut, const Numbering& numbering);

  bool empty() const { return interfaces_.empty(); }
  /// Equations of Vx, Vy, ω of each, in the order of the interfaces.
  std::vector<Index> unknowns(const Numbering& numbering) const;

  void declare_blocks(const Numbering& numbering, BlockMatrix& matrix);

  /// Forgets the integrals of all multipliers.
  void clear_integrals();
  /// Adds a piece of surface to those of multiplier m: ∫φ [m] and ∫φ (x − c) [m²].
  void add_integrals(Index m, double length, const Vec2& arm);

  /// Adds what the bodies make of no slip, and their balances, with `rigid` = (Vx, Vy, ω) of each interface
  /// [m/s, rad/s].
  void add_residual(const std::vector<Interface>& interfaces, const Vector& rigid, const Vector& lambda,
                    Vector& of_lambda, Vector& of_rigid) const;
  void add_jacobian(const std::vector<Interface>& interfaces, BlockMatrix& matrix) const;

 private:
  struct Multiplier {
    Index number, interface;
    double length = 0;        // ∫φ
    Vec2 arm = Vec2::Zero();  // ∫φ (x − c)
  };
  std::vector<Index> interfaces_;  // that are free
  std::vector<Multiplier> multipliers_;
  std::vector<Index> place_;  // of each multiplier in multipliers_, or −1
  Index first_block_ = 0;     // of the matrix: the multipliers', then the bodies'
};

}  // namespace fpi::fluid
