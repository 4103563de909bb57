#include "coupling/make_acceleration.hpp"

#include "coupling/aitken.hpp"
#include "coupling/constant_relaxation.hpp"
#include "coupling/iqn_ils.hpp"
#include "coupling/iqn_imvj.hpp"

namespace fpi::coupling {

std::unique_ptr<Acceleration> make_acceleration(const scene::Coupling& parameters) {
  if (parameters.acceleration == "constant")
    return std::make_unique<ConstantRelaxation>(parameters.relaxation);
  if (parameters.acceleration == "aitken") return std::make_unique<Aitken>(parameters.relaxation);
  if (parameters.acceleration == "iqn-imvj") return std::make_unique<IqnImvj>(parameters.relaxation);
  return std::make_unique<IqnIls>(parameters.relaxation);
}

}  // namespace fpi::coupling
