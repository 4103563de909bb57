/// Bytes to plain messages: size limit, FlatBuffers verification, then one `unpack` a type, then `check`.
#include <bit>
#include <cstring>
#include <type_traits>

#include "core/error.hpp"
#include "fpi_generated.h"
#include "proto/codec.hpp"
#include "proto/codec/check.hpp"

namespace fpi::proto {
namespace {

static_assert(std::endian::native == std::endian::little, "lists of numbers are copied as they came");

/// Copies parts out of verified bytes. Hostile bytes may name one part many times over; an honest message has
/// every part once, so what is copied may not exceed what came.
class Reader {
 public:
  explicit Reader(std::size_t size) : left_(size) {}

  std::string text(const flatbuffers::String* s) {
    if (!s) return {};
    take(s->size());
    return s->str();
  }
  template <class T>
  std::vector<T> numbers(const flatbuffers::Vector<T>* list) {
    if (!list || list->size() == 0) return {};
    require_aligned<T>(list->Data());
    take(list->size() * sizeof(T));
    return {list->data(), list->data() + list->size()};
  }
  template <class Wire>
  auto list(const flatbuffers::Vector<Wire>* items) {
    std::vector<decltype(unpack(*this, items->Get(0)))> unpacked;
    if (!items || items->size() == 0) return unpacked;
    using Element = std::remove_cv_t<std::remove_pointer_t<Wire>>;  // a struct lies there itself
    require_aligned<Element>(items->Data());
    take(items->size() * sizeof(Element));
    unpacked.reserve(items->size());
    for (const auto* item : *items) unpacked.push_back(unpack(*this, item));
    return unpacked;
  }
  void take(std::size_t size) {
    require(size <= left_, "every part must be given once; the same bytes are used again");
    left_ -= size;
  }

 private:
  /// The verifier looks at where a list begins, which is the place of its length, not at its elements.
  template <class T>
  static void require_aligned(const std::uint8_t* first) {
    require(reinterpret_cast<std::uintptr_t>(first) % alignof(T) == 0,
            "lists must be aligned to their elements of {} B; one is not", alignof(T));
  }

