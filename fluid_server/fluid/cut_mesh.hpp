/// The mesh as the bodies cut it: which elements are fluid, cut or deactivated (paper, section 2.4),
/// quadrature of the cut ones over Ω⁺, and the arcs split where they cross mesh edges. Only elements near a
/// body are looked at.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "fluid/element.hpp"
#include "fluid/knots.hpp"
#include "fluid/locator.hpp"
#include "fluid/mesh.hpp"

namespace fpi::fluid {

enum class CellState : std::uint8_t { fluid, cut, solid };

/// A body as the mesh sees it: once, and again for each periodic side that it reaches over.
struct Image {
  Index interface;  ///< index in the list of interfaces
  Vec2 shift;       ///< from the body to its image, whole periods [m]
  Outline outline;  ///< shifted
};

/// A stretch of one arc (or edge) inside one element.
struct ArcPiece {
  Index cell;
  Index interface;                   ///< index in the list of interfaces
  Index arc;                         ///< number of the arc on its body
  std::array<Index, 2> multipliers;  ///< of the arc, numbered through all interfaces
  double start, end;                 ///< parameters of the outline
  Vec2 shift;                        ///< of the image that lies in the element [m]
};

struct CutCell {
  Index cell;
  std::vector<ElementPoint> points;  ///< over the fluid part; weights in m²
  Metric<double> metric;             ///< of the straight element, its area 1 m²: weights have it already
};

/// A node inside a body, which moves with it.
struct CoveredNode {
  Index node;
  Index interface;
  Vec2 shift;  ///< of the image that covers it [m]
};

struct CutMesh {
  std::vector<Image> images;
  std::vector<CellState> state;  ///< of every cell
  std::vector<CutCell> cut_cells;
  std::vector<ArcPiece> pieces;
  std::vector<Index> ghost_edges;       ///< between two active cells of which one is cut
  std::vector<CoveredNode> covered;     ///< nodes inside a body
  std::vector<Knots> knots;             ///< of each interface
  std::vector<Index> first_multiplier;  ///< of each interface; one more entry at the end
  std::vector<double> active_length;    ///< ∫ of each multiplier's function in the fluid [m]

  bool is_active(Index cell) const { return state[cell] != CellState::solid; }
  Index n_multipliers() const { return first_multiplier.back(); }
};

std::vector<Image> images(const Period& period, std::span<const Interface> interfaces);
std::vector<Outline> outlines(std::span<const Image> images);

/// Sets the active lengths, by the pieces.
void measure_multipliers(std::span<const Interface> interfaces, CutMesh& cut);

CutMesh cut_mesh(const Mesh& mesh, const Locator& locator, std::span<const Interface> interfaces);

/// Arc length that suits the mesh around an outline: `ratio` times the mean size h of the elements it cuts; 0
/// outside the mesh.
double wanted_arc_length(const Mesh& mesh, const Locator& locator, const Outline& outline, double ratio);

}  // namespace fpi::fluid
