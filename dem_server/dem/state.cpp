#include "dem/state.hpp"

#include <cmath>

#include "core/bytes.hpp"

namespace fpi::dem {
namespace {

constexpr std::uint64_t magic = 0x31534d4544495046;  // "FPIDEMS1"
constexpr std::size_t body_size = 13 * sizeof(double);
constexpr std::size_t pair_size = 2 * sizeof(std::uint32_t) + 6 * sizeof(double);

class Writer : public ByteWriter {
 public:
  using ByteWriter::put;
  void put(const Vec3& v) { put(std::span<const double>(v.data(), 3)); }
  void put(const Quaternion& q) {
    for (const double value : {q.w(), q.x(), q.y(), q.z()}) put(value);
  }
};

class Reader : public ByteReader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : ByteReader(bytes, "the DEM's state") {}
  Vec3 vector() {
    Vec3 v;
    numbers({v.data(), 3});
    return v;
  }
  Quaternion quaternion() {
    const double w = number(), x = number(), y = number(), z = number();
    const Quaternion q(w, x, y, z);
    require(std::abs(q.norm() - 1) < 1e-9, "the DEM's state must have unit quaternions; got norm {}",
            q.norm());
    return q;
  }
};

void check_plane(const Model& model, const Motions& motions) {
  for (std::size_t i = 0; i < motions.position.size(); ++i) {
    const Vec3& w = motions.spin[i];
    require(motions.position[i].z() == 0 && motions.velocity[i].z() == 0 && w.x() == 0 && w.y() == 0,
            "the DEM's state has disc {} out of its plane: take another checkpoint", model.bodies.name[i]);
  }
}

void check_pairs(const Model& model, const std::vector<Pair>& pairs) {
  const std::size_t n = model.bodies.size();
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const auto [a, b] = pairs[p];
    require(a < n && a < b && b < n + model.walls.size() && (p == 0 || pairs[p - 1] < pairs[p]),
            "the DEM's state has a contact {} of bodies {} and {} that cannot be: take another checkpoint", p,
            a, b);
  }
}

}  // namespace

std::vector<std::uint8_t> to_bytes(const State& state) {
  Writer write;
  const Motions& motions = state.motions;
  const std::size_t n = motions.position.size(), n_pairs = state.neighbours.pairs.size();
  write.bytes.reserve(3 * sizeof(std::uint64_t) + n * body_size + n_pairs * pair_size);
  write.put(magic);
  write.put(std::uint64_t{n});
  write.put(std::uint64_t{n_pairs});
  for (std::size_t i = 0; i < n; ++i) {
    write.put(motions.position[i]);
    write.put(motions.orientation[i].base);
    write.put(motions.velocity[i]);
    write.put(motions.spin[i]);
  }
  for (std::size_t p = 0; p < n_pairs; ++p) {
    write.put(state.neighbours.pairs[p].a);
    write.put(state.neighbours.pairs[p].b);
    write.put(state.neighbours.memories[p].slip);
    write.put(state.neighbours.memories[p].roll);
  }
  return std::move(write.bytes);
}

State from_bytes(std::span<const std::uint8_t> bytes, const Model& model) {
  Reader read(bytes);
  require(read.get<std::uint64_t>() == magic, "a state of this DEM is required; got other bytes");
  const auto n = read.get<std::uint64_t>(), n_pairs = read.get<std::uint64_t>();
  require(n == model.bodies.size(),
          "a state of {} bodies is required; got {}: resume the scene it was written by", model.bodies.size(),
          n);
  require(n_pairs <= read.left() / pair_size && read.left() == n * body_size + n_pairs * pair_size,
          "a DEM state of {} bodies and {} contacts has another length than the {} bytes that came", n,
          n_pairs, bytes.size());
  State state;
  for (std::size_t i = 0; i < n; ++i) {
    state.motions.position.push_back(read.vector());
    state.motions.orientation.push_back({read.quaternion(), Vec3::Zero()});
    state.motions.velocity.push_back(read.vector());
    state.motions.spin.push_back(read.vector());
  }
  for (std::size_t p = 0; p < n_pairs; ++p) {
    const auto a = read.get<std::uint32_t>(), b = read.get<std::uint32_t>();
    state.neighbours.pairs.push_back({a, b});
    const Vec3 slip = read.vector(), roll = read.vector();
    state.neighbours.memories.push_back({slip, roll});
  }
  if (model.plane) check_plane(model, state.motions);
  check_pairs(model, state.neighbours.pairs);
  return state;
}

}  // namespace fpi::dem
