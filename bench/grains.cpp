/// Time, memory and contacts of the grains' sub-steps for a packing that other programs can read too:
///   grains_bench PACKING.csv SUB_STEPS DT [--discs] [--gravity G] [--box X0,X1,Y0,Y1,Z0,Z1]
///                [--restitution E] [--out END.csv]
/// The packing has a line "x,y,z,radius" [m] for each grain, and "vx,vy,vz" [m/s] after it where it moves;
/// the box has walls where its bounds are finite; the state at the end can be written as the packing was.
/// Prints JSON.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>
#include <limits>
#include <sstream>

#include "core/error.hpp"
#include "core/pages.hpp"
#include "dem/solver.hpp"

using namespace fpi;

namespace {

constexpr double density = 2500;                       // [kg/m³]
constexpr double discs_thickness = 4.0 / 3 * 0.55e-3;  // [m]: the mass of spheres, which is what others step

std::vector<double> numbers(const std::string& text) {
  std::vector<double> values;
  std::stringstream line(text);
  for (std::string entry; std::getline(line, entry, ',');) values.push_back(std::stod(entry));
  return values;
}

std::vector<scene::Body> read_packing(const std::string& path, bool discs) {
  std::ifstream file(path);
  require(file.good(), "a packing is required: cannot read {}", path);
  std::vector<scene::Body> bodies;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || std::isalpha(line[0])) continue;
    const std::vector<double> v = numbers(line);
    require(v.size() == 4 || v.size() == 7,
            "a packing must have lines x,y,z,radius[,vx,vy,vz]; got \"{}\" in {}", line, path);
    scene::Body body;
    body.shape = discs ? "disc" : "sphere";
    body.radius = v[3];
    body.density = density;
    const std::ptrdiff_t axes = discs ? 2 : 3;
    body.position.assign(v.begin(), v.begin() + axes);
    body.velocity.assign(axes, 0);
    body.spin.assign(discs ? 1 : 3, 0);
    if (v.size() == 7) body.velocity.assign(v.begin() + 4, v.begin() + 4 + axes);
    bodies.push_back(std::move(body));
  }
  return bodies;
}

/// A wall at each finite bound of the box.
std::vector<scene::Wall> make_walls(const std::vector<double>& bounds) {
  std::vector<scene::Wall> walls;
  for (std::size_t k = 0; k < bounds.size(); ++k) {
    if (!std::isfinite(bounds[k])) continue;
    std::vector<double> point(3, 0), normal(3, 0);
    point[k / 2] = bounds[k];
    normal[k / 2] = k % 2 == 0 ? 1 : -1;
    scene::Wall& wall = walls.emplace_back();
    wall.name = fmt::format("wall{}", k);
    wall.point = point;
    wall.normal = normal;
  }
  return walls;
}

scene::Material grain_material(double restitution) {
  scene::Material material;
  material.name = "grain";
  material.youngs_modulus = 1e7;
  material.poisson_ratio = 0.25;
  material.restitution = restitution;
  material.friction = 0.5;
  return material;
}

void write_state(const std::string& path, const dem::Solver& solver) {
  std::ofstream file(path);
  file << "x,y,z,radius,vx,vy,vz\n";
  const dem::Motions& motions = solver.motions();
  for (std::size_t i = 0; i < motions.position.size(); ++i) {
    const dem::Vec3 &x = motions.position[i], &v = motions.velocity[i];
    file << fmt::format("{},{},{},{},{},{},{}\n", x.x(), x.y(), x.z(), solver.model().bodies.radius[i], v.x(),
                        v.y(), v.z());
  }
  require(file.good(), "the state at the end must be written; {} cannot be", path);
}

/// Peak of the resident memory [MB].
double peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return std::stod(line.substr(6)) / 1024;
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  fpi::keep_pages();  // as dem_server does
  try {
    require(argc >= 4, "grains_bench PACKING.csv SUB_STEPS DT [--discs] [--gravity G] [--box BOUNDS]");
    const auto steps = static_cast<double>(std::stoul(argv[2]));
    const double dt = std::stod(argv[3]);
    bool discs = false;
    dem::Problem problem;
    double gravity = 9.81, restitution = 0.5;
    std::string end;
    for (int i = 4; i < argc; ++i) {
      const std::string option = argv[i];
      if (option == "--discs") discs = true;
      if (option == "--gravity" && ++i < argc) gravity = std::stod(argv[i]);
      if (option == "--restitution" && ++i < argc) restitution = std::stod(argv[i]);
      if (option == "--out" && ++i < argc) end = argv[i];
      if (option == "--box" && ++i < argc) problem.walls = make_walls(numbers(argv[i]));
    }
    problem.gravity = discs ? dem::Vec3(0, -gravity, 0) : dem::Vec3(0, 0, -gravity);
    problem.thickness = discs_thickness;
    problem.materials = {grain_material(restitution)};
    problem.dem.steps_per_contact = 10;  // so that the step asked for is taken
    problem.dem.largest_sub_step = dt;
    problem.bodies = read_packing(argv[1], discs);
    dem::Solver solver(problem);
    problem = {};
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t cpu_start = std::clock();
    const dem::Advanced outcome = solver.advance(steps * dt, {});
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    const double cpu_seconds = static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC;
    require(outcome.converged, "the steps went wrong: {}", outcome.reason);
    if (!end.empty()) write_state(end, solver);
    const auto n = static_cast<double>(solver.model().bodies.size());
    fmt::print(
        "{{\"grains\": {}, \"sub_steps\": {}, \"seconds\": {:.4f}, \"cpu_seconds\": {:.4f}, "
        "\"million_steps_per_cpu_second\": {:.3f}, "
        "\"megabytes\": {:.1f}, \"contacts_per_grain\": {:.3f}, \"searches\": {}, \"largest_overlap\": "
        "{:.3g}}}\n",
        n, outcome.sub_steps, took.count(), cpu_seconds,
        n * static_cast<double>(outcome.sub_steps) / cpu_seconds / 1e6, peak_memory(),
        2 * static_cast<double>(outcome.contacts) / n, outcome.searches, outcome.largest_overlap);
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
  }
}
