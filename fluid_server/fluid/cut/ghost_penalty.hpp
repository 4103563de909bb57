/// The ghost penalty over a face between two active elements of which one is cut: the squared distance
/// between the two polynomials, each extended to both elements (numerics.md section 1). It bounds the
/// condition number whatever the cut, and keeps moving bodies stable.
#pragma once

#include "fluid/base/element.hpp"
#include "fluid/mesh/mesh.hpp"

namespace fpi::fluid {

/// ∫_{T1 ∪ T2} (E1 w − E2 w)(E1 v − E2 v) over the union of the two elements' shape functions.
struct GhostFace {
  Index edge;
  std::array<Index, 9> nodes;            ///< P2: six of T1, then the three that only T2 has
  std::array<Index, 4> vertices;         ///< P1: three of T1, then the one that only T2 has
  Eigen::Matrix<double, 9, 9> velocity;  ///< [m²]
  Eigen::Matrix4d pressure;              ///< [m²]
  double h2;                             ///< h² = h1 h2 [m²]
};

GhostFace ghost_face(const Mesh& mesh, Index edge);

/// The inertial part γ_m acts on the acceleration where the body rests, so that it vanishes with Δt as the
/// scheme's own error does; where the body moves, nodes inside have no history, so on u, at the rate at which
/// elements are passed.
struct GhostInertia {
  bool of_acceleration;
  double rate;  ///< ∂/∂u of what it acts on [1/s]
};

/// With the velocity at which nodes move with bodies (x, y of each [m/s]; empty: all stay) and the
/// inertia of the time scheme [1/s].
GhostInertia ghost_inertia(const GhostFace& face, const Vector& mesh_velocity, double inertia);

}  // namespace fpi::fluid
