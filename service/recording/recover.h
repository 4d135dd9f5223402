// Makes a complete recording of one that was cut off or damaged.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "service/recording/summary.h"
#include "service/status/status.h"

namespace bleedsim::recording {

/// Called after each chunk with the number done and in all; false gives up.
using RecoverProgress = std::function<bool(std::size_t done, std::size_t total)>;

struct RecoverReport {
  RecordingSummary summary;          ///< of the new file
  std::uint64_t chunks = 0;          ///< kept
  std::uint64_t damaged_chunks = 0;  ///< left out
  std::string reason;                ///< where and why the old file ends early; empty when it has its index
};

/// Copies every message of every complete chunk of `from` into `to`, with index and summary, and notes there where they come
/// from. `to` is replaced once all is written, `from` stays as it is. Memory: one chunk and the index. Errors: io, not_found,
/// unsupported as RecordingReader::open(); data_loss: there is no complete chunk; invalid_argument: `to` is `from`, or no file;
/// wrong_state: given up, `to` is as it was.
Result<RecoverReport> recover(const std::filesystem::path& from, const std::filesystem::path& to,
                              const RecoverProgress& progress = {});

/// There is something to recover in a file: chunks can be found, though perhaps none of them is whole.
bool isRecoverable(const std::filesystem::path& from);

}  // namespace bleedsim::recording
