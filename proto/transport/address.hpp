/// Addresses: which ones stay on this machine, and which may be used without keys.
#pragma once

#include <string>

namespace fpi::proto {

/// True for tcp:// addresses of the loopback interface (127.0.0.0/8, ::1, localhost) and for ipc://.
bool is_local(const std::string& address);

/// Throws Error unless `address` is tcp://HOST:PORT or ipc://PATH, and local wherever `keys` is empty.
void require_usable(const std::string& address, const std::string& keys);

}  // namespace fpi::proto
