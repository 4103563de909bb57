#include "output/interface_writer.hpp"

namespace fpi::output {

void InterfaceWriter::write(double time, const InterfaceArrays& arrays) {
  const std::size_t n_arcs = arrays.body.size(), n_bodies = arrays.centre.size() / 2;
  H5File file = series_.begin(time);
  file.write("/body", arrays.body, {n_arcs});
  file.write("/start", arrays.start, {n_arcs});
  file.write("/end", arrays.end, {n_arcs});
  file.write("/middle", arrays.middle, {n_arcs, 2});
  file.write("/traction", arrays.traction, {n_arcs, 2});
  file.write("/centre", arrays.centre, {n_bodies, 2});
  series_.end(std::move(file), time);
}

}  // namespace fpi::output
