#include "output/field_writer.hpp"

#include <filesystem>

#include "core/error.hpp"
#include "output/replace.hpp"

namespace fpi::output {

namespace {

std::string xdmf_file(const std::string& folder) { return folder + "/fields.xdmf"; }

/// Of the series, once no .xdmf names steps that it may lose.
std::string series_file(const std::string& folder) {
  std::filesystem::remove(xdmf_file(folder));
  return folder + "/fields.h5";
}

}  // namespace

FieldWriter::FieldWriter(const std::string& folder) : folder_(folder), series_(series_file(folder)) {}

FieldWriter::FieldWriter(const std::string& folder, std::size_t kept)
    : folder_(folder), series_(series_file(folder), kept) {
  read_layout();
  write_xdmf();
}

void FieldWriter::write_xdmf() const {
  replace_text(xdmf_file(folder_), xdmf_text(layout_, series_.times()), Durable::after_sync);
}

void FieldWriter::read_layout() {
  const H5File file = H5File::read(series_.path());
  if (!file.has("/mesh")) return;
  layout_.points = file.shape("/mesh/points").at(0);
  layout_.cells = file.shape("/mesh/cells").at(0);
  if (series_.size() == 0) return;
  const std::string group = StepSeries::group(0);
  for (const std::string& name : file.list(group)) {
    const Shape shape = file.shape(group + "/" + name);
    layout_.fields.push_back({name, shape[0] == layout_.cells, shape.size() > 1 ? shape[1] : 1});
  }
}

void FieldWriter::write_mesh(std::span<const double> points, std::span<const std::uint32_t> cells) {
  layout_.points = points.size() / 2;
  layout_.cells = cells.size() / 6;
  H5File mesh = series_.begin_shared("mesh");
  mesh.write("/points", points, {layout_.points, 2});
  mesh.write("/cells", cells, {layout_.cells, 6});
  series_.end_shared(std::move(mesh), "mesh");
}

void FieldWriter::write(double time, std::span<const FieldView> fields) {
  require(has_mesh(), "the mesh is required before the first fields; got none");
  H5File file = series_.begin(time);
  layout_.fields.clear();
  for (const FieldView& field : fields) {
    const std::size_t count = field.on_cells ? layout_.cells : layout_.points;
    const Shape shape = field.components == 1 ? Shape{count} : Shape{count, field.components};
    file.write("/" + field.name, field.values, shape);
    layout_.fields.push_back({field.name, field.on_cells, field.components});
  }
  series_.end(std::move(file), time);
  write_xdmf();
}

}  // namespace fpi::output
