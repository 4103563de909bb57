#include "fluid/base/state.hpp"

#include "core/bytes.hpp"

namespace fpi::fluid {
namespace {

constexpr std::uint64_t magic = 0x36534c4644495046;  // "FPIDFLS6"

constexpr std::size_t bytes_a_body = 8 * sizeof(double);  // its place and its load

std::span<const double> view(const Vector& v) { return {v.data(), static_cast<std::size_t>(v.size())}; }

Vector read_vector(ByteReader& read, Eigen::Index size) {
  Vector v(size);
  read.numbers({v.data(), static_cast<std::size_t>(size)});
  return v;
}

}  // namespace

State State::at_rest(Index n_nodes, Index n_vertices) {
  State state;
  state.u = Vector::Zero(2 * static_cast<Eigen::Index>(n_nodes));
  state.acceleration = state.previous_u = state.previous_acceleration = state.mesh_velocity = state.u;
  state.p = Vector::Zero(n_vertices);
  return state;
}

void State::forget_past() {
  previous_step = step_before = 0;
  has_acceleration = has_previous_acceleration = false;
  acceleration.setZero();
  p.setZero();
  prediction_errors = {};
}

std::vector<std::uint8_t> to_bytes(const State& state) {
  ByteWriter write;
  write.put(magic);
  write.put(static_cast<std::uint64_t>(state.u.size() / 2));
  write.put(static_cast<std::uint64_t>(state.p.size()));
  write.put(state.time);
  write.put(static_cast<std::uint8_t>(state.has_acceleration));
  write.put(view(state.u));
  write.put(view(state.acceleration));
  write.put(view(state.p));
  write.put(state.previous_step);
  write.put(state.step_before);
  write.put(view(state.previous_u));
  write.put(static_cast<std::uint8_t>(state.has_previous_acceleration));
  write.put(view(state.previous_acceleration));
  write.put(view(state.mesh_velocity));
  write.put(static_cast<std::uint64_t>(state.places.size()));
  for (const BodyPlace& place : state.places) {
    write.put(static_cast<std::int64_t>(place.body));
    for (const double number : {place.centre.x(), place.centre.y(), place.angle}) write.put(number);
  }
  for (const MeanLoad& load : state.loads) {
    write.put(static_cast<std::int64_t>(load.body));
    for (const double number : {load.force.x(), load.force.y(), load.torque}) write.put(number);
  }
  for (const Vector* in_cells : {&state.fluid_in_cells, &state.previous_fluid_in_cells}) {
    write.put(static_cast<std::uint64_t>(in_cells->size()));
    write.put(view(*in_cells));
  }
  write.put(static_cast<std::int64_t>(state.damped_steps));
  for (const double error : state.prediction_errors) write.put(error);
  return std::move(write.bytes);
}

State from_bytes(std::span<const std::uint8_t> bytes, Index n_nodes, Index n_vertices) {
  ByteReader read(bytes, "the fluid's state");
  require(read.get<std::uint64_t>() == magic, "a state of this fluid is required; got other bytes");
  const auto nodes = read.get<std::uint64_t>(), vertices = read.get<std::uint64_t>();
  require(
      nodes == static_cast<std::uint64_t>(n_nodes) && vertices == static_cast<std::uint64_t>(n_vertices),
      "a state of {} nodes and {} vertices is required; got {} and {}: resume the scene it was written by",
      n_nodes, n_vertices, nodes, vertices);
  State state;
  state.time = read.number();
  state.has_acceleration = read.get<std::uint8_t>() != 0;
  state.u = read_vector(read, 2 * n_nodes);
  state.acceleration = read_vector(read, 2 * n_nodes);
  state.p = read_vector(read, n_vertices);
  state.previous_step = read.number();
  state.step_before = read.number();
  state.previous_u = read_vector(read, 2 * n_nodes);
  state.has_previous_acceleration = read.get<std::uint8_t>() != 0;
  state.previous_acceleration = read_vector(read, 2 * n_nodes);
  state.mesh_velocity = read_vector(read, 2 * n_nodes);
  const auto n_places = read.get<std::uint64_t>();
  require(n_places <= read.left() / bytes_a_body,
          "the fluid's state holds fewer places of bodies than the {} it names: take another checkpoint",
          n_places);
  for (std::uint64_t i = 0; i < n_places; ++i) {
    const auto body = static_cast<Index>(read.get<std::int64_t>());
    const double x = read.number(), y = read.number();
    state.places.push_back({body, Vec2(x, y), read.number()});
  }
  for (std::uint64_t i = 0; i < n_places; ++i) {
    const auto body = static_cast<Index>(read.get<std::int64_t>());
    const double x = read.number(), y = read.number();
    state.loads.push_back({body, Vec2(x, y), read.number()});
  }
  for (Vector* in_cells : {&state.fluid_in_cells, &state.previous_fluid_in_cells}) {
    const auto size = read.get<std::uint64_t>();
    require(size <= read.left() / sizeof(double),
            "the fluid's state holds fewer numbers of cells than the {} it names: take another checkpoint",
            size);
    *in_cells = read_vector(read, static_cast<Eigen::Index>(size));
  }
  state.damped_steps = static_cast<int>(read.get<std::int64_t>());
  for (double& error : state.prediction_errors) error = read.number();
  require(read.left() == 0, "the fluid's state has {} bytes too many: take another checkpoint", read.left());
  return state;
}

}  // namespace fpi::fluid
