/// The discrete equations for one position of the bodies (paper, eq. 20; signs and ghost penalty: numerics.md
/// section 1): what is numbered, the residual of any fields, and its exact Jacobian.
#pragma once

#include <memory>
#include <vector>

#include "core/timer.hpp"
#include "fluid/cut/cut_mesh.hpp"
#include "fluid/discretisation/body_force.hpp"
#include "fluid/discretisation/drives.hpp"
#include "fluid/discretisation/free_bodies.hpp"
#include "fluid/discretisation/kernel.hpp"
#include "fluid/discretisation/moving_part.hpp"
#include "fluid/discretisation/numbering.hpp"
#include "fluid/discretisation/space.hpp"
#include "fluid/discretisation/zone_correction.hpp"
#include "fluid/linear/block_matrix.hpp"
#include "fluid/linear/linear_solver.hpp"
#include "scene/fluid.hpp"

namespace fpi::fluid {

/// Nodal values of everything.
struct Fields {
  Vector u;       ///< x, y of each node [m/s]
  Vector p;       ///< of each vertex [Pa], without the hydrostatic part
  Vector lambda;  ///< x, y of each multiplier [Pa]
  Vector rigid;   ///< Vx, Vy, ω of each interface [m/s, rad/s]; read of bodies that the fluid moves
  Vector drive;   ///< size of each drive [Pa/m or Pa]
};

/// The acceleration as a function of the velocity: a = inertia · u − history (paper, eq. 10). Where nodes
/// move with bodies (an ALE frame) both are taken along their paths, and what is missing of ∂u/∂t, (∇u) w
/// with the mesh velocity w, joins convection.
struct TimeTerms {
  double inertia = 0;                 ///< 1/(γ Δt) [1/s]; zero in steady flow
  Vector history;                     ///< x, y of each node [m/s²]
  Vector mesh_velocity;               ///< x, y of each node: velocity of its path [m/s]; empty: all stay
  std::vector<std::uint8_t> follows;  ///< cells whose history is not of nodes but in `load`; empty: none
  Vector load;                        ///< x, y of each node: ∫ w · history over these cells [m³/s²]
  Vector carried;                 ///< x, y of each cell: ∫ history over it, if it is one of these [m³/s²]
  std::vector<MovingPart> parts;  ///< whose momentum is kept

  static TimeTerms steady(Index n_nodes) {
    TimeTerms terms;
    terms.history = Vector::Zero(2 * static_cast<Eigen::Index>(n_nodes));
    return terms;
  }
  bool moves() const { return mesh_velocity.size() > 0; }
  bool follows_path(Index cell) const { return !follows.empty() && follows[cell] != 0; }
  Vector acceleration(const Vector& u) const { return inertia * u - history; }
};

/// Residual before constraints: what each node, vertex, multiplier and body would have to balance [N/m, m²/s,
/// m²/s, N/m and N], and by how much the flow of each drive is too large [m²/s or m³/s].
struct Residual {
  Vector u, p, lambda, rigid, drive;
};

/// Unknowns of the blocks: (ux, uy of 6 nodes, p of 3 vertices); (ux, uy of 9 nodes); (λ of both ends of an
/// arc, then ux, uy of 6 nodes).
namespace block_size {
inline constexpr int cell = element_unknowns, ghost = 18, arc = 16;
}

class System {
 public:
  /// Takes what bodies that stayed have to do with from the cut mesh `before`.
  System(const Space& space, const scene::Fluid& parameters, std::vector<Interface> interfaces,
         const CutMesh& before, Timers& timers);

  const Space& space() const { return space_; }
  const CutMesh& cut() const { return cut_; }
  const Components& components() const { return components_; }
  const Numbering& numbering() const { return numbering_; }
  const Drives& drives() const { return drives_; }
  /// Of unknowns, those of the drives last.
  Index n_unknowns() const { return numbering_.n_equations + drives_.size(); }
  const std::vector<Interface>& interfaces() const { return interfaces_; }
  /// Length of arc that suits the mesh around each interface [m].
  const std::vector<double>& arc_lengths() const { return arc_lengths_; }
  bool same_geometry(const std::vector<Interface>& interfaces) const;

  /// Takes the velocities and balances (not the geometry) of `interfaces`.
  void set_velocities(const std::vector<Interface>& interfaces);
  /// Vx, Vy, ω of each interface: those of `rigid` where the fluid moves it, else as given.
  Vector motions(const Vector& rigid) const;
  /// Gives the bodies that the fluid moves the velocities that it found.
  void keep_motions(const Vector& rigid);
  /// Sets what drives the flow at time t [s]: body force ρb [N/m³] and boundary tractions.
  void set_load(double t, const BodyForce& body_force);

  /// That load [N/m], without the drives.
  const Vector& load() const { return load_; }
  /// Adds ∫ w·f over the fluid, f the force density at a place [N/m³], to `load` [N/m].
  void add_force_density(const std::function<Vec2(const Vec2&)>& f, Vector& load) const;

  /// Residual of eq. (20); fills the matrix with its Jacobian too where `with_jacobian`.
  Residual assemble(const Flow& flow, const Fields& fields, const TimeTerms& time, bool with_jacobian);

