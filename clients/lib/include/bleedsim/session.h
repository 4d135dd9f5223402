// One running session: its frames, figures, state and commands. Made by Client::open.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bleedsim/commands.h"
#include "bleedsim/frame.h"
#include "bleedsim/instrument.h"
#include "bleedsim/types.h"

namespace bleedsim::client {

enum class Delivery {
  newest,  ///< a new frame replaces one that was not taken; best effort: a slow reader costs nobody anything
  queue,   ///< up to queue_length frames wait, the oldest goes first; reliable, losses on the way are repaired
  none,    ///< no frames: commands and state only
};

using FramePointer = std::shared_ptr<const Frame>;

/// Whether the session is heard of. The library reconnects by itself, to the daemon that was lost as to another one of the same
/// name: frames go on, numbers that were missed count as gaps of the former, commands and instruments reach it again. A command
/// whose time runs out meanwhile gets ReplyCode::no_answer.
struct ConnectionState {
  bool connected = true;
  std::uint64_t losses = 0;        ///< how often it was lost or ended
  std::uint64_t replacements = 0;  ///< how often another daemon has taken the name; the clock offset starts anew then
};

struct SessionOptions {
  Delivery delivery = Delivery::newest;
  std::size_t queue_length = 64;                                ///< of Delivery::queue, 1 to 256
  std::function<void(const FramePointer&)> on_frame{};          ///< called on the session's thread instead of keeping the frame
  std::function<void(const FrameStats&)> on_stats{};            ///< called on the session's thread
  std::function<void(const ConnectionState&)> on_connection{};  ///< called on the session's thread when it changes
  std::chrono::milliseconds command_timeout{5000};              ///< until a command's future gets ReplyCode::no_answer
};

/// Move-only; all methods may be called from any thread. Closing it answers every open command with ReplyCode::no_answer.
class Session {
 public:
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;
  ~Session();

  const std::string& name() const;

  // ---- what comes from the session
  /// The next frame, or null when there is none yet.
  FramePointer tryTakeFrame();
  /// timed_out: no frame within the time.
  Result<FramePointer> waitFrame(std::chrono::nanoseconds timeout);
  FrameCounters frameCounters() const;
  std::optional<FrameStats> stats() const;
  std::optional<SessionStatus> status() const;
  std::optional<SceneInfo> scene() const;
  /// Waits until the status fulfils the condition; timed_out tells the last state.
  Result<SessionStatus> waitStatus(const std::function<bool(const SessionStatus&)>& condition, std::chrono::nanoseconds timeout);
  /// Waits for the scene, which a running session sends at once.
  Result<SceneInfo> waitScene(std::chrono::nanoseconds timeout);
  /// False once the session has stopped or was not heard of for 2 to 3 s; true again when it comes back.
  bool alive() const;
  ConnectionState connection() const;
  /// Waits until alive() is true; false: it is still gone.
  bool waitAlive(std::chrono::nanoseconds timeout);
  /// Waits until alive() is false; false: it still lives.
  bool waitGone(std::chrono::nanoseconds timeout);

  // ---- commands. Each is sent again until it is answered; the session acts on it once.
  std::future<Reply> addWound(const WoundSpec& wound);
  std::future<Reply> updateWound(std::uint32_t wound_id, const WoundChange& change);
  std::future<Reply> moveWound(std::uint32_t wound_id, const Vec3& position, const std::optional<Vec3>& normal = std::nullopt);
  std::future<Reply> removeWound(std::uint32_t wound_id);
  /// The same for the wound that was opened with this name, by whichever client. For services since protocol 1.2.
  std::future<Reply> updateWound(const std::string& name, const WoundChange& change);
  std::future<Reply> removeWound(const std::string& name);
  std::future<Reply> force(const ForceSpec& force);
  std::future<Reply> pause();
  std::future<Reply> resume();
  std::future<Reply> reset();
  std::future<Reply> step(std::uint32_t count);
  std::future<Reply> pace(const Pace& pace);
  std::future<Reply> output(const OutputSpec& output);
  std::future<Reply> loadScene(const std::string& text);
  /// Switches an effect of the running scene, e.g. "surface_tension". `settings` is protobuf text of its message in
  /// idl/scene.proto; empty: the settings it had when it was last on, or its defaults. The answer comes when it acts.
  std::future<Reply> setEffect(const std::string& name, bool enabled, const std::string& settings = {});
  /// Keeps the state as it is now under this name, on the disk of the service; in place of one that has the name. Empty: the
  /// service gives a name, Reply::object_name, and keeps the last three of these. The answer comes when it is written. For
  /// services since protocol 1.3 that were started with --checkpoint-every or --checkpoint-dir.
  std::future<Reply> checkpoint(const std::string& name = {});
  /// Returns to a checkpoint, to the newest one without a name: a new epoch goes on from there. See SessionStatus::checkpoints.
  std::future<Reply> restore(const std::string& name = {});
  std::future<Reply> shutdown();
  /// Makes this session object the only one that may command, for `length` of wall time (1 to 300 s): the commands of others get
  /// ReplyCode::leased and their instruments are not used. Acquire it again to keep it. It ends with this object, too. For
  /// services since protocol 1.2.
  std::future<Reply> acquireLease(std::chrono::milliseconds length);
  std::future<Reply> releaseLease();
  /// By which this object is known to the service: see SessionStatus::clients and lease_client.
  const Uuid& clientId() const;

  /// One round trip, which also improves clockOffset(). timed_out: no answer.
  Result<std::chrono::nanoseconds> ping(std::chrono::nanoseconds timeout);
  /// Nothing before the first ping.
  std::optional<ClockOffset> clockOffset() const;

  /// A stream for one tool; the name (at most 32 bytes) follows CRTK, e.g. "PSM1". Waits for the service for up to 2 s.
  Result<InstrumentStream> instrument(std::uint32_t tool, const std::string& name);

 private:
  friend class Client;
  class Impl;
  explicit Session(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace bleedsim::client
