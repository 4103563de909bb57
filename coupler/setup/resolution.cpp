#include "setup/resolution.hpp"

#include <fmt/format.h>

namespace fpi {

Resolution resolution(const scene::Scene& scene, const CoupledProblem& problem) {
  constexpr std::string_view prefix = "resolution:";
  Resolution out;
  for (const auto& [role, figures] : problem.solvers().configured_figures())
    for (const auto& [name, value] : figures)
      if (name.starts_with(prefix)) out.figures[name.substr(prefix.size())] = value;
  if (!scene.time.steady) out.figures["time_step"] = scene.time.step;
  const std::vector<double>& lengths = problem.solvers().arc_lengths();
  for (std::size_t i = 0; scene.fluid && i < lengths.size(); ++i) {
    if (!(lengths[i] > 0)) continue;  // its fluid was not asked
    const double spans = elements_per_diameter(scene, i, lengths[i]);
    if (!out.coarsest_body.empty() && spans >= out.figures["elements_per_diameter"]) continue;
    out.coarsest_body = scene.bodies[i].name;
    out.figures["elements_per_diameter"] = spans;
  }
  return out;
}

std::vector<std::string> describe(const Resolution& resolution) {
  std::vector<std::string> lines;
  const auto value = [&](const char* name) {
    const auto found = resolution.figures.find(name);
    return found == resolution.figures.end() ? 0.0 : found->second;
  };
  if (value("expected_unknowns") > 0)
    lines.push_back(fmt::format("up to {:.0f} unknowns, about {:.0f} MB in the fluid program",
                                value("expected_unknowns"), value("expected_memory_bytes") / (1 << 20)));
  if (!resolution.coarsest_body.empty())
    lines.push_back(fmt::format("{:.3g} elements or more across the diameter of every body (\"{}\")",
                                value("elements_per_diameter"), resolution.coarsest_body));
  if (value("speed") > 0)
    lines.push_back(
        fmt::format("with the {:.3g} m/s that the scene gives: Reynolds number {:.3g}, of an element {:.3g}, "
                    "Courant number "
                    "{:.3g}",
                    value("speed"), value("reynolds"), value("cell_reynolds"), value("courant")));
  if (value("viscous_number") > 0)
    lines.push_back(fmt::format("the time step is {:.3g} of the viscous time h²/ν of the smallest element",
                                value("viscous_number")));
  if (value("contact_time") > 0 && value("time_step") > 0)
    lines.push_back(fmt::format("the shortest impact takes about {:.2g} s, a time step {:.3g} of that",
                                value("contact_time"), value("time_step") / value("contact_time")));
  return lines;
}

}  // namespace fpi
