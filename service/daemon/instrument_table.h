// The tools that push on the fluid: the newest sample of each, and when it ends.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "service/checkpoint/checkpoint.h"
#include "service/daemon/command_queue.h"
#include "service/dds/frame_snapshot.h"
#include "service/dds/journal_entry.h"

namespace bleedsim::daemon {

struct Tool {
  dds::InstrumentSample sample;
  TimePoint received;
  sph::ForceKey force_key = 0;
  bool pending = true;                            ///< the newest sample was not applied yet
  std::optional<dds::InstrumentApplied> applied;  ///< the newest sample that was
};

/// At most dds::kMaxInstruments tools. A client may have as many as there are free places, so that one alone has half of them and
/// there is always a place for a client without any. Belongs to the simulation thread; allocates nothing after construction.
class InstrumentTable {
 public:
  InstrumentTable();

  enum class Update { taken, full, not_newer };
  /// `missed` is raised by the numbers that the tool's stream left out.
  Update update(const InstrumentInput& input, std::uint64_t& missed);

  std::span<Tool> tools() { return tools_; }
  std::span<const Tool> tools() const { return tools_; }
  void remove(std::size_t index);
  void clear() { tools_.clear(); }

  /// The tools that push, for a checkpoint.
  void mark(checkpoint::SessionMark& mark) const;
  /// Those tools and no others: they push as they did until they are silent for too long from `now` on, whoever holds them next.
  void restore(const checkpoint::SessionMark& mark, TimePoint now);

  /// When the first tool falls silent for longer than `expiry`; nothing without tools.
  std::optional<TimePoint> nextExpiry(Clock::duration expiry) const;

  /// The newest sample of each client that a step up to `step` has used. Returns how many were written.
  std::size_t report(std::span<dds::InstrumentApplied> out, std::uint64_t step) const;

 private:
  std::vector<Tool> tools_;
  sph::ForceKey next_key_;
};

}  // namespace bleedsim::daemon
