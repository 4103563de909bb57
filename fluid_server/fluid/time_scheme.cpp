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
