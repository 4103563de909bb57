#include "fluid/solve/history.hpp"

#include <algorithm>

#include "fluid/mesh/sample.hpp"

namespace fpi::fluid {
namespace {

std::optional<Sample> sample(const Space& space, const Vec2& x) {
  const std::optional<Place> place = space.locator.find(x);
  return place ? std::optional(Sample(space.mesh, *place)) : std::nullopt;
}

/// u^{n−1} where the path was that is at x with u^n; x itself where that lies outside the mesh.
Vec2 previous_velocity(const Space& space, const State& state, const Vec2& x, const Sample& at_x) {
  const Vec2 mesh_velocity = at_x.velocity(state.mesh_velocity);
  const auto before =
      mesh_velocity.isZero(0) ? at_x : sample(space, x - state.previous_step * mesh_velocity).value_or(at_x);
  return before.velocity(state.previous_u);
}

}  // namespace

bool stays(const Vector& displacement, const State& state, Index node) {
  return displacement.segment<2>(2 * node).isZero(0) && state.mesh_velocity.segment<2>(2 * node).isZero(0);
}

State along_paths(const Space& space, const Vector& displacement, const State& state) {
  const Mesh& mesh = space.mesh;
  State out = state;
  for (Index node = 0; node < mesh.n_nodes(); ++node) {
    if (stays(displacement, state, node)) continue;
    const Vec2 x = mesh.node_position(node) - displacement.segment<2>(2 * node);
    const auto old = sample(space, x);
    if (!old) continue;
    for (Vector State::*field :
         {&State::u, &State::acceleration, &State::previous_acceleration, &State::mesh_velocity})
      (out.*field).segment<2>(2 * node) = old->velocity(state.*field);
    out.previous_u.segment<2>(2 * node) = previous_velocity(space, state, x, *old);
    if (node < mesh.n_vertices()) out.p[node] = old->pressure(state.p);
  }
  return out;
}

void follow_paths(const System& system, const Vector& displacement, const State& state, const Scheme& scheme,
                  TimeTerms& terms) {
  const Space& space = system.space();
  const Mesh& mesh = space.mesh;
  terms.follows.assign(mesh.n_cells(), 0);
  terms.load = Vector::Zero(2 * static_cast<Eigen::Index>(mesh.n_nodes()));
  terms.carried = Vector::Zero(2 * static_cast<Eigen::Index>(mesh.n_cells()));
  std::vector<Vec2> history;
  for (std::size_t k = 0; k < system.active_cells().size(); ++k) {
    const Index c = system.active_cells()[k];
    const auto nodes = mesh.cell_nodes(c);
    if (std::all_of(nodes.begin(), nodes.end(), [&](Index n) { return stays(displacement, state, n); }))
      continue;
    const Quadrature rule = system.quadrature(k);
    const auto places = mesh.cell_places(c);
    history.clear();
    for (const ElementPoint& point : rule.points) {
      Vec2 x = position_at(places, point.shape.n);
      for (int i = 0; i < 6; ++i) x -= point.shape.n[i] * displacement.segment<2>(2 * nodes[i]);
      const auto old = sample(space, x);
      if (!old) break;
      const Vec2 u = old->velocity(state.u), before = previous_velocity(space, state, x, *old);
      history.push_back(scheme.inertia * u + scheme.before * (u - before));
    }
    if (history.size() < rule.points.size()) continue;  // a path from outside the mesh: node by node
    terms.follows[c] = 1;
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      terms.carried.segment<2>(2 * c) += rule.weight(q) * history[q];
      for (int i = 0; i < 6; ++i)
        terms.load.segment<2>(2 * nodes[i]) += rule.weight(q) * rule.points[q].shape.n[i] * history[q];
    }
  }
}

}  // namespace fpi::fluid