  std::size_t left_;
};

// ---- parts --------------------------------------------------------------------------------------

Vec3 unpack(const wire::Vec3& v) { return {v.x(), v.y(), v.z()}; }
Vec3 unpack(const wire::Vec3* v) { return v ? unpack(*v) : Vec3{}; }

std::string unpack(Reader& r, const flatbuffers::String* s) { return r.text(s); }
std::pair<std::string, double> unpack(Reader& r, const wire::Figure* w) {
  return {r.text(w->name()), w->value()};
}
ArcLength unpack(Reader&, const wire::ArcLength* w) { return {w->body(), w->length()}; }
Motion unpack(Reader&, const wire::Motion* w) {
  const wire::Quaternion& q = w->orientation();
  return {w->body(),
          unpack(w->position()),
          {q.w(), q.x(), q.y(), q.z()},
          unpack(w->velocity()),
          unpack(w->spin())};
}
std::optional<Balance> unpack(const wire::Balance* w) {
  if (!w) return std::nullopt;
  return Balance{w->mass(),         w->inertia(),       unpack(w->velocity()),
                 unpack(w->spin()), unpack(w->force()), unpack(w->torque())};
}
Interface unpack(Reader& r, const wire::Interface* w) {
  return {.body = w->body(),
          .centre = unpack(w->centre()),
          .radius = w->radius(),
          .start = r.numbers(w->start()),
          .end = r.numbers(w->end()),
          .vertices = r.numbers(w->vertices()),
          .rigid = w->rigid(),
          .translation = unpack(w->translation()),
          .spin = unpack(w->spin()),
          .points = w->points(),
          .velocities = r.numbers(w->velocities()),
          .balance = unpack(w->balance())};
}
Traction unpack(Reader& r, const wire::Traction* w) {
  const auto given = [](const wire::Vec3* v) { return v ? std::optional(unpack(v)) : std::nullopt; };
  return {w->body(),           r.numbers(w->values()), unpack(w->force()),
          unpack(w->torque()), w->arc_length(),        unpack(w->velocity()),
          unpack(w->spin()),   given(w->mean_force()), given(w->mean_torque())};
}
Load unpack(Reader& r, const wire::Load* w) {
  return {w->body(),           unpack(w->force()),        unpack(w->torque()),   r.numbers(w->start()),
          r.numbers(w->end()), r.numbers(w->tractions()), unpack(w->velocity()), unpack(w->spin()),
          w->added_mass(),     w->added_inertia()};
}
File unpack(Reader& r, const wire::File* w) { return {r.text(w->name()), r.numbers(w->bytes())}; }
Finding unpack(Reader& r, const wire::Finding* w) {
  return {.is_error = w->is_error(), .key = r.text(w->key()), .text = r.text(w->text())};
}
Field unpack(Reader& r, const wire::Field* w) {
  return {r.text(w->name()), w->on_cells(), w->components(), r.numbers(w->values())};
}
Curve unpack(Reader& r, const wire::Curve* w) {
  return {r.text(w->name()), r.numbers(w->points()), r.numbers(w->lines()), w->components(),
          r.numbers(w->values())};
}

Sheet unpack(Reader& r, const wire::Sheet* w) {
  return {r.text(w->name()), r.list(w->columns()), r.numbers(w->values())};
}

// ---- messages -----------------------------------------------------------------------------------

Hello unpack(Reader& r, const wire::Hello* w) {
  return {w->protocol_version(),        r.text(w->role()),         r.text(w->program()),
          r.text(w->program_version()), r.list(w->capabilities()), w->schema_fingerprint(),
          w->scene_fingerprint()};
}
Welcome unpack(Reader&, const wire::Welcome* w) {
  return {w->scene_fingerprint(), w->heartbeat_interval(), w->silence_timeout()};
}
Refusal unpack(Reader& r, const wire::Refusal* w) { return {r.text(w->reason())}; }
Configure unpack(Reader& r, const wire::Configure* w) {
  return {r.text(w->scene()), r.list(w->files()), r.numbers(w->state())};
}
Configured unpack(Reader& r, const wire::Configured* w) {
  return {r.list(w->arc_lengths()), w->resolved_gap_ratio(), r.list(w->notes()), r.list(w->figures()),
          r.list(w->findings())};
}
FluidAdvance unpack(Reader& r, const wire::FluidAdvance* w) {
  return {w->time(),     w->time_step(), r.list(w->interfaces()), w->same_interfaces(), w->wants_resistance(),
          w->rehearsal()};
}
FluidAdvanced unpack(Reader& r, const wire::FluidAdvanced* w) {
  return {w->converged(), r.text(w->reason()),  r.list(w->tractions()), w->newton_iterations(),
          w->residual(),  w->time_error(),      w->time_error_order(),  r.numbers(w->resistance()),
          w->speed(),     r.list(w->findings())};
}
DemAdvance unpack(Reader& r, const wire::DemAdvance* w) {
  return {w->time(),
          w->time_step(),
          r.list(w->loads()),
          r.list(w->prescribed()),
          r.numbers(w->resolved_gaps()),
          r.list(w->walls()),
          r.numbers(w->resistance())};
}
DemAdvanced unpack(Reader& r, const wire::DemAdvanced* w) {
  return {w->converged(), r.text(w->reason()),      r.list(w->motions()),
          w->sub_steps(), r.numbers(w->contacts()), w->largest_overlap()};
}
Accept unpack(Reader& r, const wire::Accept* w) { return {r.numbers(w->left())}; }
Accepted unpack(Reader& r, const wire::Accepted* w) { return {r.list(w->figures()), r.list(w->findings())}; }
Write unpack(Reader&, const wire::Write* w) { return {w->mesh()}; }
Fields unpack(Reader& r, const wire::Fields* w) {
  return {w->time(),           r.numbers(w->points()),  r.numbers(w->cells()),
          r.list(w->fields()), r.list(w->boundaries()), r.list(w->profiles()),
          r.list(w->tables())};
}
State unpack(Reader& r, const wire::State* w) { return {r.numbers(w->bytes())}; }
Heartbeat unpack(Reader& r, const wire::Heartbeat* w) { return {r.text(w->phase()), w->progress()}; }
Failure unpack(Reader& r, const wire::Failure* w) {
  return {r.text(w->who()), r.text(w->phase()), r.text(w->text())};
}
Goodbye unpack(Reader& r, const wire::Goodbye* w) { return {r.text(w->reason())}; }
Farewell unpack(Reader& r, const wire::Farewell* w) { return {r.list(w->figures())}; }

Message unpack(Reader& r, const wire::Envelope& e) {
  switch (e.body_type()) {
    case wire::Body::Hello:
      return unpack(r, e.body_as_Hello());
    case wire::Body::Welcome:
      return unpack(r, e.body_as_Welcome());
    case wire::Body::Refusal:
      return unpack(r, e.body_as_Refusal());
    case wire::Body::Configure:
      return unpack(r, e.body_as_Configure());
    case wire::Body::Configured:
      return unpack(r, e.body_as_Configured());
    case wire::Body::FluidAdvance:
      return unpack(r, e.body_as_FluidAdvance());
    case wire::Body::FluidAdvanced:
      return unpack(r, e.body_as_FluidAdvanced());
    case wire::Body::DemAdvance:
      return unpack(r, e.body_as_DemAdvance());
    case wire::Body::DemAdvanced:
      return unpack(r, e.body_as_DemAdvanced());
    case wire::Body::Accept:
      return unpack(r, e.body_as_Accept());
    case wire::Body::Accepted:
      return unpack(r, e.body_as_Accepted());
    case wire::Body::Restore:
      return Restore{};
    case wire::Body::Restored:
      return Restored{};
    case wire::Body::Write:
      return unpack(r, e.body_as_Write());
    case wire::Body::Fields:
      return unpack(r, e.body_as_Fields());
    case wire::Body::Checkpoint:
      return Checkpoint{};
    case wire::Body::State:
      return unpack(r, e.body_as_State());
    case wire::Body::Heartbeat:
      return unpack(r, e.body_as_Heartbeat());
    case wire::Body::Failure:
      return unpack(r, e.body_as_Failure());
    case wire::Body::Goodbye:
      return unpack(r, e.body_as_Goodbye());
    case wire::Body::Farewell:
      return unpack(r, e.body_as_Farewell());
    case wire::Body::NONE:
      break;
  }
  fail("a message of protocol version {} is required; got one of unknown type {}", protocol_version,
       static_cast<int>(e.body_type()));
}

Envelope read(std::span<const std::uint8_t> bytes) {
  flatbuffers::Verifier verifier(bytes.data(), bytes.size());
  require(wire::VerifyEnvelopeBuffer(verifier),
          "an intact message of protocol version {} is required; got {} B that "
          "are none",
          protocol_version, bytes.size());
  const wire::Envelope& envelope = *wire::GetEnvelope(bytes.data());
  Reader reader(bytes.size());
  Envelope plain{{envelope.run(), envelope.step(), envelope.sub_iteration()}, unpack(reader, envelope)};
  check(plain.message);
  return plain;
}

}  // namespace

std::variant<Envelope, Malformed> decode(std::span<const std::uint8_t> bytes) {
  try {
    require(bytes.size() <= largest_message, "a message must have at most {} B; got {} B", largest_message,
            bytes.size());
    constexpr std::size_t alignment = 8;
    if (reinterpret_cast<std::uintptr_t>(bytes.data()) % alignment == 0) return read(bytes);
    return read(Bytes(bytes.begin(), bytes.end()));
  } catch (const Error& e) {
    return Malformed{e.what()};
  }
}

}  // namespace fpi::proto
