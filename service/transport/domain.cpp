#include "service/transport/domain.h"

#include <dds/dds.h>
#include <dds/version.h>
#include <fmt/core.h>
#include <map>
#include <mutex>

#include "service/transport/entity.h"

namespace bleedsim::transport {

class DomainShare {
 public:
  DomainShare(DomainOptions options, Entity domain) : options_{std::move(options)}, domain_{std::move(domain)} {}
  const DomainOptions& options() const { return options_; }

 private:
  DomainOptions options_;
  Entity domain_;  // empty when Cyclone creates the domain itself, from the user's configuration
};

namespace {

// Cyclone keeps one domain object per number and process, so the record of them has to be one per process as well.
struct DomainRegistry {
  std::mutex mutex;
  std::map<std::uint32_t, std::weak_ptr<DomainShare>> domains;
};

DomainRegistry& registry() {
  static DomainRegistry instance;
  return instance;
}

}  // namespace

const char* middlewareVersion() { return DDS_VERSION; }

Result<std::shared_ptr<DomainShare>> joinDomain(DomainOptions options) {
  if (options.domain > kMaxDomain) {
    return Status{StatusCode::invalid_argument,
                  fmt::format("DDS domain {} is out of range: use 0 to {}", options.domain, kMaxDomain)};
  }
  const Result<DomainConfig> config = chooseConfig(options);
  if (!config) return config.status();
  if (options.interface.empty()) options.interface = "lo";
  options.tag = config->tag;

  DomainRegistry& domains = registry();
  const std::lock_guard lock{domains.mutex};
  if (std::shared_ptr<DomainShare> existing = domains.domains[options.domain].lock()) {
    if (existing->options() == options) return existing;
    return Status{StatusCode::wrong_state,
                  fmt::format("this process is in DDS domain {} on interface '{}' with tag '{}' already: use the same options",
                              options.domain, existing->options().interface, existing->options().tag)};
  }
  Entity domain;
  if (config->kind != ConfigKind::user) {
    Result<Entity> configured =
        Entity::adopt(dds_create_domain(options.domain, configXml(*config).c_str()),
                      fmt::format("set up DDS domain {} on interface '{}'", options.domain, config->interface));
    if (!configured) return configured.status();
    domain = std::move(*configured);
  }
  auto share = std::make_shared<DomainShare>(options, std::move(domain));
  domains.domains[options.domain] = share;
  return share;
}

}  // namespace bleedsim::transport
