// Real-time factor of the shipped scenes: simulated seconds per second of wall time, solver alone. An iteration is a frame of
// 1/60 s; a scene first runs until it holds blood. Argument: threads.
//
//   bench_scenes --benchmark_counters_tabular=true
#include <benchmark/benchmark.h>
#include <limits>
#include <string>

#include "service/scene/scene.h"
#include "service/sph/world.h"

namespace bleedsim::bench {
namespace {

constexpr double kFrame = 1.0 / 60.0;

bool advance(sph::World& world, double seconds) {
  const double end = world.time() + seconds;
  while (world.time() < end) {
    if (!world.step(std::numeric_limits<double>::infinity()).ok()) return false;
  }
  return true;
}

void frames(benchmark::State& state, const std::string& name, double start) {
  const auto scene = scene::loadScene(std::string{BLEEDSIM_SCENES} + "/" + name + ".textproto");
  if (!scene) {
    state.SkipWithError(scene.status().message().c_str());
    return;
  }
  auto made = sph::createWorld(scene->world, {.threads = static_cast<int>(state.range(0))});
  if (!made) {
    state.SkipWithError(made.status().message().c_str());
    return;
  }
  sph::World& world = **made;
  if (!advance(world, start)) {
    state.SkipWithError("the scene's start failed");
    return;
  }
  const double before = world.time();
  for (auto _ : state) {
    if (!advance(world, kFrame)) {
      state.SkipWithError("a step failed");
      break;
    }
  }
  state.counters["real_time_factor"] = benchmark::Counter{world.time() - before, benchmark::Counter::kIsRate};
  state.counters["particles"] = world.particleCount();
}

void addScene(const std::string& name, double start, std::int64_t iterations) {
  benchmark::RegisterBenchmark(("scene/" + name).c_str(), [name, start](benchmark::State& state) { frames(state, name, start); })
      ->Arg(1)
      ->Arg(2)
      ->ArgName("threads")
      ->Iterations(iterations)
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace
}  // namespace bleedsim::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  bleedsim::bench::addScene("round_wound", 5.0, 120);
  bleedsim::bench::addScene("round_wound_20k", 0.5, 30);
  bleedsim::bench::addScene("incision", 1.0, 60);
  bleedsim::bench::addScene("drip", 1.0, 60);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
