#include "service/daemon/checkpoint_keeper.h"

#include <algorithm>
#include <exception>
#include <spdlog/spdlog.h>
#include <utility>

#include "service/status/checkpoint_name.h"
#include "service/transport/clock.h"

namespace bleedsim::daemon {

CheckpointKeeper::CheckpointKeeper(std::shared_ptr<checkpoint::Folder> folder, CheckpointOrigin origin, StatusBoard& board,
                                   Wakeup& done, Wakeup& shown)
    : folder_{std::move(folder)}, origin_{std::move(origin)}, board_{board}, done_{done}, shown_{shown} {
  showList();
  thread_ = std::thread{[this] { run(); }};
}

CheckpointKeeper::~CheckpointKeeper() {
  {
    const std::lock_guard lock{mutex_};
    stopping_ = true;
  }
  bell_.notify_one();
  thread_.join();
}

std::span<std::byte> CheckpointKeeper::room(std::size_t bytes) {
  {
    const std::lock_guard lock{mutex_};
    if (turn_ != Turn::simulation) return {};
    if (room_.size() >= bytes) return room_;
    wanted_ = bytes;
    turn_ = Turn::grow;
  }
  bell_.notify_one();
  return {};
}

void CheckpointKeeper::submit(CheckpointJob job) {
  {
    const std::lock_guard lock{mutex_};
    job_ = std::move(job);
    turn_ = Turn::write;
  }
  bell_.notify_one();
}

std::optional<CheckpointOutcome> CheckpointKeeper::takeOutcome() {
  const std::lock_guard lock{mutex_};
  if (turn_ != Turn::outcome) return std::nullopt;
  turn_ = Turn::simulation;
  return std::move(outcome_);
}

void CheckpointKeeper::run() {
  for (;;) {
    Turn turn = Turn::simulation;
    {
      std::unique_lock lock{mutex_};
      bell_.wait(lock, [this] { return stopping_ || turn_ == Turn::grow || turn_ == Turn::write; });
      turn = turn_;
      if (turn != Turn::grow && turn != Turn::write) return;
    }
    if (turn == Turn::grow) grow();
    if (turn == Turn::write) write();
    done_.notify();
  }
}

/// With some more than is asked for: a session that bleeds soon asks for more.
void CheckpointKeeper::grow() {
  bool failed = false;
  try {
    std::vector<std::byte>().swap(room_);
    room_.resize(wanted_ + wanted_ / 4);
  } catch (const std::exception&) { failed = true; }
  const std::lock_guard lock{mutex_};
  if (failed) outcome_ = {{StatusCode::capacity, "there is no memory for a copy of the state"}, {}};
  turn_ = failed ? Turn::outcome : Turn::simulation;
}

void CheckpointKeeper::write() {
  checkpoint::Head head;
  head.name = job_.name;
  head.realtime_stamp_ns = transport::realtimeNow();
  head.build_id = origin_.build_id;
  head.session_name = origin_.session_name;
  head.session = origin_.session;
  head.simd_target = job_.simd_target;
  head.precision = "float32";
  head.seed = job_.scene->world.seed;
  head.scene_text = job_.scene->normalized_text;
  head.loaded_text = job_.loaded->normalized_text;
  head.former_settings = job_.scene->former_settings;
  head.decided_for_wound = job_.scene->narrowest_wound;
  head.mark = job_.mark;
  Status written;
  try {
    written = folder_->write(head, std::span{room_}.first(job_.bytes));
  } catch (const std::exception& failure) { written = {StatusCode::internal, failure.what()}; }
  if (written) {
    // Those of the clock would fill the log.
    const auto level = isAutomaticCheckpoint(head.name) ? spdlog::level::debug : spdlog::level::info;
    spdlog::log(level, "checkpoint '{}' at step {}, {:.3f} s", head.name, head.mark.step, head.mark.sim_time);
    showList();
  } else {
    spdlog::error("no checkpoint at step {}: {}", head.mark.step, written.message());
  }
  job_ = {};
  const std::lock_guard lock{mutex_};
  outcome_ = {std::move(written), head.name};
  turn_ = Turn::outcome;
}

void CheckpointKeeper::showList() {
  std::vector<dds::CheckpointInfo> infos;
  for (const checkpoint::Entry& entry : folder_->list()) {
    if (!entry.readable) continue;
    const checkpoint::SessionMark& mark = entry.head.mark;
    infos.push_back({entry.name, mark.epoch, mark.step, mark.sim_time, entry.bytes, entry.head.realtime_stamp_ns,
                     entry.head.session == origin_.session});
  }
  board_.change([&infos](dds::StatusReport& report) { report.checkpoints = std::move(infos); });
  shown_.notify();
}

}  // namespace bleedsim::daemon
