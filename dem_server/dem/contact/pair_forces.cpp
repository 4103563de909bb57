#include "dem/contact/pair_forces.hpp"

#include "core/parallel.hpp"
#include "dem/contact/acting.hpp"
#include "dem/contact/space.hpp"

namespace fpi::dem {
namespace {

void set_lane(PairLawOf<Lanes>& laws, int lane, const PairLaw& law) {
  laws.normal[lane] = law.normal;
  laws.tangential_ratio[lane] = law.tangential_ratio;
  laws.damping_ratio[lane] = law.damping_ratio;
  laws.friction[lane] = law.friction;
  laws.rolling_friction[lane] = law.rolling_friction;
  laws.twisting_friction[lane] = law.twisting_friction;
}

/// What a scene has not costs a branch that is never taken.
template <class Space, class Elastic>
class PairForces {
 public:
  PairForces(const Model& model, const Neighbours& neighbours, const SubStep& step, PairHistories& histories,
             Particles& particles)
      : model_(model), list_(neighbours), step_(step), histories_(histories), particles_(particles) {
    for (int lane = 0; lane < n_lanes; ++lane) set_lane(law_, lane, model.laws(0, 0));
  }

  /// Adds the pairs of particles first … last − 1.
  [[gnu::flatten]] void add(std::size_t first, std::size_t last, ContactCount& count) {
    Acting acting;
    const auto add = [&](const std::uint32_t* pair, const std::uint32_t* lower, std::size_t n) {
      this->add_batch({pair, lower, {}, n}, count);
    };
    for (std::size_t i = first; i < last; ++i) {
      for (std::uint32_t p = list_.start[i]; p < list_.start[i + 1]; p += n_lanes) {
        find_acting(static_cast<std::uint32_t>(i), p, acting);
        if (acting.full()) acting.empty(add);
      }
    }
    acting.empty(add);
  }

 private:
  using Vector = typename Space::Vector;
  using Rotation = typename Space::Rotation;

  /// Looks at the distances of the pairs p … p + n_lanes − 1 of particle i; those beyond its last are another
  /// particle's, and left as they are.
  void find_acting(std::uint32_t i, std::uint32_t p, Acting& acting) {
    const std::uint32_t* other = &list_.other[p];
    const Record& place = particles_.place[i];
    Lanes x = load(particles_.place[other[0]].data()), y = load(particles_.place[other[1]].data()),
          z = load(particles_.place[other[2]].data()), R = load(particles_.place[other[3]].data());
    transpose(x, y, z, R);
    LaneVector3 line{x - place[0], y - place[1], z - place[2]};
    if (repeats_) line = InSpace::shortest(line, model_.periodic);
    const Lanes sum = R + (place[3] + step_.reach);
    const std::uint32_t left = list_.start[i + 1] - p;
    const unsigned mine = left < n_lanes ? (1u << left) - 1 : (1u << n_lanes) - 1;
    const unsigned near = bits(line.dot(line) < sum * sum) & mine;
    std::uint32_t touching;
    std::memcpy(&touching, &histories_.touching[p], sizeof touching);
    touching &= lane_bytes[near | (~mine & ((1u << n_lanes) - 1))];
    std::memcpy(&histories_.touching[p], &touching, sizeof touching);
    if (near) acting.add(near, p, i);
  }

  /// `n` ≤ n_lanes pairs; further lanes repeat the last.
  struct Batch {
    const std::uint32_t *pair, *lower;
    std::uint32_t higher[n_lanes];
    std::size_t n;
  };
  /// Pairs as they are now: a is the lower particle, the normal points to b.
  struct Meeting {
    Vector normal, velocity;                      ///< of a over b
    Vector middle;                                ///< the same at the middle of the sub-step
    Rotation spin_a, spin_b, middle_a, middle_b;  ///< now and at the middle
    Lanes gap, inverse_mass, Ra, Rb;
  };

