// Simulated time against wall time. A pure calculation: the caller tells the time and does the waiting.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "service/daemon/wakeup.h"
#include "service/dds/request.h"

namespace bleedsim::daemon {

/// Time is never dropped: what the solver is late stays owed and is caught up with as fast as it can, also over a change from
/// one factor to another. Pauses stop the clock; steps done in a pause are left out of all figures.
class Pacer {
 public:
  Pacer(dds::Pace pace, TimePoint now) : pace_{pace}, wall_start_{now} {}

  /// A new world starts at that simulated time, owing nothing.
  void restart(TimePoint now, double sim_time = 0.0);
  void setPace(dds::Pace pace, TimePoint now, double sim_time);
  void pause(TimePoint now, double sim_time);
  void resume(TimePoint now, double sim_time);

  const dds::Pace& pace() const { return pace_; }
  bool paused() const { return pause_.has_value(); }

  /// Wall seconds until the state at `sim_time` is due; negative when it is late, 0 at maximum pace.
  double secondsAhead(TimePoint now, double sim_time) const;
  /// Wall seconds that the state at `sim_time` is late, 0 when on time.
  double behind(TimePoint now, double sim_time) const;
  /// Simulated over wall seconds of the last second of wall time or little more: of all the time since the last change of pace or
  /// restart where that is less, 0 before any has passed. To be asked after every step.
  double realTimeFactor(TimePoint now, double sim_time);

 private:
  struct Pause {
    TimePoint wall;
    double sim_time;
  };
  /// Wall and simulated s since the last change of pace or restart.
  struct Mark {
    double wall = 0.0;
    double sim = 0.0;
  };
  static constexpr double kWindowSeconds = 1.0;
  static constexpr double kMarkSeconds = 0.1;
  static constexpr std::size_t kMarks = 12;  // those within the window and the one before it
  void forgetMarks();
  double wallElapsed(TimePoint now) const;
  double simElapsed(double sim_time) const;

  dds::Pace pace_;
  TimePoint wall_start_;
  double sim_start_ = 0.0;
  double owed_ = 0.0;  // simulated s, brought over from the pace before
  std::optional<Pause> pause_;
  std::array<Mark, kMarks> marks_{};  // a ring, at least kMarkSeconds apart
  std::size_t oldest_mark_ = 0;
  std::size_t mark_count_ = 1;
};

}  // namespace bleedsim::daemon
