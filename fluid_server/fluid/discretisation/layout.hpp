/// What a matrix was made for: where the bodies lie, how they cut the mesh, along which paths they take
/// nodes, and which unknowns there are. Enough to tell which unknowns two systems on one mesh share, and
/// where they differ.
#pragma once

#include <vector>

#include "fluid/cut/cut_mesh.hpp"
#include "fluid/discretisation/numbering.hpp"

namespace fpi::fluid {

struct Layout {
  std::vector<Interface> interfaces;
  CutMesh cut;
  Numbering numbering;
  Vector mesh_velocity;  ///< x, y of each node: velocity of its path [m/s]; empty: all stay
  double inertia = 0;    ///< of the time scheme [1/s]
};

/// For each equation of `after`, the one of `before` that has the same unknown, or −1: velocity of a node,
/// pressure of a vertex, motion of a body, multiplier of a body that has as many of them in both.
std::vector<Index> shared_equations(const Layout& before, const Layout& after);

/// The equations of `after` (ascending) in the zone where the two systems differ: around bodies that moved,
/// came or went, where they were and where they are, or that began or ceased to move, with `layers` of
/// elements around.
std::vector<Index> changed_zone(const Mesh& mesh, const Layout& before, const Layout& after, int layers);

}  // namespace fpi::fluid
