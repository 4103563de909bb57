/// Conditions on the outer boundary: which velocity components of which nodes are given, and tractions
/// (paper, eq. 7). Where parts meet in a node, no_slip goes before velocity, velocity before slip.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/expression.hpp"
#include "core/findings.hpp"
#include "fluid/cut/components.hpp"
#include "scene/fluid.hpp"

namespace fpi::fluid {

/// What keeps the fluid from the boundary: bodies, and parts of the fluid that are left out.
struct Cover {
  std::span<const Surface> bodies;
  /// Of each Mesh::boundary, see Components::of_boundary; empty: all of it is beside fluid.
  std::span<const Index> part;
  bool hides(std::size_t edge) const { return !part.empty() && part[edge] < 0; }
};

/// How much of a node's velocity is given.
enum class Constraint : std::uint8_t { none, normal, both };

/// Errors: each condition for a part that the mesh does not have, and each part without a condition.
Findings unmatched(const Mesh& mesh, const std::map<std::string, scene::Boundary>& conditions);

class Boundary {
 public:
  /// Throws Error with what is unmatched.
  Boundary(const Mesh& mesh, const std::map<std::string, scene::Boundary>& conditions);

  Constraint constraint(Index node) const { return constraint_[node]; }
  /// Unit normal of a node whose normal velocity is 0; its unknown is the component along (−n_y, n_x).
  const Vec2& normal(Index node) const { return normal_[node]; }

  /// Sets the given velocities at time t [s] in u (x, y of each node) [m/s].
  void impose(double t, Vector& u) const;
  /// Adds ∫ w·t̄ over what the cover leaves of the traction parts at time t [s] to `load` [N/m].
  void add_tractions(double t, const Cover& cover, Vector& load) const;
  /// Force of the traction at time t [s] on the fluid at a part [N/m].
  Vec2 traction_force(Index boundary, double t, const Cover& cover) const;
  /// Adds −∫ w·n over what the cover leaves of a part: the load of a unit pressure.
  void add_pressure(Index boundary, const Cover& cover, Vector& load) const;
  bool traction_depends_on_time() const;

  /// 1 for the parts of the fluid that have an open boundary.
  std::vector<std::uint8_t> open_components(const Components& components) const;
  /// Through the sides that are not open [m²/s]: ∫u·n, ∫|u·n| and ∫|u|.
  struct Flux {
    double net = 0, gross = 0, reach = 0;
  };
  Flux flux(const Vector& u) const;
  /// True where fluid has a way out through no part.
  bool is_closed() const;
  /// Throws Error where fluid flows in or out (more than 1 % net) although no part is open: nowhere for it to
  /// go.
  void check_net_flux(double t, const Vector& u) const;
  /// A sentence with the numbers where it is less, but more than round-off; else "".
  std::string doubtful_net_flux(double t, const Vector& u) const;

  /// True for a part on which the normal velocity is free, so that the pressure level is known.
  bool is_open(Index boundary) const { return parts_[boundary].type == Type::traction; }
  /// Nodes of a named part, each node in one part only (the one that constrains it).
  const std::vector<Index>& nodes(Index boundary) const { return parts_[boundary].nodes; }

 private:
  enum class Type { no_slip, velocity, slip, traction };  // in the order of precedence
  struct Part {
    Type type;
    Expression x, y;  ///< velocity or traction
    std::vector<Index> nodes;
  };
  using Traction = std::function<Vec2(const Vec2& x, const Vec2& normal)>;
  void add_traction(Index boundary, const Traction& traction, const Cover& cover, Vector& load) const;
  Traction given_traction(Index boundary, double t) const;
  void assign_nodes();
  void find_slip_normals();

  const Mesh& mesh_;
  std::vector<Part> parts_;  // of each Mesh::boundary_names
  std::vector<Constraint> constraint_;
  std::vector<Vec2> normal_;
};

}  // namespace fpi::fluid
