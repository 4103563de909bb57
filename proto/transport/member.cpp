#include "proto/transport/member.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "proto/codec.hpp"

namespace fpi::proto {

std::string Member::who() const {
  return fmt::format("{} ({} {})", hello.role, hello.program, hello.program_version);
}

std::string Member::where() const {
  if (stamp.step == 0) return fmt::format("in phase \"{}\", before the first step", phase);
  return fmt::format("in phase \"{}\" of step {}, sub-iteration {}", phase, stamp.step, stamp.sub_iteration);
}

std::string Member::foreign(const Stamp& theirs, const Message& message) const {
  const auto words = [](const Stamp& s) {
    return fmt::format("run {:016x}, step {}, sub-iteration {}", s.run, s.step, s.sub_iteration);
  };
  return fmt::format("answered {} of {} with {} of {}; an answer repeats the stamp of its request", asked,
                     words(stamp), name(message), words(theirs));
}

std::string objection(const Hello& hello, const std::vector<std::string>& roles, const Members& members,
                      const HostOptions& options) {
  constexpr std::array<std::string_view, 2> known_roles{"fluid", "dem"};
  const auto is_among = [&](const auto& list) { return std::ranges::find(list, hello.role) != list.end(); };
  if (hello.protocol_version != protocol_version)
    return fmt::format("protocol version {} is required; {} speaks {}: use programs of one release",
                       protocol_version, hello.program, hello.protocol_version);
  if (hello.schema_fingerprint != schema_fingerprint())
    return fmt::format(
        "schema fingerprint {:016x} is required; {} has {:016x}: build both from the same fpi.fbs",
        schema_fingerprint(), hello.program, hello.schema_fingerprint);
  if (!is_among(known_roles))
    return fmt::format("a role must be one of {}; got \"{}\"", fmt::join(known_roles, ", "), hello.role);
  if (!is_among(roles)) return fmt::format("this scene needs no {}; leave {} out", hello.role, hello.program);
  if (const auto taken = members.find(hello.role); taken != members.end())
    return fmt::format("the role {} is taken by {}; stop one of the two", hello.role, taken->second.who());
  if (hello.scene_fingerprint != 0 && hello.scene_fingerprint != options.scene_fingerprint)
    return fmt::format(
        "scene fingerprint {:016x} is required; {} was started for {:016x}: start it for this run",
        options.scene_fingerprint, hello.program, hello.scene_fingerprint);
  return {};
}

}  // namespace fpi::proto
