/// Gmsh meshes: what is taken is a sound mesh; every refusal names the file.
#include "fluid/mesh/gmsh.hpp"
#include "fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fpi;
  const std::vector<std::string> none, both{"left", "walls"};
  for (const auto& conditions : {none, both})
    fuzz::takes_or_refuses("mesh.msh", [&] {
      const fluid::Mesh mesh = fluid::read_gmsh(fuzz::text(data, size), "mesh.msh", conditions);
      for (fluid::Index c = 0; c < mesh.n_cells(); ++c)
        if (!(mesh.area(c) > 0)) fuzz::fault("a triangle without an area");
    });
  return 0;
}

namespace fpi::fuzz {

std::vector<Bytes> seeds() { return files(FPI_FUZZ_CORPUS "/gmsh"); }

std::vector<std::string> words() {
  return {"$MeshFormat\n",
          "$EndMeshFormat\n",
          "$PhysicalNames\n",
          "$Entities\n",
          "$PartitionedEntities\n",
          "$Nodes\n",
          "$EndNodes\n",
          "$Elements\n",
          "$EndElements\n",
          "$Periodic\n",
          "4.1",
          "2.2",
          "\"left\"",
          "8",
          "9"};
}

}  // namespace fpi::fuzz
