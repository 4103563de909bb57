#include "output/field_writer.hpp"

#include "core/error.hpp"
#include "output/replace.hpp"

namespace fpi::output {

FieldWriter::FieldWriter(const std::string& folder) : folder_(folder), series_(folder + "/fields.h5") {}

FieldWriter::FieldWriter(const std::string& folder, std::size_t kept)
    : folder_(folder), series_(folder + "/fields.h5", kept) {
  if (series_.file().has("/mesh/points")) read_layout();
}

void FieldWriter::read_layout() {
  const H5File& file = series_.file();
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
  series_.file().write("/mesh/points", points, {layout_.points, 2});
  series_.file().write("/mesh/cells", cells, {layout_.cells, 6});
}

void FieldWriter::write(double time, std::span<const FieldView> fields) {
  require(has_mesh(), "the mesh is required before the first fields; got none");
  const std::string group = series_.begin(time);
  layout_.fields.clear();
  for (const FieldView& field : fields) {
    const std::size_t count = field.on_cells ? layout_.cells : layout_.points;
    const Shape shape = field.components == 1 ? Shape{count} : Shape{count, field.components};
    series_.file().write(group + "/" + field.name, field.values, shape);
    layout_.fields.push_back({field.name, field.on_cells, field.components});
  }
  series_.flush();
  replace_text(folder_ + "/fields.xdmf", xdmf_text(layout_, series_.times()));
}

}  // namespace fpi::output
