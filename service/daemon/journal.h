// The inputs as applied, numbered, on their way from the simulation thread to the publisher.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "service/daemon/bounded_queue.h"
#include "service/dds/journal_entry.h"

namespace bleedsim::daemon {

/// One writer thread, one reader thread. An entry that finds no room still uses up its number, so that readers see the gap.
class Journal {
 public:
  static constexpr std::size_t kCapacity = 8192;

  explicit Journal(std::size_t capacity = kCapacity) : entries_{capacity} {}

  /// Numbers start again at 1.
  void beginEpoch(std::uint32_t epoch) {
    epoch_ = epoch;
    next_number_ = 1;
  }

  /// False: no room, the number is lost.
  template <class Applied>
  bool append(std::uint64_t step, double sim_time, Applied&& input) {
    dds::JournalEntry entry{epoch_, next_number_++, step, sim_time, std::forward<Applied>(input)};
    return entries_.tryPush(std::move(entry));
  }

  /// Entries of the epoch so far; for the writer.
  std::uint64_t lastNumber() const { return next_number_ - 1; }

  bool tryPop(dds::JournalEntry& out) { return entries_.tryPop(out); }
  bool empty() const { return entries_.empty(); }

 private:
  BoundedQueue<dds::JournalEntry> entries_;
  std::uint32_t epoch_ = 0;
  std::uint64_t next_number_ = 1;
};

}  // namespace bleedsim::daemon
