#include "output/field_writer.hpp"

#include "core/error.hpp"
#include "output/replace.hpp"

namespace fpi::output {

FieldWriter::FieldWriter(const std::string& folder) : folder_(folder), series_(folder + "/fields.h5") {}

FieldWriter::FieldWriter(const std::string& folder, std::size_t kept)
    : folder_(folder), series_(folder + "/fields.h5", kept) {
  read_layout();
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
  replace_text(folder_ + "/fields.xdmf", xdmf_text(layout_, series_.times()), Durable::after_sync);
}

}  // namespace fpi::output
