#include "output/xdmf.hpp"

#include <fmt/format.h>

#include <iterator>

#include "output/step_series.hpp"

namespace fpi::output {
namespace {

/// `type` as an attribute list, such as R"(NumberType="Float" Precision="8")".
std::string array(const std::string& path, const std::string& dimensions, const char* type) {
  return fmt::format(R"(<DataItem Format="HDF" Dimensions="{}" {}>fields.h5:{}</DataItem>)", dimensions, type,
                     path);
}

constexpr const char* real = R"(NumberType="Float" Precision="8")";
constexpr const char* index = R"(NumberType="UInt" Precision="4")";

std::string attribute(const XdmfLayout& layout, const XdmfField& field, const std::string& group) {
  const std::size_t count = field.on_cells ? layout.cells : layout.points;
  const std::string dimensions =
      field.components == 1 ? fmt::format("{}", count) : fmt::format("{} {}", count, field.components);
  return fmt::format("        <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">{}</Attribute>\n",
                     field.name, field.components == 1 ? "Scalar" : "Vector",
                     field.on_cells ? "Cell" : "Node", array(group + "/" + field.name, dimensions, real));
}

}  // namespace

std::string xdmf_text(const XdmfLayout& layout, std::span<const double> times) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n"
      "    <Grid Name=\"fluid\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (std::size_t step = 0; step < times.size(); ++step) {
    fmt::format_to(std::back_inserter(text),
                   "      <Grid Name=\"fluid\" GridType=\"Uniform\">\n"
                   "        <Time Value=\"{}\"/>\n"
                   "        <Topology TopologyType=\"Triangle_6\" NumberOfElements=\"{}\">{}</Topology>\n"
                   "        <Geometry GeometryType=\"XY\">{}</Geometry>\n",
                   times[step], layout.cells, array("/mesh/cells", fmt::format("{} 6", layout.cells), index),
                   array("/mesh/points", fmt::format("{} 2", layout.points), real));
    for (const XdmfField& field : layout.fields) text += attribute(layout, field, StepSeries::group(step));
    text += "      </Grid>\n";
  }
  return text + "    </Grid>\n  </Domain>\n</Xdmf>\n";
}

}  // namespace fpi::output
