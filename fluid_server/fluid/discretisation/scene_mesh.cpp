#include "fluid/discretisation/scene_mesh.hpp"

#include "core/context.hpp"
#include "fluid/discretisation/boundary.hpp"
#include "fluid/mesh/circle_fit.hpp"
#include "fluid/mesh/gmsh.hpp"
#include "fluid/mesh/periodic_mesh.hpp"
#include "fluid/mesh/rectangle.hpp"

namespace fpi::fluid {
namespace {

/// Grid lines along one axis (0: x, 1: y).
std::vector<double> lines(const scene::Mesh& m, int axis) {
  const double lower = m.lower[axis], upper = m.upper[axis];
  if (m.cell_size == 0)
    return graded_lines(lower, upper, static_cast<Index>(axis == 0 ? m.cells_x : m.cells_y), m.crowding);
  const bool everywhere = m.fine_region.empty();
  return graded_lines(lower, upper, everywhere ? lower : m.fine_region[axis],
                      everywhere ? upper : m.fine_region[axis + 2], m.cell_size, m.growth,
                      m.largest_cell_size);
}

Period period(const scene::Periodic& periodic) {
  Period out;
  for (const int axis : {0, 1}) {
    const auto& planes = periodic.along(axis);
    if (planes.empty()) continue;
    out.lower[axis] = planes[0];
    out.upper[axis] = planes[1];
    out.along[axis] = true;
  }
  return out;
}

std::vector<std::string> names(const std::map<std::string, scene::Boundary>& boundaries) {
  std::vector<std::string> out;
  for (const auto& [name, boundary] : boundaries) out.push_back(name);
  return out;
}

}  // namespace

Mesh scene_mesh(const scene::Fluid& fluid, const scene::Periodic& periodic, std::string_view file_text) {
  const scene::Mesh& parameters = fluid.mesh;
  const Period sides = period(periodic);
  if (parameters.file.empty())
    return make_rectangle(lines(parameters, 0), lines(parameters, 1), parameters.refinements, sides.along);
  Mesh mesh = read_gmsh(file_text, parameters.file, names(fluid.boundaries));
  in_context(parameters.file, [&] {
    for (const scene::Circle& circle : parameters.circles)
      fit_circle(mesh, circle.boundary, {circle.centre[0], circle.centre[1]}, circle.radius);
    make_periodic(mesh, sides);
    unmatched(mesh, fluid.boundaries).raise();
  });
  return mesh;
}

}  // namespace fpi::fluid
