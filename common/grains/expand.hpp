/// From [[grains]] to bodies. Every process that reads a scene does this for itself, from the scene's text
/// and its tables, and comes to the same bodies.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/findings.hpp"
#include "scene/scene.hpp"

namespace fpi::grains {

/// The content of a file by the name that the scene gives it.
using Content = std::function<std::string_view(const std::string& name)>;

/// The same as `expand`, with all that it throws, and what is doubtful, as findings.
Findings place(scene::Scene& scene, const Content& content);

/// Adds the grains of all groups to the bodies, named GROUP.0, GROUP.1 …, and counts them in their groups.
/// Throws Error where a packing is not possible or a table is not one, and where free bodies start outside a
/// rectangle of fluid or a periodic cell, or overlap others by more than a hundredth of a radius.
void expand(scene::Scene& scene, const Content& content);

/// A line on each group: how many grains, of which size, and the part of the box that they fill.
std::vector<std::string> describe(const scene::Scene& scene);

}  // namespace fpi::grains
