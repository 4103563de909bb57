/// Plain messages to bytes: one `pack` a type, each the constructor call that flatc generated for its table.
#include <type_traits>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "fpi_generated.h"
#include "proto/codec.hpp"
#include "proto/codec/members.hpp"
#include "schema.hpp"

namespace fpi::proto {
namespace {

using Builder = flatbuffers::FlatBufferBuilder;

static_assert(std::variant_size_v<Message> == static_cast<std::size_t>(wire::Body::MAX),
              "Message and the union Body of fpi.fbs list the same messages in the same order");

// ---- parts --------------------------------------------------------------------------------------

wire::Vec3 pack(const Vec3& v) { return {v[0], v[1], v[2]}; }
wire::ArcLength pack(Builder&, const ArcLength& m) { return {m.body, m.length}; }
wire::Motion pack(Builder&, const Motion& m) {
  const auto& [w, x, y, z] = m.orientation;
  return {m.body, pack(m.position), wire::Quaternion(w, x, y, z), pack(m.velocity), pack(m.spin)};
}

auto text(Builder& b, const std::string& s) { return b.CreateString(s); }
template <class T>
auto numbers(Builder& b, const std::vector<T>& list) {
  return b.CreateVector(list);
}

auto pack(Builder& b, const std::string& s) { return text(b, s); }
auto pack(Builder& b, const std::pair<std::string, double>& figure) {
  return wire::CreateFigure(b, text(b, figure.first), figure.second);
}
auto pack(Builder& b, const File& m) { return wire::CreateFile(b, text(b, m.name), numbers(b, m.bytes)); }
wire::Balance pack(const Balance& m) {
  return {m.mass, m.inertia, pack(m.velocity), pack(m.spin), pack(m.force), pack(m.torque)};
}
auto pack(Builder& b, const Interface& m) {
  const wire::Balance balance = m.balance ? pack(*m.balance) : wire::Balance();
  const wire::Vec3 centre = pack(m.centre), translation = pack(m.translation), spin = pack(m.spin);
  return wire::CreateInterface(b, m.body, &centre, m.radius, numbers(b, m.start), numbers(b, m.end),
                               numbers(b, m.vertices), m.rigid, &translation, &spin, m.points,
                               numbers(b, m.velocities), m.balance ? &balance : nullptr);
}
auto pack(Builder& b, const Traction& m) {
  const wire::Vec3 force = pack(m.force), torque = pack(m.torque), v = pack(m.velocity), w = pack(m.spin);
  const wire::Vec3 mean_force = pack(m.mean_force.value_or(Vec3{})),
                   mean_torque = pack(m.mean_torque.value_or(Vec3{}));
  return wire::CreateTraction(b, m.body, numbers(b, m.values), &force, &torque, m.arc_length, &v, &w,
                              m.mean_force ? &mean_force : nullptr, m.mean_torque ? &mean_torque : nullptr);
}
auto pack(Builder& b, const Load& m) {
  const wire::Vec3 force = pack(m.force), torque = pack(m.torque), v = pack(m.velocity), w = pack(m.spin);
  return wire::CreateLoad(b, m.body, &force, &torque, numbers(b, m.start), numbers(b, m.end),
                          numbers(b, m.tractions), &v, &w, m.added_mass, m.added_inertia);
}
auto pack(Builder& b, const Finding& m) {
  return wire::CreateFinding(b, m.is_error, text(b, m.key), text(b, m.text));
}
auto pack(Builder& b, const Field& m) {
  return wire::CreateField(b, text(b, m.name), m.on_cells, m.components, numbers(b, m.values));
}
auto pack(Builder& b, const Curve& m) {
  return wire::CreateCurve(b, text(b, m.name), numbers(b, m.points), numbers(b, m.lines), m.components,
                           numbers(b, m.values));
}

auto pack(Builder& b, const Sheet& m) {
  return wire::CreateSheet(b, text(b, m.name), b.CreateVectorOfStrings(m.columns), numbers(b, m.values));
}

template <class T>
auto list(Builder& b, const std::vector<T>& items) {
  std::vector<decltype(pack(b, items[0]))> packed;
  packed.reserve(items.size());
  for (const T& item : items) packed.push_back(pack(b, item));
  if constexpr (std::is_same_v<T, ArcLength> || std::is_same_v<T, Motion>)
    return b.CreateVectorOfStructs(packed);
  else
    return b.CreateVector(packed);
}

// ---- messages -----------------------------------------------------------------------------------

auto pack(Builder& b, const Hello& m) {
  return wire::CreateHello(b, m.protocol_version, text(b, m.role), text(b, m.program),
                           text(b, m.program_version), list(b, m.capabilities), m.schema_fingerprint,
                           m.scene_fingerprint);
}
auto pack(Builder& b, const Welcome& m) {
  return wire::CreateWelcome(b, m.scene_fingerprint, m.heartbeat_interval, m.silence_timeout);
}
auto pack(Builder& b, const Refusal& m) { return wire::CreateRefusal(b, text(b, m.reason)); }
auto pack(Builder& b, const Configure& m) {
  return wire::CreateConfigure(b, text(b, m.scene), list(b, m.files), numbers(b, m.state));
}
auto pack(Builder& b, const Configured& m) {
  return wire::CreateConfigured(b, list(b, m.arc_lengths), m.resolved_gap_ratio, list(b, m.notes),
                                list(b, m.figures), list(b, m.findings));
}
auto pack(Builder& b, const FluidAdvance& m) {
  return wire::CreateFluidAdvance(b, m.time, m.time_step, list(b, m.interfaces), m.same_interfaces,
                                  m.wants_resistance, m.rehearsal);
}
auto pack(Builder& b, const FluidAdvanced& m) {
  return wire::CreateFluidAdvanced(b, m.converged, text(b, m.reason), list(b, m.tractions),
                                   m.newton_iterations, m.residual, m.time_error, m.time_error_order,
                                   numbers(b, m.resistance), m.speed, list(b, m.findings));
}
auto pack(Builder& b, const DemAdvance& m) {
  return wire::CreateDemAdvance(b, m.time, m.time_step, list(b, m.loads), list(b, m.prescribed),
                                numbers(b, m.resolved_gaps), list(b, m.walls), numbers(b, m.resistance));
}
auto pack(Builder& b, const DemAdvanced& m) {
  return wire::CreateDemAdvanced(b, m.converged, text(b, m.reason), list(b, m.motions), m.sub_steps,
                                 numbers(b, m.contacts), m.largest_overlap);
}
auto pack(Builder& b, const Accept& m) { return wire::CreateAccept(b, numbers(b, m.left)); }
auto pack(Builder& b, const Accepted& m) {
  return wire::CreateAccepted(b, list(b, m.figures), list(b, m.findings));
}
auto pack(Builder& b, const Restore&) { return wire::CreateRestore(b); }
auto pack(Builder& b, const Restored&) { return wire::CreateRestored(b); }
auto pack(Builder& b, const Write& m) { return wire::CreateWrite(b, m.mesh); }
auto pack(Builder& b, const Fields& m) {
  return wire::CreateFields(b, m.time, numbers(b, m.points), numbers(b, m.cells), list(b, m.fields),
                            list(b, m.boundaries), list(b, m.profiles), list(b, m.tables));
}
auto pack(Builder& b, const Checkpoint&) { return wire::CreateCheckpoint(b); }
auto pack(Builder& b, const State& m) { return wire::CreateState(b, numbers(b, m.bytes)); }
auto pack(Builder& b, const Heartbeat& m) { return wire::CreateHeartbeat(b, text(b, m.phase), m.progress); }
auto pack(Builder& b, const Failure& m) {
  return wire::CreateFailure(b, text(b, m.who), text(b, m.phase), text(b, m.text));
}
auto pack(Builder& b, const Goodbye& m) { return wire::CreateGoodbye(b, text(b, m.reason)); }
auto pack(Builder& b, const Farewell& m) { return wire::CreateFarewell(b, list(b, m.figures)); }

// ---- size ---------------------------------------------------------------------------------------

/// Bytes [B] that a value holds; the builder must not be fed more than it can address.
std::size_t payload(const std::string& s) { return s.size(); }
template <class T>
std::size_t payload(const std::vector<T>& items);
template <class T>
std::size_t payload(const T& value) {
  std::size_t sum = sizeof(T);
  for_each_member(value, [&](const char*, const auto& member) { sum += payload(member); });
  return sum;
}
template <class T>
std::size_t payload(const std::vector<T>& items) {
  if constexpr (std::is_arithmetic_v<T>) return items.size() * sizeof(T);
  std::size_t sum = 0;
  for (const T& item : items) sum += payload(item);
  return sum;
}

void limit(std::size_t size, const Message& message) {
  require(size <= largest_message, "a message must have at most {} B; got {} B for {}: use a smaller mesh",
          largest_message, size, name(message));
}

}  // namespace

std::uint64_t schema_fingerprint() { return fnv1a(wire::schema); }

const char* name(const Message& message) {
  return wire::EnumNameBody(static_cast<wire::Body>(message.index() + 1));
}

Bytes encode(const Envelope& envelope) {
  const auto& [stamp, message] = envelope;
  limit(std::visit([](const auto& m) { return payload(m); }, message), message);
  Builder builder;
  builder.ForceDefaults(true);  // −0.0 equals the default 0 but must arrive as −0.0
  const auto body = std::visit([&](const auto& m) { return pack(builder, m).Union(); }, message);
  const auto type = static_cast<wire::Body>(message.index() + 1);
  wire::FinishEnvelopeBuffer(
      builder, wire::CreateEnvelope(builder, stamp.run, stamp.step, stamp.sub_iteration, type, body));
  limit(builder.GetSize(), message);
  return {builder.GetBufferPointer(), builder.GetBufferPointer() + builder.GetSize()};
}

}  // namespace fpi::proto
