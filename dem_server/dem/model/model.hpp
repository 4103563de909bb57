/// What does not change during a run: the bodies' properties, the walls, the contact laws, gravity; and the
/// motions that the bodies have. A structure of arrays, indexed as the scene's [[bodies]].
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/findings.hpp"
#include "dem/base/periodic_box.hpp"
#include "dem/model/materials.hpp"
#include "dem/walls/walls.hpp"
#include "scene/bodies.hpp"
#include "scene/dem.hpp"
#include "scene/periodic.hpp"
#include "scene/walls.hpp"

namespace fpi::dem {

/// The DEM's part of a scene.
struct Problem {
  Vec3 gravity = Vec3::Zero();  ///< [m/s²]
  double thickness = 1;         ///< of a plane scene [m]
  double duration = 0;          ///< of the run [s], for how far bodies may fall
  double hydraulic_radius_ratio = 1;
  scene::Periodic periodic{};
  scene::Dem dem{};
  std::vector<scene::Body> bodies;
  std::vector<scene::Material> materials;
  std::vector<scene::Wall> walls;
  std::map<std::string, std::vector<Corners>> meshes{};  ///< triangles by the file that walls name
};

/// Properties; a body that is not free has infinite mass, so that no force moves it.
struct Bodies {
  std::vector<std::string> name;
  std::vector<double> radius;           ///< R [m]
  std::vector<double> mass, inertia;    ///< its own [kg], [kg m²]
  std::vector<double> inverse_mass;     ///< [1/kg], with what a fluid adds; 0 where not free
  std::vector<double> inverse_inertia;  ///< [1/(kg m²)], likewise; 0 where not free to turn
  std::vector<std::size_t> material;
  std::vector<bool> left;  ///< it is no longer there: nothing moves it and it touches nothing
  std::size_t size() const { return radius.size(); }
  bool is_free(std::size_t i) const { return inverse_mass[i] > 0; }
  void take_out(std::size_t i) {
    left[i] = true;
    inverse_mass[i] = inverse_inertia[i] = 0;
  }
  /// Has a free body move with its own inertia and this.
  void set_added(std::size_t i, double added_mass, double added_inertia) {
    if (!is_free(i)) return;
    inverse_mass[i] = 1 / (mass[i] + added_mass);
    if (inverse_inertia[i] > 0) inverse_inertia[i] = 1 / (inertia[i] + added_inertia);
  }
};

/// Motion of every body.
struct Motions {
  std::vector<Vec3> position;  ///< [m]
  std::vector<Vec3> velocity;  ///< [m/s]
  std::vector<Vec3> spin;      ///< [rad/s]
  std::vector<Orientation> orientation;
};

/// The liquid in narrow gaps.
struct Lubricant {
  double viscosity = 0;     ///< μ [Pa s], of discs times the thickness [Pa s m]; 0: there are no films
  double roughness = 0;     ///< of the smaller radius: no gap counts as narrower
  double radius_ratio = 1;  ///< radius that the liquid sees over the contact radius
};

struct Model {
  bool plane = false;           ///< discs: they move in x, y and spin about z
  Vec3 gravity = Vec3::Zero();  ///< [m/s²]
  double steps_per_contact = 50;
  double largest_sub_step = 0;  ///< [s]; infinite where the scene sets none
  Bodies bodies;
  Walls walls;
  PeriodicBox periodic;
  Elasticity elasticity = Elasticity::hertz;
  LawTable laws{{}};
  Lubricant lubricant;
  scene::NearField near_field;
  double adhesion_range = 0;  ///< gap at which adhesion ends, over R*
  double stretch = 1;         ///< of contact times
  bool implicit = false;      ///< sub-steps by the trapezoidal rule
  bool loads_are_linear = false;
  bool accounts_energy = false;
  double start_overlap = 0;  ///< allowed, of the smaller radius
  Box expected;              ///< a free body outside is lost
};

/// Adds to `wrong` every body, wall or material at fault, with its scene key: an unknown material, a free
/// body without mass, discs among spheres or moving out of their plane, numbers that are not finite, walls
/// that do not fit the periodic box. With errors the model is of no use.
Model make_model(const Problem& problem, Findings& wrong);
/// Throws Error with all of these.
Model make_model(const Problem& problem);

/// The motions at the start.
Motions initial_motions(const Problem& problem);

}  // namespace fpi::dem
