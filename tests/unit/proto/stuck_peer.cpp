/// One side of a run as a program of its own that gets stuck, so that tests can kill or stop it:
/// `stuck_peer fluid ADDRESS` in the phase "factor" of its first advance, `stuck_peer coupler ADDRESS` once a
/// fluid has joined.
#include <unistd.h>

#include "parties.hpp"

int main(int argc, char** argv) {
  using namespace fpi::proto;
  if (argc != 3) return 64;
  const std::string side = argv[1], address = argv[2];
  if (side == "coupler") {
    HostOptions options = parties::with_token();
    options.address = address;
    options.silence_timeout = 0.5;
    Host host(options);
    host.admit({"fluid"}, {true});
    for (;;) pause();
  }
  parties::Fluid fluid;
  fluid.on_advance = [&](auto&, auto&) -> FluidAdvanced {
    fluid.progress.set("factor");
    for (;;) pause();
  };
  return serve(fluid, parties::connection_to(address));
}
