// Particle updates per second of the whole step and of its stages: pressure, viscosity and gravity at h = 2 dx, about 31
// neighbours, a pool in an open box. Arguments: particles in thousands, threads; the name carries the SIMD target.
//
//   bench_solver --benchmark_counters_tabular=true [--benchmark_filter=best]
#include <benchmark/benchmark.h>
#include <cmath>
#include <limits>
#include <string>

#include "service/sph/world.h"

namespace bleedsim::bench {
namespace {

constexpr double kSpacing = 0.001;

sph::WorldDescription pool(std::int64_t thousands) {
  const double depth = 20.0;  // spacings
  const double across = std::round(std::sqrt(1000.0 * static_cast<double>(thousands) / depth));
  sph::WorldDescription scene;
  const sph::Vec3 size = kSpacing * sph::Vec3{across, across, depth};
  scene.spacing = kSpacing;
  scene.domain.lower = sph::Vec3::Constant(-0.01);
  scene.domain.upper = size + sph::Vec3::Constant(0.01);
  scene.capacity = static_cast<std::uint32_t>(across * across * depth);
  scene.compressibility.max_fall_or_depth = size.z();
  scene.effects.gravity.emplace();
  scene.effects.pressure.emplace();
  scene.effects.viscosity.emplace();
  sph::BoxShape box;
  box.upper = size;
  box.open_top = true;
  scene.tissue.push_back({.name = "box", .shape = box});
  sph::FluidBlock block;
  block.upper = size;
  block.jitter = 0.15;  // blood in motion is no lattice: culling and caches see a disordered pool
  scene.fluid_blocks.push_back(block);
  return scene;
}

void wholeStep(benchmark::State& state, sph::SimdTarget target) {
  auto made = sph::createWorld(pool(state.range(0)), {.threads = static_cast<int>(state.range(1)), .simd = target});
  if (!made) {
    state.SkipWithError(made.status().message().c_str());
    return;
  }
  sph::World& world = **made;
  constexpr double kAny = std::numeric_limits<double>::infinity();
  for (int warm_up = 0; warm_up < 20; ++warm_up) {
    if (!world.step(kAny).ok()) {
      state.SkipWithError("the warm-up failed");
      return;
    }
  }
  sph::WorldStats before;
  world.collectStats(before);
  for (auto _ : state) {
    if (!world.step(kAny).ok()) {
      state.SkipWithError("a step failed");
      break;
    }
  }
  sph::WorldStats after;
  world.collectStats(after);
  const double millions = 1e-6 * after.particles * static_cast<double>(after.step - before.step);
  state.counters["M_updates/s"] = benchmark::Counter{millions, benchmark::Counter::kIsRate};
  for (const sph::Stage stage : {sph::Stage::neighbors, sph::Stage::tissue, sph::Stage::density, sph::Stage::force}) {
    const auto index = static_cast<std::size_t>(stage);
    const double seconds = after.stage_seconds[index] - before.stage_seconds[index];
    if (seconds > 0.0) state.counters[std::string{sph::stageName(stage)} + "_M/s"] = millions / seconds;
  }
}

void addCases(const std::string& name, sph::SimdTarget target) {
  benchmark::RegisterBenchmark(("step/" + name).c_str(), [target](benchmark::State& state) { wholeStep(state, target); })
      ->ArgsProduct({{12, 20, 100}, {1, 2}})
      ->ArgNames({"thousands", "threads"})
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace
}  // namespace bleedsim::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  const auto targets = bleedsim::sph::availableSimdTargets();
  for (const bleedsim::sph::SimdTarget target : targets) {
    const std::string best = target == targets.front() ? "best:" : "";
    bleedsim::bench::addCases(best + std::string{bleedsim::sph::simdTargetName(target)}, target);
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
