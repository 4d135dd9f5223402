// What the publisher shows of the simulation: written by the simulation thread, read by the publisher and the intake.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>

#include "service/dds/session_report.h"

namespace bleedsim::daemon {

class StatusBoard {
 public:
  /// What moves with every step. Not a change that is worth a status of its own.
  void progress(std::uint64_t step, double sim_time, std::uint32_t particles, double real_time_factor, double behind) {
    const std::lock_guard lock{mutex_};
    report_.step = step;
    report_.sim_time = sim_time;
    report_.particles = particles;
    report_.real_time_factor = real_time_factor;
    report_.behind = behind;
  }

  /// The solver's counters at a frame.
  void countFaults(const decltype(dds::StatusReport::faults)& faults) {
    const std::lock_guard lock{mutex_};
    report_.faults = faults;
  }

  /// A change of state, pace, rate, ...: `edit(StatusReport&)`. The publisher must be woken by the caller.
  template <class Edit>
  void change(Edit&& edit) {
    const std::lock_guard lock{mutex_};
    edit(report_);
    ++revision_;
  }

  void postScene(std::shared_ptr<const dds::SceneReport> scene) {
    const std::lock_guard lock{mutex_};
    scene_ = std::move(scene);
  }
  /// The scene that was posted since the last call, or null.
  std::shared_ptr<const dds::SceneReport> takeScene() {
    const std::lock_guard lock{mutex_};
    return std::exchange(scene_, nullptr);
  }

  struct Reading {
    dds::StatusReport report;
    std::uint64_t revision = 0;  ///< rises with each change()
  };
  Reading read() const {
    const std::lock_guard lock{mutex_};
    return {report_, revision_};
  }

 private:
  mutable std::mutex mutex_;
  dds::StatusReport report_;
  std::uint64_t revision_ = 1;
  std::shared_ptr<const dds::SceneReport> scene_;
};

}  // namespace bleedsim::daemon
