#include "dem/pair_forces.hpp"

#include <array>
#include <bit>
#include <tuple>

#include "core/parallel.hpp"
#include "dem/triple.hpp"

namespace fpi::dem {
namespace {

/// For each set of lanes the numbers of those that are in it, one after another.
constexpr auto packed_lanes = [] {
  std::array<std::array<std::uint32_t, n_lanes>, 1 << n_lanes> table{};
  for (unsigned set = 0; set < table.size(); ++set) {
    for (unsigned lane = 0, k = 0; lane < n_lanes; ++lane)
      if (set >> lane & 1) table[set][k++] = lane;
  }
  return table;
}();
/// For each set of lanes a byte of ones for those in it.
constexpr auto lane_bytes = [] {
  std::array<std::uint32_t, 1 << n_lanes> table{};
  for (unsigned set = 0; set < table.size(); ++set) {
    for (unsigned lane = 0; lane < n_lanes; ++lane)
      if (set >> lane & 1) table[set] |= 0xffu << (8 * lane);
  }
  return table;
}();

/// Pairs that are near enough to act, until they are taken through the law.
struct Acting {
  static constexpr std::size_t most = 256;
  std::uint32_t pair[most + n_lanes], lower[most + n_lanes];
  std::size_t n = 0;

  void add(unsigned set, std::uint32_t first_pair, std::uint32_t i) {
    for (unsigned k = 0; k < n_lanes; ++k) {
      pair[n + k] = first_pair + packed_lanes[set][k];
      lower[n + k] = i;
    }
    n += static_cast<std::size_t>(std::popcount(set));
  }
};

void set_lane(PairLawOf<Lanes>& laws, int lane, const PairLaw& law) {
  laws.normal[lane] = law.normal;
  laws.tangential_ratio[lane] = law.tangential_ratio;
  laws.damping_ratio[lane] = law.damping_ratio;
  laws.friction[lane] = law.friction;
  laws.rolling_friction[lane] = law.rolling_friction;
  laws.twisting_friction[lane] = law.twisting_friction;
}

/// Which parts of the law a scene has; what it has not costs nothing.
template <class ElasticLaw, bool turns, bool one_law, bool recorded>
struct Parts {
  using Elastic = ElasticLaw;
  static constexpr bool turning = turns;     ///< resists rolling or twisting
  static constexpr bool single = one_law;    ///< all bodies of one material
  static constexpr bool records = recorded;  ///< each contact's forces, for the account of energies
};

template <class Law>
class PairForces {
 public:
  PairForces(const Model& model, const Neighbours& neighbours, const SubStep& step, PairMemories& memories,
             Particles& particles)
      : model_(model), list_(neighbours), step_(step), memories_(memories), particles_(particles) {
    for (int lane = 0; Law::single && lane < n_lanes; ++lane) set_lane(law_, lane, model.laws(0, 0));
  }

  /// Adds the pairs of particles first … last − 1.
  [[gnu::flatten]] void add(std::size_t first, std::size_t last, ContactCount& count) {
    Acting acting;
    for (std::size_t i = first; i < last; ++i) {
      for (std::uint32_t p = list_.start[i]; p < list_.start[i + 1]; p += n_lanes) {
        find_acting(static_cast<std::uint32_t>(i), p, acting);
        if (acting.n > Acting::most - n_lanes) take(acting, count);
      }
    }
    take(acting, count);
  }

 private:
  using Elastic = typename Law::Elastic;

  /// Looks at the distances of the pairs p … p + n_lanes − 1 of particle i; those beyond its last are another
  /// particle's, and left as they are.
  void find_acting(std::uint32_t i, std::uint32_t p, Acting& acting) {
    const std::uint32_t* other = &list_.other[p];
    const Record& place = particles_.place[i];
    Lanes x = load(particles_.place[other[0]].data()), y = load(particles_.place[other[1]].data()),
          z = load(particles_.place[other[2]].data()), R = load(particles_.place[other[3]].data());
    transpose(x, y, z, R);
    const Lanes dx = x - place[0], dy = y - place[1], dz = z - place[2], sum = R + (place[3] + step_.reach);
    const std::uint32_t left = list_.start[i + 1] - p;
    const unsigned mine = left < n_lanes ? (1u << left) - 1 : (1u << n_lanes) - 1;
    const unsigned near = bits(dx * dx + dy * dy + dz * dz < sum * sum) & mine;
    std::uint32_t touching;
    std::memcpy(&touching, &memories_.touching[p], sizeof touching);
    touching &= lane_bytes[near | (~mine & ((1u << n_lanes) - 1))];
    std::memcpy(&memories_.touching[p], &touching, sizeof touching);
    if (near) acting.add(near, p, i);
  }

