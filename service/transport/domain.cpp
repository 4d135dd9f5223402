#include "service/transport/domain.h"

#include <algorithm>
#include <cstdlib>
#include <dds/dds.h>
#include <fmt/core.h>
#include <map>
#include <mutex>

#include "service/transport/entity.h"
#include "service/transport/receive_buffer.h"

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

const char* environment(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr && *value != '\0' ? value : nullptr;
}

Status checkTag(const std::string& tag) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.';
  };
  if (tag.size() <= 64 && std::all_of(tag.begin(), tag.end(), allowed)) return {};
  return {StatusCode::invalid_argument,
          fmt::format("domain tag '{}' is not valid: use at most 64 letters, digits, '_', '-' or '.'", tag.substr(0, 80))};
}

Result<Entity> configureDomain(const DomainOptions& options) {
  const Result<NetworkInterface> interface = findInterface(options.interface, listInterfaces());
  if (!interface) return interface.status();
  const std::string xml = configXml(options.interface, interface->loopback, options.tag);
  return Entity::adopt(dds_create_domain(options.domain, xml.c_str()),
                       fmt::format("set up DDS domain {} on interface '{}'", options.domain, options.interface));
}

}  // namespace

std::string configXml(const std::string& interface, bool loopback, const std::string& tag) {
  // Loopback carries no multicast; saying so keeps the middleware from warning about it.
  const char* sizes =
      loopback
          ? "<AllowMulticast>false</AllowMulticast><MaxMessageSize>65500B</MaxMessageSize><FragmentSize>65000B</FragmentSize>"
          : "<MaxMessageSize>1460B</MaxMessageSize>";
  const std::string tag_element = tag.empty() ? std::string{} : fmt::format("<Tag>{}</Tag>", tag);
  return fmt::format(
      "<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface name=\"{}\"/></Interfaces>{}</General>"
      "<Discovery>{}<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>100</MaxAutoParticipantIndex>"
      "<SPDPInterval>1s</SPDPInterval><LeaseDuration>3s</LeaseDuration></Discovery>"
      "<Internal><SocketReceiveBufferSize max=\"{}B\"/></Internal></Domain></CycloneDDS>",
      interface, sizes, tag_element, kReceiveBufferBytes);
}

Result<std::shared_ptr<DomainShare>> joinDomain(DomainOptions options) {
  if (options.domain > kMaxDomain) {
    return Status{StatusCode::invalid_argument,
                  fmt::format("DDS domain {} is out of range: use 0 to {}", options.domain, kMaxDomain)};
  }
  const bool user_configured = environment("CYCLONEDDS_URI") != nullptr;
  if (options.interface.empty()) options.interface = "lo";
  if (options.tag.empty()) {
    if (const char* tag = environment("BLEEDSIM_DDS_TAG")) options.tag = tag;
  }
  if (const Status tag = checkTag(options.tag); !tag) return tag;

  DomainRegistry& domains = registry();
  const std::lock_guard lock{domains.mutex};
  if (std::shared_ptr<DomainShare> existing = domains.domains[options.domain].lock()) {
    if (existing->options() == options) return existing;
    return Status{StatusCode::wrong_state,
                  fmt::format("this process is in DDS domain {} on interface '{}' with tag '{}' already: use the same options",
                              options.domain, existing->options().interface, existing->options().tag)};
  }
  Entity domain;
  if (!user_configured) {
    Result<Entity> configured = configureDomain(options);
    if (!configured) return configured.status();
    domain = std::move(*configured);
  }
  auto share = std::make_shared<DomainShare>(options, std::move(domain));
  domains.domains[options.domain] = share;
  return share;
}

}  // namespace bleedsim::transport
