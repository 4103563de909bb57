/// What a scene's `fluid.mesh.elements_per_diameter` asks of the mesh, as refinements that any fluid
/// understands: small triangles around each body where it starts, along its prescribed path, and where a free
/// one may go. Bodies of different size get triangles of different size.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace fpi::coupling {

/// Of a disc as the fluid sees it, of a polygon that of the disc of equal area [m].
double diameter(const scene::Body& body, double hydraulic_radius_ratio);

struct MeshAroundBodies {
  std::vector<scene::Refinement> refinements;
  std::vector<std::string> notes;  ///< what was refined, a sentence a body
};

/// Nothing where the scene does not ask for it. The mesh is a rectangle, the scene plane.
MeshAroundBodies mesh_around_bodies(const scene::Scene& scene);

}  // namespace fpi::coupling
