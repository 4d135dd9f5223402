// Which configuration of Cyclone DDS a domain gets: the user's, or one of ours for loopback or for a network.
#pragma once

#include <cstdint>
#include <string>

#include "service/status/status.h"

namespace bleedsim::transport {

/// What distinguishes the configuration of a domain.
struct DomainOptions {
  std::uint32_t domain = 0;
  std::string interface {};  ///< empty: "lo", so that nothing leaves the host unless someone asks for it
  std::string tag{};         ///< participants with another tag never meet; empty: $BLEEDSIM_DDS_TAG, or none

  bool operator==(const DomainOptions&) const = default;
};

enum class ConfigKind {
  loopback,  ///< as config/dds/loopback.xml
  network,   ///< as config/dds/network.xml
  user,      ///< $CYCLONEDDS_URI
};

struct DomainConfig {
  ConfigKind kind = ConfigKind::loopback;
  std::string interface {};  ///< not of the user's
  std::string tag{};         ///< the user's has its own instead
  std::string uri{};         ///< of the user's
};

/// The configuration that these options bring: the user's if there is one, otherwise the one for loopback if the interface is
/// that, and the network's for any other. invalid_argument: the tag; not_found or unavailable: the interface.
Result<DomainConfig> chooseConfig(const DomainOptions& options);

/// As "loopback only (interface 'lo', datagrams of 64 KiB, as dds/loopback.xml), tag 'lab'".
std::string describe(const DomainConfig& config);

/// Cyclone's configuration, unless it is the user's. On loopback: 64 KiB datagrams; elsewhere 1460 B, since the loss of one part
/// loses a whole datagram. Receive buffer up to kReceiveBufferBytes (never a minimum: an unreachable one fails), lease 3 s and
/// announcements every 1 s, so a killed peer is noticed within 3 s; up to 100 processes per domain and host.
std::string configXml(const DomainConfig& config);

}  // namespace bleedsim::transport
