/// How finely elements and time steps resolve a flow: cell Reynolds number, Courant number, viscous number.
#pragma once

#include "fluid/base/types.hpp"
#include "fluid/mesh/mesh.hpp"

namespace fpi::fluid {

struct Resolution {
  /// A largest value, and the centre of the element that has it.
  struct Peak {
    double value = 0;
    Vec2 place = Vec2::Zero();  ///< [m]
  };
  double speed = 0;    ///< largest |u| [m/s]
  Peak cell_reynolds;  ///< |u| h/ν
  Peak courant;        ///< |u| Δt/h; 0 in a steady flow

  /// Keeps the larger values of both.
  void include(const Resolution& other);
};

/// Of the velocity u [m/s] at the nodes of the elements for which `counts` is true; all where it is empty.
Resolution resolution(const Mesh& mesh, const std::vector<bool>& counts, const Vector& u,
                      double kinematic_viscosity, double time_step);

}  // namespace fpi::fluid
