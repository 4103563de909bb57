/// The codec keeps every message to the last bit and takes nothing else.
#include "proto/codec.hpp"

#include <flatbuffers/flatbuffers.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/error.hpp"
#include "samples.hpp"

namespace fpi::proto {
namespace {

std::string reason(const Bytes& bytes) {
  const auto result = decode(bytes);
  const auto* malformed = std::get_if<Malformed>(&result);
  return malformed ? malformed->reason : "";
}
std::string reason(const Message& message) { return reason(encode({{}, message})); }

TEST(Codec, has_a_sample_of_every_message) {
  const auto envelopes = samples::all();
  ASSERT_EQ(envelopes.size(), std::variant_size_v<Message>);
  for (std::size_t i = 0; i < envelopes.size(); ++i) EXPECT_EQ(envelopes[i].message.index(), i);
}

TEST(Codec, keeps_every_message_to_the_last_bit) {
  for (const Envelope& envelope : samples::all()) {
    const Bytes bytes = encode(envelope);
    const auto decoded = decode(bytes);
    ASSERT_TRUE(std::holds_alternative<Envelope>(decoded))
        << name(envelope.message) << ": " << std::get<Malformed>(decoded).reason;
    EXPECT_TRUE(samples::same_envelope(std::get<Envelope>(decoded), envelope)) << name(envelope.message);
    EXPECT_EQ(encode(std::get<Envelope>(decoded)), bytes) << name(envelope.message);
  }
}

TEST(Codec, keeps_negative_zero) {
  const auto decoded = decode(encode({{}, FluidAdvance{.time = -0.0}}));
  EXPECT_TRUE(std::signbit(std::get<FluidAdvance>(std::get<Envelope>(decoded).message).time));
}

TEST(Codec, reads_bytes_at_any_address) {
  const Envelope envelope{{1, 2, 3}, FluidAdvance{0.3, 0.1, {samples::arcs()}}};
  const Bytes bytes = encode(envelope);
  for (std::size_t shift = 0; shift < 8; ++shift) {
    Bytes shifted(shift, 0);
    shifted.insert(shifted.end(), bytes.begin(), bytes.end());
    const auto decoded = decode(std::span(shifted).subspan(shift));
    ASSERT_TRUE(std::holds_alternative<Envelope>(decoded)) << shift;
    EXPECT_TRUE(samples::same_envelope(std::get<Envelope>(decoded), envelope)) << shift;
  }
}

TEST(Codec, refuses_truncated_bytes) {
  for (const Envelope& envelope : samples::all()) {
    const Bytes bytes = encode(envelope);
    for (std::size_t n = 0; n < bytes.size(); ++n) {
      const auto decoded = decode(std::span(bytes).first(n));
      const auto* taken = std::get_if<Envelope>(&decoded);
      EXPECT_TRUE(!taken || samples::same_envelope(*taken, envelope))  // only padding may be missing
          << name(envelope.message) << " cut at " << n;
    }
    EXPECT_NE(reason(Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(bytes.size() / 2))),
              "");
  }
}

TEST(Codec, survives_flipped_bits) {
  std::mt19937_64 random(20240607);
  std::size_t refused = 0;
  for (const Envelope& envelope : samples::all()) {
    const Bytes intact = encode(envelope);
    for (int trial = 0; trial < 2000; ++trial) {
      Bytes bytes = intact;
      for (std::uint64_t flips = 1 + random() % 4; flips > 0; --flips)
        bytes[random() % bytes.size()] ^= static_cast<std::uint8_t>(1u << random() % 8);
      const auto decoded = decode(bytes);
      if (const auto* taken = std::get_if<Envelope>(&decoded))
        encode(*taken);  // what is taken is usable
      else
        refused += !std::get<Malformed>(decoded).reason.empty();
    }
  }
  EXPECT_GT(refused, 10000u);
}

TEST(Codec, refuses_bytes_of_something_else) {
  EXPECT_NE(reason(Bytes{}), "");
  EXPECT_NE(reason(Bytes(100, 0)), "");
  EXPECT_NE(reason(Bytes(4096, 0xff)), "");
}

TEST(Codec, refuses_parts_that_are_used_again) {
  // A Configured whose 20 000 notes are one string of 100 kB: 180 kB that would become 2 GB.
  flatbuffers::FlatBufferBuilder b;
  const auto note = b.CreateString(std::string(100'000, 'x'));
  const auto notes = b.CreateVector(std::vector(20'000, note));
  const auto configured = b.StartTable();
  b.AddOffset(8, notes);
  const flatbuffers::Offset<void> body(b.EndTable(configured));
  const auto envelope = b.StartTable();
  b.AddElement<std::uint8_t>(10, 5, 0);
  b.AddOffset(12, body);
  b.Finish(flatbuffers::Offset<void>(b.EndTable(envelope)), "FPI1");
  EXPECT_EQ(reason(Bytes(b.GetBufferPointer(), b.GetBufferPointer() + b.GetSize())),
            "every part must be given once; the same bytes are used again");
}

/// An Envelope of a DemAdvanced whose list of `n` elements of `size` bytes begins 4 bytes off their
/// alignment: FlatBuffers' verifier looks at the place of its length only.
Bytes with_misaligned_list(flatbuffers::voffset_t member, std::size_t size, std::uint8_t type) {
  flatbuffers::FlatBufferBuilder b;
  b.ForceVectorAlignment(size + 4, 1, 8);  // a length, then elements that are not where they should be
  b.PushBytes(Bytes(size, 0).data(), size);
  b.PushElement<flatbuffers::uoffset_t>(1);
  const flatbuffers::Offset<void> list(b.GetSize());
  const auto body = b.StartTable();
  b.AddOffset(member, list);
  const flatbuffers::Offset<void> message(b.EndTable(body));
  const auto envelope = b.StartTable();
  b.AddElement<std::uint8_t>(10, type, 0);
  b.AddOffset(12, message);
  b.Finish(flatbuffers::Offset<void>(b.EndTable(envelope)), "FPI1");
  return {b.GetBufferPointer(), b.GetBufferPointer() + b.GetSize()};
}

TEST(Codec, refuses_lists_that_are_not_aligned) {
  constexpr std::uint8_t dem_advance = 8, dem_advanced = 9;
  constexpr std::size_t motion = 112;
  EXPECT_EQ(reason(with_misaligned_list(8, motion, dem_advanced)),
            "lists must be aligned to their elements of 8 B; one is not");
  EXPECT_EQ(reason(with_misaligned_list(12, 8, dem_advance)),
            "lists must be aligned to their elements of 8 B; one is not");
}

TEST(Codec, refuses_numbers_that_are_not_finite_and_says_where) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Interface mesh = samples::arcs();
    mesh.velocities[5] = bad;
    EXPECT_EQ(reason(FluidAdvance{0.3, 0.1, {samples::arcs(), mesh}}),
              fmt::format("FluidAdvance.interfaces[1].velocities[5] must be finite; got {}", bad));
    Motion motion = samples::motion();
    motion.spin[2] = bad;
    EXPECT_EQ(reason(DemAdvanced{.motions = {motion}}),
              fmt::format("DemAdvanced.motions[0].spin[2] must be finite; got {}", bad));
    EXPECT_EQ(reason(Farewell{{{"factor", bad}}}),
              fmt::format("Farewell.figures[0].value must be finite; got {}", bad));
  }
}

/// Messages that break one rule each, with what the sentence says is required.
TEST(Codec, refuses_what_breaks_a_rule) {
  const auto advance = [](auto&& damage) -> Message {
    Interface mesh = samples::arcs();
    damage(mesh);
    return FluidAdvance{0.3, 0.1, {mesh}};
  };
  const std::vector<std::pair<Message, std::string>> cases{
      {Hello{.role = std::string(201, 'x')}, "at most 200 bytes"},
      {Hello{.role = "\x1b[31m"}, "Hello.role must be UTF-8 text without control characters"},
      {Hello{.role = "fluid", .program = "caf\xe9"}, "Hello.program must be UTF-8 text"},
      {Hello{.role = "fluid", .capabilities = {"\xc0\xaf"}}, "Hello.capabilities[0] must be UTF-8 text"},
      {Failure{.text = "d\xe9"
                       "faut"},
       "Failure.text must be UTF-8 text without control characters; got \"d\ufffdfaut\""},
      {Accepted{{{"\xff", 1}}}, "Accepted.figures[0].name must be UTF-8 text"},
      {Configured{.notes = {"\xed\xa0\x80"}}, "Configured.notes[0] must be UTF-8 text"},
      {Fields{.profiles = {{.name = "\xf5"}}}, "Fields.profiles[0].name must be UTF-8 text"},
      {Welcome{.heartbeat_interval = 0}, "heartbeat_interval must be > 0 s; got 0"},
      {Welcome{.silence_timeout = -1}, "silence_timeout must be > 0 s; got -1"},
      {Configured{.arc_lengths = {{0, -1}}}, "Configured.arc_lengths[0].length must be > 0 m; got -1"},
      {Configured{.resolved_gap_ratio = -1}, "resolved_gap_ratio must be >= 0; got -1"},
      {FluidAdvance{.time_step = -0.1}, "FluidAdvance.time_step must be >= 0 s; got -0.1"},
      {DemAdvance{.time_step = -0.1}, "DemAdvance.time_step must be >= 0 s; got -0.1"},
      {DemAdvance{.resolved_gaps = {0.1, 0}}, "resolved_gaps must be > 0 m; got 0"},
      {advance([](Interface& m) { m.radius = -1; }), "radius must be >= 0 m; got -1"},
      {advance([](Interface& m) { m.end.pop_back(); }), "end must be as long as start (2); got 1"},
      {advance([](Interface& m) { m.end[0] = -1; }), "end must be above start"},
      {advance([](Interface& m) { m.end[1] = 9; }), "by one turn at most"},
      {advance([](Interface& m) { m.radius = 0; }), "start must be given where radius > 0, and only there"},
      {advance([](Interface& m) { m.vertices = {0, 0, 1, 0, 0, 1}; }), "and empty elsewhere"},
      {advance([](Interface& m) { m = samples::surface(), m.vertices.pop_back(); }),
       "three or more vertices"},
      {advance([](Interface& m) { m.points = 0; }), "points must be > 0 where the motion is not rigid"},
      {advance([](Interface& m) { m.velocities.pop_back(); }), "2 * points * arcs = 8 numbers; got 7"},
      {advance([](Interface& m) { m.points = 0xffffffff; }), "velocities must be"},
      {FluidAdvanced{.tractions = {{.values = {1, 2, 3}, .arc_length = 1}}},
       "values must be two numbers an arc"},
      {FluidAdvanced{.tractions = {{.arc_length = -1}}}, "tractions[0].arc_length must be >= 0 m"},
      {FluidAdvance{.interfaces = {samples::arcs()}, .same_interfaces = true},
       "interfaces must be empty where same_interfaces is set; got 1"},
      {FluidAdvanced{.time_error = -1}, "time_error must be >= 0; got -1"},
      {FluidAdvanced{.time_error_order = -1}, "time_error_order must be >= 0; got -1"},
      {FluidAdvanced{.speed = -1}, "speed must be >= 0 m/s; got -1"},
      {FluidAdvanced{.residual = -1}, "residual must be >= 0"},
      {FluidAdvanced{.resistance = {1, 2}}, "resistance must be as many columns as rows; got 2"},
      {DemAdvance{.loads = {{}}, .resistance = {1, 2, 3, 4}},
       "resistance must be empty, or 3 rows and columns, three a load; got 4"},
      {DemAdvance{.loads = {{.start = {0}, .end = {1}, .tractions = {1}}}},
       "two numbers for each of 1 arcs; got 1"},
      {DemAdvanced{.largest_overlap = -1}, "largest_overlap must be >= 0 m"},
      {DemAdvanced{.motions = {{.orientation = {1, 1, 0, 0}}}}, "orientation must be a unit quaternion"},
      {Fields{.fields = {{.name = "u", .components = 0}}}, "components must be > 0"},
      {Fields{.fields = {{.name = "u", .components = 2, .values = {1}}}},
       "a multiple of components (2); got 1"},
      {Fields{.points = {1, 2}}, "points must be x, y, z of each point"},
      {Fields{.points = {1, 2, 3}, .cells = {0}}, "cells must be 6 indices each"},
      {Fields{.points = {1, 2, 3}, .cells = {0, 0, 0, 0, 0, 1}}, "indices below the 1 points; got 1"},
      {Fields{.points = {1, 2, 3}, .fields = {{.name = "p", .values = {1, 2}}}},
       "1 numbers for \"p\"; got 2"},
      {Fields{.boundaries = {{.name = "w", .points = {1, 2}}}},
       "boundaries[0].points must be x, y, z of each point; got 2"},
      {Fields{.boundaries = {{.name = "w", .lines = {0, 1}}}}, "lines must be 3 indices each; got 2"},
      {Fields{.boundaries = {{.name = "w", .points = {1, 2, 3}, .lines = {0, 0, 1}}}},
       "below the 1 points; got 1"},
      {Fields{.profiles = {{.name = "p", .components = 0}}}, "profiles[0].components must be > 0; got 0"},
      {Fields{.profiles = {{.name = "p", .points = {1, 2, 3}, .values = {1, 2}}}},
       "values must be 1 numbers; got 2"},
      {Fields{.fields = {{.name = "a/b"}}}, "name must be a word of letters, digits and _; got a/b"},
      {Fields{.fields = {{.name = "\"><x"}}}, "name must be a word of letters"},
      {Fields{.fields = {{.name = "u"}, {.name = "u"}}},
       "fields must be of different names; got \"u\" again"},
      {Fields{.boundaries = {{}}}, "boundaries[0].name must be given; got none"},
      {Fields{.tables = {{"../up", {"x"}, {}}}}, "name must be a word of letters, digits and _; got ../up"},
      {Fields{.tables = {{"t", {"x", "y"}, {1, 2, 3}}}},
       "values must be rows of one number or more a column"},
      {Heartbeat{.progress = 1.5}, "progress must be between 0 and 1; got 1.5"},
  };
  for (const auto& [message, required] : cases)
    EXPECT_NE(reason(message).find(required), std::string::npos)
        << "required: " << required << "\ngot: " << reason(message);
}

TEST(Codec, knows_its_schema) {
  EXPECT_NE(schema_fingerprint(), 0xcbf29ce484222325u) << "the hash of nothing";
}

}  // namespace
}  // namespace fpi::proto
