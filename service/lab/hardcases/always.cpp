#include "service/lab/hardcases/always.h"

#include <algorithm>
#include <cmath>

#include "service/sph/recovery.h"
#include "service/sph/tissue/signed_distance.h"

namespace bleedsim::lab {
namespace {

constexpr double kDeepest = -0.1;         // spacings
constexpr double kRounding = 1.0 + 1e-6;  // of a speed that was scaled to its bound
constexpr double kNear = 0.99;            // of v_cap
constexpr double kAnything = std::numeric_limits<double>::infinity();

constexpr std::uint32_t kEveryAttribute =
    sph::kFrameVelocity | sph::kFrameDensity | sph::kFrameViscosity | sph::kFramePlatelet | sph::kFrameRadius;

std::size_t indexOf(sph::Counter counter) { return static_cast<std::size_t>(counter); }

HardFigure countOf(const char* name, std::uint64_t value) { return {name, static_cast<double>(value), 0.0, 0.0, true}; }

}  // namespace

std::vector<HardFigure> Always::figures() const {
  return {{"steps", static_cast<double>(steps), 0.0, kAnything, false},
          countOf("particle-steps that are not finite", not_finite),
          {"smallest distance to tissue, dx", deepest, kDeepest, kAnything, true},
          countOf("steps with a wrong count", miscounted),
          {"largest speed over v_cap", fastest, 0.0, kRounding, true},
          countOf("steps with fewer clamps counted than particles came to v_cap", uncounted_clamps),
          countOf("steps beyond their cap of iterations", beyond_caps),
          countOf("steps after which a counter was lower", counters_fell)};
}

bool Always::holds() const {
  const std::vector<HardFigure> all = figures();
  return std::all_of(all.begin(), all.end(), [](const HardFigure& figure) { return figure.holds(); });
}

AlwaysWatch::AlwaysWatch(const sph::World& world, Always& worst) : worst_{worst} {
  frame_.reserve(world.description().capacity, kEveryAttribute);
  check(world);
}

const sph::FrameBuffer& AlwaysWatch::look(const sph::World& world) {
  world.copyFrame(frame_, kEveryAttribute);
  return frame_;
}

void AlwaysWatch::check(const sph::World& world) {
  ++worst_.steps;
  sph::WorldStats stats;
  world.collectStats(stats);
  look(world);
  if (stats.particles != stats.injected - stats.removed || stats.particles != frame_.count) ++worst_.miscounted;
  const double over_cap = stats.max_speed / (2.0 * world.speedOfSound());
  worst_.fastest = std::isfinite(over_cap) ? std::max(worst_.fastest, over_cap) : kAnything;
  const std::uint64_t retries =
      stats.counters[indexOf(sph::Counter::step_retried)] - counters_[indexOf(sph::Counter::step_retried)];
  const int most_iterations = world.description().effects.viscosity ? world.description().effects.viscosity->max_iterations : 0;
  if (retries > sph::kMostHalvings || stats.viscosity_iterations > most_iterations) ++worst_.beyond_caps;
  for (std::size_t k = 0; k < counters_.size(); ++k) {
    if (stats.counters[k] < counters_[k]) ++worst_.counters_fell;
  }
  const std::uint64_t clamps =
      stats.counters[indexOf(sph::Counter::speed_clamped)] - counters_[indexOf(sph::Counter::speed_clamped)];
  counters_ = stats.counters;
  checkParticles(world, clamps);
  checkDepth(world);
}

// A particle that was slower and is at the bound was cut to it in this step. One that was fast before may fly on at the bound
// without another cut, within rounding.
void AlwaysWatch::checkParticles(const sph::World& world, std::uint64_t clamps) {
  const double cap = 2.0 * world.speedOfSound();
  double fastest2 = 0.0;
  std::uint64_t arrived = 0;
  std::vector<std::uint32_t> fast;
  for (std::size_t i = 0; i < frame_.count; ++i) {
    double sum = 0.0;  // not finite if a part of it is not
    double speed2 = 0.0;
    for (std::size_t a = 0; a < 3; ++a) {
      sum += static_cast<double>(frame_.position[3 * i + a]);
      const double v = static_cast<double>(frame_.velocity[3 * i + a]);
      speed2 += v * v;
    }
    sum += speed2 + static_cast<double>(frame_.density[i]) + static_cast<double>(frame_.viscosity[i]) +
           static_cast<double>(frame_.platelet[i]) + static_cast<double>(frame_.radius[i]);
    if (!std::isfinite(sum)) ++worst_.not_finite;
    fastest2 = std::max(fastest2, speed2);
    const double over_cap = std::sqrt(speed2) / cap;
    if (over_cap < kNear) continue;
    fast.push_back(frame_.id[i]);
    if (over_cap * kRounding > 1.0 && !std::binary_search(fast_.begin(), fast_.end(), frame_.id[i])) ++arrived;
  }
  worst_.fastest = std::max(worst_.fastest, std::sqrt(fastest2) / cap);
  if (arrived > clamps) ++worst_.uncounted_clamps;
  std::sort(fast.begin(), fast.end());
  fast_.swap(fast);
}

void AlwaysWatch::checkDepth(const sph::World& world) {
  const sph::WorldDescription& scene = world.description();
  for (const sph::TissueDescription& tissue : scene.tissue) {
    for (std::size_t i = 0; i < frame_.count; ++i) {
      const float* p = frame_.position.data() + 3 * i;
      const sph::Vec3 at{static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
      worst_.deepest = std::min(worst_.deepest, sph::signedDistance(tissue.shape, at).value / scene.spacing);
    }
  }
}

}  // namespace bleedsim::lab
