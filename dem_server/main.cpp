/// dem_server: moves the grains of one run for a coupler.
#include "core/pages.hpp"
#include "dem_service.hpp"
#include "proto/serve.hpp"

int main(int argc, char** argv) {
  fpi::keep_pages();
  const fpi::proto::Connection connection =
      fpi::proto::read_command_line(argc, argv, "dem_server", {"checkpoint", "added_inertia", "resistance"});
  fpi::dem::DemService service;
  return fpi::proto::serve(service, connection);
}
