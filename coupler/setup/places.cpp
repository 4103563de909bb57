#include "setup/places.hpp"

#include <algorithm>
#include <utility>

namespace fpi {

Places::Places(const scene::Reading& file, const scene::Scene& expanded, std::vector<std::size_t> groups)
    : file_(file), scene_(expanded), groups_(std::move(groups)) {}

void Places::fill(Findings& findings) const {
  for (Finding& finding : findings.all())
    if (finding.place.empty()) finding.place = file_.place_of(key_in_file(finding.key));
  findings.sort();
}

/// A grain's key is that of its group.
std::string Places::key_in_file(const std::string& key) const {
  const std::vector<std::string> parts = scene::split_key(key);
  const bool has_number = parts.size() > 1 && !parts[1].empty() && parts[1].size() < 10 &&
                          parts[1].find_first_not_of("0123456789") == std::string::npos;
  if (!has_number) return key;
  std::size_t number = std::stoul(parts[1]), group = 0;
  if (parts[0] == "bodies") {
    if (number < scene_.n_listed()) return key;
    number -= scene_.n_listed();
    while (group < scene_.grains.size() && number >= scene_.grains[group].count)
      number -= scene_.grains[group++].count;
  } else if (parts[0] == "grains") {
    group = number;
  } else {
    return key;
  }
  std::string in_file = "grains." + std::to_string(group < groups_.size() ? groups_[group] : group);
  for (std::size_t i = 2; i < parts.size() && parts[0] == "grains"; ++i) in_file += "." + parts[i];
  return in_file;
}

}  // namespace fpi
