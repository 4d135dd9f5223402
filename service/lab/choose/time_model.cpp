#include "service/lab/choose/time_model.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <limits>

#include "service/sph/world_setup.h"
#include "service/sph/wound/orifice.h"
#include "service/sph/wound/patch_geometry.h"

namespace bleedsim::lab {
namespace {

constexpr double kMeasuredPart = 0.1;  // of the horizon, at its end

double wallSeconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// Of this thread, which others on the machine hardly touch, where it does all the work.
double workSeconds(int threads) {
  if (threads > 1) return wallSeconds();
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

double volumeOf(const sph::WorldDescription& scene, double horizon) {
  double volume = 0.0;
  for (const sph::FluidBlock& block : scene.fluid_blocks) volume += (block.upper - block.lower).prod();
  for (const sph::WoundDescription& wound : scene.wounds)
    volume += horizon * sph::driveFlow(wound.drive, sph::patchArea(wound.shape), scene.rest_density);
  return volume;
}

Result<SceneSample> runScene(const sph::WorldDescription& scene, double horizon, double frame_rate,
                             const sph::WorldOptions& options) {
  const double begin = wallSeconds();
  auto world = sph::createWorld(scene, options);
  if (!world) return world.status();
  SceneSample sample;
  sample.scene = scene;
  const auto run_until = [&](double end) -> Status {
    while ((*world)->time() < end) {
      if (Status status = (*world)->step(std::numeric_limits<double>::infinity()); !status.ok()) return status;
    }
    return {};
  };
  const double start = (1.0 - kMeasuredPart) * horizon;
  if (Status status = run_until(start); !status.ok()) return status;
  constexpr int kParts = 10;
  double particle_steps = 0.0;
  double work = 0.0;
  double density = 0.0;
  const std::uint64_t steps_before = (*world)->stepCount();
  const double time_before = (*world)->time();
  for (int part = 1; part <= kParts; ++part) {
    const std::uint64_t steps = (*world)->stepCount();
    const double clock = workSeconds(options.threads);
    if (Status status = run_until(start + kMeasuredPart * horizon * part / kParts); !status.ok()) return status;
    work += workSeconds(options.threads) - clock;
    particle_steps += static_cast<double>((*world)->stepCount() - steps) * (*world)->particleCount();
    sph::WorldStats stats;
    (*world)->collectStats(stats);
    density += stats.max_density_error / kParts;
    sample.max_speed = std::max(sample.max_speed, stats.max_speed);
  }
  const auto steps = static_cast<double>((*world)->stepCount() - steps_before);
  if (!(steps > 0.0) || !(particle_steps > 0.0)) {
    return Status{StatusCode::invalid_argument,
                  "the scene has no blood at the end of its horizon, or no step fits into it; give a longer --horizon"};
  }
  const double simulated = (*world)->time() - time_before;
  sample.particles = (*world)->particleCount();
  sample.microseconds = 1e6 * work / particle_steps;
  sample.dt = simulated / steps;
  sample.frame_ms = 1e3 * work / simulated / frame_rate;
  sample.density_error = density;
  sample.wall_s = wallSeconds() - begin;
  return sample;
}

double longestStep(const sph::WorldDescription& scene, double max_speed) {
  const double infinity = std::numeric_limits<double>::infinity();
  sph::TimeStepLimits limits = sph::timeStepLimits(scene, sph::speedOfSound(scene));
  const double with_viscosity = sph::stableTimeStep(limits, max_speed, 0.0, infinity);
  if (!scene.effects.viscosity || scene.effects.viscosity->solve == sph::ViscositySolve::explicit_) return with_viscosity;
  // Where viscosity would be the smallest limit it is solved implicitly, and none.
  limits.viscous = infinity;
  return sph::stableTimeStep(limits, max_speed, 0.0, infinity);
}

FrameTime TimeModel::predict(double spacing, double mach_factor, double frame_rate) const {
  sph::WorldDescription scene = fine_.scene;
  scene.spacing = spacing;
  scene.compressibility.mach_factor = mach_factor;
  FrameTime time;
  const double finer = fine_.scene.spacing / spacing;
  time.particles = static_cast<std::uint32_t>(std::lround(std::min(4e9, fine_.particles * finer * finer * finer)));
  const double kept = fine_.dt / longestStep(fine_.scene, fine_.max_speed);
  time.steps = 1.0 / (frame_rate * kept * longestStep(scene, fine_.max_speed));
  const double spread = std::log(static_cast<double>(fine_.particles) / coarse_.particles);
  double power = spread > 0.1 ? std::log(fine_.microseconds / coarse_.microseconds) / spread : 0.0;
  power = std::clamp(power, -0.2, 0.2);  // a disturbed run must not lead far away
  const double more = static_cast<double>(std::max(1U, time.particles)) / fine_.particles;
  time.microseconds = fine_.microseconds * std::pow(std::clamp(more, 0.05, 20.0), power);
  time.milliseconds = 1e-3 * time.microseconds * time.steps * time.particles;
  return time;
}

}  // namespace bleedsim::lab
