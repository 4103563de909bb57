#include "output/step_series.hpp"

#include "core/error.hpp"

namespace fpi::output {

std::string StepSeries::group(std::size_t index) { return fmt::format("/steps/{:06}", index); }

StepSeries::StepSeries(const std::string& path) : file_(H5File::create(path)) {}

StepSeries::StepSeries(const std::string& path, std::size_t kept) : file_(H5File::edit(path)) {
  for (std::size_t i = 0; file_.has(group(i)); ++i) {
    if (i < kept) {
      times_.push_back(file_.attribute(group(i), "time"));
    } else {
      file_.remove(group(i));
    }
  }
  require(times_.size() == kept,
          "{} steps are required in {}; got {}: the file does not belong to the checkpoint", kept, path,
          times_.size());
}

std::string StepSeries::begin(double time) {
  std::string name = group(times_.size());
  file_.make_group(name, "time", time);
  times_.push_back(time);
  return name;
}

}  // namespace fpi::output
