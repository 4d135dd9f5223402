// The inside of a Session: its readers, its request writer and the one thread that serves them.
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "bleedsim/session.h"
#include "clients/lib/clock_estimator.h"
#include "clients/lib/frame_box.h"
#include "clients/lib/gap_counter.h"
#include "clients/lib/request_tracker.h"
#include "service/transport/reader.h"
#include "service/transport/wait_set.h"
#include "service/transport/writer.h"

namespace bleedsim::client {

class Session::Impl {
 public:
  /// Makes the endpoints and starts the thread.
  static Result<std::unique_ptr<Impl>> open(const transport::Participant& participant, const std::string& name,
                                            const SessionOptions& options);
  ~Impl();

  /// Waits until the session reads our requests and we its replies and status.
  Status waitMatched(std::chrono::nanoseconds timeout);

  /// Numbers, sends and tracks a request.
  std::future<Reply> submit(const RequestPointer& request);
  std::future<Reply> submit(Result<RequestPointer> request);
  std::future<Reply> submit(const RequestPointer& request, std::chrono::nanoseconds timeout);

  const std::string name;
  const SessionOptions options;
  const transport::Participant participant;
  const Uuid client;

  mutable std::mutex mutex;  // covers everything below it
  std::condition_variable changed;
  FrameBox frames;
  FrameCounters counters;
  GapCounter gaps;
  std::optional<FrameStats> stats;
  std::optional<SessionStatus> status;
  std::optional<SceneInfo> scene;
  bool alive = true;
  ConnectionState connection;  // as it was told last
  bool matched = false;
  bool heard = true;  // a status has come since the session was lost
  ClockEstimator clock;
  bool had_offset = false;  // somebody wants the clock offset

 private:
  struct Endpoints;

  Impl(const transport::Participant& with, const std::string& session, const SessionOptions& chosen,
       std::unique_ptr<Endpoints> endpoints);
  void serve();
  void takeReplies();
  void takeState();
  void takeFrames();
  void takeStats();
  void watchPeers();
  void tellConnection();
  /// Sends what is due and ends what is late; needs request_mutex_.
  void sendDue();

  std::unique_ptr<Endpoints> endpoints_;
  bool replaced_ = false;     // since tellConnection(); of the thread
  std::mutex request_mutex_;  // covers tracker_ and the request writer
  RequestTracker tracker_;
  std::atomic<bool> stopping_ = false;
  std::thread thread_;
};

}  // namespace bleedsim::client
