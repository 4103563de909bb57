/// The account of the fluid's volume: what comes in through every boundary, what bodies push ahead of them,
/// and what leaks through their surfaces, where no slip holds in the mean over an arc only. Together they
/// vanish to the error of the quadrature, as the discrete equation of continuity holds for all the fluid;
/// where no side is open, one vertex of given pressure takes what leaks.
#pragma once

#include <string>
#include <vector>

#include "fluid/discretisation/system.hpp"

namespace fpi::fluid {

struct VolumeBalance {
  struct Term {
    std::string name;
    double inflow = 0;  ///< into the fluid [m²/s]
  };
  /// "boundary:NAME" of each, "bodies" (that move into the fluid), "leak" (through their surfaces).
  std::vector<Term> terms;

  double rest() const;  ///< what they add up to [m²/s]
};

/// Of the flow u [m/s] in which bodies move as the interfaces of the system say.
VolumeBalance volume_balance(const System& system, const Vector& u);

/// Of each part of the fluid that has sides, none of them open: what comes in through these, with the
/// velocity u [m/s] there, and what bodies push ahead of them, with the velocities of the interfaces [m²/s].
struct PartInflow {
  double net = 0;
  bool is_given = true;  ///< false for other parts, of which nothing is said
};
std::vector<PartInflow> inflow_of_parts(const System& system, const Vector& u);

}  // namespace fpi::fluid
