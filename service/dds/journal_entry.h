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

/// The epoch begins with a checkpoint.
struct Restored {
  Uuid session{};           ///< that it is of
  std::uint32_t epoch = 0;  ///< of that session
  std::uint64_t step = 0;
  std::uint64_t number = 0;  ///< entries of that epoch's journal that the state contains
  std::uint64_t state_hash = 0;
  std::string name;
};
/// A world took over whose effects.auto was decided for wounds by command as narrow as this.
struct Switched {
  double narrowest_wound = 0.0;  ///< m; infinite: none
  bool by_request = false;       ///< with the effect of the request that is the next entry
};

/// `step` steps were done when the input took effect.
struct JournalEntry {
  std::uint32_t epoch = 0;
  std::uint64_t number = 0;
  std::uint64_t step = 0;
  double sim_time = 0.0;  ///< s
  std::variant<Decision, RequestTaken, InstrumentTaken, InstrumentEnded, Restored, Switched> input;
};

}  // namespace bleedsim::dds
