#include "service/transport/domain_config.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/core.h>

#include "service/transport/interfaces.h"
#include "service/transport/receive_buffer.h"

namespace bleedsim::transport {
namespace {

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string{} : std::string{value};
}

Status checkTag(const std::string& tag) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.';
  };
  if (tag.size() <= 64 && std::all_of(tag.begin(), tag.end(), allowed)) return {};
  return {StatusCode::invalid_argument,
          fmt::format("domain tag '{}' is not valid: use at most 64 letters, digits, '_', '-' or '.'", tag.substr(0, 80))};
}

}  // namespace

Result<DomainConfig> chooseConfig(const DomainOptions& options) {
  DomainConfig config;
  config.tag = options.tag.empty() ? environment("BLEEDSIM_DDS_TAG") : options.tag;
  if (Status tag = checkTag(config.tag); !tag) return tag;
  config.uri = environment("CYCLONEDDS_URI");
  if (!config.uri.empty()) {
    config.kind = ConfigKind::user;
    return config;
  }
  const Result<NetworkInterface> interface =
      findInterface(options.interface.empty() ? "lo" : options.interface, listInterfaces());
  if (!interface) return interface.status();
  config.interface = interface->name;
  config.kind = interface->loopback ? ConfigKind::loopback : ConfigKind::network;
  return config;
}

std::string describe(const DomainConfig& config) {
  const std::string tag = config.tag.empty() ? std::string{} : fmt::format(", tag '{}'", config.tag);
  switch (config.kind) {
    case ConfigKind::loopback:
      return fmt::format("loopback only (interface '{}', datagrams of 64 KiB, as dds/loopback.xml){}", config.interface, tag);
    case ConfigKind::network:
      return fmt::format("the network (interface '{}', messages of 1460 B, as dds/network.xml){}", config.interface, tag);
    case ConfigKind::user:
      break;
  }
  return fmt::format("what CYCLONEDDS_URI says ({})", config.uri);
}

std::string configXml(const DomainConfig& config) {
  // Loopback carries no multicast; saying so keeps the middleware from warning about it.
  const char* sizes =
      config.kind == ConfigKind::loopback
          ? "<AllowMulticast>false</AllowMulticast><MaxMessageSize>65500B</MaxMessageSize><FragmentSize>65000B</FragmentSize>"
          : "<MaxMessageSize>1460B</MaxMessageSize>";
  const std::string tag_element = config.tag.empty() ? std::string{} : fmt::format("<Tag>{}</Tag>", config.tag);
  return fmt::format(
      "<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface name=\"{}\"/></Interfaces>{}</General>"
      "<Discovery>{}<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>100</MaxAutoParticipantIndex>"
      "<SPDPInterval>1s</SPDPInterval><LeaseDuration>3s</LeaseDuration></Discovery>"
      "<Internal><SocketReceiveBufferSize max=\"{}B\"/></Internal></Domain></CycloneDDS>",
      config.interface, sizes, tag_element, kReceiveBufferBytes);
}

}  // namespace bleedsim::transport
