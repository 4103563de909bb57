#include "fluid/mesh/rectangle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "fluid/mesh/bisection.hpp"
#include "fluid/mesh/periodic_mesh.hpp"
#include "fluid/mesh/size_field.hpp"

namespace fpi::fluid {
namespace {

constexpr double most_lines = 1e5, most_cells = 1e7;

/// Distances 0 = d0 < d1 < … = length that start near `first` and grow by `growth` up to `largest`.
std::vector<double> growing_distances(double length, double first, double growth, double largest) {
  std::vector<double> d{0};
  if (length <= 0) return d;
  double step = first;
  while (d.back() < length) {
    require(
        d.size() < most_lines,
        "at most {:g} grid lines along a side are taken; the cell size {:g} m asks for more: make it larger",
        most_lines, first);
    step = std::min(step * growth, largest);
    d.push_back(d.back() + step);
  }
  // Ending nearer to the last line or the one before it decides whether steps are squeezed or stretched.
  if (d.size() > 2 && d.back() - length > length - d[d.size() - 2]) d.pop_back();
  const double scale = length / d.back();
  for (double& value : d) value *= scale;
  return d;
}

/// Triangles between grid lines with the diagonal as edge 01, as Bisection wants them.
Bisection halved_cells(const std::vector<double>& x, const std::vector<double>& y, bool has_corners) {
  const Index nx = static_cast<Index>(x.size()) - 1, ny = static_cast<Index>(y.size()) - 1;
  require(nx >= 1 && ny >= 1, "a rectangle needs at least one cell each way; got {} × {}", nx, ny);
  require(static_cast<double>(nx) * ny <= most_cells,
          "at most {:g} cells of two triangles are taken; got {} × {}: make the cells larger", most_cells, nx,
          ny);
  std::vector<Vec2> vertices;
  for (double yj : y)
    for (double xi : x) vertices.emplace_back(xi, yj);

  std::vector<std::array<Index, 3>> triangles;
  for (Index j = 0; j < ny; ++j) {
    for (Index i = 0; i < nx; ++i) {
      const Index a = j * (nx + 1) + i, b = a + 1, d = a + nx + 1, c = d + 1;
      const bool at_left = i == 0, at_right = i == nx - 1, at_bottom = j == 0, at_top = j == ny - 1;
      bool rising = (i + j) % 2 == 0;  // diagonal from lower left to upper right
      if (has_corners && ((at_left && at_bottom) || (at_right && at_top))) rising = true;
      if (has_corners && ((at_left && at_top) || (at_right && at_bottom))) rising = false;
      if (rising) {
        triangles.push_back({c, a, b});
        triangles.push_back({a, c, d});
      } else {
        triangles.push_back({b, d, a});
        triangles.push_back({d, b, c});
      }
    }
  }
  return {std::move(vertices), std::move(triangles)};
}

/// Halves a triangle while it is larger than wanted anywhere in it, or has all its vertices on the boundary.
/// Halves that neighbours leave behind are smaller, so one pass over all triangles is enough.
void refine(Bisection& mesh, const Period& sides, std::span<const scene::Refinement> refinements) {
  const auto is_outer = [&](Index v) {
    const Vec2& x = mesh.vertices()[v];
    const auto at_side = [&](int axis) {
      return !sides.along[axis] && (x[axis] == sides.lower[axis] || x[axis] == sides.upper[axis]);
    };
    return at_side(0) || at_side(1);
  };
  constexpr double round_off = 1e-9;  // a size met exactly is small enough
  const auto is_too_large = [&](Index t) {
    const auto& [va, vb, vc] = mesh.triangle(t);
    const Vec2 &a = mesh.vertices()[va], &b = mesh.vertices()[vb], &c = mesh.vertices()[vc];
    const Vec2 centre = (a + b + c) / 3;
    const double reach = std::sqrt(
        std::max({(a - centre).squaredNorm(), (b - centre).squaredNorm(), (c - centre).squaredNorm()}));
    return std::sqrt(cross(b - a, c - a)) > (1 + round_off) * wanted_size(refinements, centre, reach);
  };
  for (Index t = 0; t < mesh.n_triangles(); ++t)
    while (std::ranges::all_of(mesh.triangle(t), is_outer) || is_too_large(t)) mesh.bisect(t);
}

}  // namespace

std::vector<double> uniform_lines(double lower, double upper, Index cells) {
  std::vector<double> lines(cells + 1);
  for (Index i = 0; i <= cells; ++i) lines[i] = lower + (upper - lower) * i / cells;
  return lines;
}

std::vector<double> graded_lines(double lower, double upper, Index cells, double crowding) {
  std::vector<double> lines = uniform_lines(0, 1, cells);
  for (double& t : lines)
    t = lower +
        (upper - lower) * ((1 - crowding) * t + crowding * (0.5 - 0.5 * std::cos(std::numbers::pi * t)));
  lines.back() = upper;
  return lines;
}

std::vector<double> graded_lines(double lower, double upper, double fine_lower, double fine_upper,
                                 double cell_size, double growth, double largest) {
  fine_lower = std::clamp(fine_lower, lower, upper);
  fine_upper = std::clamp(fine_upper, lower, upper);
  require(fine_lower < fine_upper,
          "the fine region must overlap the rectangle; got [{:g}, {:g}] m in [{:g}, {:g}] m", fine_lower,
          fine_upper, lower, upper);
  if (largest <= 0) largest = upper - lower;
  const auto below = growing_distances(fine_lower - lower, cell_size, growth, largest);
  const auto above = growing_distances(upper - fine_upper, cell_size, growth, largest);
  require(
      (fine_upper - fine_lower) / cell_size < most_lines,
      "at most {:g} grid lines along a side are taken; the cell size {:g} m asks for more: make it larger",
      most_lines, cell_size);
  const Index n_fine =
      std::max<Index>(1, static_cast<Index>(std::lround((fine_upper - fine_lower) / cell_size)));

  std::vector<double> lines;
  for (std::size_t i = below.size() - 1; i > 0; --i) lines.push_back(fine_lower - below[i]);
  for (double line : uniform_lines(fine_lower, fine_upper, n_fine)) lines.push_back(line);
  for (std::size_t i = 1; i < above.size(); ++i) lines.push_back(fine_upper + above[i]);
  lines.front() = lower;
  lines.back() = upper;
  return lines;
}

Mesh make_rectangle(const std::vector<double>& x, const std::vector<double>& y,
                    std::span<const scene::Refinement> refinements, const std::array<bool, 2>& periodic) {
  const Period sides{{x.front(), y.front()}, {x.back(), y.back()}, periodic};
  Bisection mesh = halved_cells(x, y, !sides.any());
  if (!refinements.empty()) {
    for (int axis : {0, 1}) {
      if (!periodic[axis]) continue;
      const std::size_t cells = (axis == 0 ? x : y).size() - 1;
      require(cells >= 3, "a period that is refined needs at least three cells before; got {} along {}",
              cells, axis == 0 ? "x" : "y");
      mesh.join_sides(axis);
    }
    refine(mesh, sides, refinements);
  }

  enum : Index { left, right, bottom, top };
  std::vector<NamedEdge> edges;
  for (const auto& edge : mesh.boundary()) {
    const Vec2 &a = mesh.vertices()[edge[0]], &b = mesh.vertices()[edge[1]];
    const bool upright = a.x() == b.x();
    const Index side = upright ? (a.x() == x.front() ? left : right) : (a.y() == y.front() ? bottom : top);
    edges.push_back({edge, side});
  }
  Mesh out = make_mesh(mesh.vertices(), mesh.triangles(), edges, {"left", "right", "bottom", "top"});
  make_periodic(out, sides);
  return out;
}

}  // namespace fpi::fluid
