// What takes part in a domain, of any vendor and program, as DDS's own discovery tells it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "service/transport/participant.h"

namespace bleedsim::transport {

/// RTPS: of a participant and everything that belongs to it. Its first two bytes name the vendor.
using GuidPrefix = std::array<std::uint8_t, 12>;

struct DomainMember {
  GuidPrefix guid{};
  std::uint16_t vendor = 0;  ///< number of the OMG's list
  std::string host;          ///< as the participant says, empty if it does not
  std::string process;       ///< the same
  std::int32_t pid = 0;      ///< the same, 0 if it does not
};

struct DomainEndpoint {
  GuidPrefix member{};
  bool writer = false;
  bool reliable = false;
  std::string topic;
  std::vector<std::string> partitions;  ///< empty: the default one
};

struct DomainView {
  std::vector<DomainMember> members;
  std::vector<DomainEndpoint> endpoints;
};

inline constexpr std::uint16_t kOwnVendor = 0x0110;  ///< Cyclone DDS

/// "Cyclone DDS", "Fast DDS", ...; "vendor 0x1234" for one that is not known here.
std::string vendorName(std::uint16_t vendor);
std::uint16_t vendorOf(const GuidPrefix& guid);

/// Move-only. Hears from its creation on; peers announce themselves within a second or so.
class DomainObserver {
 public:
  static Result<DomainObserver> create(const Participant& participant);

  /// What takes part now, this process included. Bounded: of more than kMaxMembers and kMaxEndpoints the rest is left out.
  DomainView view() const;

  static constexpr std::size_t kMaxMembers = 1024;
  static constexpr std::size_t kMaxEndpoints = 16384;

 private:
  DomainObserver(Participant participant, std::array<Entity, 3> readers)
      : participant_{std::move(participant)}, readers_{std::move(readers)} {}

  Participant participant_;
  std::array<Entity, 3> readers_;  // participants, writers, readers
};

}  // namespace bleedsim::transport
