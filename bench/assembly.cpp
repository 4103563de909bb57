/// Time of assembling residual and Jacobian, with the scatter, for each triangle: straight, curved and cut.
#include <chrono>
#include <cstdio>

#include "fluid/mesh/rectangle.hpp"
#include "fluid/navier_stokes.hpp"

using namespace fpi;
using namespace fpi::fluid;

namespace {

double microseconds_per_cell(System& system, Index n_cells, bool with_jacobian) {
  const Space& space = system.space();
  Fields fields{Vector::Random(2 * space.mesh.n_nodes()), Vector::Random(space.mesh.n_vertices()),
                Vector::Random(2 * system.cut().n_multipliers()), Vector(0), Vector(0)};
  TimeTerms time;
  time.inertia = 100;
  time.history = Vector::Random(2 * space.mesh.n_nodes());
  const Flow flow{1, 1e-3, 1, true};
  double best = 1e9;
  for (int repeat = 0; repeat < 20; ++repeat) {
    const auto start = std::chrono::steady_clock::now();
    system.assemble(flow, fields, time, with_jacobian);
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
    best = std::min(best, took.count() / n_cells);
  }
  return best;
}

void measure(const char* name, Mesh mesh) {
  std::map<std::string, scene::Boundary> conditions;
  for (const char* side : {"left", "right", "bottom", "top"}) conditions[side].type = "no_slip";
  const Space space(std::move(mesh), conditions);
  Timers timers;
  System system(space, {}, {}, {}, timers);
  const Index n = space.mesh.n_cells();
  std::printf("%-10s %6d triangles: residual %.2f µs, residual and Jacobian %.2f µs each\n", name, n,
              microseconds_per_cell(system, n, false), microseconds_per_cell(system, n, true));
}

}  // namespace

int main() {
  for (const Index n : {32, 70, 128}) {
    Mesh mesh = make_rectangle(uniform_lines(0, 1, n), uniform_lines(0, 1, n));
    measure("straight", mesh);
    for (Index e = 0; e < mesh.n_edges(); ++e)
      if (mesh.edge_cells[e][1] != -1) mesh.middles[e] += Vec2(0.02, 0.01) / n;
    measure("curved", mesh);
  }
}
