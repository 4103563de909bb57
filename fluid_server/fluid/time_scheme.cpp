#include "fluid/time_scheme.hpp"

#include <algorithm>

namespace fpi::fluid {

TimeTerms newmark(const Vector& u, const Vector& acceleration, double time_step, const Vector& gamma) {
  TimeTerms terms{(gamma * time_step).cwiseInverse(), Vector(u.size())};
  for (Eigen::Index i = 0; i < gamma.size(); ++i)
    terms.history.segment<2>(2 * i) =
        terms.inertia[i] * u.segment<2>(2 * i) + (1 - gamma[i]) / gamma[i] * acceleration.segment<2>(2 * i);
  return terms;
}

Vector predicted_velocity(const State& state, double time_step) {
  if (!state.has_acceleration) return state.u;
  const Vector tangent = state.u + time_step * state.acceleration;
  if (state.previous_step == 0) return tangent;
  const double bend = 0.5 * time_step * time_step / state.previous_step;
  return tangent + bend * (state.acceleration - state.previous_acceleration);
}

TimeError time_error(const State& start, const Vector& u, double time_step, const Vector& gamma) {
  if (!start.has_acceleration || start.previous_step == 0) return {};
  const Vector from_tangent = u - start.u - time_step * start.acceleration;
  const Vector from_prediction = u - predicted_velocity(start, time_step);
  const double second_order = 1 / (3 * (1 + start.previous_step / time_step));
  const bool is_second_order = gamma.maxCoeff() == 0.5;
  double sum = 0;
  for (Eigen::Index n = 0; n < gamma.size(); ++n) {
    const double first_order = (gamma[n] - 0.5) / gamma[n];
    sum += gamma[n] == 0.5 ? (second_order * from_prediction.segment<2>(2 * n)).squaredNorm()
                           : (first_order * from_tangent.segment<2>(2 * n)).squaredNorm();
  }
  const double size = u.norm();
  return {size > 0 ? std::sqrt(sum) / size : 0, is_second_order ? 3 : 2};
}

Vector gamma_of_nodes(const Mesh& mesh, const CutMesh& cut, double gamma) {
  std::vector<std::uint8_t> near_body(mesh.n_nodes(), 0);
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (cut.state[c] != CellState::fluid)
      for (Index node : mesh.cell_nodes(c)) near_body[node] = 1;
  Vector out = Vector::Constant(mesh.n_nodes(), gamma);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const auto nodes = mesh.cell_nodes(c);
    if (std::any_of(nodes.begin(), nodes.end(), [&](Index n) { return near_body[n] != 0; }))
      for (Index node : nodes) out[node] = 1;
  }
  return out;
}

}  // namespace fpi::fluid
