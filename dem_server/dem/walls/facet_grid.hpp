/// The facets of a wall sorted into the cells of a grid, so that a grain in a mesh of thousands meets those
/// near it only. The grid is the wall's own and moves with it.
#pragma once

#include <cstdint>

#include "dem/walls/facets.hpp"

namespace fpi::dem {

class FacetGrid {
 public:
  FacetGrid() = default;
  explicit FacetGrid(const std::vector<Facet>& facets);

  /// Every facet whose bounds meet `box`, and perhaps others: in ascending order, each once.
  void find(const Box& box, std::vector<std::uint32_t>& found) const;

 private:
  struct Cells {
    std::array<std::size_t, 3> first, last;
  };
  void choose_cells(const Vec3& extent, double most);
  Cells cells_of(const Box& box) const;
  template <class Visit>
  void each_cell(const Box& box, Visit visit) const;

  std::uint32_t n_facets_ = 0;
  Box all_;
  double size_ = 0;  ///< of a cell [m]; 0: few facets, and no cells
  std::array<std::size_t, 3> n_{};
  std::vector<std::size_t> start_;    ///< of each cell in facet_
  std::vector<std::uint32_t> facet_;  ///< of each cell
};

}  // namespace fpi::dem
