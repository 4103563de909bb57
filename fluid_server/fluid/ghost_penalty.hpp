/// The ghost penalty over a face between two active elements of which one is cut: the squared distance
/// between the two polynomials, each extended to both elements (numerics.md section 1). It bounds the
/// condition number whatever the cut, and keeps moving bodies stable.
#pragma once

#include "fluid/element.hpp"
#include "fluid/mesh.hpp"

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

}  // namespace fpi::fluid
