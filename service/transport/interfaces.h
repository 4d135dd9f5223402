// The network interfaces of this host.
#pragma once

#include <string>
#include <vector>

#include "service/status/status.h"

namespace bleedsim::transport {

struct NetworkInterface {
  std::string name;
  bool loopback = false;
  bool up = false;
};

/// Every interface with an IPv4 address, in the kernel's order, each once.
std::vector<NetworkInterface> listInterfaces();

/// The interface of that name; not_found lists the existing ones, unavailable says that it is down.
Result<NetworkInterface> findInterface(const std::string& name, const std::vector<NetworkInterface>& existing);

}  // namespace bleedsim::transport
