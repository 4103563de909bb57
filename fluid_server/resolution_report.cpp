#include "resolution_report.hpp"

#include <algorithm>
#include <cmath>

#include "core/expression.hpp"
#include "core/pages.hpp"
#include "measurements.hpp"

namespace fpi::fluid {
namespace {

// What docs/numerics.md ("What resolution supports") measures.
constexpr double largest_cell_reynolds = 80;
constexpr double largest_courant = 5;
constexpr double creeping_body = 2, creeping_channel = 10;  ///< Reynolds numbers

/// Fits of peak memory over unknowns, see docs/numerics.md [B].
double expected_memory(double unknowns) {
  constexpr double base = 2.6e7, per_unknown = -130, per_fill = 228;
  return base + unknowns * (per_unknown + per_fill * std::log2(std::max(unknowns, 4.0)));
}

double diameter(const Surface& surface) { return std::sqrt(4 * surface.area() / M_PI); }

/// Largest speed of a body's surface that its formulas give over the run [m/s]; of a free one that at the
/// start.
double given_speed(const scene::Body& body, double reach, double end) {
  constexpr int samples = 64;
  if (body.is_free()) return std::hypot(body.velocity[0], body.velocity[1]) + std::abs(body.spin[0]) * reach;
  if (body.motion != "prescribed") return 0;
  const Expression x(body.prescribed_velocity[0]), y(body.prescribed_velocity[1]), spin(body.prescribed_spin);
  double largest = 0;
  for (int k = 0; k <= samples; ++k) {
    const double t = end * k / samples;
    largest = std::max(largest, std::hypot(x(0, 0, t), y(0, 0, t)) + std::abs(spin(0, 0, t)) * reach);
  }
  return largest;
}

std::string at(const Vec2& place) { return fmt::format("({:.4g}, {:.4g}) m", place.x(), place.y()); }

}  // namespace

void ResolutionReport::begin(const scene::Scene& scene, const NavierStokes& solver, Findings& findings) {
  const scene::Fluid& fluid = *scene.fluid;
  const Mesh& mesh = solver.mesh();
  convection_ = fluid.convection;
  viscosity_ = fluid.viscosity() / fluid.density;
  time_step_ = scene.time.steady ? 0 : std::max(scene.time.step, scene.time.max_step);
  smallest_ = mesh.size(0);
  for (Index c = 0; c < mesh.n_cells(); ++c) smallest_ = std::min(smallest_, mesh.size(c));
  unknowns_ = 2.0 * mesh.n_nodes() + mesh.n_vertices();
  const auto memory = static_cast<double>(machine_memory());
  if (const double expected = expected_memory(unknowns_); expected > memory)
    findings.warn(
        "fluid.mesh",
        "about {:.3g} GB of memory are expected for {:.3g} unknowns, and this machine has {:.3g} GB: "
        "the system may end the run; take larger elements, or another machine",
        expected / 1e9, unknowns_, memory / 1e9);
  const Box box = mesh.box();
  length_ = (box.upper - box.lower).minCoeff();
  length_of_ = "the mesh";
  Resolution given;
  try {
    given = solver.given_resolution(scene.time.steady ? 0 : scene.time.end, scene.time.step);
    double widest = 0;
    for (const scene::Body& body : scene.bodies) {
      if (!body.is_plane()) continue;
      const Surface surface = fluid::surface(body, scene.hydraulic_radius_ratio);
      const double D = diameter(surface);
      if (D > widest) {
        widest = length_ = D;
        length_of_ = "the body \"" + body.name + "\"";
      }
      const double reach = 0.5 * (surface.upper() - surface.lower()).norm();
      const double speed = given_speed(body, reach, scene.time.steady ? 0 : scene.time.end);
      if (speed == 0) continue;
      const double h = solver.arc_length(surface) / fluid.embedding.arc_ratio;
      if (!(h > 0)) continue;
      const Vec2 centre(body.position[0], body.position[1]);
      given.include({speed, {speed * h / viscosity_, centre}, {speed * scene.time.step / h, centre}});
    }
  } catch (const Error& e) {
    findings.warn("fluid", "a formula of the run has no value at a later time: {}", e.what());
  }
  judge(given, "as the scene gives it", findings);
}

std::vector<Finding> ResolutionReport::accept(const NavierStokes& solver) {
  Findings findings;
  judge(solver.resolution(), fmt::format("at t = {:g} s", solver.state().time), findings);
  if (const std::string doubt = solver.doubtful_net_flux(); !doubt.empty())
    warn_once("fluid.boundaries", doubt, findings);
  return findings.all();
}

void ResolutionReport::judge(const Resolution& now, const std::string& when, Findings& findings) {
  largest_.include(now);
  const double reynolds = now.speed * length_ / viscosity_;
  const bool creeps = reynolds <= (length_of_ == "the mesh" ? creeping_channel : creeping_body);
  if (!convection_ && !creeps)
    warn_once(
        "fluid.convection",
        fmt::format("convection is left out, but the Reynolds number {} is {:.3g} ({:.3g} m/s, {:.3g} m of "
                    "{}): its part in the forces is not small above {:g}; set fluid.convection = true",
                    when, reynolds, now.speed, length_, length_of_,
                    length_of_ == "the mesh" ? creeping_channel : creeping_body),
        findings);
  if (convection_ && now.cell_reynolds.value > largest_cell_reynolds)
    warn_once("fluid.mesh",
              fmt::format("the cell Reynolds number |u| h/ν {} is {:.3g} in the element at {}, above {:g}: "
                          "boundary layers and wakes there are not resolved; take smaller elements",
                          when, now.cell_reynolds.value, at(now.cell_reynolds.place), largest_cell_reynolds),
              findings);
  if (now.courant.value > largest_courant)
    warn_once(
        "time.step",
        fmt::format("the Courant number |u| Δt/h {} is {:.3g} in the element at {}, above {:g}: what the "
                    "flow carries along is not resolved in time; take smaller steps",
                    when, now.courant.value, at(now.courant.place), largest_courant),
        findings);
}

void ResolutionReport::warn_once(const std::string& key, const std::string& text, Findings& findings) {
  if (told_.insert(key).second) findings.warn(key, "{}", text);
}

proto::Figures ResolutionReport::figures() const {
  return {{"resolution:expected_unknowns", unknowns_},
          {"resolution:expected_memory_bytes", expected_memory(unknowns_)},
          {"resolution:speed", largest_.speed},
          {"resolution:reynolds", largest_.speed * length_ / viscosity_},
          {"resolution:cell_reynolds", largest_.cell_reynolds.value},
          {"resolution:courant", largest_.courant.value},
          {"resolution:viscous_number", viscosity_ * time_step_ / (smallest_ * smallest_)}};
}

}  // namespace fpi::fluid
