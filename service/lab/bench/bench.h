// What a step of the solver costs, stage by stage, and how far that is from what the machine can do.
//
// All cases are measured in turns, and the ceilings of the machine with them, so that a machine that gives more or less from one
// second to the next does so to all alike. A turn is about 0.02 s of steps, at least one, after one that is not counted and
// brings its data back into the caches. Every figure is the median of the turns, told with the least and the most. The clock is
// the wall's: a step is all of World::step. A still block is brought back to its start every 64 steps, so that a long measurement
// sees the same neighbours as a short one.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "service/lab/bench/census.h"
#include "service/lab/bench/work_count.h"
#include "service/lab/machine.h"
#include "service/sph/world.h"
#include "service/status/status.h"

namespace bleedsim::lab {

inline constexpr int kLeastBenchTurns = 5;  ///< whatever the time that they take

/// A figure over the turns.
struct Sampled {
  double median = 0.0, least = 0.0, most = 0.0;
};
/// Zero of nothing.
Sampled sampledOf(const std::vector<double>& values);

/// What is measured: a still block (still_block.h), or a scene from where it is after a while.
struct BenchCase {
  std::string model;  ///< of the block; "scene"
  std::string scene;  ///< path; empty for a block
  sph::WorldDescription world;
  double step = 0.0;     ///< of a block: s, of each step; 0: as long as is stable
  double warm_up = 0.0;  ///< simulated time before the measurement, s; a few steps in any case
  int threads = 1;
};

struct BenchOptions {
  sph::SimdTarget simd = sph::SimdTarget::automatic;
  double seconds = 10.0;  ///< wall time after which no further turn begins, preparation apart
};

struct MeasuredCase {
  std::string model, scene, simd;
  std::uint32_t particles = 0;
  int threads = 1;
  int turns = 0;
  int steps = 0;         ///< in a turn
  double warm_up = 0.0;  ///< s, simulated
  double dt = 0.0;       ///< s, of the last step
  Census census;
  StageWork work{};
  Sampled updates;                                                            ///< million particle-updates/s
  Sampled microseconds;                                                       ///< of a step, per particle
  std::array<Sampled, static_cast<std::size_t>(sph::Stage::count)> stages{};  ///< the same of each stage
  double bytes = 0.0;  ///< memory per particle of the capacity, lists apart
  double list_bytes = 0.0;
};

struct CeilingOutcome {
  int threads = 1;
  Sampled gflops, gigabytes_s;
};

struct BenchOutcome {
  Machine machine;
  std::string build;
  std::vector<CeilingOutcome> ceilings;  ///< of each number of threads
  std::vector<MeasuredCase> cases;

  const CeilingOutcome& ceilingOf(int threads) const;
};

/// The part of what the roofline allows: the least time that `work` can take under the ceilings, over `microseconds`; 0 of a
/// stage whose work is not counted or that took no time.
double rooflineShare(const Work& work, double microseconds, const CeilingOutcome& ceiling);

/// `progress` is told what is done, 0 to 1. The message of a failure names the case.
Result<BenchOutcome> measureCases(const std::vector<BenchCase>& cases, const BenchOptions& options,
                                  const std::function<void(double)>& progress);

}  // namespace bleedsim::lab