  void take(Acting& acting, ContactCount& count) {
    for (std::size_t k = acting.n; k % n_lanes != 0; ++k) {
      acting.pair[k] = acting.pair[acting.n - 1];
      acting.lower[k] = acting.lower[acting.n - 1];
    }
    for (std::size_t k = 0; k < acting.n; k += n_lanes)
      push(&acting.pair[k], &acting.lower[k], std::min<std::size_t>(n_lanes, acting.n - k), count);
    acting.n = 0;
  }

  /// Pairs as they are now: a is the lower particle, the normal points to b.
  struct Meeting {
    Triple normal, velocity, spin_a, spin_b;      ///< velocity of a over b
    Triple middle, middle_spin_a, middle_spin_b;  ///< the same at the middle of the sub-step
    Lanes gap, inverse_mass, Ra, Rb;
    Triple along(const Triple& v) const { return v - v.dot(normal) * normal; }
  };
  /// `n` ≤ n_lanes pairs; further lanes repeat the last.
  struct Batch {
    const std::uint32_t *pair, *lower;
    std::uint32_t higher[n_lanes];
    std::size_t n;
  };

  /// Three numbers and a fourth of each lane's record.
  template <class RecordOf>
  static std::pair<Triple, Lanes> gather(RecordOf record_of) {
    Lanes x = record_of(0), y = record_of(1), z = record_of(2), w = record_of(3);
    transpose(x, y, z, w);
    return {Triple{x, y, z}, w};
  }
  /// Calls put(k, record) for each lane.
  template <class Put>
  static void scatter(const Batch& batch, const Triple& v, Lanes w, Put put) {
    Lanes records[n_lanes] = {v.x, v.y, v.z, w};
    transpose(records[0], records[1], records[2], records[3]);
    for (std::size_t k = 0; k < batch.n; ++k) put(k, records[k]);
  }
  static void add_to(Record& sum, Lanes more) { store(load(sum.data()) + more, sum.data()); }

  Meeting meet(const Batch& batch) const {
    const auto place = [&](std::uint32_t i) { return load(particles_.place[i].data()); };
    const auto linear = [&](std::uint32_t i) { return load(particles_.now[i].linear.data()); };
    const auto angular = [&](std::uint32_t i) { return load(particles_.now[i].angular.data()); };
    const Lanes opposite{-1, -1, -1, 1};  // adds the inverse masses
    Meeting m;
    const Triple line =
        gather([&](std::size_t k) { return place(batch.higher[k]) - place(batch.lower[k]); }).first;
    std::tie(m.velocity, m.inverse_mass) =
        gather([&](std::size_t k) { return linear(batch.lower[k]) + opposite * linear(batch.higher[k]); });
    const auto middle = [&](std::uint32_t i) { return load(particles_.half[i].linear.data()); };
    const auto middle_spin = [&](std::uint32_t i) { return load(particles_.half[i].angular.data()); };
    m.middle = gather([&](std::size_t k) { return middle(batch.lower[k]) - middle(batch.higher[k]); }).first;
    m.middle_spin_a = gather([&](std::size_t k) { return middle_spin(batch.lower[k]); }).first;
    m.middle_spin_b = gather([&](std::size_t k) { return middle_spin(batch.higher[k]); }).first;
    std::tie(m.spin_a, m.Ra) = gather([&](std::size_t k) { return angular(batch.lower[k]); });
    std::tie(m.spin_b, m.Rb) = gather([&](std::size_t k) { return angular(batch.higher[k]); });
    const Lanes distance = sqrt(line.dot(line));
    m.normal = 1 / distance * line;
    m.gap = distance - (m.Ra + m.Rb);
    return m;
  }

  void find_laws(const Batch& batch) {
    if constexpr (Law::single) return;
    const auto& material = particles_.material;
    for (int k = 0; k < n_lanes; ++k)
      set_lane(law_, k, model_.laws(material[batch.lower[k]], material[batch.higher[k]]));
  }

  /// Turns springs into the contacts' planes as they are now, without changing their lengths.
  static Triple follow(const Meeting& m, const Triple& spring) {
    const Triple turned = m.along(spring);
    const Lanes left = turned.dot(turned);
    return select(left > 0, sqrt(spring.dot(spring) / left), Lanes{}) * turned;
  }

