/// fluid_server: solves the flow of one run for a coupler.
#include "blas_kernel.hpp"
#include "core/pages.hpp"
#include "fluid_service.hpp"
#include "proto/serve.hpp"

int main(int argc, char** argv) {
  fpi::fluid::choose_blas_kernel(argv);
  fpi::keep_pages();
  const fpi::proto::Connection connection =
      fpi::proto::read_command_line(argc, argv, "fluid_server", {"checkpoint", "fields", "balance"});
  fpi::fluid::FluidService service;
  return fpi::proto::serve(service, connection);
}
