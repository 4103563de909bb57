/// A scene: everything a run needs, as declared in the groups beside this file. Only the coupler reads the
/// file; a participant gets its part (`part_of`) as text with all defaults filled in and reads that.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scene/bodies.hpp"
#include "scene/coupling.hpp"
#include "scene/dem.hpp"
#include "scene/fluid.hpp"
#include "scene/grains.hpp"
#include "scene/outlets.hpp"
#include "scene/percolation.hpp"
#include "scene/periodic.hpp"
#include "scene/walls.hpp"

namespace fpi::scene {

/// [time]
struct Time {
  bool steady = false;
  double step = 0;  ///< Δt [s]
  double end = 0;   ///< [s]
  double relative_tolerance = 0;
  double max_displacement = 0;  ///< of h
  std::int64_t wanted_sub_iterations = 0;
  double min_step = 0, max_step = 0;  ///< [s]
  std::int64_t max_halvings = 6;

  bool adapts() const { return relative_tolerance > 0 || max_displacement > 0 || wanted_sub_iterations > 0; }

  void declare(ParameterVisitor& v) {
    v.boolean({"steady", "", "true: one steady solve, no time loop"}, steady);
    v.real({"step", "s",
            "largest time step Δt, or the first one where relative_tolerance > 0 or max_step is given and "
            "the steps "
            "adapt; the steps to each output time "
            "and to the end are equal and hit it exactly; needed unless steady"},
           step, not_negative());
    v.real({"end", "s", "time at which the run ends; needed unless steady"}, end, not_negative());
    v.real(
        {"relative_tolerance", "",
         "error of a step in time, over the velocity, that the size of the steps is chosen by; 0: steps of "
         "the size given"},
        relative_tolerance, between(0, 0.5));
    v.real({"max_displacement", "h",
            "largest way of a body in a step, in element sizes beside it, that the size of the steps is "
            "chosen by; "
            "0: any"},
           max_displacement, not_negative());
    v.integer({"wanted_sub_iterations", "",
               "the steps become smaller where more sub-iterations are needed than this; 0: they do not"},
              wanted_sub_iterations, between(0, 10000));
    v.real(
        {"min_step", "s",
         "smallest step chosen so; 0: a thousandth of step; the equal steps to an output time or the end and "
         "halved ones may be smaller"},
        min_step, not_negative());
    v.real({"max_step", "s",
            "largest step chosen so; 0: no limit where relative_tolerance > 0, else the step given"},
           max_step, not_negative());
    v.require(min_step <= step, "min_step", "must be at most step");
    v.require(max_step == 0 || max_step >= step, "max_step", "must be at least step, or 0");
    v.integer({"max_halvings", "", "how often a step that does not converge is halved before the run ends"},
              max_halvings, between(0, 30));
    v.require(steady || step > 0, "step", "must be > 0 s (or steady = true)");
    v.require(steady || end > 0, "end", "must be > 0 s (or steady = true)");
  }
};

/// [output]
struct Output {
  double interval = 0;  ///< [s] of fields; 0: first and last only
  bool fields = true;
  std::int64_t checkpoint_every = 0;
  double checkpoint_interval = 60;     ///< [s] of wall time
  std::optional<double> measure_from;  ///< [s]
  double onset = 0;                    ///< of the diameter

  static constexpr std::int64_t steps_between_states = 25;
  /// After how many steps a run can be resumed each time; 0: never.
  std::int64_t resumable_every() const {
    if (checkpoint_every > 0) return checkpoint_every;
    return checkpoint_interval > 0 ? steps_between_states : 0;
  }

  void declare(ParameterVisitor& v) {
    v.real({"interval", "s", "time between written fields; 0: the first and the last only"}, interval,
           not_negative());
    v.boolean({"fields", "", "false: no fields are gathered, sent or written"}, fields);
    v.integer({"checkpoint_every", "steps",
               "steps between checkpoints of all participants; 0: the state after every 25th step is one, "
               "and is written "
               "when checkpoint_interval says so, or when the run is stopped"},
              checkpoint_every, between(0, 1e9));
    v.real({"checkpoint_interval", "s",
            "wall time between written checkpoints where checkpoint_every is 0; longer where writing them "
            "would take more "
            "than a hundredth of the time; 0: none"},
           checkpoint_interval, not_negative());
    v.real(
        {"measure_from", "s",
         "extrema, means and frequencies of coefficients and probes are those from this time on; none: the "
         "second half of the run"},
        measure_from, not_negative());
    v.real(
        {"onset", "",
         "way of a free body, over its diameter, that counts as the onset of motion: when the first one has "
         "gone as far, and what drove the flow then, is told in summary.json; 0: not looked for"},
        onset, not_negative());
  }
};

/// [coefficients], or [[coefficients]] where there are several: drag and lift of a body or a named boundary,
/// c = 2F/(ρ U² L).
struct Coefficients {
  std::string name;
  std::string on;
  double velocity = 0, length = 0;

