/// One walk over the members of a message: every number must be finite, every text printable; then the rules
/// of each type. The place of a value is spelt out only when it is refused.
#include "proto/codec/check.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string_view>

#include "core/error.hpp"
#include "core/text.hpp"
#include "proto/codec.hpp"
#include "proto/codec/members.hpp"

namespace fpi::proto {
namespace {

constexpr std::size_t no_index = std::numeric_limits<std::size_t>::max();

/// A member of a message, e.g. FluidAdvanced.tractions[2].values.
struct Place {
  const Place* outer;
  std::string_view name;
  std::size_t index = no_index;

  std::string text() const {
    const std::string path = outer ? fmt::format("{}.{}", outer->text(), name) : std::string(name);
    return index == no_index ? path : fmt::format("{}[{}]", path, index);
  }
};

/// A rule on `member` of the thing at `at`.
template <class Got>
void demand(bool holds, const Place& at, std::string_view member, std::string_view required, const Got& got) {
  if (!holds) fail("{}.{} must be {}; got {}", at.text(), member, required, got);
}

// ---- rules --------------------------------------------------------------------------------------

template <class T>
void rules(const Place&, const T&) {}

void rules(const Place& at, const Hello& hello) {
  constexpr std::size_t longest = 200;
  for (const std::string* text : {&hello.role, &hello.program, &hello.program_version})
    demand(text->size() <= longest, at, "role, program and program_version", "at most 200 bytes long",
           text->size());
}

void rules(const Place& at, const Welcome& welcome) {
  demand(welcome.heartbeat_interval > 0, at, "heartbeat_interval", "> 0 s", welcome.heartbeat_interval);
  demand(welcome.silence_timeout > 0, at, "silence_timeout", "> 0 s", welcome.silence_timeout);
}

void rules(const Place& at, const ArcLength& arc) {
  demand(arc.length > 0, at, "length", "> 0 m", arc.length);
}

void rules(const Place& at, const Configured& configured) {
  demand(configured.resolved_gap_ratio >= 0, at, "resolved_gap_ratio", ">= 0", configured.resolved_gap_ratio);
}

void rules(const Place& at, const Motion& motion) {
  const auto& [w, x, y, z] = motion.orientation;
  const double length = std::sqrt(w * w + x * x + y * y + z * z);
  demand(std::abs(length - 1) <= 1e-6, at, "orientation", "a unit quaternion (within 1e-6)", length);
}

void arcs_in_order(const Place& at, const std::vector<double>& start, const std::vector<double>& end) {
  demand(start.size() == end.size(), at, "end", fmt::format("as long as start ({})", start.size()),
         end.size());
  constexpr double turn = 2 * std::numbers::pi * (1 + 1e-12);
  for (std::size_t a = 0; a < start.size(); ++a)
    demand(start[a] < end[a] && end[a] - start[a] <= turn, at, "end", "above start by one turn at most",
           end[a] - start[a]);
}

void rules(const Place& at, const Balance& balance) {
  demand(balance.mass >= 0, at, "mass", ">= 0 kg", balance.mass);
  demand(balance.inertia >= 0, at, "inertia", ">= 0 kg m2", balance.inertia);
}

void rules(const Place& at, const Interface& mesh) {
  demand(mesh.radius >= 0, at, "radius", ">= 0 m", mesh.radius);
  arcs_in_order(at, mesh.start, mesh.end);
  const bool of_arcs = mesh.radius > 0;
  demand(of_arcs == !mesh.start.empty(), at, "start", "given where radius > 0, and only there",
         mesh.start.size());
  demand(of_arcs ? mesh.vertices.empty() : mesh.vertices.size() >= 6 && mesh.vertices.size() % 2 == 0, at,
         "vertices", "x, y of three or more vertices where radius = 0, and empty elsewhere",
         mesh.vertices.size());
  demand(mesh.points > 0 || mesh.rigid, at, "points", "> 0 where the motion is not rigid", mesh.points);
  const std::size_t wanted = 2 * std::size_t{mesh.points} * mesh.size();
  demand(mesh.velocities.size() == wanted, at, "velocities",
         fmt::format("2 * points * arcs = {} numbers", wanted), mesh.velocities.size());
}

void rules(const Place& at, const FluidAdvance& advance) {
  demand(advance.time_step >= 0, at, "time_step", ">= 0 s", advance.time_step);
  demand(!advance.same_interfaces || advance.interfaces.empty(), at, "interfaces",
         "empty where same_interfaces is set", advance.interfaces.size());
}

void rules(const Place& at, const Traction& traction) {
  demand(traction.values.size() % 2 == 0, at, "values", "two numbers an arc", traction.values.size());
  demand(traction.arc_length >= 0, at, "arc_length", ">= 0 m", traction.arc_length);
}

void rules(const Place& at, const FluidAdvanced& advanced) {
  demand(advanced.residual >= 0, at, "residual", ">= 0", advanced.residual);
  demand(advanced.time_error >= 0, at, "time_error", ">= 0", advanced.time_error);
  demand(advanced.time_error_order >= 0, at, "time_error_order", ">= 0", advanced.time_error_order);
  demand(advanced.speed >= 0, at, "speed", ">= 0 m/s", advanced.speed);
  const auto rows = static_cast<std::size_t>(std::lround(std::sqrt(advanced.resistance.size())));
  demand(rows * rows == advanced.resistance.size(), at, "resistance", "as many columns as rows",
         advanced.resistance.size());
}

void rules(const Place& at, const Load& load) {
  arcs_in_order(at, load.start, load.end);
  demand(load.tractions.size() == 2 * load.start.size(), at, "tractions",
         fmt::format("two numbers for each of {} arcs", load.start.size()), load.tractions.size());
  demand(load.added_mass >= 0, at, "added_mass", ">= 0 kg", load.added_mass);
  demand(load.added_inertia >= 0, at, "added_inertia", ">= 0 kg m2", load.added_inertia);
}

void rules(const Place& at, const DemAdvance& advance) {
  demand(advance.time_step >= 0, at, "time_step", ">= 0 s", advance.time_step);
  for (const double gap : advance.resolved_gaps) demand(gap > 0, at, "resolved_gaps", "> 0 m", gap);
  const std::size_t rows = 3 * advance.loads.size();
  demand(advance.resistance.empty() || advance.resistance.size() == rows * rows, at, "resistance",
         fmt::format("empty, or {0} rows and columns, three a load", rows), advance.resistance.size());
}

void rules(const Place& at, const DemAdvanced& advanced) {
  demand(advanced.largest_overlap >= 0, at, "largest_overlap", ">= 0 m", advanced.largest_overlap);
}

/// A name that files and paths inside them take.
void demand_word(const Place& at, const std::string& name) {
  const auto is_plain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  demand(!name.empty() && std::ranges::all_of(name, is_plain), at, "name", "a word of letters, digits and _",
         name);
}

/// Each name is a place in a file.
template <class Named>
void demand_different(const Place& at, std::string_view member, const std::vector<Named>& list) {
  std::set<std::string_view> names;
  for (const Named& item : list)
    demand(names.insert(item.name).second, at, member, "of different names",
           fmt::format("\"{}\" again", item.name));
}

void rules(const Place& at, const Field& field) {
  demand_word(at, field.name);
  demand(field.components > 0, at, "components", "> 0", field.components);
  demand(field.values.size() % field.components == 0, at, "values",
         fmt::format("a multiple of components ({})", field.components), field.values.size());
}

void indices_below(std::size_t n_points, const Place& at, std::string_view member,
                   const std::vector<std::uint32_t>& indices) {
  const auto largest = std::max_element(indices.begin(), indices.end());
  if (largest != indices.end())
    demand(*largest < n_points, at, member, fmt::format("indices below the {} points", n_points), *largest);
}

void rules(const Place& at, const Curve& curve) {
  demand(!curve.name.empty(), at, "name", "given", "none");
  demand(curve.points.size() % 3 == 0, at, "points", "x, y, z of each point", curve.points.size());
  demand(curve.lines.size() % 3 == 0, at, "lines", "3 indices each", curve.lines.size());
  const std::size_t n_points = curve.points.size() / 3;
  indices_below(n_points, at, "lines", curve.lines);
  demand(curve.components > 0, at, "components", "> 0", curve.components);
  demand(curve.values.size() == n_points * curve.components, at, "values",
         fmt::format("{} numbers", n_points * curve.components), curve.values.size());
}

void rules(const Place& at, const Sheet& table) {
  demand_word(at, table.name);
  const std::size_t columns = table.columns.size();
  demand(columns > 0 && table.values.size() % columns == 0, at, "values",
         "rows of one number or more a column", table.values.size());
}

void rules(const Place& at, const Fields& fields) {
  demand_different(at, "fields", fields.fields);
  demand_different(at, "boundaries", fields.boundaries);
  demand_different(at, "profiles", fields.profiles);
  demand_different(at, "tables", fields.tables);
  demand(fields.points.size() % 3 == 0, at, "points", "x, y, z of each point", fields.points.size());
  demand(fields.cells.size() % 6 == 0, at, "cells", "6 indices each", fields.cells.size());
  const std::size_t n_points = fields.points.size() / 3, n_cells = fields.cells.size() / 6;
  indices_below(n_points, at, "cells", fields.cells);
  if (n_points == 0) return;  // the mesh went with an earlier message
  for (const Field& field : fields.fields) {
    const std::size_t wanted = (field.on_cells ? n_cells : n_points) * field.components;
    demand(field.values.size() == wanted, at, "fields",
           fmt::format("{} numbers for \"{}\"", wanted, field.name), field.values.size());
  }
}

void rules(const Place& at, const Heartbeat& heartbeat) {
  demand(heartbeat.progress >= 0 && heartbeat.progress <= 1, at, "progress", "between 0 and 1",
         heartbeat.progress);
}

// ---- the walk -----------------------------------------------------------------------------------

void walk(const Place& at, const std::string& text) {
  if (!is_legible(text))
    fail("{} must be UTF-8 text without control characters; got \"{}\"", at.text(),
         legible(text.substr(0, 80)));
}

void walk(const Place& at, double value) {
  if (!std::isfinite(value)) fail("{} must be finite; got {}", at.text(), value);
}

void walk(const Place& at, const std::pair<std::string, double>& figure) {
  walk({&at, "name"}, figure.first);
  walk({&at, "value"}, figure.second);
}

template <class T>
requires std::is_integral_v<T>
void walk(const Place&, T) {}
void walk(const Place&, const Bytes&) {}

template <class T>
void walk(const Place& at, const std::vector<T>& list);
template <class T>
void walk(const Place& at, const std::optional<T>& value);

template <std::size_t n>
void walk(const Place& at, const std::array<double, n>& list) {
  for (std::size_t i = 0; i < n; ++i) walk({at.outer, at.name, i}, list[i]);
}

template <class T>
requires std::is_class_v<T>
void walk(const Place& at, const T& owner) {
  for_each_member(owner, [&](const char* member, const auto& value) { walk(Place{&at, member}, value); });
  rules(at, owner);
}

template <class T>
void walk(const Place& at, const std::optional<T>& value) {
  if (value) walk(at, *value);
}

template <class T>
void walk(const Place& at, const std::vector<T>& list) {
  for (std::size_t i = 0; i < list.size(); ++i) walk(Place{at.outer, at.name, i}, list[i]);
}

}  // namespace

void check(const Message& message) {
  std::visit([&](const auto& m) { walk(Place{nullptr, name(message)}, m); }, message);
}

}  // namespace fpi::proto
