/// The members of every message by name, as data: checks (and tests) walk them instead of naming each again.
#pragma once

#include <tuple>

#include "proto/messages.hpp"

namespace fpi::proto {

template <class Owner, class Value>
struct NamedMember {
  const char* name;
  Value Owner::*pointer;
};
template <class Owner, class Value>
constexpr NamedMember<Owner, Value> member(const char* name, Value Owner::*pointer) {
  return {name, pointer};
}

/// Empty for types that are not messages or parts of them, and for messages without content.
template <class T>
inline constexpr auto members_of = std::tuple<>{};

template <>
inline constexpr auto members_of<Hello> = std::tuple{
    member("protocol_version", &Hello::protocol_version),
    member("role", &Hello::role),
    member("program", &Hello::program),
    member("program_version", &Hello::program_version),
    member("capabilities", &Hello::capabilities),
    member("schema_fingerprint", &Hello::schema_fingerprint),
    member("scene_fingerprint", &Hello::scene_fingerprint),
};
template <>
inline constexpr auto members_of<Welcome> = std::tuple{
    member("scene_fingerprint", &Welcome::scene_fingerprint),
    member("heartbeat_interval", &Welcome::heartbeat_interval),
    member("silence_timeout", &Welcome::silence_timeout),
};
template <>
inline constexpr auto members_of<Refusal> = std::tuple{member("reason", &Refusal::reason)};
template <>
inline constexpr auto members_of<File> =
    std::tuple{member("name", &File::name), member("bytes", &File::bytes)};
template <>
inline constexpr auto members_of<Configure> = std::tuple{
    member("scene", &Configure::scene),
    member("files", &Configure::files),
    member("state", &Configure::state),
};
template <>
inline constexpr auto members_of<ArcLength> =
    std::tuple{member("body", &ArcLength::body), member("length", &ArcLength::length)};
template <>
inline constexpr auto members_of<Finding> = std::tuple{
    member("is_error", &Finding::is_error),
    member("key", &Finding::key),
    member("text", &Finding::text),
};
template <>
inline constexpr auto members_of<Configured> = std::tuple{
    member("arc_lengths", &Configured::arc_lengths),
    member("resolved_gap_ratio", &Configured::resolved_gap_ratio),
    member("notes", &Configured::notes),
    member("figures", &Configured::figures),
    member("findings", &Configured::findings),
};
template <>
inline constexpr auto members_of<Motion> = std::tuple{
    member("body", &Motion::body),
    member("position", &Motion::position),
    member("orientation", &Motion::orientation),
    member("velocity", &Motion::velocity),
    member("spin", &Motion::spin),
};
template <>
inline constexpr auto members_of<Balance> = std::tuple{
    member("mass", &Balance::mass),         member("inertia", &Balance::inertia),
    member("velocity", &Balance::velocity), member("spin", &Balance::spin),
    member("force", &Balance::force),       member("torque", &Balance::torque),
};
template <>
inline constexpr auto members_of<Interface> = std::tuple{
    member("body", &Interface::body),
    member("centre", &Interface::centre),
    member("radius", &Interface::radius),
    member("start", &Interface::start),
    member("end", &Interface::end),
    member("vertices", &Interface::vertices),
    member("rigid", &Interface::rigid),
    member("translation", &Interface::translation),
    member("spin", &Interface::spin),
    member("points", &Interface::points),
    member("velocities", &Interface::velocities),
    member("balance", &Interface::balance),
};
template <>
inline constexpr auto members_of<FluidAdvance> = std::tuple{
    member("time", &FluidAdvance::time),
    member("time_step", &FluidAdvance::time_step),
    member("interfaces", &FluidAdvance::interfaces),
    member("same_interfaces", &FluidAdvance::same_interfaces),
    member("wants_resistance", &FluidAdvance::wants_resistance),
    member("rehearsal", &FluidAdvance::rehearsal),
};
template <>
inline constexpr auto members_of<Traction> = std::tuple{
    member("body", &Traction::body),
    member("values", &Traction::values),
    member("force", &Traction::force),
    member("torque", &Traction::torque),
    member("arc_length", &Traction::arc_length),
    member("velocity", &Traction::velocity),
    member("spin", &Traction::spin),
    member("mean_force", &Traction::mean_force),
    member("mean_torque", &Traction::mean_torque),
};
template <>
inline constexpr auto members_of<FluidAdvanced> = std::tuple{
    member("converged", &FluidAdvanced::converged),
    member("reason", &FluidAdvanced::reason),
    member("tractions", &FluidAdvanced::tractions),
    member("newton_iterations", &FluidAdvanced::newton_iterations),
    member("residual", &FluidAdvanced::residual),
    member("time_error", &FluidAdvanced::time_error),
    member("time_error_order", &FluidAdvanced::time_error_order),
    member("resistance", &FluidAdvanced::resistance),
    member("speed", &FluidAdvanced::speed),
    member("findings", &FluidAdvanced::findings),
};
template <>
inline constexpr auto members_of<Load> = std::tuple{
    member("body", &Load::body),
    member("force", &Load::force),
    member("torque", &Load::torque),
    member("start", &Load::start),
    member("end", &Load::end),
    member("tractions", &Load::tractions),
    member("velocity", &Load::velocity),
    member("spin", &Load::spin),
    member("added_mass", &Load::added_mass),
    member("added_inertia", &Load::added_inertia),
};
template <>
inline constexpr auto members_of<DemAdvance> = std::tuple{
    member("time", &DemAdvance::time),
    member("time_step", &DemAdvance::time_step),
    member("loads", &DemAdvance::loads),
    member("prescribed", &DemAdvance::prescribed),
    member("resolved_gaps", &DemAdvance::resolved_gaps),
    member("walls", &DemAdvance::walls),
    member("resistance", &DemAdvance::resistance),
};
template <>
inline constexpr auto members_of<DemAdvanced> = std::tuple{
    member("converged", &DemAdvanced::converged), member("reason", &DemAdvanced::reason),
    member("motions", &DemAdvanced::motions),     member("sub_steps", &DemAdvanced::sub_steps),
    member("contacts", &DemAdvanced::contacts),   member("largest_overlap", &DemAdvanced::largest_overlap),
};
template <>
inline constexpr auto members_of<Accept> = std::tuple{member("left", &Accept::left)};
template <>
inline constexpr auto members_of<Accepted> = std::tuple{
    member("figures", &Accepted::figures),
    member("findings", &Accepted::findings),
};
template <>
inline constexpr auto members_of<Write> = std::tuple{member("mesh", &Write::mesh)};
template <>
inline constexpr auto members_of<Field> = std::tuple{
    member("name", &Field::name),
    member("on_cells", &Field::on_cells),
    member("components", &Field::components),
    member("values", &Field::values),
};
template <>
inline constexpr auto members_of<Sheet> = std::tuple{
    member("name", &Sheet::name),
    member("columns", &Sheet::columns),
    member("values", &Sheet::values),
};
template <>
inline constexpr auto members_of<Curve> = std::tuple{
    member("name", &Curve::name),     member("points", &Curve::points),
    member("lines", &Curve::lines),   member("components", &Curve::components),
    member("values", &Curve::values),
};
template <>
inline constexpr auto members_of<Fields> = std::tuple{
    member("time", &Fields::time),
    member("points", &Fields::points),
    member("cells", &Fields::cells),
    member("fields", &Fields::fields),
    member("boundaries", &Fields::boundaries),
    member("profiles", &Fields::profiles),
    member("tables", &Fields::tables),
};
template <>
inline constexpr auto members_of<State> = std::tuple{member("bytes", &State::bytes)};
template <>
inline constexpr auto members_of<Heartbeat> =
    std::tuple{member("phase", &Heartbeat::phase), member("progress", &Heartbeat::progress)};
template <>
inline constexpr auto members_of<Failure> = std::tuple{
    member("who", &Failure::who),
    member("phase", &Failure::phase),
    member("text", &Failure::text),
};
template <>
inline constexpr auto members_of<Goodbye> = std::tuple{member("reason", &Goodbye::reason)};
template <>
inline constexpr auto members_of<Farewell> = std::tuple{member("figures", &Farewell::figures)};

/// Calls `visit(name, value)` for every member of `owner`, in order.
template <class Owner, class Visit>
void for_each_member(Owner& owner, Visit&& visit) {
  std::apply([&](const auto&... m) { (visit(m.name, owner.*(m.pointer)), ...); },
             members_of<std::remove_const_t<Owner>>);
}

}  // namespace fpi::proto