  /// Throws Error where a part of the fluid at sides that are all closed gains or loses volume in the flow u
  /// [m/s]: the continuity equation that its pinned pressure leaves out has a residual beyond a twentieth of
  /// what boundaries let through and bodies push.
  void check_closed_parts(const Residual& residual, const Vector& u) const;

  /// Zeros.
  Residual no_residual() const;
  /// Residual of the unknowns in the system.
  Vector gather(const Residual& residual) const;
  /// Adds `step` times an update of the unknowns to the fields.
  void add(const Vector& update, double step, Fields& fields) const;

  const std::vector<Index>& active_cells() const { return active_cells_; }
  /// Over the fluid part of the k-th active cell.
  Quadrature quadrature(std::size_t k) const;
  /// Size h of the smallest element [m].
  double smallest_size() const { return space_.smallest_size; }
  const BlockMatrix& matrix() const { return matrix_; }
  /// Factors the matrix as it stands, without the drives; its pattern is analysed once. `timers` counts
  /// analyses.
  std::shared_ptr<const Factor> factor_of_matrix(Timers& timers);
  /// Of the whole system: made from `reference` where one is given and that pays, else new, and then the
  /// reference of later ones.
  std::shared_ptr<const Factor> factor(const TimeTerms& time, std::shared_ptr<const Background>& reference,
                                       Timers& timers);
  /// Whether factors are to have the Schur complement of the bodies that the fluid moves, which tells how it
  /// resists them; where the linear solver cannot give it, or drives are unknowns, they have none.
  void want_resistance(bool wanted);
  bool wants_resistance() const { return wants_resistance_; }
  /// Whether the reference has it, if it is wanted.
  bool has_resistance(const Background& reference) const;
  /// What it has, with the bodies' own m/Δt as it is now; without entries where none is wanted.
  Eigen::MatrixXd resistance(const Background& reference) const;
  /// 1 for each equation of a velocity, 0 for all else: that follows from the velocities.
  Vector velocity_weight() const;
  /// 1 for each node in the fluid itself, 0 also where an active element reaches into a body.
  std::vector<std::uint8_t> wet_nodes() const;
  /// Root mean square of a velocity at the nodes of active elements [m/s].
  double speed(const Vector& u) const;
  /// "the largest residual is at (x, y) m", of the gathered residual.
  std::string largest_residual(const Vector& gathered) const;

  /// ∫λ and ∫(x − c) × λ over a body [N/m, N].
  struct Resultant {
    Vec2 force = Vec2::Zero();
    double torque = 0;
  };
  std::vector<Resultant> resultants(const Vector& lambda) const;
  /// Length of the bodies' surfaces in the fluid [m].
  double wetted_length() const;

 private:
  void declare_blocks();
  /// Positions in active_cells_ of the cells of one colour: straight ones, curved ones, then those that are
  /// cut or have a slip node, which go one by one.
  struct Stretch {
    Index begin, curved, single, end;
  };
  /// What all cells need.
  struct Assembly {
    const Flow& flow;
    const Fields& fields;
    const TimeTerms& time;
    const Vector& acceleration;
    Residual& residual;
    bool with_jacobian;
  };
  void order_cells();
  Drives make_drives(const scene::Fluid& parameters) const;
  void assemble_cells(const Assembly& what);
  void assemble_several(const Assembly& what, Index begin, Index end);
  void assemble_single(const Assembly& what, Index k);
  void assemble_ghost(const Flow& flow, const Fields& fields, const TimeTerms& time,
                      const Vector& acceleration, Residual& residual, bool with_jacobian);
  void assemble_arcs(const Fields& fields, Residual& residual, bool with_jacobian);
  bool has_slip_node(std::span<const Index> nodes) const;
  void rotate_slip(std::span<const Index> nodes, int first_x, int first_y, int n, double* dense) const;

  /// Over one arc piece, with each of its two multipliers' functions φ.
  struct PieceIntegrals {
    std::array<Padded, 2> shape{Padded::Zero(), Padded::Zero()};  ///< ∫ φ N_i
    std::array<Vec2, 2> velocity{Vec2::Zero(), Vec2::Zero()};     ///< ∫ φ u of the body
    std::array<Vec2, 2> arm{Vec2::Zero(), Vec2::Zero()};          ///< ∫ φ (x − c)
    std::array<double, 2> length{};                               ///< ∫ φ
  };

  const Space& space_;
  scene::Embedding embedding_;
  std::string linear_solver_;
  std::vector<Interface> interfaces_;
  CutMesh cut_;
  Components components_;
  std::vector<double> arc_lengths_;
  Numbering numbering_;
  std::vector<Index> active_cells_;
  std::vector<Stretch> stretches_;  // of each colour
  std::vector<Index> cut_index_;    // of each active cell in cut_.cut_cells, or −1
  std::vector<PieceIntegrals> pieces_;
  FreeBodies free_bodies_;
  Drives drives_;
  Vector load_;
  bool has_load_ = false;
  Index first_ghost_ = 0, first_piece_ = 0;  // block numbers
  BlockMatrix matrix_;
  std::shared_ptr<const Analysis> analysis_;
  bool wants_resistance_ = false;  // from factors
};

}  // namespace fpi::fluid
