// Who asked for what: the names of clients, requests and instruments.
#pragma once

#include <compare>
#include <cstdint>

#include "service/transport/uuid.h"

namespace bleedsim::dds {

using transport::Uuid;

/// One start of one client; `run` is drawn at random by the client.
struct ClientRun {
  Uuid client{};
  std::uint64_t run = 0;

  // NOLINTNEXTLINE(modernize-use-nullptr): the check takes the zero in the generated comparison for a pointer
  auto operator<=>(const ClientRun&) const = default;
};

/// Names a request for ever: the same key sent again is the same request.
struct RequestKey {
  ClientRun origin;
  std::uint64_t seq = 0;

  // NOLINTNEXTLINE(modernize-use-nullptr): as above
  auto operator<=>(const RequestKey&) const = default;
};

/// Names one tool in a client's hands.
struct InstrumentKey {
  Uuid client{};
  std::uint32_t tool = 0;

  // NOLINTNEXTLINE(modernize-use-nullptr): as above
  auto operator<=>(const InstrumentKey&) const = default;
};

}  // namespace bleedsim::dds
