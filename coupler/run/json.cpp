#include "run/json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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

/// Before the first step nothing is known of the forces: null, as zero would look like a result.
Json bodies(const Summary& summary) {
  Json list = Json::array();
  const bool has_forces = summary.statistics.steps() > 0;
  for (std::size_t i = 0; i < summary.body_names.size(); ++i) {
    const coupling::RigidMotion& motion = summary.bodies.motions.at(i);
    const coupling::RigidLoad& load = summary.bodies.loads.at(i);
    list.push_back({{"name", summary.body_names[i]},
                    {"position", vector(motion.position)},
                    {"velocity", vector(motion.velocity)},
                    {"spin", vector(motion.spin)},
                    {"force", has_forces ? vector(load.force) : Json()},
                    {"torque", has_forces ? vector(load.torque) : Json()}});
  }
  return list;
}

Json groups(const Summary& summary) {
  Json list = Json::array();
  for (const GroupMotion& group : summary.groups)
    list.push_back({{"name", group.name},
                    {"count", group.count},
                    {"position", vector(group.position)},
                    {"velocity", vector(group.velocity)},
                    {"kinetic_energy", group.kinetic_energy}});
  return list;
}

/// Null where nothing has moved far enough, or nobody asked.
Json onset(const Summary& summary) {
  if (summary.onset_body.empty()) return {};
  return {
      {"time", summary.bodies.onset->time}, {"body", summary.onset_body}, {"drives", summary.onset_drives}};
}

Json outlets(const Summary& summary) {
  Json list = Json::array();
  for (std::size_t i = 0; i < summary.outlet_names.size(); ++i) {
    const Departed& departed = summary.bodies.departed.at(i);
    list.push_back({{"name", summary.outlet_names[i]},
                    {"count", static_cast<std::uint64_t>(departed.count)},
                    {"mass", departed.mass},
                    {"momentum", vector(departed.momentum)}});
  }
  return list;
}

Json boundaries(const Summary& summary) {
  Json list = Json::array();
  for (std::size_t i = 0; i < summary.boundaries.size(); ++i) {
    const std::string& name = summary.boundary_names[i];
    const BoundaryLoad& load = summary.boundaries[i];
    list.push_back(
        {{"name", name},
         {"force", {load.fx, load.fy, 0}},
         {"torque", {0, 0, load.torque}},
         {"centre",
          {figure(summary, "fluid", "centre_x:" + name), figure(summary, "fluid", "centre_y:" + name), 0}}});
  }
  return list;
}

Json signals(const Summary& summary) {
  Json all = Json::object();
  for (const auto& [name, signal] : summary.signals) {
    const SignalFigures& f = signal.figures;
    Json& one = all[name] = {{"min", f.smallest.value},
                             {"min_time", f.smallest.time},
                             {"max", f.largest.value},
                             {"max_time", f.largest.time},
                             {"mean", f.mean}};
    if (const auto& o = f.oscillation) {
      one["frequency"] = o->frequency;
      one["periods"] = o->periods;
      one["peak_spread"] = o->peak_spread;
      one["settled"] = o->is_settled();
    }
    if (signal.strouhal) one["strouhal"] = *signal.strouhal;
  }
  return all;
}

/// "min:NAME", "min_x:NAME", … of the fluid, by profile.
Json profiles(const Summary& summary) {
  Json all = Json::object();
  for (const std::string& name : summary.profile_names)
    for (const std::string kind : {"min", "max"}) {
      const auto part = [&](const std::string& suffix) {
        return figure(summary, "fluid", kind + suffix + name);
      };
      all[name][kind] = part(":");
      all[name][kind + "_at"] = {part("_x:"), part("_y:")};
    }
  return all;
}

/// Figures "PREFIX…" of the fluid without the prefix.
Json figures_after(const Summary& summary, const std::string& prefix) {
  Json all = Json::object();
  const auto fluid = summary.figures.find("fluid");
  if (fluid == summary.figures.end()) return all;
  for (const auto& [name, value] : fluid->second)
    if (name.starts_with(prefix)) all[name.substr(prefix.size())] = value;
  return all;
}

