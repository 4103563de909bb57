#include "proto/transport/address.hpp"

#include <arpa/inet.h>

#include "core/error.hpp"

namespace fpi::proto {
namespace {

constexpr std::string_view tcp = "tcp://", ipc = "ipc://";

/// HOST of tcp://HOST:PORT, without the brackets of IPv6; "" where there is none.
std::string host_of(const std::string& address) {
  const std::size_t colon = address.rfind(':');
  if (!address.starts_with(tcp) || colon < tcp.size() || colon + 1 == address.size()) return {};
  const std::string host = address.substr(tcp.size(), colon - tcp.size());
  const bool bracketed = host.size() > 2 && host.front() == '[' && host.back() == ']';
  return bracketed ? host.substr(1, host.size() - 2) : host;
}

}  // namespace

bool is_local(const std::string& address) {
  if (address.starts_with(ipc)) return true;
  const std::string host = host_of(address);
  in_addr v4{};
  if (inet_pton(AF_INET, host.c_str(), &v4) == 1) return ntohl(v4.s_addr) >> 24 == 127;
  in6_addr v6{};
  if (inet_pton(AF_INET6, host.c_str(), &v6) == 1) return IN6_IS_ADDR_LOOPBACK(&v6);
  return host == "localhost";
}

void require_usable(const std::string& address, const std::string& keys) {
  require(address.starts_with(ipc) || !host_of(address).empty(),
          "an address must be tcp://HOST:PORT (PORT * for a free one) or ipc://PATH; got \"{}\"", address);
  require(
      is_local(address) || !keys.empty(),
      "an address beyond this machine needs keys, so that nobody else can take part; got {} without: make "
      "them with ./fpi keys DIR and give --keys DIR on both sides",
      address);
}

}  // namespace fpi::proto
