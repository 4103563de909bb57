/// Which unknowns are in the system: velocities of active nodes that the boundary does not give, pressures of
/// active vertices except one pinned in each part of the fluid that knows no pressure level, multipliers of
/// arcs in the fluid, velocity and spin of bodies that the fluid moves.
#pragma once

#include <optional>
#include <vector>

#include "fluid/cut/components.hpp"
#include "fluid/discretisation/boundary.hpp"
#include "fluid/linear/nested_dissection.hpp"

namespace fpi::fluid {

struct Numbering {
  std::vector<Index> velocity;  ///< equation of 2·node + component, or −1. At a slip node: normal, tangential
  std::vector<Index> pressure;    ///< equation of each vertex, or −1
  std::vector<Index> multiplier;  ///< equation of 2·multiplier + component, or −1
  std::vector<Index> rigid;       ///< equations of Vx, Vy, ω of each interface, or −1 where they are given
  std::vector<Index> pinned;      ///< vertices whose pressure is set to 0
  std::vector<std::uint8_t> node_is_active;
  Index n_equations = 0;
  std::vector<Cluster> clusters;  ///< the unknowns by place: nodes, multipliers, bodies; together all of them
};

/// A multiplier is in the system where more than a twentieth of its function lies in the fluid.
Numbering number_unknowns(const Mesh& mesh, const Boundary& boundary, const CutMesh& cut,
                          const Components& components, const std::vector<Interface>& interfaces);

/// A direction along which no boundary and no body gives the velocity of the system, so that a uniform flow
/// can be added to any other; none where all are held.
std::optional<Vec2> unheld_direction(const Boundary& boundary, const Numbering& numbering);

}  // namespace fpi::fluid
