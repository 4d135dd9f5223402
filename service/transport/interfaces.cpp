#include "service/transport/interfaces.h"

#include <algorithm>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <sys/socket.h>

namespace bleedsim::transport {

std::vector<NetworkInterface> listInterfaces() {
  std::vector<NetworkInterface> out;
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return out;
  for (const ifaddrs* i = first; i != nullptr; i = i->ifa_next) {
    if (i->ifa_addr == nullptr || i->ifa_addr->sa_family != AF_INET) continue;
    const std::string name = i->ifa_name;
    const auto same = [&](const NetworkInterface& other) { return other.name == name; };
    if (std::any_of(out.begin(), out.end(), same)) continue;
    out.push_back({name, (i->ifa_flags & IFF_LOOPBACK) != 0, (i->ifa_flags & IFF_UP) != 0});
  }
  freeifaddrs(first);
  return out;
}

Result<NetworkInterface> findInterface(const std::string& name, const std::vector<NetworkInterface>& existing) {
  const auto same = [&](const NetworkInterface& other) { return other.name == name; };
  const auto found = std::find_if(existing.begin(), existing.end(), same);
  if (found == existing.end()) {
    std::vector<std::string> names;
    for (const NetworkInterface& i : existing) names.push_back(i.name);
    return Status{StatusCode::not_found,
                  fmt::format("there is no network interface '{}' with an IPv4 address; this host has: {}", name.substr(0, 64),
                              names.empty() ? std::string{"none"} : fmt::format("{}", fmt::join(names, ", ")))};
  }
  if (!found->up) {
    return Status{StatusCode::unavailable,
                  fmt::format("the network interface '{}' is down: bring it up or choose another", name)};
  }
  return *found;
}

}  // namespace bleedsim::transport