/// What every term exerts on the fluid, and what is left of their sum.
Json force_balance(const Summary& summary) {
  Json all = Json::object();
  const Json x = figures_after(summary, "balance_x:"), y = figures_after(summary, "balance_y:");
  for (const auto& [name, force] : x.items()) all[name] = {force, y[name], 0};
  if (!all.empty()) all["rest"] = figure(summary, "fluid", "balance:rest");
  return all;
}

/// Plain figures of every participant, whatever it counts.
Json counts(const Summary& summary) {
  Json all = Json::object();
  for (const auto& [role, figures] : summary.figures) {
    all[role] = Json::object();
    for (const auto& [name, value] : figures)
      if (name.find(':') == std::string::npos && name != "peak_memory_bytes") all[role][name] = value;
  }
  return all;
}

/// Before the first step as far as it was known then, at the end as it was at most.
Json resolution(const Summary& summary) {
  Json all = summary.resolution.figures;
  all.update(figures_after(summary, "resolution:"));
  if (!summary.resolution.coarsest_body.empty()) all["coarsest_body"] = summary.resolution.coarsest_body;
  if (const double share = leak_share(summary); share > 0) all["leak"] = share;
  return all;
}

Json findings(const Findings& findings) {
  Json list = Json::array();
  for (const Finding& finding : findings.all()) {
    Json one{{"severity", finding.is_error ? "error" : "warning"}, {"key", finding.key}};
    const std::size_t colon = finding.place.rfind(':');
    const std::string line = colon == std::string::npos ? "" : finding.place.substr(colon + 1);
    const bool has_line =
        !line.empty() && line.size() < 10 && line.find_first_not_of("0123456789") == std::string::npos;
    one["file"] = has_line ? finding.place.substr(0, colon) : finding.place;
    one["line"] = has_line ? Json(std::stol(line)) : Json();
    one["text"] = finding.text;
    list.push_back(std::move(one));
  }
  return list;
}

Json participants(const Plan& plan) {
  Json list = Json::array();
  for (const auto& [role, command, external] : plan.participants)
    list.push_back({{"role", role}, {"command", command}, {"external", external}});
  return list;
}

Json stages(const Plan& plan) {
  Json list = Json::array();
  for (const Stage& stage : plan.stages)
    list.push_back({{"scene", stage.scene}, {"folder", stage.folder}, {"ready", stage.ready}});
  return list;
}

Json wall_seconds(const Summary& summary) {
  Json seconds{{"total", summary.wall_total}};
  for (const char* part : {"mesh", "assembly", "factor", "solve", "interface"}) {
    seconds[part] = figure(summary, "fluid", std::string("seconds:") + part);
  }
  seconds.update(figures_after(summary, "seconds:"));  // whatever else it measured
  seconds["dem"] = figure(summary, "dem", "seconds:dem");
  seconds["coupling"] = summary.wall_coupling;
  seconds["output"] = summary.wall_output;
  return seconds;
}

/// While one program works the others wait for it.
Json coupling_report(const Summary& summary) {
  const Statistics& s = summary.statistics;
  const auto worst = s.worst();
  return {
      {"rejected_steps", s.rejected()},
      {"repeated_steps", s.repeated()},
      {"recuts", s.recuts()},
      {"largest_miss", s.largest_miss()},
      {"largest_displacement", s.largest_displacement()},
      {"columns", {{"mean", s.mean_columns()}, {"max", s.most_columns()}, {"dropped", s.dropped_columns()}}},
      {"stalls",
       {{"history_dropped", s.remedies()[0]},
        {"aitken", s.remedies()[1]},
        {"step_shortened", s.remedies()[2]}}},
      {"worst_body", {{"name", summary.worst_body}, {"steps", worst ? worst->steps : 0}}},
      {"waited_for", summary.waited_for}};
}

}  // namespace

