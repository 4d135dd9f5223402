// Gathers a recording's figures from its messages.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "service/recording/quantize.h"
#include "service/recording/recording_metadata.h"
#include "service/recording/recording_reader.h"
#include "service/recording/seq_tracker.h"
#include "service/recording/summary.h"

namespace bleedsim::recording {

class SummaryCollector {
 public:
  /// Told of each message in the file's order. data_loss: it does not parse.
  ::bleedsim::Status add(const RecordedMessage& message);
  /// All but what concerns the file itself. Called once.
  RecordingSummary finish(const WriterKnowledge& knowledge);

 private:
  using Epoch = std::pair<SessionKey, std::uint32_t>;
  struct FrameSpan {
    std::uint64_t first_seq = 0;
    std::uint64_t last_seq = 0;
    double first_s = 0.0;
    double last_s = 0.0;
  };
  struct LedgerPoint {
    std::uint64_t seq = 0;
    double emitted_ml = 0.0;
  };

  ::bleedsim::Status addFrame(const RecordedMessage& message);
  ::bleedsim::Status addStats(const RecordedMessage& message);
  ::bleedsim::Status addScene(const RecordedMessage& message);
  ::bleedsim::Status addJournal(const RecordedMessage& message);
  void addLedgers();
  void apply(const WriterKnowledge& knowledge);

  RecordingSummary out_;
  FrameTracker frames_;
  ReplayCheck replay_;
  MaxErrors errors_;
  std::map<Epoch, FrameSpan> spans_;
  std::vector<std::pair<Epoch, LedgerPoint>> ledger_;
  Epoch last_epoch_;
  double real_time_factors_ = 0.0;
  std::uint64_t first_time_ns_ = 0;
  std::uint64_t last_time_ns_ = 0;
  Frame frame_;
  FrameStats stats_;
};

}  // namespace bleedsim::recording
