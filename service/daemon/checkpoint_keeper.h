// Brings checkpoints to the disk on a thread of its own: the simulation thread only copies its state into room that is there.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "service/checkpoint/folder.h"
#include "service/daemon/status_board.h"
#include "service/daemon/wakeup.h"
#include "service/scene/scene.h"

namespace bleedsim::daemon {

/// What a checkpoint says of where it comes from.
struct CheckpointOrigin {
  std::string build_id;
  std::string session_name;
  checkpoint::Uuid session{};
};

/// A state that was copied into the keeper's room. Handing it over allocates nothing.
struct CheckpointJob {
  std::string name;  ///< empty: an automatic one
  std::size_t bytes = 0;
  std::string_view simd_target;
  std::shared_ptr<const scene::SceneDescription> scene;   ///< as it acts
  std::shared_ptr<const scene::SceneDescription> loaded;  ///< as the epoch began with it
  checkpoint::SessionMark mark;
};

struct CheckpointOutcome {
  Status status;
  std::string name;
};

/// One checkpoint at a time. room(), submit() and takeOutcome() are for the simulation thread.
class CheckpointKeeper {
 public:
  /// `done` is notified when room was made or a checkpoint was written, `board` shows the list and `shown` is then notified.
  CheckpointKeeper(std::shared_ptr<checkpoint::Folder> folder, CheckpointOrigin origin, StatusBoard& board, Wakeup& done,
                   Wakeup& shown);
  /// What was handed over is written before.
  ~CheckpointKeeper();
  CheckpointKeeper(const CheckpointKeeper&) = delete;
  CheckpointKeeper& operator=(const CheckpointKeeper&) = delete;

  /// Room for a state of so many bytes; empty while there is none: it is then being made, or the checkpoint before is being
  /// written.
  std::span<std::byte> room(std::size_t bytes);
  /// After room() was filled.
  void submit(CheckpointJob job);
  /// Of the checkpoint that was submitted last, once it is written or has failed.
  std::optional<CheckpointOutcome> takeOutcome();

 private:
  enum class Turn { simulation, grow, write, outcome };  // who acts next

  void run();
  void grow();
  void write();
  void showList();

  std::shared_ptr<checkpoint::Folder> folder_;
  CheckpointOrigin origin_;
  StatusBoard& board_;
  Wakeup& done_;
  Wakeup& shown_;
  std::vector<std::byte> room_;  // of whoever has the turn
  CheckpointJob job_;
  CheckpointOutcome outcome_;
  std::mutex mutex_;
  std::condition_variable bell_;
  Turn turn_ = Turn::simulation;  // guarded, like all below
  std::size_t wanted_ = 0;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace bleedsim::daemon
