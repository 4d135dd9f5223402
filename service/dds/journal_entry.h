// One input as applied.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <variant>

#include "service/dds/request.h"

namespace bleedsim::dds {

struct RequestTaken {
  std::unique_ptr<RequestCopy> request;
  std::uint32_t object_id = 0;
};
struct InstrumentTaken {
  bleed_v1_Instrument sample{};
};
enum class InstrumentEndReason : std::uint32_t {
  expired = bleed_v1_INSTRUMENT_END_EXPIRED,
  lost = bleed_v1_INSTRUMENT_END_LOST,
};
struct InstrumentEnded {
  InstrumentKey key;
  InstrumentEndReason reason = InstrumentEndReason::expired;
};
/// What the service decided by itself, e.g. that the solver failed.
struct Decision {
  std::string text;
};

/// `step` steps were done when the input took effect.
struct JournalEntry {
  std::uint32_t epoch = 0;
  std::uint64_t number = 0;
  std::uint64_t step = 0;
  double sim_time = 0.0;  ///< s
  std::variant<Decision, RequestTaken, InstrumentTaken, InstrumentEnded> input;
};

}  // namespace bleedsim::dds
