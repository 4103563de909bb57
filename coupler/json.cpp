#include "json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace fpi {
namespace {

using Json = nlohmann::ordered_json;

/// A participant's figure: 0 where the run has no such participant, null where it was lost before it could
/// say.
Json figure(const Summary& summary, const std::string& role, const std::string& name) {
  const auto participant = summary.figures.find(role);
  if (participant == summary.figures.end()) return 0;
  const auto& figures = participant->second;
  const auto found = std::ranges::find(figures, name, &proto::Figures::value_type::first);
  return found == figures.end() ? Json() : Json(found->second);
}

/// The same, for counts.
Json count(const Summary& summary, const std::string& role, const std::string& name) {
  const Json value = figure(summary, role, name);
  return value.is_null() ? value : Json(static_cast<std::uint64_t>(std::max(0.0, value.get<double>())));
}

Json vector(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json bodies(const Summary& summary) {
  Json list = Json::array();
  for (std::size_t i = 0; i < summary.body_names.size(); ++i) {
    const coupling::RigidMotion& motion = summary.bodies.motions.at(i);
    const coupling::RigidLoad& load = summary.bodies.loads.at(i);
    list.push_back({{"name", summary.body_names[i]},
                    {"position", vector(motion.position)},
                    {"velocity", vector(motion.velocity)},
                    {"spin", vector(motion.spin)},
                    {"force", vector(load.force)},
                    {"torque", vector(load.torque)}});
  }
  return list;
}

Json wall_seconds(const Summary& summary) {
  Json seconds{{"total", summary.wall_total}};
  for (const char* part : {"mesh", "assembly", "factor", "solve", "interface"}) {
    seconds[part] = figure(summary, "fluid", std::string("seconds:") + part);
  }
  seconds["dem"] = figure(summary, "dem", "seconds:dem");
  seconds["coupling"] = summary.wall_coupling;
  seconds["output"] = summary.wall_output;
  return seconds;
}

}  // namespace

std::string to_json(const Plan& plan) {
  Json participants = Json::array();
  for (const auto& [role, command, external] : plan.participants) {
    participants.push_back({{"role", role}, {"command", command}, {"external", external}});
  }
  return Json{{"title", plan.title},
              {"scene_fingerprint", plan.scene_fingerprint},
              {"participants", std::move(participants)}}
      .dump();
}

std::string to_json(const Standing& s) {
  return Json{{"step", s.step},
              {"steps", s.steps},
              {"time", s.time},
              {"end", s.end},
              {"sub_iterations", s.sub_iterations},
              {"text", fmt::format("step {} of {}, t = {:.4g} of {:.4g} s, {} sub-iterations", s.step,
                                   s.steps, s.time, s.end, s.sub_iterations)}}
      .dump();
}

std::string to_json(const Summary& s) {
  return Json{{"status", s.status},
              {"reason", s.reason},
              {"steps", s.statistics.steps()},
              {"sub_iterations",
               {{"mean", s.statistics.mean_sub_iterations()}, {"max", s.statistics.max_sub_iterations()}}},
              {"newton_iterations", count(s, "fluid", "newton_iterations")},
              {"factorisations", count(s, "fluid", "factorisations")},
              {"solves", count(s, "fluid", "solves")},
              {"unknowns", count(s, "fluid", "unknowns")},
              {"wall_seconds", wall_seconds(s)},
              {"peak_memory_bytes",
               {{"coupler", static_cast<std::uint64_t>(s.peak_memory)},
                {"fluid_server", count(s, "fluid", "peak_memory_bytes")},
                {"dem_server", count(s, "dem", "peak_memory_bytes")}}},
              {"bodies", bodies(s)},
              {"coefficients", s.coefficients},
              {"probes", s.probes}}
             .dump(2) +
         "\n";
}

bool says_completed(const std::string& summary) {
  const Json json = Json::parse(summary, nullptr, /*allow_exceptions=*/false);
  return json.is_object() && json.contains("status") && json["status"] == "completed";
}

}  // namespace fpi
