#include "dem/contact/state.hpp"

#include <array>
#include <cmath>

#include "core/bytes.hpp"

namespace fpi::dem {
namespace {

constexpr std::uint64_t magic = 0x38534d4544495046;  // "FPIDEMS8"
constexpr std::size_t body_size = 13 * sizeof(double);
constexpr std::size_t contact_size = 2 * sizeof(std::uint32_t) + 7 * sizeof(double);
constexpr std::size_t wall_contact_size = contact_size + sizeof(Image);
constexpr std::size_t load_size = 6 * sizeof(double);
constexpr std::size_t works_size = sizeof(Works);
constexpr std::size_t taken_size = all_energies.size() * sizeof(double);
constexpr std::size_t wall_size = 10 * sizeof(double);

constexpr std::array all_works{&Works::conservative, &Works::damping, &Works::friction,  &Works::turning,
                               &Works::films,        &Works::loads,   &Works::boundaries};
static_assert(all_works.size() * sizeof(double) == works_size);

class Writer : public ByteWriter {
 public:
  using ByteWriter::put;
  void put(const Vec3& v) { put(std::span<const double>(v.data(), 3)); }
  void put(const Quaternion& q) {
    for (const double value : {q.w(), q.x(), q.y(), q.z()}) put(value);
  }
  void put(const Pair& pair) {
    put(pair.a);
    put(pair.b);
  }
  void put(const WallPlace& place) {
    put(place.body);
    put(place.facet);
    for (const std::int64_t boxes : place.image) put(boxes);
  }
  template <class Place>
  void put(const ContactList<Place>& list) {
    for (std::size_t p = 0; p < list.places.size(); ++p) {
      put(list.places[p]);
      put(list.histories[p].slip);
      put(list.histories[p].roll);
      put(list.histories[p].twist);
    }
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
  /// `count` contacts of a body below `n_first` and another or a facet below `n_second`, in order.
  template <class Place>
  void contacts(std::uint64_t count, std::size_t n_first, std::size_t n_second, ContactList<Place>& list) {
    for (std::size_t p = 0; p < count; ++p) {
      const auto a = get<std::uint32_t>(), b = get<std::uint32_t>();
      list.places.push_back({a, b});
      if constexpr (std::is_same_v<Place, WallPlace>)
        for (std::int64_t& boxes : list.places[p].image) boxes = get<std::int64_t>();
      require(a < n_first && b < n_second && (p == 0 || list.places[p - 1] < list.places[p]),
              "the DEM's state has a contact {} of {} and {} that cannot be: take another checkpoint", p, a,
              b);
      const Vec3 slip = vector(), roll = vector();
      list.histories.push_back({slip, roll, number()});
    }
  }
};

void check_plane(const Model& model, const Motions& motions) {
  for (std::size_t i = 0; i < motions.position.size(); ++i) {
    const Vec3& w = motions.spin[i];
    require(motions.position[i].z() == 0 && motions.velocity[i].z() == 0 && w.x() == 0 && w.y() == 0,
            "the DEM's state has disc {} out of its plane: take another checkpoint", model.bodies.name[i]);
  }
}

}  // namespace

void find_neighbours(const Model& model, double reach, State& state) {
  state.neighbours = std::make_shared<const Neighbours>(search(model, state.motions.position, reach));
  search_walls(model, state.motions.position, state.neighbours->widest_gap(), state.wall_contacts);
}

void forget_contacts_of_left(const Model& model, State& state) {
  const std::vector<bool>& left = model.bodies.left;
  state.contacts.keep(
      [&](const Pair& pair, const ContactHistory&) { return !left[pair.a] && !left[pair.b]; });
  state.wall_contacts.keep([&](const WallPlace& place, const ContactHistory&) { return !left[place.body]; });
  state.neighbours.reset();
}

void forget_search(State& state) {
  state.contacts.sort();
  state.contacts.keep_remembered();
  state.wall_contacts.keep_remembered();
  state.neighbours.reset();
}

std::vector<std::uint8_t> to_bytes(const State& state) {
  Writer write;
  const Motions& motions = state.motions;
  const std::size_t n = motions.position.size();
  const std::size_t n_pairs = state.contacts.places.size(), n_touched = state.wall_contacts.places.size();
  const std::size_t n_walls = state.wall_contacts.motions.size(), n_loads = state.loads.force.size();
  const std::size_t n_left = state.left.size();
  write.bytes.reserve(works_size + taken_size + 7 * sizeof(std::uint64_t) + n_left * sizeof(std::uint32_t) +
                      n * body_size + n_walls * wall_size + n_loads * load_size + n_pairs * contact_size +
                      n_touched * wall_contact_size);
  write.put(magic);
  write.put(std::uint64_t{n});
  write.put(std::uint64_t{n_pairs});
  write.put(std::uint64_t{n_touched});
  write.put(std::uint64_t{n_walls});
  write.put(std::uint64_t{n_loads});
  write.put(std::uint64_t{n_left});
  for (std::size_t i = 0; i < n; ++i) {
    write.put(motions.position[i]);
    write.put(motions.orientation[i].base);
    write.put(motions.velocity[i]);
    write.put(motions.spin[i]);
  }
  for (const WallMotion& wall : state.wall_contacts.motions) {
    write.put(wall.position);
    write.put(wall.orientation);
    write.put(wall.spin);
  }
  for (double Works::*work : all_works) write.put(state.works.*work);
  for (double Energies::*part : all_energies) write.put(state.taken.*part);
  for (const std::uint32_t body : state.left) write.put(body);
  for (std::size_t i = 0; i < n_loads; ++i) {
    write.put(state.loads.force[i]);
    write.put(state.loads.torque[i]);
  }
  write.put(state.contacts);
  write.put(state.wall_contacts);
  return std::move(write.bytes);
}

State from_bytes(std::span<const std::uint8_t> bytes, const Model& model) {
  Reader read(bytes);
  require(read.get<std::uint64_t>() == magic, "a state of this DEM is required; got other bytes");
  const auto n = read.get<std::uint64_t>();
  const auto n_pairs = read.get<std::uint64_t>(), n_touched = read.get<std::uint64_t>();
  const auto n_walls = read.get<std::uint64_t>(), n_loads = read.get<std::uint64_t>();
  const auto n_left = read.get<std::uint64_t>();
  require(n == model.bodies.size() && n_walls == model.walls.walls.size(),
          "a state of {} bodies and {} walls is required; got {} and {}: resume the scene it was written by",
          model.bodies.size(), model.walls.walls.size(), n, n_walls);
  require(n_loads == 0 || n_loads == n, "a DEM state of {} bodies cannot have {} loads", n, n_loads);
  const std::uint64_t most = read.left() / contact_size;
  require(n_pairs <= most && n_touched <= most && n_left <= n &&
              read.left() == works_size + taken_size + n_left * sizeof(std::uint32_t) + n * body_size +
                                 n_walls * wall_size + n_loads * load_size + n_pairs * contact_size +
                                 n_touched * wall_contact_size,
          "a DEM state of {} bodies and {} contacts has another length than the {} bytes that came", n,
          n_pairs + n_touched, bytes.size());
  State state;
  for (std::size_t i = 0; i < n; ++i) {
    state.motions.position.push_back(read.vector());
    state.motions.orientation.push_back({read.quaternion(), Vec3::Zero()});
    state.motions.velocity.push_back(read.vector());
    state.motions.spin.push_back(read.vector());
  }
  for (std::size_t w = 0; w < n_walls; ++w) {
    WallMotion& wall = state.wall_contacts.motions.emplace_back();
    wall.position = read.vector();
    wall.orientation = read.quaternion();
    wall.spin = read.vector();
  }
  for (double Works::*work : all_works) state.works.*work = read.number();
  for (double Energies::*part : all_energies) state.taken.*part = read.number();
  for (std::size_t k = 0; k < n_left; ++k) {
    state.left.push_back(read.get<std::uint32_t>());
    require(state.left.back() < n, "the DEM's state has body {} of {} leave: take another checkpoint",
            state.left.back(), n);
  }
  for (std::size_t i = 0; i < n_loads; ++i) {
    state.loads.force.push_back(read.vector());
    state.loads.torque.push_back(read.vector());
  }
  read.contacts(n_pairs, n, n, state.contacts);
  read.contacts(n_touched, n, model.walls.facets.size(), state.wall_contacts);
  for (const Pair& pair : state.contacts.places)
    require(pair.a < pair.b, "the DEM's state has a pair {} and {} that is out of order", pair.a, pair.b);
  if (model.plane) check_plane(model, state.motions);
  return state;
}

}  // namespace fpi::dem
