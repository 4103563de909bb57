/// Values of nodal fields at one place of the mesh: the P2 functions of its element for velocities, the P1
/// functions for the pressure.
#pragma once

#include "fluid/mesh/locator.hpp"

namespace fpi::fluid {

class Sample {
 public:
  Sample(const Mesh& mesh, const Place& place)
      : nodes_(mesh.cell_nodes(place.cell)), n_(p2_at(place.l)), l_(place.l) {}

  /// Of x, y of each node.
  Vec2 velocity(const Vector& nodal) const { return value_at(nodes_, n_, nodal); }
  /// Of a number of each vertex.
  double pressure(const Vector& nodal) const {
    return l_[0] * nodal[nodes_[0]] + l_[1] * nodal[nodes_[1]] + l_[2] * nodal[nodes_[2]];
  }

 private:
  std::array<Index, 6> nodes_;
  Padded n_;
  Barycentric l_;
};

}  // namespace fpi::fluid
