#include "output/body_writer.hpp"

#include <utility>

namespace fpi::output {
namespace {

constexpr std::array<std::pair<const char*, std::array<double, 3> BodyRow::*>, 6> columns{
    {{"/position", &BodyRow::position},
     {"/rotation", &BodyRow::rotation},
     {"/velocity", &BodyRow::velocity},
     {"/spin", &BodyRow::spin},
     {"/force", &BodyRow::force},
     {"/torque", &BodyRow::torque}}};

std::string file_in(const std::string& folder) { return folder + "/bodies.h5"; }

}  // namespace

BodyWriter::BodyWriter(const std::string& folder, const std::vector<std::string>& names,
                       const std::vector<double>& radii)
    : file_(H5File::create(file_in(folder))) {
  file_.write("/name", names);
  file_.write("/radius", radii, {radii.size()});
}

BodyWriter::BodyWriter(const std::string& folder, std::size_t kept)
    : file_(H5File::edit(file_in(folder))), rows_(kept) {
  if (!file_.has("/time")) return;
  file_.keep_rows("/time", kept);
  for (const auto& [name, member] : columns) file_.keep_rows(name, kept);
}

void BodyWriter::append(double time, std::span<const BodyRow> bodies) {
  file_.append("/time", std::span(&time, 1), {});
  std::vector<double> values;
  for (const auto& [name, member] : columns) {
    values.clear();
    for (const BodyRow& body : bodies)
      values.insert(values.end(), (body.*member).begin(), (body.*member).end());
    file_.append(name, values, {bodies.size(), 3});
  }
  ++rows_;
  // A flush costs more than the row, so that fast runs share one among many.
  if (std::chrono::steady_clock::now() - flushed_ > std::chrono::seconds(1)) flush();
}

void BodyWriter::flush() {
  file_.flush();
  flushed_ = std::chrono::steady_clock::now();
}

}  // namespace fpi::output
