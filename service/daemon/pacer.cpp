#include "service/daemon/pacer.h"

#include <algorithm>

namespace bleedsim::daemon {
namespace {

double seconds(Clock::duration duration) { return std::chrono::duration<double>{duration}.count(); }

}  // namespace

double Pacer::wallElapsed(TimePoint now) const { return seconds((pause_ ? pause_->wall : now) - wall_start_); }
double Pacer::simElapsed(double sim_time) const { return (pause_ ? pause_->sim_time : sim_time) - sim_start_; }

void Pacer::restart(TimePoint now, double sim_time) {
  wall_start_ = now;
  sim_start_ = sim_time;
  owed_ = 0.0;
  forgetMarks();
  if (pause_) pause_ = Pause{now, sim_time};
}

void Pacer::setPace(dds::Pace pace, TimePoint now, double sim_time) {
  const double late = behind(now, sim_time) * pace_.factor;
  owed_ = pace.mode == dds::PaceMode::maximum ? 0.0 : late;
  pace_ = pace;
  wall_start_ = now;
  sim_start_ = sim_time;
  forgetMarks();
  if (pause_) pause_ = Pause{now, sim_time};
}

void Pacer::pause(TimePoint now, double sim_time) {
  if (!pause_) pause_ = Pause{now, sim_time};
}

void Pacer::resume(TimePoint now, double sim_time) {
  if (!pause_) return;
  wall_start_ += now - pause_->wall;
  sim_start_ += sim_time - pause_->sim_time;
  pause_.reset();
}

double Pacer::secondsAhead(TimePoint now, double sim_time) const {
  if (pace_.mode == dds::PaceMode::maximum) return 0.0;
  return (simElapsed(sim_time) - owed_) / pace_.factor - wallElapsed(now);
}

double Pacer::behind(TimePoint now, double sim_time) const { return std::max(0.0, -secondsAhead(now, sim_time)); }

void Pacer::forgetMarks() {
  oldest_mark_ = 0;
  mark_count_ = 1;
  marks_[0] = {};
}

double Pacer::realTimeFactor(TimePoint now, double sim_time) {
  const auto mark = [this](std::size_t i) -> Mark& { return marks_[(oldest_mark_ + i) % kMarks]; };
  const Mark here{wallElapsed(now), simElapsed(sim_time)};
  while (mark_count_ > 1 && mark(1).wall <= here.wall - kWindowSeconds) {
    oldest_mark_ = (oldest_mark_ + 1) % kMarks;
    --mark_count_;
  }
  if (here.wall - mark(mark_count_ - 1).wall >= kMarkSeconds && mark_count_ < kMarks) mark(mark_count_++) = here;
  const Mark& from = mark(0);
  return here.wall > from.wall ? (here.sim - from.sim) / (here.wall - from.wall) : 0.0;
}

}  // namespace bleedsim::daemon
