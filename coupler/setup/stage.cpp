#include "setup/stage.hpp"

#include "core/error.hpp"
#include "results/end_state.hpp"

namespace fpi {

std::string table_of(const Stage& stage) {
  require(
      stage.ready,
      "the grains' places are those at the end of {0}, which must have been run as it is now and by this "
      "version; {1} has no such run: `./fpi run` runs it before the scene that asks for it, or do `coupler "
      "--scene {0} --out {1}` and start what it needs",
      stage.scene, stage.folder);
  return final_bodies_file(stage.folder);
}

}  // namespace fpi
