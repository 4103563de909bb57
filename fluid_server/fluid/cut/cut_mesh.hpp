/// The mesh as the bodies cut it: which elements are fluid, cut or deactivated (paper, section 2.4),
/// quadrature of the cut ones over Ω⁺, and the arcs split where they cross mesh edges. Only elements near a
/// body that moved are looked at; what belongs to others is shared with the cut mesh before.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "fluid/base/element.hpp"
#include "fluid/cut/ghost_penalty.hpp"
#include "fluid/cut/intersected_cells.hpp"
#include "fluid/cut/multiplier_nodes.hpp"

namespace fpi::fluid {

enum class CellState : std::uint8_t { fluid, cut, solid };

/// A stretch of one arc (or edge) inside one element.
struct ArcPiece {
  Index cell;
  Index interface;                   ///< index in the list of interfaces
  Index arc;                         ///< number of the arc on its body
  std::array<Index, 2> multipliers;  ///< of the arc, numbered through all interfaces
  double start, end;                 ///< parameters of the surface
  Vec2 shift;                        ///< of the image that lies in the element [m]
};

/// What bodies leave of one cell, the same as long as none of them moves.
struct CutCell {
  /// A part of a surface inside the cell and outside all other bodies.
  struct Stretch {
    Index own;          ///< whose it is, of intersected_cells_of
    double start, end;  ///< parameters of the surface
  };
  Index cell;
  std::vector<std::shared_ptr<const IntersectedCells>> intersected_cells_of;  ///< of the bodies that cut it
  std::vector<Stretch> stretches;
  std::vector<ElementPoint> points;  ///< over the fluid part; weights in m²
  Metric<double> metric;             ///< of the straight element, its area 1 m²: weights have it already
  double share;                      ///< of the cell that is in the fluid
};

/// A node inside a body, which moves with it.
struct CoveredNode {
  Index node;
  Index interface;
  Vec2 shift;  ///< of the image that covers it [m]
};

struct CutMesh {
  std::vector<Image> images;
  std::vector<CellState> state;                           ///< of every cell
  std::vector<std::shared_ptr<const CutCell>> cut_cells;  ///< ascending
  std::vector<ArcPiece> pieces;
  /// Of the edges between two active cells of which one is cut, ascending.
  std::vector<std::shared_ptr<const GhostFace>> ghost_faces;
  std::vector<CoveredNode> covered;               ///< nodes inside a body
  std::vector<MultiplierNodes> multiplier_nodes;  ///< of each interface
  std::vector<Index> first_multiplier;            ///< of each interface; one more entry at the end
  std::vector<double> active_length;              ///< ∫ of each multiplier's function in the fluid [m]

  bool is_active(Index cell) const { return state[cell] != CellState::solid; }
  Index n_multipliers() const { return first_multiplier.back(); }
};

/// Sets the active lengths, by the pieces.
void measure_multipliers(std::span<const Interface> interfaces, CutMesh& cut);

/// The same to the bit whatever was `before`; what bodies that stayed have to do with is taken from there.
CutMesh cut_mesh(const Mesh& mesh, const Locator& locator, std::span<const Interface> interfaces,
                 const CutMesh& before = {});

}  // namespace fpi::fluid
