/// The result files of a run folder: history.csv at every step, and bodies.h5 too, but for scenes with groups
/// of grains, of which it has those steps only that fields are written at; there are fields.h5, fields.xdmf,
/// interface.h5, boundaries.h5 and profiles.h5 at the steps that are written, and the fluid's tables of the
/// last of these; left_bodies.csv has a line a body that left. What a scene does not have gets no file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "output/body_writer.hpp"
#include "output/curve_writer.hpp"
#include "output/field_writer.hpp"
#include "output/interface_writer.hpp"
#include "output/table.hpp"
#include "results/reported.hpp"
#include "step/coupled_problem.hpp"

namespace fpi {

std::string history_file(const std::string& folder);

class Recorder {
 public:
  /// New files in `folder`.
  Recorder(const scene::Scene& scene, const std::string& folder);
  /// The files of a checkpoint, without what was written after it.
  Recorder(const scene::Scene& scene, const std::string& folder, const std::vector<double>& sizes);

  /// The accepted step that ends at `time` [s].
  void record_step(double time, const Attempt& attempt, const CoupledProblem& problem,
                   const Reported& reported);
  /// A row of bodies.h5.
  void record_bodies(double time, const CoupledState& state);
  void record_interface(double time, const CoupledState& state);
  void record_fields(double time, const proto::Fields& fields);

  bool wants_mesh() const { return !fields_ || !fields_->has_mesh(); }
  /// Brings everything into the files.
  void flush();
  /// How far each file has grown, for a checkpoint.
  std::vector<double> sizes() const;

 private:
  void record_departures(double time, const std::vector<Departure>& departures);

  const scene::Scene& scene_;
  std::string folder_;
  output::Table history_;
  std::optional<output::Table> left_;
  std::optional<output::BodyWriter> bodies_;
  std::optional<output::InterfaceWriter> interface_;
  // From the first fields on:
  std::optional<output::FieldWriter> fields_;
  std::optional<output::CurveWriter> boundaries_, profiles_;
};

}  // namespace fpi
