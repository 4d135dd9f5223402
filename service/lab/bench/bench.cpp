#include "service/lab/bench/bench.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <fmt/core.h>
#include <limits>
#include <memory>

#include "service/build/build_info.h"
#include "service/lab/bench/ceilings.h"
#include "service/lab/measured.h"

namespace bleedsim::lab {
namespace {

constexpr int kWarmUpSteps = 5;  // pages, caches and lists
constexpr double kTurn = 0.02;   // s
constexpr int kMostStepsInTurn = 500;
// A block creeps: after so many steps it is brought back to where it began.
constexpr int kStillSteps = 64;
constexpr std::size_t kStages = static_cast<std::size_t>(sph::Stage::count);

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

std::string nameOf(const BenchCase& one) { return one.scene.empty() ? one.model : one.scene; }

/// One case, measured in turns.
class Runner {
 public:
  static Result<Runner> create(const BenchCase& one, const BenchOptions& options) {
    auto world = sph::createWorld(one.world, {.threads = one.threads, .simd = options.simd});
    if (!world) return world.status();
    Runner runner{one, std::move(*world)};
    if (Status status = runner.warmUp(); !status.ok()) return status;
    return runner;
  }

  Status turn() {
    if (Status status = bringBack(); !status.ok()) return status;
    // What ran before has the caches.
    if (Status status = step(); !status.ok()) return status;
    sph::WorldStats before;
    world_->collectStats(before);
    double updates = 0.0;
    const double start = now();
    for (int k = 0; k < steps_; ++k) {
      if (Status status = step(); !status.ok()) return status;
      updates += world_->particleCount();
    }
    const double seconds = now() - start;
    sph::WorldStats after;
    world_->collectStats(after);
    if (!(updates > 0.0)) return {StatusCode::invalid_argument, "there is no blood yet: warm up for longer with --warm-up"};
    updates_.push_back(1e-6 * updates / seconds);
    microseconds_.push_back(1e6 * seconds / updates);
    for (std::size_t s = 0; s < kStages; ++s)
      stages_[s].push_back(1e6 * (after.stage_seconds[s] - before.stage_seconds[s]) / updates);
    iterations_ = after.viscosity_iterations;
    dt_ = after.dt;
    return {};
  }

  MeasuredCase outcome() const {
    MeasuredCase outcome;
    outcome.model = case_->model;
    outcome.scene = case_->scene;
    outcome.simd = sph::simdTargetName(world_->simdTarget());
    outcome.particles = world_->particleCount();
    outcome.threads = case_->threads;
    outcome.turns = static_cast<int>(updates_.size());
    outcome.steps = steps_;
    outcome.warm_up = case_->warm_up;
    outcome.dt = dt_;
    outcome.census = takeCensus(*world_);
    outcome.work = workOf(world_->description(), outcome.census, iterations_);
    outcome.updates = sampledOf(updates_);
    outcome.microseconds = sampledOf(microseconds_);
    for (std::size_t s = 0; s < kStages; ++s) outcome.stages[s] = sampledOf(stages_[s]);
    const sph::MemoryUse memory = world_->memory();
    const double capacity = world_->description().capacity;
    outcome.bytes =
        static_cast<double>(memory.particles + memory.passes + memory.grid + memory.tissue + memory.effects) / capacity;
    outcome.list_bytes = static_cast<double>(memory.lists) / capacity;
    return outcome;
  }

 private:
  Runner(const BenchCase& one, std::unique_ptr<sph::World> world) : case_{&one}, world_{std::move(world)} {}

  Status step() { return world_->step(case_->step > 0.0 ? case_->step : std::numeric_limits<double>::infinity()); }

  Status warmUp() {
    while (world_->time() < case_->warm_up) {
      if (Status status = step(); !status.ok()) return status;
    }
    double shortest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < kWarmUpSteps; ++k) {
      const double start = now();
      if (Status status = step(); !status.ok()) return status;
      shortest = std::min(shortest, now() - start);
    }
    steps_ = static_cast<int>(std::clamp(std::round(kTurn / shortest), 1.0, double{kMostStepsInTurn}));
    if (!(case_->step > 0.0)) return {};
    steps_ = std::min(steps_, kStillSteps - 1);
    start_.resize(world_->stateBytes());
    if (world_->saveState(start_) == 0) return {StatusCode::internal, "the block's state cannot be kept"};
    kept_at_ = world_->stepCount();
    return checkStep();
  }

