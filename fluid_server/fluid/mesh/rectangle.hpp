/// The built-in mesh: a rectangle of right triangles between grid lines, uniform or graded, which refinements
/// halve where they want smaller ones; with sides left, right, bottom, top.
#pragma once

#include <span>

#include "fluid/mesh/mesh.hpp"
#include "scene/fluid.hpp"

namespace fpi::fluid {

/// Grid lines from `lower` to `upper`: `cell_size` inside [fine_lower, fine_upper], growing outwards by the
/// ratio `growth` from cell to cell up to `largest` (0: no limit). The whole fine interval is divided evenly,
/// and the outer parts are stretched a little to end on the sides. All [m].
std::vector<double> graded_lines(double lower, double upper, double fine_lower, double fine_upper,
                                 double cell_size, double growth, double largest);

std::vector<double> uniform_lines(double lower, double upper, Index cells);
/// Uniform lines at `crowding` 0, a cosine's at 1, in between a mixture.
std::vector<double> graded_lines(double lower, double upper, Index cells, double crowding);

/// Triangles between grid lines, the diagonals alternating; at the four corners they end in the corner, so
/// that no triangle has two sides on the boundary (its corner pressure would not be controlled). With
/// refinements they are halved until every one is as small as is wanted anywhere in it (Mesh::size against
/// wanted_size); then none has all its vertices on the boundary either. Along an axis that is periodic the
/// two sides are joined (make_periodic), and refined alike; refinements then need three cells there.
Mesh make_rectangle(const std::vector<double>& x, const std::vector<double>& y,
                    std::span<const scene::Refinement> refinements = {},
                    const std::array<bool, 2>& periodic = {});

}  // namespace fpi::fluid
