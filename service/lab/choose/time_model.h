// What a frame of a scene costs at a resolution, from two short runs of the scene itself at coarse ones.
//
//   ms per frame = N x steps per frame x us per particle-step / 1000
//
// N is the volume at the horizon over dx^3; the step follows the limits of the solver (time_step.h), times what the finer run
// kept of them, since accelerations shorten some; us follows N by the power law between the two runs.
#pragma once

#include <cstdint>

#include "service/sph/world.h"

namespace bleedsim::lab {

/// What a run of a scene to its horizon was like near its end.
struct SceneSample {
  sph::WorldDescription scene;
  std::uint32_t particles = 0;  ///< at the end: in the scene, not removed
  double microseconds = 0.0;    ///< per particle and step; CPU time on one thread, wall time on several
  double dt = 0.0;              ///< mean step, s
  double max_speed = 0.0;       ///< m/s
  double frame_ms = 0.0;        ///< mean cost of a frame
  double density_error = 0.0;   ///< the largest in the scene, mean over samples
  double wall_s = 0.0;          ///< that the whole run took
};

/// Runs the scene for `horizon` s and measures its last tenth.
Result<SceneSample> runScene(const sph::WorldDescription& scene, double horizon, double frame_rate,
                             const sph::WorldOptions& options);

/// Blood at the end of the horizon, m^3: blocks, and what wounds bring.
double volumeOf(const sph::WorldDescription& scene, double horizon);

struct FrameTime {
  std::uint32_t particles = 0;
  double steps = 0.0;  ///< in a frame
  double microseconds = 0.0;
  double milliseconds = 0.0;  ///< of a frame
};

class TimeModel {
 public:
  TimeModel(SceneSample coarse, SceneSample fine) : coarse_{std::move(coarse)}, fine_{std::move(fine)} {}

  /// At the samples' support ratio and effects.
  FrameTime predict(double spacing, double mach_factor, double frame_rate) const;
  const SceneSample& fine() const { return fine_; }

 private:
  SceneSample coarse_, fine_;
};

/// The longest step that the solver allows the scene at a speed, accelerations left out, s.
double longestStep(const sph::WorldDescription& scene, double max_speed);

}  // namespace bleedsim::lab
