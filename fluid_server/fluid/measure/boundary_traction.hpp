/// Traction of the fluid on the boundaries that hold it, recovered from the residual: the continuous P2 field
/// t with ∫ t·w = −residual(w) for the functions w of a boundary's nodes. No gradient is taken, and its
/// integral is the sum of the nodal reactions.
#pragma once

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <string>
#include <vector>

#include "fluid/discretisation/boundary.hpp"
#include "fluid/mesh/mesh.hpp"

namespace fpi::fluid {

/// A named boundary that constrains the velocity, as points and quadratic lines. At a corner each side has a
/// point of its own, since the traction has two values there.
struct BoundaryCurve {
  std::string name;
  Vec2 centre = Vec2::Zero();  ///< that torques are about: centroid of a closed boundary's inside, else of
                               ///< its length [m]
  std::vector<Index> nodes;    ///< of each point
  std::vector<std::array<Index, 3>> lines;  ///< points: both ends, then the middle
};

/// What the fluid does to a BoundaryCurve; like the pressure without its hydrostatic part.
struct BoundaryTraction {
  Vec2 force = Vec2::Zero();  ///< [N/m]
  double torque = 0;          ///< about the curve's centre [N]
  std::vector<Vec2> values;   ///< at each point [Pa]
};

/// Where parts of different names meet, or the boundary turns by more than 30°, is a corner: the traction is
/// linear along the line before it (the corner's value is extrapolated, its test function left out), and what
/// is left of the corner's reaction counts to the sides in equal shares, so that the forces of all parts add
/// up to all of the residual.
class BoundaryTractions {
 public:
  BoundaryTractions(const Mesh& mesh, const Boundary& boundary);
  BoundaryTractions(const BoundaryTractions&) = delete;
  BoundaryTractions& operator=(const BoundaryTractions&) = delete;

  const std::vector<BoundaryCurve>& curves() const { return curves_; }
  /// `reaction`: x, y of each node, minus the residual of the momentum equation [N/m]. In the order of
  /// curves().
  std::vector<BoundaryTraction> recover(const Vector& reaction) const;

 private:
  struct Line {
    Index curve;
    std::array<Index, 3> nodes, points;  ///< points: of the curve
    std::array<Index, 3> equations;      ///< −1: the value follows from the others
    Eigen::Matrix3d mass;                ///< ∫ N_i N_j [m]
    Eigen::Matrix<double, 2, 3> moment;  ///< ∫ (x − centre) N_i [m²]
    Eigen::Matrix3d expansion;           ///< values of the points from those that have equations
  };
  /// The end of a line.
  struct End {
    Index line;
    int end;
  };
  void find_curves(const Boundary& boundary);
  void number_points();
  void integrate();
  void factor();
  bool is_corner(const std::vector<End>& ends) const;

  const Mesh& mesh_;
  std::vector<BoundaryCurve> curves_;
  std::vector<Line> lines_;
  std::vector<std::vector<End>> corners_;
  std::vector<Index> equation_node_;
  Eigen::SparseLU<Eigen::SparseMatrix<double>> mass_;
};

}  // namespace fpi::fluid