  /// Restores a block before the turn that would take it too far.
  Status bringBack() {
    if (start_.empty() || world_->stepCount() + static_cast<std::uint64_t>(steps_) + 1 <= kept_at_ + kStillSteps) return {};
    return world_->restoreState(start_);
  }

  /// A block must have taken its own step, or it is another case.
  Status checkStep() const {
    sph::WorldStats stats;
    world_->collectStats(stats);
    if (stats.dt == case_->step) return {};
    return {StatusCode::internal, fmt::format("steps are {:g} s long, not {:g} s as they should: the block does not stand still",
                                              stats.dt, case_->step)};
  }

  const BenchCase* case_;
  std::unique_ptr<sph::World> world_;
  std::vector<std::byte> start_;  // a block's state after the warm-up
  std::uint64_t kept_at_ = 0;     // step of that state
  int steps_ = 1;                 // in a turn
  int iterations_ = 0;
  double dt_ = 0.0;
  std::vector<double> updates_, microseconds_;
  std::array<std::vector<double>, kStages> stages_;
};

struct CeilingRunner {
  int threads;
  Ceilings ceilings;
  std::vector<double> gflops, gigabytes_s;

  void turn() {
    const Ceiling ceiling = ceilings.measure();
    gflops.push_back(ceiling.gflops);
    gigabytes_s.push_back(ceiling.gigabytes_s);
  }
};

std::vector<CeilingRunner> ceilingsOf(const std::vector<BenchCase>& cases) {
  std::vector<CeilingRunner> runners;
  for (const BenchCase& one : cases) {
    const auto same = [&one](const CeilingRunner& runner) { return runner.threads == one.threads; };
    if (std::none_of(runners.begin(), runners.end(), same)) runners.push_back({one.threads, Ceilings{one.threads}, {}, {}});
  }
  return runners;
}

}  // namespace

Sampled sampledOf(const std::vector<double>& values) {
  if (values.empty()) return {};
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return {medianOf(values).value, *least, *most};
}

const CeilingOutcome& BenchOutcome::ceilingOf(int threads) const {
  const auto found =
      std::find_if(ceilings.begin(), ceilings.end(), [threads](const CeilingOutcome& one) { return one.threads == threads; });
  return *found;
}

double rooflineShare(const Work& work, double microseconds, const CeilingOutcome& ceiling) {
  if (!(microseconds > 0.0)) return 0.0;
  const double least = std::max(1e-3 * work.flops / ceiling.gflops.median, 1e-3 * work.bytes / ceiling.gigabytes_s.median);
  return least / microseconds;
}

Result<BenchOutcome> measureCases(const std::vector<BenchCase>& cases, const BenchOptions& options,
                                  const std::function<void(double)>& progress) {
  const auto failed = [](const BenchCase& one, const Status& status) {
    return Status{status.code(),
                  fmt::format("{}, {} thread{}: {}", nameOf(one), one.threads, one.threads == 1 ? "" : "s", status.message())};
  };
  BenchOutcome outcome;
  outcome.machine = thisMachine();
  outcome.build = buildId();
  std::vector<Runner> runners;
  for (const BenchCase& one : cases) {
    auto runner = Runner::create(one, options);
    if (!runner) return failed(one, runner.status());
    runners.push_back(std::move(*runner));
  }
  std::vector<CeilingRunner> ceilings = ceilingsOf(cases);
  const double start = now();
  for (int turn = 0; turn < kLeastBenchTurns || now() - start < options.seconds; ++turn) {
    for (CeilingRunner& one : ceilings) one.turn();
    for (std::size_t k = 0; k < runners.size(); ++k) {
      if (Status status = runners[k].turn(); !status.ok()) return failed(cases[k], status);
    }
    progress(std::min(1.0, (now() - start) / options.seconds));
  }
  for (const CeilingRunner& one : ceilings)
    outcome.ceilings.push_back({one.threads, sampledOf(one.gflops), sampledOf(one.gigabytes_s)});
  for (const Runner& runner : runners) outcome.cases.push_back(runner.outcome());
  return outcome;
}

}  // namespace bleedsim::lab
