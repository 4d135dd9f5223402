// The process's DDS domains: a domain is configured once per process and shared by all participants in it.
#pragma once

#include <cstdint>
#include <memory>

#include "service/status/status.h"
#include "service/transport/domain_config.h"

namespace bleedsim::transport {

inline constexpr std::uint32_t kMaxDomain = 230;  // above, the UDP ports of the domain leave the valid range

/// Of the middleware, as "0.10.2".
const char* middlewareVersion();

/// A share in a configured domain; the domain goes with its last share.
class DomainShare;

/// Joins the domain, configuring it if this process has none of that number yet. With $CYCLONEDDS_URI set that configuration is
/// used as it is, and interface and tag are left to it. wrong_state: the process has the domain with other options.
Result<std::shared_ptr<DomainShare>> joinDomain(DomainOptions options);

}  // namespace bleedsim::transport
