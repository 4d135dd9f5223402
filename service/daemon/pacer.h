// Simulated time against wall time. A pure calculation: the caller tells the time and does the waiting.
#pragma once

#include <optional>

#include "service/daemon/wakeup.h"
#include "service/dds/request.h"

namespace bleedsim::daemon {

/// Time is never dropped: what the solver is late stays owed and is caught up with as fast as it can, also over a change from
/// one factor to another. Pauses stop the clock; steps done in a pause are left out of all figures.
class Pacer {
 public:
  Pacer(dds::Pace pace, TimePoint now) : pace_{pace}, wall_start_{now} {}

  /// A new world starts at simulated time 0, owing nothing.
  void restart(TimePoint now);
  void setPace(dds::Pace pace, TimePoint now, double sim_time);
  void pause(TimePoint now, double sim_time);
  void resume(TimePoint now, double sim_time);

  const dds::Pace& pace() const { return pace_; }
  bool paused() const { return pause_.has_value(); }

  /// Wall seconds until the state at `sim_time` is due; negative when it is late, 0 at maximum pace.
  double secondsAhead(TimePoint now, double sim_time) const;
  /// Wall seconds that the state at `sim_time` is late, 0 when on time.
  double behind(TimePoint now, double sim_time) const;
  /// Simulated over wall seconds since the last change of pace or restart; 0 before any time has passed.
  double realTimeFactor(TimePoint now, double sim_time) const;

 private:
  struct Pause {
    TimePoint wall;
    double sim_time;
  };
  double wallElapsed(TimePoint now) const;
  double simElapsed(double sim_time) const;

  dds::Pace pace_;
  TimePoint wall_start_;
  double sim_start_ = 0.0;
  double owed_ = 0.0;  // simulated s, brought over from the pace before
  std::optional<Pause> pause_;
};

}  // namespace bleedsim::daemon
