#include "stl.hpp"

#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <span>

#include "core/error.hpp"

namespace fpi::dem {
namespace {

constexpr std::size_t binary_head = 84, binary_triangle = 50;  ///< bytes

}  // namespace

std::vector<Corners> read_stl(std::string_view bytes, const std::string& name) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, "stl");
  require(scene != nullptr, "an STL file, text or binary, is required; {} cannot be read as one: {}", name,
          importer.GetErrorString());
  std::vector<Corners> triangles;
  for (const aiMesh* mesh : std::span(scene->mMeshes, scene->mNumMeshes)) {
    for (const aiFace& face : std::span(mesh->mFaces, mesh->mNumFaces)) {
      require(face.mNumIndices == 3, "an STL file of triangles is required; {} has a face of {} corners",
              name, face.mNumIndices);
      Corners& corners = triangles.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        const aiVector3D& v = mesh->mVertices[face.mIndices[i]];
        corners[i] = {v.x, v.y, v.z};
        require(corners[i].allFinite(),
                "an STL file of finite numbers is required; triangle {} of {} has others", triangles.size(),
                name);
      }
    }
  }
  require(!triangles.empty(), "an STL file with a triangle is required; {} has none", name);
  const bool binary = bytes.size() == binary_head + binary_triangle * triangles.size();
  require(binary || bytes.find("endsolid") != bytes.npos,
          "a whole STL file is required; {} ends without endsolid: it was cut short", name);
  return triangles;
}

}  // namespace fpi::dem