  /// The contact law of a batch, and what it does to the particles. Both share the overlap, so that their
  /// angular momentum is kept exactly.
  void push(const std::uint32_t* pair, const std::uint32_t* lower, std::size_t n, ContactCount& count) {
    Batch batch{pair, lower, {}, n};
    for (std::size_t k = 0; k < n_lanes; ++k) batch.higher[k] = list_.other[pair[k]];
    const Meeting m = meet(batch);
    find_laws(batch);
    NormalOf<Lanes> state{1 / m.inverse_mass, m.Ra * m.Rb / (m.Ra + m.Rb), -m.gap, m.velocity.dot(m.normal)};
    state.acceleration = acceleration_now<Elastic>(
        law_, state, Lanes(2 / step_.duration * (m.velocity - m.middle).dot(m.normal)), step_.stretch_time);
    const Lanes N = normal_force<Elastic>(law_, state, step_.duration);
    const Lanes elastic = Law::records ? elastic_force(state) : N;
    state.overlap = mean_overlap(state, step_.duration);
    const auto rubs = (state.overlap > 0) & (N > 0);
    const Lanes arm_a = m.Ra + 0.5 * m.gap, arm_b = m.Rb + 0.5 * m.gap;

    const auto remembers = remembering(batch);
    auto [slip, twist] = gather([&](std::size_t k) { return load(memories_.slip[pair[k]].data()); });
    const auto sliding = [&](const Triple& v, const Triple& spin_a, const Triple& spin_b) {
      return m.along(v) + (arm_a * spin_a + arm_b * spin_b).cross(m.normal);
    };
    slip = follow(m, keep(remembers, slip)) +
           step_.stretch_time * sliding(m.middle, m.middle_spin_a, m.middle_spin_b);
    const Triple slide = sliding(m.velocity, m.spin_a, m.spin_b);
    const SpringOf<Lanes> tangential = tangential_spring<Elastic>(law_, state);
    const Triple friction = keep(rubs, stick_slip(tangential, law_.friction * N, slide, slip));

    const Triple force = friction - N * m.normal, moment = m.normal.cross(friction);
    Triple moment_a = arm_a * moment, moment_b = arm_b * moment, resistance;
    if constexpr (Law::turning) {
      twist = select(remembers, twist, Lanes{});
      resistance = keep(rubs, resist_turning(batch, m, state, tangential, N, remembers, twist));
      moment_a += resistance;
      moment_b = moment_b - resistance;
    }
    if constexpr (Law::records)
      record(batch, {m.normal, friction, resistance}, {elastic, N - elastic, arm_a, arm_b}, count);
    scatter(batch, slip, twist, [&](std::size_t k, Lanes v) { store(v, memories_.slip[pair[k]].data()); });
    auto& push = particles_.push;
    scatter(batch, force, Lanes{}, [&](std::size_t k, Lanes v) {
      add_to(push[lower[k]].linear, v);
      add_to(push[batch.higher[k]].linear, -v);
    });
    scatter(batch, moment_a, Lanes{}, [&](std::size_t k, Lanes v) { add_to(push[lower[k]].angular, v); });
    scatter(batch, moment_b, Lanes{},
            [&](std::size_t k, Lanes v) { add_to(push[batch.higher[k]].angular, v); });
    const unsigned rubbing = bits(rubs);
    for (std::size_t k = 0; k < n; ++k) memories_.touching[pair[k]] = rubbing >> k & 1;
    note(batch, m, count);
  }

  /// The part of the normal force that does not come of damping.
  Lanes elastic_force(const NormalOf<Lanes>& state) const {
    PairLawOf<Lanes> undamped = law_;
    undamped.damping_ratio = Lanes{};
    return normal_force<Elastic>(undamped, state, step_.duration);
  }

  /// Takes down the forces of a batch: normal, friction and resistance, then elastic, damping and the two
  /// arms.
  void record(const Batch& batch, const std::array<Triple, 3>& vectors, const std::array<Lanes, 4>& numbers,
              ContactCount& count) const {
    for (std::size_t k = 0; k < batch.n; ++k) {
      const auto vector = [&](const Triple& v) { return Vec3(v.x[k], v.y[k], v.z[k]); };
      count.forces.push_back({.a = particles_.body[batch.lower[k]],
                              .b = particles_.body[batch.higher[k]],
                              .normal = vector(vectors[0]),
                              .elastic = numbers[0][k],
                              .damping = numbers[1][k],
                              .friction = vector(vectors[1]),
                              .resistance = vector(vectors[2]),
                              .arm_a = numbers[2][k],
                              .arm_b = numbers[3][k]});
    }
  }

