// What the service counts about its inputs and outputs. Rising only, readable from any thread.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "service/dds/session_report.h"

namespace bleedsim::daemon {

enum class ServiceCounter {
  requests,               ///< samples on the request topic
  requests_refused,       ///< answered with anything but accepted
  requests_resent,        ///< known requests that came again
  requests_busy,          ///< refused because the command queue was full
  requests_stale,         ///< older than the replies that are kept
  requests_missed,        ///< numbers left out in a client's requests: lost on the way, they are usually sent again
  instrument_samples,     ///< samples on the instrument topic
  instruments_malformed,  ///< with a value out of range
  instruments_dropped,    ///< too many tools, the command queue full, or not newer than the one before
  instruments_refused,    ///< refused by the world: out of its domain, without the applied-force effect, in a scene being loaded
  instruments_missed,     ///< numbers left out in a tool's stream: lost on the way, or dropped here
  instruments_ended,      ///< silent, refused after they had pushed, or lost
  journal_lost,           ///< inputs that the journal had no room for
  replies_lost,           ///< replies that found no room; the client asks again
  write_failures,         ///< samples that the middleware did not take
  checkpoints_written,
  checkpoints_failed,  ///< for want of room on the disk or in memory
  count
};

inline constexpr std::array<std::string_view, static_cast<std::size_t>(ServiceCounter::count)> kServiceCounterNames{
    "requests",
    "requests_refused",
    "requests_resent",
    "requests_busy",
    "requests_stale",
    "requests_missed",
    "instrument_samples",
    "instruments_malformed",
    "instruments_dropped",
    "instruments_refused",
    "instruments_missed",
    "instruments_ended",
    "journal_lost",
    "replies_lost",
    "write_failures",
    "checkpoints_written",
    "checkpoints_failed"};

class ServiceCounters {
 public:
  void add(ServiceCounter counter, std::uint64_t count = 1) { slot(counter).fetch_add(count, std::memory_order_relaxed); }
  std::uint64_t value(ServiceCounter counter) const {
    return values_[static_cast<std::size_t>(counter)].load(std::memory_order_relaxed);
  }

  using All = std::array<dds::NamedCount, static_cast<std::size_t>(ServiceCounter::count)>;
  All all() const {
    All out;
    for (std::size_t i = 0; i < out.size(); ++i) {
      out[i] = {kServiceCounterNames[i], values_[i].load(std::memory_order_relaxed)};
    }
    return out;
  }

 private:
  std::atomic<std::uint64_t>& slot(ServiceCounter counter) { return values_[static_cast<std::size_t>(counter)]; }

  std::array<std::atomic<std::uint64_t>, static_cast<std::size_t>(ServiceCounter::count)> values_{};
};

}  // namespace bleedsim::daemon
