// The simulation thread's work: inputs, steps, frames. Owns the world. It never calls the middleware or the logger.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "service/checkpoint/checkpoint.h"
#include "service/daemon/channels.h"
#include "service/daemon/frame_clock.h"
#include "service/daemon/instrument_table.h"
#include "service/daemon/lease.h"
#include "service/daemon/pacer.h"
#include "service/daemon/scene_loader.h"
#include "service/daemon/wound_commands.h"
#include "service/daemon/wound_names.h"

namespace bleedsim::daemon {

class CheckpointKeeper;

struct SimulationOptions {
  dds::Pace pace;
  std::optional<double> frame_rate;    ///< frames per simulated second, instead of the scenes'
  std::optional<double> duration;      ///< simulated s at which the session ends, those before a resume included
  CheckpointKeeper* keeper = nullptr;  ///< null: no checkpoints
  /// Simulated s between checkpoints that the service takes by itself, at the first state at or after each multiple of it, the
  /// first of an epoch included.
  std::optional<double> checkpoint_every = {};
};

class Simulation {
 public:
  Simulation(const SimulationOptions& options, LoadedScene first, SceneFactory factory, Channels& channels, TimePoint now);

  /// What to do after a tick: go on at once, wait for input (at most until `until`), or end.
  struct Next {
    enum class Kind { again, wait, stop } kind = Kind::again;
    std::optional<TimePoint> until;
  };

  /// Takes all inputs, then does at most one step. Never waits.
  Next tick(TimePoint now);

  /// tick() until it says stop or requestStop() was called, waiting in between.
  void run();
  /// From any thread.
  void requestStop();

  dds::SessionState state() const;

  std::uint32_t epoch() const { return epoch_; }
  const sph::World& world() const { return *world_; }

 private:
  struct PendingLoad {
    dds::DecodedRequest request;
    bool reset = false;
    bool stay_paused = false;  // the new world waits as the old one did
    bool was_faulted = false;
    std::string checkpoint{};  // that was restored
  };

  /// Another world is built beside the one that runs: for a request, or without one for wounds that wait.
  struct PendingSwitch {
    std::optional<dds::DecodedRequest> request;
    double narrowest_wound = 0.0;  // m, that it is decided for
  };
  struct WaitingWound {
    dds::DecodedRequest request;
    WoundCommand wound;
  };

  // simulation.cpp
  void install(LoadedScene loaded, TimePoint now);
  void finishLoading(TimePoint now);
  bool durationOver() const;
  void advance(TimePoint now);
  void publishFrame(TimePoint now);
  void postScene();
  void showState();
  Next end();
  void fault(const std::string& reason, TimePoint now);
  std::optional<TimePoint> nextExpiry() const;
  Clock::duration instrumentExpiry() const;

  // simulation_requests.cpp
  /// True: more wait than one step may take.
  bool drainInputs(TimePoint now);
  void loseWriter(std::uint64_t writer, TimePoint now);
  void carryOut(dds::DecodedRequest& request, TimePoint now);
  Result<sph::Applied> perform(dds::DecodedRequest& request, TimePoint now);
  Result<sph::Applied> applyToWorld(const sph::Command& command);
  Result<sph::Applied> applyToNamed(sph::Command command, const std::string& wound_name);
  Status nameWound(sph::Command& command, const std::string& wound_name) const;
  void noteWoundName(const sph::Command& command, std::uint32_t id);
  Status startLoading(SceneJob job, bool reset, TimePoint now);
  Result<sph::Applied> setOutput(const dds::SetOutput& output);
  void settle(dds::DecodedRequest& request, const Result<sph::Applied>& done);
  dds::Reply replyTo(const dds::DecodedRequest& request, const Status& status, std::uint32_t object_id) const;
  void answer(const dds::DecodedRequest& request, const Status& status, std::uint32_t object_id);
  void answerLoad(PendingLoad& load, const Status& status);
  void send(dds::Reply reply);
  template <class Applied>
  void record(Applied&& input) {
    if (!channels_.journal.append(world_->stepCount(), world_->time(), std::forward<Applied>(input))) {
      channels_.counters.add(ServiceCounter::journal_lost);
    }
    channels_.publisher.notify();
  }

  // simulation_effects.cpp
  Status switchingNow() const;
  Status startSwitching(const dds::SetEffect& set);
  void finishSwitching();
  Status takeOver(LoadedScene& next);
  void recordNewNotes(const std::vector<std::string>& before);
  std::uint32_t availableAttributes() const;
  bool acts(std::string_view effect) const;
  std::vector<std::string> notes() const;

  // simulation_checkpoints.cpp
  Status wantCheckpoint() const;
  Status startRestoring(const std::string& name, TimePoint now);
  void takeCheckpoint();
  void finishCheckpoint();
  checkpoint::SessionMark sessionMark() const;
  void goOnFrom(const checkpoint::Head& head, TimePoint now);

  // simulation_wounds.cpp
  bool callsForTension(double width) const;
  bool anyCallsForTension() const;
  bool holdWound(dds::DecodedRequest& request);
  void decideForWounds();
  void releaseWounds(const Status& switched);

  // simulation_lease.cpp
  Result<sph::Applied> acquireLease(const dds::DecodedRequest& request, TimePoint now);
  Result<sph::Applied> releaseLease(const dds::DecodedRequest& request, TimePoint now);
  Status leasedToOther(TimePoint now) const;

  // simulation_instruments.cpp
  void takeSample(const InstrumentInput& input, TimePoint now);
  void rejectSample(const dds::InstrumentSample& sample, ServiceCounter why);
  void applyInstruments();
  void endSilentInstruments(TimePoint now);
  void endInstrumentsOf(std::uint64_t writer);
  void endInstrument(std::size_t index, dds::InstrumentEndReason reason);

  SimulationOptions options_;
  Channels& channels_;
  SceneLoader loader_;
  std::unique_ptr<sph::World> world_;
  std::shared_ptr<const scene::SceneDescription> scene_;         // as it acts now
  std::shared_ptr<const scene::SceneDescription> loaded_scene_;  // as the epoch began with it
  std::uint32_t epoch_ = 0;
  std::uint32_t attributes_ = 0;
  Pacer pacer_;
  FrameClock frame_clock_;
  InstrumentTable instruments_;
  Lease lease_;
  WoundNames wound_names_;
  sph::ForceKey next_force_key_ = 1;
  std::uint32_t steps_left_ = 0;  // of a step request, in a pause
  std::uint32_t steps_in_frame_ = 0;
  std::array<double, static_cast<std::size_t>(sph::Stage::count)> stage_seconds_at_frame_{};
  std::optional<PendingLoad> pending_load_;
  std::optional<PendingSwitch> pending_switch_;                       // at most one of the two: there is one loader
  std::vector<WaitingWound> waiting_wounds_;                          // in order, until surface tension is there
  double narrowest_wound_ = std::numeric_limits<double>::infinity();  // m, of all that came by command in this epoch
  std::optional<FrameClock> checkpoint_clock_;                        // of checkpoint_every
  bool checkpoint_due_ = false;                                       // by the clock
  std::optional<dds::DecodedRequest> asked_checkpoint_;               // answered when it is written
  bool saving_ = false;                                               // the keeper has a state
  bool saving_for_request_ = false;
  std::uint64_t saved_step_ = 0;  // of that state
  double saved_time_ = 0.0;       // s
  bool faulted_ = false;
  std::string fault_text_;
  bool ended_ = false;
  std::atomic<bool> stop_requested_{false};
  Input input_;  // reused by drainInputs()
};

}  // namespace bleedsim::daemon
