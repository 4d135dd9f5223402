#include "service/transport/discovery.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <dds/dds.h>
#include <fmt/core.h>
#include <memory>
#include <utility>

namespace bleedsim::transport {
namespace {

struct Vendor {
  std::uint16_t number;
  const char* name;
};

constexpr std::array<Vendor, 6> kVendors{{{0x0101, "RTI Connext"},
                                          {0x0102, "OpenSplice"},
                                          {0x0103, "OpenDDS"},
                                          {0x010f, "Fast DDS"},
                                          {kOwnVendor, "Cyclone DDS"},
                                          {0x0112, "RustDDS"}}};

GuidPrefix prefixOf(const dds_guid_t& guid) {
  GuidPrefix prefix{};
  std::memcpy(prefix.data(), guid.v, prefix.size());
  return prefix;
}

std::string property(const dds_qos_t* qos, const char* name) {
  char* value = nullptr;
  if (qos == nullptr || !dds_qget_prop(qos, name, &value) || value == nullptr) return {};
  std::string out{value};
  dds_free(value);
  return out;
}

std::vector<std::string> partitionsOf(const dds_qos_t* qos) {
  std::vector<std::string> out;
  std::uint32_t count = 0;
  char** names = nullptr;
  if (qos == nullptr || !dds_qget_partition(qos, &count, &names)) return out;
  for (std::uint32_t i = 0; i < count; ++i) {
    out.emplace_back(names[i]);
    dds_free(names[i]);
  }
  dds_free(names);
  return out;
}

bool isReliable(const dds_qos_t* qos) {
  dds_reliability_kind_t kind = DDS_RELIABILITY_BEST_EFFORT;
  return qos != nullptr && dds_qget_reliability(qos, &kind, nullptr) && kind == DDS_RELIABILITY_RELIABLE;
}

DomainMember memberOf(const dds_builtintopic_participant_t& sample) {
  DomainMember member;
  member.guid = prefixOf(sample.key);
  member.vendor = vendorOf(member.guid);
  member.host = property(sample.qos, "__Hostname");
  member.process = property(sample.qos, "__ProcessName");
  const std::string pid = property(sample.qos, "__Pid");
  std::from_chars(pid.data(), pid.data() + pid.size(), member.pid);
  return member;
}

DomainEndpoint endpointOf(const dds_builtintopic_endpoint_t& sample, bool writer) {
  DomainEndpoint endpoint;
  endpoint.member = prefixOf(sample.participant_key);
  endpoint.writer = writer;
  endpoint.reliable = isReliable(sample.qos);
  if (sample.topic_name != nullptr) endpoint.topic = sample.topic_name;
  endpoint.partitions = partitionsOf(sample.qos);
  return endpoint;
}

/// Calls use(sample) for what lives, at most `limit` times.
template <class T, class Use>
void readAlive(dds_entity_t reader, std::size_t limit, Use&& use) {
  std::vector<void*> samples(limit, nullptr);
  std::vector<dds_sample_info_t> infos(limit);
  const dds_return_t count = dds_read(reader, samples.data(), infos.data(), limit, static_cast<std::uint32_t>(limit));
  for (std::size_t i = 0; i < static_cast<std::size_t>(std::max(count, 0)); ++i) {
    if (infos[i].valid_data && infos[i].instance_state == DDS_IST_ALIVE) use(*static_cast<const T*>(samples[i]));
  }
  if (count > 0) dds_return_loan(reader, samples.data(), count);
}

}  // namespace

std::string vendorName(std::uint16_t vendor) {
  const auto known = std::find_if(kVendors.begin(), kVendors.end(), [vendor](const Vendor& v) { return v.number == vendor; });
  return known != kVendors.end() ? known->name : fmt::format("vendor 0x{:04x}", vendor);
}

std::uint16_t vendorOf(const GuidPrefix& guid) { return static_cast<std::uint16_t>(guid[0] << 8U | guid[1]); }

Result<DomainObserver> DomainObserver::create(const Participant& participant) {
  constexpr std::array<dds_entity_t, 3> kBuiltIn{DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, DDS_BUILTIN_TOPIC_DCPSPUBLICATION,
                                                 DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION};
  std::array<Entity, 3> readers;
  for (std::size_t i = 0; i < readers.size(); ++i) {
    Result<Entity> reader =
        Entity::adopt(dds_create_reader(participant.handle(), kBuiltIn[i], nullptr, nullptr), "read DDS's discovery");
    if (!reader) return reader.status();
    readers[i] = std::move(*reader);
  }
  return DomainObserver{participant, std::move(readers)};
}

DomainView DomainObserver::view() const {
  DomainView view;
  readAlive<dds_builtintopic_participant_t>(readers_[0].get(), kMaxMembers,
                                            [&](const auto& sample) { view.members.push_back(memberOf(sample)); });
  for (const bool writer : {true, false}) {
    readAlive<dds_builtintopic_endpoint_t>(readers_[writer ? 1 : 2].get(), kMaxEndpoints, [&](const auto& sample) {
      DomainEndpoint endpoint = endpointOf(sample, writer);
      const bool of_discovery_itself = endpoint.topic.starts_with("DCPS");
      if (!of_discovery_itself) view.endpoints.push_back(std::move(endpoint));
    });
  }
  return view;
}

}  // namespace bleedsim::transport