  auto remembering(const Batch& batch) const {
    Lanes remembers;
    for (int k = 0; k < n_lanes; ++k) remembers[k] = memories_.touching[batch.pair[k]];
    return remembers > 0;
  }

  /// Moment on a by which the contacts resist rolling and twisting.
  template <class Mask>
  Triple resist_turning(const Batch& batch, const Meeting& m, const NormalOf<Lanes>& state,
                        const SpringOf<Lanes>& tangential, Lanes N, Mask remembers, Lanes& twist) {
    Lanes inverse_inertia;
    for (int k = 0; k < n_lanes; ++k)
      inverse_inertia[k] =
          particles_.half[batch.lower[k]].angular[3] + particles_.half[batch.higher[k]].angular[3];
    const SpringOf<Lanes> spring = turning_spring(
        law_, state, tangential, Lanes(select(inverse_inertia > 0, 1 / inverse_inertia, Lanes{})));
    const Triple middle = m.middle_spin_a - m.middle_spin_b;
    const Triple turning = m.spin_a - m.spin_b, rolling = m.along(turning);
    const Lanes twisting = turning.dot(m.normal), lever = state.radius * N;
    Triple roll = gather([&](std::size_t k) { return load(memories_.roll[batch.pair[k]].data()); }).first;
    roll = follow(m, keep(remembers, roll)) + step_.stretch_time * m.along(middle);
    twist += step_.stretch_time * middle.dot(m.normal);
    const Triple moment =
        stick_slip(spring, Lanes(law_.rolling_friction * lever), rolling, roll) +
        stick_slip(spring, Lanes(law_.twisting_friction * lever), twisting, twist) * m.normal;
    scatter(batch, roll, Lanes{},
            [&](std::size_t k, Lanes v) { store(v, memories_.roll[batch.pair[k]].data()); });
    return moment;
  }

  void note(const Batch& batch, const Meeting& m, ContactCount& count) const {
    const unsigned real = (1u << batch.n) - 1, touching = bits(m.gap < 0) & real;
    const unsigned too_deep = bits(-m.gap >= min(m.Ra, m.Rb)) & real;
    count.touching += static_cast<std::uint64_t>(std::popcount(touching));
    for (std::size_t k = 0; k < batch.n; ++k)
      count.largest_overlap = std::max(count.largest_overlap, -m.gap[k]);
    if (!too_deep) return;
    const int k = std::countr_zero(too_deep);
    count.too_deep = names(model_, {particles_.body[batch.lower[k]], particles_.body[batch.higher[k]]});
  }

  const Model& model_;
  const Neighbours& list_;
  const SubStep step_;
  PairMemories& memories_;
  Particles& particles_;
  PairLawOf<Lanes> law_{};
};

template <class Law>
ContactCount add_with(const Model& model, const Neighbours& neighbours, const SubStep& step,
                      PairMemories& memories, Particles& particles) {
  const auto& slabs = neighbours.slabs;
  const std::size_t n_slabs = slabs.size() - 1;
  std::vector<ContactCount> counts(n_slabs);
  for (const std::size_t parity : {0, 1}) {
    const std::size_t n = (n_slabs + 1 - parity) / 2;
    parallel_for(static_cast<int>(n), [&](int k) {
      const std::size_t s = 2 * static_cast<std::size_t>(k) + parity;
      PairForces<Law>(model, neighbours, step, memories, particles).add(slabs[s], slabs[s + 1], counts[s]);
    });
  }
  ContactCount sum;
  for (const ContactCount& count : counts) sum.add(count);
  return sum;
}

/// Forces are recorded by the code for several materials only.
template <class Elastic, bool turning>
auto choose(const Model& model) {
  if (model.accounts_energy) return add_with<Parts<Elastic, turning, false, true>>;
  return model.laws.n_materials() == 1 ? add_with<Parts<Elastic, turning, true, false>>
                                       : add_with<Parts<Elastic, turning, false, false>>;
}

}  // namespace

ContactCount add_pair_forces(const Model& model, const Neighbours& neighbours, const SubStep& step,
                             PairMemories& memories, Particles& particles) {
  return with_elastic_law(model.elasticity, [&](auto law) {
    using Elastic = decltype(law);
    const auto add = memories.roll.empty() ? choose<Elastic, false>(model) : choose<Elastic, true>(model);
    return add(model, neighbours, step, memories, particles);
  });
}

}  // namespace fpi::dem
