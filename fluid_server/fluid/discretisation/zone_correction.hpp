/// A factor for bodies that have moved, from one that was made when they were elsewhere. The two matrices
/// differ in a zone around the bodies that moved, so the residual is first solved for exactly in the zone,
/// then everywhere with the old factor, then once more in the zone: the multiplicative, symmetric Schwarz
/// method with two subdomains (e.g. B. Smith, P. Bjørstad, W. Gropp, Domain Decomposition, 1996,
/// section 1.1). The iteration around it converges in a few rounds, however far few bodies went
/// (docs/numerics.md, "A factor of bodies that were elsewhere").
#pragma once

#include <memory>

#include "fluid/discretisation/layout.hpp"
#include "fluid/linear/linear_solver.hpp"

namespace fpi::fluid {

/// A factor and what it was made for.
struct Background {
  std::shared_ptr<const Factor> factor;
  Layout layout;
};

/// For `matrix`, which belongs to `layout`; the zone's is factored by the linear solver named. Null where
/// that would not pay, because much has changed, or could not converge, because the pressure is pinned
/// elsewhere or the zone's matrix is singular. It has no Schur complement; the reference has.
std::shared_ptr<const Factor> with_zone_correction(std::shared_ptr<const Background> reference,
                                                   const Mesh& mesh, const Layout& layout,
                                                   const BlockMatrix& matrix, std::string_view solver);

}  // namespace fpi::fluid
