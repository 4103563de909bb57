/// Where in its file a scene says what a finding is about.
#pragma once

#include <string>
#include <vector>

#include "core/findings.hpp"
#include "scene/reading.hpp"

namespace fpi {

class Places {
 public:
  /// `expanded` is the scene of the file with the bodies that its groups of grains stand for; where groups
  /// were left out, `groups` has the numbers in the file of those that were not.
  Places(const scene::Reading& file, const scene::Scene& expanded, std::vector<std::size_t> groups = {});
  /// Fills in the places of findings that have none, and sorts them.
  void fill(Findings& findings) const;

 private:
  std::string key_in_file(const std::string& key) const;

  const scene::Reading& file_;
  const scene::Scene& scene_;
  std::vector<std::size_t> groups_;
};

}  // namespace fpi
