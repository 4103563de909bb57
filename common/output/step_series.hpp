/// A file of /steps/000000, /steps/000001, …, each a group marked with its time: the shape that fields.h5,
/// interface.h5, boundaries.h5 and profiles.h5 share. Each step is a file of its own in a folder beside,
/// fields/000000.h5 for one, which is written once and then linked to: all of them can be read at any moment.
#pragma once

#include <string>
#include <vector>

#include "output/h5_file.hpp"

namespace fpi::output {

class StepSeries {
 public:
  /// A new series; `path` ends in ".h5".
  explicit StepSeries(const std::string& path);
  /// The series that is there, without what lies beyond its first `kept` steps. Throws Error where it has
  /// fewer.
  StepSeries(const std::string& path, std::size_t kept);

  /// The file of the next step, to be filled and given to `end`.
  H5File begin(double time) const;
  void end(H5File step, double time);
  /// The file of what all steps share, and its place in the series, "/name".
  H5File begin_shared(const std::string& name) const;
  void end_shared(H5File shared, const std::string& name);

  const std::string& path() const { return path_; }
  const std::vector<double>& times() const { return times_; }  ///< [s]
  std::size_t size() const { return times_.size(); }

  static std::string group(std::size_t index);

 private:
  std::string piece(const std::string& name) const;
  std::string linked(const std::string& name) const;
  void link(const std::string& group, const std::string& name) const;

  std::string path_, folder_;
  std::vector<double> times_;
};

}  // namespace fpi::output
