#include "output/body_writer.hpp"

#include <algorithm>
#include <utility>

#include "core/error.hpp"

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
    : path_(file_in(folder)) {
  H5File file = H5File::replacing(path_);
  file.write("/name", names);
  file.write("/radius", radii, {radii.size()});
  file.publish(Durable::now);
}

BodyWriter::BodyWriter(const std::string& folder, std::size_t kept) : path_(file_in(folder)), in_file_(kept) {
  H5File file = H5File::revising(path_);
  require(file.has("/time") || kept == 0,
          "{} rows are required in {}; got none: the file does not belong to the checkpoint", kept, path_);
  if (!file.has("/time")) return;
  file.keep_rows("/time", kept);
  for (const auto& [name, member] : columns) file.keep_rows(name, kept);
  file.publish(Durable::now);
}

void BodyWriter::append(double time, std::span<const BodyRow> bodies) {
  times_.push_back(time);
  rows_.insert(rows_.end(), bodies.begin(), bodies.end());
  if (std::chrono::steady_clock::now() > next_flush_) flush();
}

void BodyWriter::flush() {
  using Clock = std::chrono::steady_clock;
  if (times_.empty()) return;
  const Clock::time_point start = Clock::now();
  H5File file = H5File::revising(path_);
  file.append("/time", times_, {});
  std::vector<double> values;
  for (const auto& [name, member] : columns) {
    values.clear();
    for (const BodyRow& body : rows_)
      values.insert(values.end(), (body.*member).begin(), (body.*member).end());
    file.append(name, values, {rows_.size() / times_.size(), 3});
  }
  file.publish(Durable::now);
  in_file_ += times_.size();
  times_.clear();
  rows_.clear();
  const Clock::time_point end = Clock::now();
  next_flush_ = end + std::max<Clock::duration>(std::chrono::seconds(1), 100 * (end - start));
}

}  // namespace fpi::output
