#include "fluid/discretisation/free_bodies.hpp"

namespace fpi::fluid {
namespace {

/// λx, λy of a multiplier with Vx, Vy, ω of its body.
constexpr int slip_block = 5;

const BlockMask& slip_mask() {
  static const BlockMask mask = [] {
    BlockMask m{slip_block, std::vector<std::uint8_t>(slip_block * slip_block, 0)};
    for (const auto& [lambda, motion] : {std::pair{0, 2}, {0, 4}, {1, 3}, {1, 4}})
      m.coupled[motion + slip_block * lambda] = m.coupled[lambda + slip_block * motion] = 1;
    return m;
  }();
  return mask;
}
const BlockMask& inertia_mask() {
  static const BlockMask mask{3, {1, 0, 0, 0, 1, 0, 0, 0, 1}};
  return mask;
}

}  // namespace

FreeBodies::FreeBodies(const std::vector<Interface>& interfaces, const CutMesh& cut,
                       const Numbering& numbering)
    : place_(cut.n_multipliers(), -1) {
  for (Index i = 0; i < static_cast<Index>(interfaces.size()); ++i) {
    if (!interfaces[i].balance) continue;
    interfaces_.push_back(i);
    const Index first = cut.first_multiplier[i];
    for (Index m = first; m < first + cut.multiplier_nodes[i].size(); ++m) {
      if (numbering.multiplier[2 * m] < 0) continue;
      place_[m] = static_cast<Index>(multipliers_.size());
      multipliers_.push_back({m, i});
    }
  }
}

std::vector<Index> FreeBodies::unknowns(const Numbering& numbering) const {
  std::vector<Index> equations;
  for (const Index i : interfaces_) {
    const auto first = numbering.rigid.begin() + 3 * i;
    equations.insert(equations.end(), first, first + 3);
  }
  return equations;
}

void FreeBodies::declare_blocks(const Numbering& numbering, BlockMatrix& matrix) {
  first_block_ = matrix.n_blocks();
  for (const Multiplier& m : multipliers_) {
    const Index* rigid = &numbering.rigid[3 * m.interface];
    const Index* lambda = &numbering.multiplier[2 * m.number];
    matrix.declare(std::array{lambda[0], lambda[1], rigid[0], rigid[1], rigid[2]}, slip_mask());
  }
  for (const Index i : interfaces_) matrix.declare(std::span(&numbering.rigid[3 * i], 3), inertia_mask());
}

void FreeBodies::clear_integrals() {
  for (Multiplier& m : multipliers_) {
    m.length = 0;
    m.arm.setZero();
  }
}

void FreeBodies::add_integrals(Index m, double length, const Vec2& arm) {
  if (place_[m] < 0) return;
  multipliers_[place_[m]].length += length;
  multipliers_[place_[m]].arm += arm;
}

void FreeBodies::add_residual(const std::vector<Interface>& interfaces, const Vector& rigid,
                              const Vector& lambda, Vector& of_lambda, Vector& of_rigid) const {
  for (const Multiplier& m : multipliers_) {
    const auto motion = rigid.segment<3>(3 * m.interface);
    const auto value = lambda.segment<2>(2 * m.number);
    of_lambda.segment<2>(2 * m.number) -= m.length * motion.head<2>() + spin_cross(motion[2], m.arm);
    of_rigid.segment<2>(3 * m.interface) -= m.length * value;
    of_rigid[3 * m.interface + 2] -= cross(m.arm, value);
  }
  for (const Index i : interfaces_) {
    const Balance& balance = *interfaces[i].balance;
    of_rigid.segment<2>(3 * i) += balance.mass_rate * rigid.segment<2>(3 * i) - balance.load;
    of_rigid[3 * i + 2] += balance.inertia_rate * rigid[3 * i + 2] - balance.torque;
  }
}

void FreeBodies::add_jacobian(const std::vector<Interface>& interfaces, BlockMatrix& matrix) const {
  Index block = first_block_;
  for (const Multiplier& m : multipliers_) {
    Eigen::Matrix<double, slip_block, slip_block> dense;
    dense.setZero();
    dense.topRightCorner<2, 3>() << -m.length, 0, m.arm.y(), 0, -m.length, -m.arm.x();
    dense.bottomLeftCorner<3, 2>() = dense.topRightCorner<2, 3>().transpose();
    matrix.add(block++, dense.data());
  }
  for (const Index i : interfaces_) {
    const Balance& balance = *interfaces[i].balance;
    const Eigen::Matrix3d dense =
        Eigen::Vector3d(balance.mass_rate, balance.mass_rate, balance.inertia_rate).asDiagonal();
    matrix.add(block++, dense.data());
  }
}

}  // namespace fpi::fluid
