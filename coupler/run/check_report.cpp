#include "run/check_report.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace fpi {

std::vector<std::string> to_text(const CheckReport& report) {
  std::vector<Finding> findings = report.findings.all();
  for (Finding& finding : findings) finding.text.insert(0, finding.is_error ? "" : "warning: ");
  std::vector<std::string> lines = to_lines(findings);
  const auto say = [&lines](std::string line) { lines.push_back(std::move(line)); };
  const auto n_errors = std::ranges::count_if(report.findings.all(), &Finding::is_error);
  const auto n_warnings = static_cast<std::ptrdiff_t>(report.findings.all().size()) - n_errors;
  if (report.is_ok())
    say(fmt::format("{}: ok, \"{}\"{}", report.scene, report.plan.title,
                    n_warnings > 0 ? fmt::format(", {} warnings", n_warnings) : ""));
  else
    say(fmt::format("{}: {} errors, {} warnings", report.scene, n_errors, n_warnings));
  for (const std::string& line : report.notes) say("  " + line);
  for (const std::string& line : describe(report.resolution)) say("  " + line);
  for (const Stage& stage : report.plan.stages)
    say(fmt::format("  stage {}: {}", stage.scene, stage.ready ? "has run" : "runs first"));
  for (const std::string& line : report.not_checked) say("  not checked: " + line);
  return lines;
}

}  // namespace fpi
