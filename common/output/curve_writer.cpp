#include "output/curve_writer.hpp"

namespace fpi::output {

void CurveWriter::write(double time, std::span<const CurveView> curves) {
  H5File file = series_.begin(time);
  for (const CurveView& curve : curves) {
    const std::string group = "/" + curve.name + "/";
    const std::size_t n = curve.points.size() / 3;
    file.write(group + "points", curve.points, {n, 3});
    if (!curve.lines.empty()) file.write(group + "lines", curve.lines, {curve.lines.size() / 3, 3});
    file.write(group + quantity_, curve.values,
               curve.components == 1 ? Shape{n} : Shape{n, curve.components});
  }
  series_.end(std::move(file), time);
}

}  // namespace fpi::output
