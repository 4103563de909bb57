/// All that `check` finds.
#pragma once

#include <string>
#include <vector>

#include "core/findings.hpp"
#include "setup/plan.hpp"
#include "setup/resolution.hpp"

namespace fpi {

struct CheckReport {
  std::string scene;  ///< its file
  Plan plan;
  Findings findings;                     ///< by file and line
  std::vector<std::string> not_checked;  ///< what could not be looked at, and why
  std::vector<std::string> notes;        ///< groups of grains
  Resolution resolution;

  bool is_ok() const { return !findings.has_errors(); }
};

/// As lines for a reader.
std::vector<std::string> to_text(const CheckReport& report);

}  // namespace fpi
