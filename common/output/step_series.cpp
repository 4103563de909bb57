#include "output/step_series.hpp"

#include <filesystem>

#include "core/error.hpp"

namespace fpi::output {
namespace fs = std::filesystem;

namespace {

std::string name_of(std::size_t index) { return fmt::format("{:06}", index); }

}  // namespace

std::string StepSeries::group(std::size_t index) { return "/steps/" + name_of(index); }

StepSeries::StepSeries(const std::string& path)
    : path_(path), folder_(fs::path(path).replace_extension().string()) {
  std::error_code error;
  fs::create_directories(folder_, error);
  require(!error, "a folder that can be written is required for {}: {}", path, error.message());
  H5File::replacing(path).publish(Durable::after_sync);
}

/// Whatever became of the file with the links: it is made anew from the files of the steps.
StepSeries::StepSeries(const std::string& path, std::size_t kept)
    : path_(path), folder_(fs::path(path).replace_extension().string()) {
  H5File series = H5File::replacing(path_);
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) {
    const std::string name = entry.path().stem();
    const bool is_step = name.find_first_not_of("0123456789") == std::string::npos;
    if (entry.path().extension() == ".h5" && !is_step) series.link("/" + name, linked(name));
  }
  for (std::size_t i = 0; i < kept && fs::exists(piece(name_of(i))); ++i) {
    times_.push_back(H5File::read(piece(name_of(i))).attribute("/", "time"));
    series.link(group(i), linked(name_of(i)));
  }
  require(times_.size() == kept,
          "{} steps are required in {}; got {}: the file does not belong to the checkpoint", kept, path,
          times_.size());
  series.publish(Durable::after_sync);
  for (std::size_t i = kept; fs::exists(piece(name_of(i))); ++i)
    fs::remove(piece(name_of(i)));  // no link names them
}

std::string StepSeries::piece(const std::string& name) const { return folder_ + "/" + name + ".h5"; }

std::string StepSeries::linked(const std::string& name) const {
  return fs::path(folder_).filename().string() + "/" + name + ".h5";
}

H5File StepSeries::begin(double time) const {
  H5File step = begin_shared(name_of(size()));
  step.mark("/", "time", time);
  return step;
}

void StepSeries::end(H5File step, double time) {
  step.publish(Durable::after_sync);
  link(group(size()), name_of(size()));
  times_.push_back(time);
}

H5File StepSeries::begin_shared(const std::string& name) const { return H5File::replacing(piece(name)); }

void StepSeries::end_shared(H5File shared, const std::string& name) {
  shared.publish(Durable::after_sync);
  link("/" + name, name);
}

void StepSeries::link(const std::string& group, const std::string& name) const {
  H5File series = H5File::revising(path_);
  series.link(group, linked(name));
  series.publish(Durable::after_sync);
}

}  // namespace fpi::output
