/// A scene file with all that is wrong with it, for whoever wants to tell it all at once.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/findings.hpp"
#include "scene/document.hpp"
#include "scene/scene.hpp"

namespace fpi::scene {

struct Reading {
  Scene scene;                  ///< where values are refused, it has the defaults
  Findings findings;            ///< by file and line
  bool has_all_values = false;  ///< nothing but unknown keys is wrong
  std::shared_ptr<const Node> document;

  /// "drop.toml:12" of a dotted key, or of the innermost table around it that the file has.
  std::string place_of(const std::string& key) const;
};

/// Throws Error only where the text is no TOML, the file cannot be read, or an override cannot be applied.
Reading read_all(const std::string& path, const std::vector<std::string>& overrides);
Reading read_all(const std::string& text, const std::string& name, const std::vector<std::string>& overrides);

}  // namespace fpi::scene
