/// A second fluid, without a mesh: each disc feels the steady Stokes drag and torque that it would feel in
/// the middle of a resting circular cylinder as wide as the short side of the scene's rectangle, whatever
/// else is around it.
///
/// Concentric cylinders of radii a < b, the inner one moving with U or turning with ω, per length (Happel &
/// Brenner, Low Reynolds Number Hydrodynamics; ψ = (A r³ + B r ln r + C r + D/r) sin θ with no slip at a and
/// b, F = 4πμB):
///   F = −4πμU / (ln(b/a) − (b² − a²)/(b² + a²)),   T = −4πμω a²b²/(b² − a²).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "proto/serve.hpp"
#include "scene/scene.hpp"

namespace {

using namespace fpi::proto;
using std::numbers::pi;

class StokesFluid : public FluidParticipant {
 public:
  Configured configure(const Configure& configure) override {
    scene_ = fpi::scene::read_text(configure.scene, "the coupler's scene");
    const auto& mesh = scene_.fluid.value().mesh;
    fpi::require(mesh.lower.size() == 2, "the toy fluid needs a rectangle; got the mesh file {}", mesh.file);
    cut_off_ = std::min(mesh.upper[0] - mesh.lower[0], mesh.upper[1] - mesh.lower[1]) / 2;
    Configured configured{.notes = {"Stokes drag in a resting cylinder; no mesh"}};
    for (std::uint32_t body = 0; body < scene_.bodies.size(); ++body)
      configured.arc_lengths.push_back({body, arc_length(scene_.bodies[body].radius)});
    return configured;
  }

  FluidAdvanced advance(const Stamp&, const FluidAdvance& advance) override {
    FluidAdvanced advanced{.converged = true};
    for (const Interface& disc : advance.interfaces) advanced.tractions.push_back(traction(disc));
    return advanced;
  }

  Accepted accept(const Accept&) override { return {}; }  // steady drag: nothing is remembered
  void restore() override {}

 private:
  static double arc_length(double radius) { return 2 * pi * radius / 32; }

  Traction traction(const Interface& disc) const {
    const double a = disc.radius, b = cut_off_, depth = scene_.thickness;
    fpi::require(a > 0 && a < b, "the toy fluid takes discs with a radius below {} m; got {} m", b, a);
    const double mu = scene_.fluid->viscosity(), a2 = a * a, b2 = b * b;
    const double drag = 4 * pi * mu * depth / (std::log(b / a) - (b2 - a2) / (b2 + a2));
    const double torque = -4 * pi * mu * depth * disc.spin[2] * a2 * b2 / (b2 - a2);
    const double buoyancy = -scene_.fluid->density * pi * a2 * depth;  // times g

    Traction result{.body = disc.body, .torque = {0, 0, torque}, .arc_length = arc_length(a)};
    std::array<double, 2> force{-drag * disc.translation[0], -drag * disc.translation[1]};
    for (std::size_t i = 0; i < 2; ++i) result.force[i] = force[i] + buoyancy * scene_.gravity[i];

    // λ = τ t in the middle of each arc gives the torque; a uniform λ gives what it leaves of the force.
    double lever = 0, circumference = 0;  // torque of τ = 1
    for (std::size_t arc = 0; arc < disc.size(); ++arc) {
      lever += 2 * a2 * depth * std::sin((disc.end[arc] - disc.start[arc]) / 2);
      circumference += a * (disc.end[arc] - disc.start[arc]);
    }
    for (std::size_t arc = 0; arc < disc.size(); ++arc) {
      const double middle = (disc.start[arc] + disc.end[arc]) / 2;
      const std::array tangential{-torque / lever * std::sin(middle), torque / lever * std::cos(middle)};
      result.values.insert(result.values.end(), tangential.begin(), tangential.end());
      for (std::size_t i = 0; i < 2; ++i)
        force[i] -= tangential[i] * a * depth * (disc.end[arc] - disc.start[arc]);
    }
    for (std::size_t i = 0; i < result.values.size(); ++i)
      result.values[i] += force[i % 2] / (circumference * depth);
    return result;
  }

  fpi::scene::Scene scene_;
  double cut_off_ = 0;  ///< radius b of the cylinder around each disc [m]
};

}  // namespace

int main(int argc, char** argv) {
  StokesFluid fluid;
  return serve(fluid, read_command_line(argc, argv, "toy_stokes_fluid", {"checkpoint"}));
}