  Meeting meet(const Batch& batch) const {
    const auto& place = particles_.place;
    const auto &now = particles_.now, &half = particles_.half;
    const auto &a = batch.lower, &b = batch.higher;
    const Lanes opposite{-1, -1, -1, 1};  // adds the inverse masses
    const auto of = [](const Record& record) { return load(record.data()); };
    Vector line = Space::vector(Gathered([&](int k) { return of(place[b[k]]) - of(place[a[k]]); }));
    const Gathered velocity([&](int k) { return of(now[a[k]].linear) + opposite * of(now[b[k]].linear); });
    const Gathered middle([&](int k) { return of(half[a[k]].linear) - of(half[b[k]].linear); });
    const Gathered spin_a([&](int k) { return of(now[a[k]].angular); });
    const Gathered spin_b([&](int k) { return of(now[b[k]].angular); });
    const Gathered middle_a([&](int k) { return of(half[a[k]].angular); });
    const Gathered middle_b([&](int k) { return of(half[b[k]].angular); });
    if (repeats_) line = Space::shortest(line, model_.periodic);
    const Lanes distance = sqrt(line.dot(line));
    return {.normal = 1 / distance * line,
            .velocity = Space::vector(velocity),
            .middle = Space::vector(middle),
            .spin_a = Space::turn(spin_a),
            .spin_b = Space::turn(spin_b),
            .middle_a = Space::turn(middle_a),
            .middle_b = Space::turn(middle_b),
            .gap = distance - (spin_a.w + spin_b.w),
            .inverse_mass = velocity.w,
            .Ra = spin_a.w,
            .Rb = spin_b.w};
  }

  void find_laws(const Batch& batch) {
    if (single_) return;
    const auto& material = particles_.material;
    for (int k = 0; k < n_lanes; ++k)
      set_lane(law_, k, model_.laws(material[batch.lower[k]], material[batch.higher[k]]));
  }

  /// The contact law of a batch, and what it does to the particles. Both share the overlap, so that their
  /// angular momentum is kept exactly. Sliding, its spring and friction are taken as n × their vector, as
  /// ContactHistory::slip.
  void add_batch(Batch batch, ContactCount& count) {
    const auto& [pair, lower, higher, n] = batch;
    for (std::size_t k = 0; k < n_lanes; ++k) batch.higher[k] = list_.other[pair[k]];
    const Meeting m = meet(batch);
    find_laws(batch);
    NormalOf<Lanes> state{1 / m.inverse_mass, m.Ra * m.Rb / (m.Ra + m.Rb), -m.gap, m.velocity.dot(m.normal)};
    const auto mean = mean_over<Elastic>(state.overlap, Lanes(step_.duration * state.rate));
    const Lanes middle_rate = m.middle.dot(m.normal);
    state.acceleration = acceleration_now<Elastic>(
        law_, state, Lanes(2 / step_.duration * (state.rate - middle_rate)), step_.stretch_time);
    const Lanes N = normal_force<Elastic>(law_, state, mean, step_.duration);
    const auto rubs = (mean.overlap > 0) & (N > 0);
    const Lanes arm_a = m.Ra + 0.5 * m.gap, arm_b = m.Rb + 0.5 * m.gap;

    const auto remembers = remembering(batch);
    const Gathered history([&](int k) { return load(histories_.slip[pair[k]].data()); });
    const auto sliding = [&](const Vector& v, const Rotation& spin_a, const Rotation& spin_b) {
      return Space::cross(m.normal, v) + Space::across(arm_a * spin_a + arm_b * spin_b, m.normal);
    };
    const Lanes stretched =
        step_.stretch_time * share_in_contact(state.overlap, Lanes(step_.stretch_time * middle_rate));
    Rotation slip = Space::follow(keep(remembers, Space::turn(history)), m.normal) +
                    stretched * sliding(m.middle, m.middle_a, m.middle_b);
    Lanes twist = keep(remembers, history.w);
    const Rotation slide = sliding(m.velocity, m.spin_a, m.spin_b);
    const SpringOf<Lanes> tangential = tangential_spring<Elastic>(law_, state, mean.slope);
    const Rotation friction = keep(rubs, stick_slip(tangential, law_.friction * N, slide, slip));

    const Vector force = Space::turned(friction, m.normal);
    Rotation moment_a = arm_a * friction, moment_b = arm_b * friction, resistance{};
    if (turning_) {
      resistance = keep(rubs, resist_turning(batch, m, state, tangential, N, remembers, stretched, twist));
      moment_a = moment_a + resistance;
      moment_b = moment_b - resistance;
    }
    if (model_.accounts_energy) {
      const Lanes elastic = elastic_force<Elastic>(law_, state, mean, step_.duration);
      for (std::size_t k = 0; k < n; ++k)
        count.forces.push_back({.a = particles_.body[lower[k]],
                                .b = particles_.body[higher[k]],
                                .normal = Space::lane(m.normal, k),
                                .elastic = elastic[k],
                                .damping = N[k] - elastic[k],
                                .friction = Space::lane(force, k),
                                .resistance = Space::lane(resistance, k),
                                .arm_a = arm_a[k],
                                .arm_b = arm_b[k]});
    }
    Space::scatter_rotation(n, slip, twist,
                            [&](std::size_t k, Lanes v) { store(v, histories_.slip[pair[k]].data()); });
    auto& on = particles_.force;
    Space::scatter_vector(n, force - N * m.normal, [&](std::size_t k, Lanes v) {
      add_to(on[lower[k]].linear, v);
      add_to(on[higher[k]].linear, -v);
    });
    Space::scatter_rotation(n, moment_a, Lanes{},
                            [&](std::size_t k, Lanes v) { add_to(on[lower[k]].angular, v); });
    Space::scatter_rotation(n, moment_b, Lanes{},
                            [&](std::size_t k, Lanes v) { add_to(on[higher[k]].angular, v); });
    const unsigned rubbing = bits(rubs);
    for (std::size_t k = 0; k < n; ++k) histories_.touching[pair[k]] = rubbing >> k & 1;
    note(batch, m, count);
  }