  void declare(ParameterVisitor& v) {
    v.text({"name", "", "columns are NAME.drag and NAME.lift; empty: drag and lift"}, name);
    v.text({"on", "", "name of a body or of a boundary", true}, on);
    v.real({"velocity", "m/s", "reference velocity U", true}, velocity, positive());
    v.real({"length", "m", "reference length L", true}, length, positive());
  }
};

/// [[probes]]: a value at a point, the difference of the values at two points, or a mean over the flow.
struct Probe {
  std::string name;
  std::string quantity = "pressure";
  std::vector<double> point, minus;

  static constexpr std::array<std::string_view, 5> quantities{
      "pressure", "velocity_x", "velocity_y", "superficial_velocity_x", "superficial_velocity_y"};

  bool is_mean() const { return quantity.starts_with("superficial"); }

  void declare(ParameterVisitor& v) {
    v.text({"name", "", "name in the results; unique", true}, name);
    v.choice(
        {"quantity", "",
         "what is read there; pressure is the reduced one where there is gravity; superficial velocities are "
         "means over the rectangle around the mesh, bodies included"},
        quantity, quantities);
    v.reals({"point", "m", "where; empty for superficial velocities"}, point, {0, 2}, any_number());
    v.reals({"minus", "m", "a second point whose value is taken away; empty: none"}, minus, {0, 2},
            any_number());
    v.require(minus.size() != 1, "minus", "must be [x, y] or empty");
    v.require(point.size() == (is_mean() ? 0 : 2), "point",
              is_mean() ? "must be left out: a superficial velocity is a mean" : "must be [x, y]");
    v.require(!is_mean() || minus.empty(), "minus", "must be left out: a superficial velocity is a mean");
  }
};

/// [[profiles]]: a quantity along a segment.
struct Profile {
  std::string name;
  std::string quantity;
  std::vector<double> from, to;

  static constexpr std::array<std::string_view, 4> quantities{"velocity_x", "velocity_y", "speed",
                                                              "pressure"};

  void declare(ParameterVisitor& v) {
    v.text({"name", "", "name in the results; unique", true}, name);
    v.choice({"quantity", "", "what is read there", true}, quantity, quantities);
    v.reals({"from", "m", "start of the segment", true}, from, {2, 2}, any_number());
    v.reals({"to", "m", "end of the segment", true}, to, {2, 2}, any_number());
    v.require(from != to, "to", "must be another point than from");
  }
};

/// [exact]: the exact solution, for errors of the computed one.
struct Exact {
  std::vector<std::string> velocity{"0", "0"};
  std::string pressure = "0";

  void declare(ParameterVisitor& v) {
    v.formulas({"velocity", "m/s", "formulas of x, y, t", true}, velocity, {2, 2});
    v.formula({"pressure", "Pa", "formula of x, y, t; its mean is taken off where no boundary is open", true},
              pressure);
  }
};

/// The whole file.
struct Scene {
  std::string title, source, expected;
  std::vector<double> gravity{0, 0};  ///< g [m/s²]
  double thickness = 1;               ///< of a plane scene [m]
  double hydraulic_radius_ratio = 1;
  Time time;
  Periodic periodic;
  std::optional<Fluid> fluid;
  std::optional<Dem> dem;
  std::vector<Body> bodies;  ///< those listed; after them, once they are made, those of `grains`
  std::vector<Grains> grains;
  std::vector<Material> materials;
  std::vector<Wall> walls;
  std::vector<Outlet> outlets;
  Coupling coupling;
  Output output;
  std::vector<Coefficients> coefficients;
  std::vector<Probe> probes;
  std::vector<Profile> profiles;
  std::optional<Percolation> percolation;
  std::optional<Exact> exact;

  void declare(ParameterVisitor& v);
  /// What must hold between its groups: names that are unique and refer to something, dimensions that agree,
  /// boundaries that all have a condition. Each condition goes to `v.require`, with the dotted key that
  /// breaks it.
  void check(ParameterVisitor& v) const;

  std::size_t n_listed() const;  ///< bodies that the scene lists one by one
  bool moves_freely() const;     ///< a body is free
  bool moves() const;            ///< the surface of a body does: a disc that only spins stays in place
  bool needs_fluid() const { return fluid.has_value(); }
  bool needs_dem() const { return moves_freely(); }
};

enum class Part { fluid, dem };

/// Reads a scene file. Throws Error: file, line, key, what was required, what came, "did you mean".
Scene read_file(const std::string& path, const std::vector<std::string>& overrides = {});
/// Reads a scene from text; `name` stands for the file in errors. Overrides are "key.subkey=value".
Scene read_text(const std::string& text, const std::string& name,
                const std::vector<std::string>& overrides = {});
/// The scene as TOML with every default filled in.
std::string write_text(const Scene& scene);
/// The scene without what concerns the other role only.
Scene part_of(Part part, const Scene& scene);
/// The keys that name files, those left empty apart, with what they name: the contents go beside the scene.
std::vector<std::pair<std::string, std::string*>> file_keys(Scene& scene);
/// What they name.
std::vector<std::string*> file_names(Scene& scene);
/// FNV-1a hash of `write_text`, but for what has no bearing on the result: texts for the reader, who starts
/// the programs, and wall times.
std::uint64_t fingerprint(const Scene& scene);
/// All parameters with unit, bounds, default and sentence, as Markdown (docs/scene_reference.md).
std::string reference();

}  // namespace fpi::scene
