#include "output/interface_writer.hpp"

namespace fpi::output {

void InterfaceWriter::write(double time, const InterfaceArrays& arrays) {
  const std::string group = series_.begin(time);
  const std::size_t n_arcs = arrays.body.size(), n_bodies = arrays.centre.size() / 2;
  H5File& file = series_.file();
  file.write(group + "/body", arrays.body, {n_arcs});
  file.write(group + "/start", arrays.start, {n_arcs});
  file.write(group + "/end", arrays.end, {n_arcs});
  file.write(group + "/middle", arrays.middle, {n_arcs, 2});
  file.write(group + "/traction", arrays.traction, {n_arcs, 2});
  file.write(group + "/centre", arrays.centre, {n_bodies, 2});
  series_.flush();
}

}  // namespace fpi::output
