// The process's DDS domains: a domain is configured once per process and shared by all participants in it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "service/status/status.h"
#include "service/transport/interfaces.h"

namespace bleedsim::transport {

inline constexpr std::uint32_t kMaxDomain = 230;  // above, the UDP ports of the domain leave the valid range

/// What distinguishes the configuration of a domain.
struct DomainOptions {
  std::uint32_t domain = 0;
  std::string interface {};  ///< empty: "lo", so that nothing leaves the host unless someone asks for it
  std::string tag{};         ///< participants with another tag never meet; empty: $BLEEDSIM_DDS_TAG, or none

  bool operator==(const DomainOptions&) const = default;
};

/// Cyclone's configuration. On loopback: 64 KiB datagrams; elsewhere 1460 B, since the loss of one part loses a whole datagram.
/// Receive buffer up to kReceiveBufferBytes (never a minimum: an unreachable one fails), lease 3 s and announcements every 1 s,
/// so a killed peer is noticed within 3 s; up to 100 processes per domain and host.
std::string configXml(const std::string& interface, bool loopback, const std::string& tag);

/// A share in a configured domain; the domain goes with its last share.
class DomainShare;

/// Joins the domain, configuring it if this process has none of that number yet. With $CYCLONEDDS_URI set that configuration is
/// used as it is, and interface and tag are left to it. wrong_state: the process has the domain with other options.
Result<std::shared_ptr<DomainShare>> joinDomain(DomainOptions options);

}  // namespace bleedsim::transport