  static void add_to(Record& sum, Lanes more) { store(load(sum.data()) + more, sum.data()); }

  auto remembering(const Batch& batch) const {
    Lanes remembers;
    for (int k = 0; k < n_lanes; ++k) remembers[k] = histories_.touching[batch.pair[k]];
    return remembers > 0;
  }

  /// Moment on a by which the contacts resist rolling and twisting.
  template <class Mask>
  Rotation resist_turning(const Batch& batch, const Meeting& m, const NormalOf<Lanes>& state,
                          const SpringOf<Lanes>& tangential, Lanes N, Mask remembers, Lanes stretched,
                          Lanes& twist) {
    Lanes inverse_inertia;
    for (int k = 0; k < n_lanes; ++k)
      inverse_inertia[k] =
          particles_.half[batch.lower[k]].angular[3] + particles_.half[batch.higher[k]].angular[3];
    const SpringOf<Lanes> spring = turning_spring(
        law_, state, tangential, Lanes(select(inverse_inertia > 0, 1 / inverse_inertia, Lanes{})));
    const Rotation middle = m.middle_a - m.middle_b, now = m.spin_a - m.spin_b;
    const Lanes lever = state.radius * N;
    const Gathered history([&](int k) { return load(histories_.roll[batch.pair[k]].data()); });
    Rotation roll = Space::follow(keep(remembers, Space::turn(history)), m.normal) +
                    stretched * Space::across(middle, m.normal);
    Rotation moment =
        stick_slip(spring, Lanes(law_.rolling_friction * lever), Space::across(now, m.normal), roll);
    if constexpr (std::is_same_v<Rotation, LaneVector3>) {
      twist += stretched * middle.dot(m.normal);
      moment +=
          stick_slip(spring, Lanes(law_.twisting_friction * lever), now.dot(m.normal), twist) * m.normal;
    }
    Space::scatter_rotation(batch.n, roll, Lanes{},
                            [&](std::size_t k, Lanes v) { store(v, histories_.roll[batch.pair[k]].data()); });
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
    const Pair pair{particles_.body[batch.lower[k]], particles_.body[batch.higher[k]]};
    count.note_too_deep(names(model_, pair), model_.bodies.is_free(pair.a) ? pair.a : pair.b);
  }

  const Model& model_;
  const bool repeats_ = model_.periodic.repeats();
  const bool single_ = model_.laws.n_materials() == 1;  ///< all bodies of one material
  const bool turning_ = model_.laws.resists_turning();
  const Neighbours& list_;
  const SubStep step_;
  PairHistories& histories_;
  Particles& particles_;
  PairLawOf<Lanes> law_{};
};

template <class Space, class Elastic>
ContactCount add_with(const Model& model, const Neighbours& neighbours, const SubStep& step,
                      PairHistories& histories, Particles& particles) {
  const auto& slabs = neighbours.slabs;
  const std::size_t n_slabs = slabs.size() - 1;
  std::vector<ContactCount> counts(n_slabs);
  for (const std::size_t parity : {0, 1}) {
    const std::size_t n = (n_slabs + 1 - parity) / 2;
    parallel_for(static_cast<int>(n), [&](int k) {
      const std::size_t s = 2 * static_cast<std::size_t>(k) + parity;
      PairForces<Space, Elastic>(model, neighbours, step, histories, particles)
          .add(slabs[s], slabs[s + 1], counts[s]);
    });
  }
  ContactCount sum;
  for (const ContactCount& count : counts) sum.add(count);
  return sum;
}

}  // namespace

ContactCount add_pair_forces(const Model& model, const Neighbours& neighbours, const SubStep& step,
                             PairHistories& histories, Particles& particles) {
  return with_elastic_law(model.elasticity, [&](auto law) {
    using Elastic = decltype(law);
    const auto add = model.plane ? add_with<InPlane, Elastic> : add_with<InSpace, Elastic>;
    return add(model, neighbours, step, histories, particles);
  });
}

}  // namespace fpi::dem
