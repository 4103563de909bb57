/// Scenes: what is taken survives what `check` does with it, and being written and read again.
#include "fuzz.hpp"
#include "grains/expand.hpp"
#include "scene/scene.hpp"

namespace {

constexpr double most_grains = 2000;  ///< that a target makes of a scene: more takes long, and shows no more

/// About how many grains the lattices and packings of a scene have.
double expected_grains(const fpi::scene::Scene& scene) {
  double number = 0;
  for (const fpi::scene::Grains& group : scene.grains) {
    double of_group = 1;
    const double spacing = std::max(group.spacing, group.largest_radius() / 2);
    for (std::size_t k = 0; k < group.lower.size(); ++k)
      of_group *= (group.upper[k] - group.lower[k]) / spacing;
    number += of_group;
  }
  return number;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fpi;
  scene::Scene scene;
  try {
    scene = scene::read_text(std::string(fuzz::text(data, size)), "scene.toml", {});
  } catch (const Error& e) {
    if (std::string_view(e.what()).find("scene.toml") == std::string_view::npos)
      fuzz::fault(fmt::format("an error that names the file is required; got: {}", e.what()));
    return 0;
  }
  const std::string written = scene::write_text(scene);
  if (scene::write_text(scene::read_text(written, "what was written")) != written)
    fuzz::fault("a scene that was written must be read as the same");
  if (!(expected_grains(scene) < most_grains)) return 0;
  try {
    grains::expand(scene, [](const std::string&) { return "x,y,radius\n0.1,0.2,0.01\n"; });
    grains::describe(scene);
  } catch (const Error&) {
  }
  return 0;
}

namespace fpi::fuzz {

std::vector<Bytes> seeds() { return files(FPI_SCENES, ".toml"); }

std::vector<std::string> words() {
  return {"\n[periodic]\n",
          "x = [0, 1]\n",
          "\n[[walls]]\n",
          "\n[[bodies]]\n",
          "\n[[grains]]\n",
          "\n[fluid]\n",
          "\n[fluid.mesh]\n",
          "lower = [0, 0]\n",
          "radius = 1e307\n",
          "motion = \"free\"\n",
          "shape = \"polygon\"\n",
          "\"\"\"",
          "'''",
          "[[",
          "]]",
          "{",
          "}",
          "= 1979-05-27",
          "= 0x",
          "\\u0000",
          "\xff",
          "\xef\xbb\xbf"};
}

}  // namespace fpi::fuzz
