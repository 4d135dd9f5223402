// A service made of transport alone: publishes what a test says and answers requests as it is told. The client is tested against
// it without a solver, and with losses that a real service would not show.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "service/transport/clock.h"
#include "service/transport/reader.h"
#include "service/transport/uuid.h"
#include "service/transport/wait_set.h"
#include "service/transport/writer.h"

namespace bleedsim::client_test {

class FakeService {
 public:
  /// Told of each request, the first and the repeated ones; false leaves it unanswered.
  using Judge = std::function<bool(const bleed_v1_Request&, bleed_v1_Reply&)>;

  static Result<std::unique_ptr<FakeService>> start(const transport::Participant& participant, const std::string& name,
                                                    Judge judge = {});
  ~FakeService();

  /// Put into every status and statistics published after.
  struct Figures {
    double real_time_factor = 1.0;
    double behind_s = 0.0;
    std::vector<std::pair<std::string, std::uint64_t>> counters{};
  };
  Figures figures;
  std::uint32_t capacity = 0;                              ///< put into every scene published after
  std::int64_t start_stamp_ns = transport::realtimeNow();  ///< put into every status published after
  std::uint64_t step = 0;  ///< put into every status published after; that of the last frame, unless a test sets it

  void publishStatus(std::uint32_t state = bleed_v1_STATE_RUNNING, const std::string& text = {});
  void publishScene(const std::string& scene_name);
  /// One frame of `count` particles at sim_time_s = seq / 60, and its stats with 0.5 mL for each frame.
  Status publishFrame(std::uint64_t seq, std::uint32_t count = 3);
  /// A frame whose stats are lost on their way, or come later.
  Status publishBareFrame(std::uint64_t seq, std::uint32_t count = 3);
  /// The stats of a frame that is lost on its way, or comes later.
  Status publishStats(std::uint64_t seq, std::uint32_t count = 3);
  /// An input that acted at this step, by its number in the journal.
  Status publishJournal(std::uint64_t number, std::uint64_t at_step);
  /// A frame whose payload is one byte short.
  Status publishMalformedFrame(std::uint64_t seq);

  /// Blocks until so many requests (repeats included) or instrument samples have come; false after 20 s.
  bool waitRequests(std::size_t count);
  bool waitInstruments(std::size_t count);
  std::vector<std::uint64_t> requestSeqs();
  std::vector<bleed_v1_Instrument> instruments();
  /// Blocks until so many readers take frames; false after 20 s.
  bool waitFrameReaders(std::size_t count);
  /// Blocks until no reader takes frames any more: the next one is not taken for one that has just ended. False after 20 s.
  bool waitNoFrameReaders();

  const transport::Uuid session = transport::drawUuid();

 private:
  struct Endpoints;
  FakeService(std::string name, Judge judge, std::unique_ptr<Endpoints> endpoints);
  void serve();

  std::string name_;
  Judge judge_;
  std::unique_ptr<Endpoints> endpoints_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::uint64_t> request_seqs_;
  std::vector<bleed_v1_Instrument> instruments_;
  std::size_t frame_readers_ = 0;
  std::uint64_t heartbeat_ = 0;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace bleedsim::client_test