std::vector<std::string> coupling_table(const Summary& summary) {
  const Statistics& s = summary.statistics;
  std::vector<std::string> lines;
  const auto line = [&lines](const char* what, const std::string& figures) {
    lines.push_back(fmt::format("  {:<22} {}", what, figures));
  };
  line("sub-iterations",
       fmt::format("mean {:.3g}, most {}", s.mean_sub_iterations(), s.max_sub_iterations()));
  line("columns", fmt::format("mean {:.3g}, most {}, dropped {}", s.mean_columns(), s.most_columns(),
                              s.dropped_columns()));
  line("steps done again", fmt::format("rejected {}, too large {}", s.rejected(), s.repeated()));
  line("geometry cut anew", fmt::format("{} times; bodies missed by at most {:.2g} h, went at most {:.2g} h",
                                        s.recuts(), s.largest_miss(), s.largest_displacement()));
  line("stalls", fmt::format("history dropped {}, Aitken {}, step made shorter {}", s.remedies()[0],
                             s.remedies()[1], s.remedies()[2]));
  if (const auto worst = s.worst())
    line("worst body", fmt::format("\"{}\", in {} steps", summary.worst_body, worst->steps));
  for (const auto& [role, seconds] : summary.waited_for)
    line(("waited for " + role).c_str(), fmt::format("{:.3g} s", seconds));
  line("largest overlap", fmt::format("{:.3g} m", s.largest_overlap()));
  return lines;
}

std::string to_json(const Plan& plan) {
  return Json{{"title", plan.title},
              {"scene_fingerprint", plan.scene_fingerprint},
              {"participants", participants(plan)},
              {"stages", stages(plan)}}
      .dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string to_json(const CheckReport& report) {
  Json figures = report.resolution.figures;
  if (!report.resolution.coarsest_body.empty()) figures["coarsest_body"] = report.resolution.coarsest_body;
  return Json{{"status", report.is_ok() ? "ok" : "refused"},
              {"scene", report.scene},
              {"title", report.plan.title},
              {"findings", findings(report.findings)},
              {"resolution", std::move(figures)},
              {"participants", participants(report.plan)},
              {"stages", stages(report.plan)},
              {"not_checked", report.not_checked},
              {"text", to_text(report)}}
      .dump(-1, ' ', false, Json::error_handler_t::replace);
}

double leak_share(const Summary& summary) {
  const Json balance = figures_after(summary, "volume:");
  double flow = 0, leak = 0;
  for (const auto& [name, value] : balance.items()) {
    if (name == "leak") leak = std::abs(value.get<double>());
    if (name == "bodies" || name.starts_with("boundary:"))
      flow = std::max(flow, std::abs(value.get<double>()));
  }
  return flow > 0 ? leak / flow : 0;
}

std::string to_json(const RunProgress& s) {
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
              {"version", s.origin.version},
              {"scene_fingerprint", s.origin.scene_fingerprint},
              {"steps", s.statistics.steps()},
              {"steps_before", s.steps_before},
              {"sub_iterations",
               {{"mean", s.statistics.mean_sub_iterations()}, {"max", s.statistics.max_sub_iterations()}}},
              {"coupling", coupling_report(s)},
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
              {"grains", groups(s)},
              {"outlets", outlets(s)},
              {"onset", onset(s)},
              {"boundaries", boundaries(s)},
              {"drives", s.drives},
              {"force_balance", force_balance(s)},
              {"volume_balance", figures_after(s, "volume:")},
              {"coefficients", s.coefficients},
              {"probes", s.probes},
              {"signals", signals(s)},
              {"profiles", profiles(s)},
              {"resolution", resolution(s)},
              {"warnings", s.warnings},
              {"percolation", figures_after(s, "percolation:")},
              {"errors", figures_after(s, "error:")},
              {"counts", counts(s)}}
             .dump(2, ' ', false, Json::error_handler_t::replace) +  // a reason may quote any bytes
         "\n";
}

std::optional<RunOrigin> origin_if_completed(const std::string& summary) {
  const Json json = Json::parse(summary, nullptr, /*allow_exceptions=*/false);
  const auto value = [&json](const char* key) {
    return json.is_object() && json.contains(key) ? json[key] : Json();
  };
  const Json version = value("version"), fingerprint = value("scene_fingerprint");
  if (value("status") != "completed" || !version.is_string() || !fingerprint.is_number_unsigned())
    return std::nullopt;
  return RunOrigin{version, fingerprint};
}

}  // namespace fpi
