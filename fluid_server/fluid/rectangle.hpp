/// The built-in mesh: a rectangle of right triangles, uniform or graded, with sides left, right, bottom, top.
#pragma once

#include "fluid/mesh.hpp"

namespace fpi::fluid {

/// Grid lines from `lower` to `upper`: `cell_size` inside [fine_lower, fine_upper], growing outwards by the
/// ratio `growth` from cell to cell up to `largest` (0: no limit). The whole fine interval is divided evenly,
/// and the outer parts are stretched a little to end on the sides. All [m].
std::vector<double> graded_lines(double lower, double upper, double fine_lower, double fine_upper,
                                 double cell_size, double growth, double largest);

std::vector<double> uniform_lines(double lower, double upper, Index cells);

/// Triangles between grid lines, the diagonals alternating; at the four corners they end in the corner, so
/// that no triangle has two sides on the boundary (its corner pressure would not be controlled).
Mesh make_rectangle(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace fpi::fluid
