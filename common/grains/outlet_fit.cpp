#include "grains/outlet_fit.hpp"

#include <algorithm>
#include <limits>

#include "core/error.hpp"

namespace fpi::grains {
namespace {

/// Width [m] of an outlet along the axis along which it is narrowest; one as long as a periodic box has no
/// ends.
struct Width {
  double width = std::numeric_limits<double>::infinity();
  std::size_t axis = 0;
};

Width least_width(const scene::Scene& scene, const scene::Outlet& outlet) {
  Width least;
  for (std::size_t axis = 0; axis < outlet.lower.size(); ++axis) {
    const std::vector<double>& planes = scene.periodic.along(static_cast<int>(axis));
    const double width = outlet.upper[axis] - outlet.lower[axis];
    if (!planes.empty() && width >= planes[1] - planes[0]) continue;
    if (width < least.width) least = {width, axis};
  }
  return least;
}

/// The free bodies by diameter.
struct Free {
  const scene::Body *smallest = nullptr, *largest = nullptr;
  std::size_t wider = 0;  ///< than an outlet

  Free(const scene::Scene& scene, double width) {
    for (const scene::Body& body : scene.bodies) {
      if (!body.is_free()) continue;
      if (!smallest || body.radius < smallest->radius) smallest = &body;
      if (!largest || body.radius > largest->radius) largest = &body;
      if (2 * body.radius > width) ++wider;
    }
  }
};

}  // namespace

void check_outlets(const scene::Scene& scene) {
  for (const scene::Outlet& outlet : scene.outlets) {
    const auto [width, axis] = least_width(scene, outlet);
    const Free free(scene, width);
    require(!free.smallest || 2 * free.smallest->radius <= width,
            "outlet {} must hold a body as a whole, which then leaves; along {} it is {:g} m wide, and the "
            "smallest free body, {}, is {:g} m: make it wider",
            outlet.name, "xyz"[axis], width, free.smallest ? free.smallest->name : "",
            free.smallest ? 2 * free.smallest->radius : 0);
  }
}

std::vector<std::string> narrow_outlets(const scene::Scene& scene) {
  std::vector<std::string> sentences;
  for (const scene::Outlet& outlet : scene.outlets) {
    const auto [width, axis] = least_width(scene, outlet);
    const Free free(scene, width);
    if (free.wider > 0)
      sentences.push_back(fmt::format(
          "{} of the free bodies never leave through outlet {}, which is {:g} m wide along {}: the largest, "
          "{}, is "
          "{:g} m, and a body leaves where it is wholly inside",
          free.wider, outlet.name, width, "xyz"[axis], free.largest->name, 2 * free.largest->radius));
  }
  return sentences;
}

}  // namespace fpi::grains
