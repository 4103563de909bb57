#include "fluid/scene_mesh.hpp"

#include "core/error.hpp"
#include "fluid/circle_fit.hpp"
#include "fluid/gmsh.hpp"
#include "fluid/rectangle.hpp"

namespace fpi::fluid {
namespace {

/// Grid lines along one axis (0: x, 1: y).
std::vector<double> lines(const scene::Mesh& m, int axis) {
  const double lower = m.lower[axis], upper = m.upper[axis];
  if (m.cell_size == 0)
    return crowded_lines(lower, upper, static_cast<Index>(axis == 0 ? m.cells_x : m.cells_y), m.crowding);
  const bool everywhere = m.fine_region.empty();
  return graded_lines(lower, upper, everywhere ? lower : m.fine_region[axis],
                      everywhere ? upper : m.fine_region[axis + 2], m.cell_size, m.growth,
                      m.largest_cell_size);
}

}  // namespace

Mesh scene_mesh(const scene::Mesh& parameters, const std::string& file_name, std::string_view file_text) {
  if (parameters.file.empty())
    return make_rectangle(lines(parameters, 0), lines(parameters, 1), parameters.refinements);
  require(!file_text.empty(), "the bytes of the mesh {} are required; got none: the coupler must send them",
          parameters.file);
  Mesh mesh = read_gmsh(file_text, file_name);
  for (const scene::Circle& circle : parameters.circles)
    fit_circle(mesh, circle.boundary, {circle.centre[0], circle.centre[1]}, circle.radius);
  return mesh;
}

}  // namespace fpi::fluid
