/// A file of /steps/000000, /steps/000001, …, each a group marked with its time: the shape that fields.h5 and
/// interface.h5 share.
#pragma once

#include <string>
#include <vector>

#include "output/h5_file.hpp"

namespace fpi::output {

class StepSeries {
 public:
  /// A new series.
  explicit StepSeries(const std::string& path);
  /// The series that is there, without what lies beyond its first `kept` steps.
  StepSeries(const std::string& path, std::size_t kept);

  /// Makes the group of the next step and returns its name.
  std::string begin(double time);
  void flush() { file_.flush(); }

  H5File& file() { return file_; }
  const std::vector<double>& times() const { return times_; }  ///< [s]
  std::size_t size() const { return times_.size(); }

  static std::string group(std::size_t index);

 private:
  H5File file_;
  std::vector<double> times_;
};

}  // namespace fpi::output
