#include "dem/state.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "core/error.hpp"

namespace fpi::dem {
namespace {

static_assert(std::endian::native == std::endian::little, "the state is written as the machine has it");

constexpr std::uint64_t magic = 0x31534d4544495046;  // "FPIDEMS1"
constexpr std::size_t body_size = 13 * sizeof(double);
constexpr std::size_t pair_size = 2 * sizeof(std::uint32_t) + 6 * sizeof(double);

class Writer {
 public:
  template <class T>
  requires std::is_arithmetic_v<T>
  void operator()(const T& value) {
    const auto* first = reinterpret_cast<const std::uint8_t*>(&value);
    bytes.insert(bytes.end(), first, first + sizeof(T));
  }
  void operator()(const Vec3& v) {
    for (int d = 0; d < 3; ++d) (*this)(v[d]);
  }
  void operator()(const Quaternion& q) {
    for (const double value : {q.w(), q.x(), q.y(), q.z()}) (*this)(value);
  }
  std::vector<std::uint8_t> bytes;
};

class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  template <class T>
  T get() {
    require(bytes_.size() >= sizeof(T), "the DEM's state ends too early: take another checkpoint");
    T value;
    std::memcpy(&value, bytes_.data(), sizeof(T));
    bytes_ = bytes_.subspan(sizeof(T));
    return value;
  }
  double number() {
    const double value = get<double>();
    require(std::isfinite(value), "the DEM's state must have finite numbers; got {}: take another checkpoint",
            value);
    return value;
  }
  Vec3 vector() {
    const double x = number(), y = number(), z = number();
    return {x, y, z};
  }
  Quaternion quaternion() {
    const double w = number(), x = number(), y = number(), z = number();
    const Quaternion q(w, x, y, z);
    require(std::abs(q.norm() - 1) < 1e-9, "the DEM's state must have unit quaternions; got norm {}",
            q.norm());
    return q;
  }
  std::size_t left() const { return bytes_.size(); }

 private:
  std::span<const std::uint8_t> bytes_;
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
  write(magic);
  write(std::uint64_t{n});
  write(std::uint64_t{n_pairs});
  for (std::size_t i = 0; i < n; ++i) {
    write(motions.position[i]);
    write(motions.orientation[i].base);
    write(motions.velocity[i]);
    write(motions.spin[i]);
  }
  for (std::size_t p = 0; p < n_pairs; ++p) {
    write(state.neighbours.pairs[p].a);
    write(state.neighbours.pairs[p].b);
    write(state.neighbours.memories[p].slip);
    write(state.neighbours.memories[p].roll);
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
