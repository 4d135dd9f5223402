// What config/perf-guard counts the instructions of: a few steps of a tiny world on one thread, always the same.
//
//   perf_guard --list             the cases, one a line
//   perf_guard --targets          the SIMD targets of this machine that valgrind can count, one a line
//   perf_guard --compiler         what compiled the solver
//   perf_guard CASE TARGET        makes the world, warms up, and takes its steps inside bleedsimCountedSteps
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "service/lab/bench/still_block.h"
#include "service/sph/world.h"

/// The function that callgrind's --toggle-collect names. False once a step fails.
extern "C" [[gnu::noinline]] bool bleedsimCountedSteps(bleedsim::sph::World& world, int steps, double limit) {
  bool held = true;
  for (int k = 0; k < steps && held; ++k) held = world.step(limit).ok();
  return held;
}

namespace bleedsim::bench {
namespace {

constexpr std::uint32_t kParticles = 1000;
constexpr int kWarmUpSteps = 2;
constexpr int kCountedSteps = 8;
constexpr const char* kWound = "wound";
constexpr const char* kClotting = "clotting";

/// A pool on flat tissue, beside it a wound of 3 mm radius that bleeds on.
sph::WorldDescription woundScene() {
  sph::WorldDescription scene;
  scene.spacing = 0.001;
  scene.domain.lower = sph::Vec3{-0.02, -0.02, -0.03};
  scene.domain.upper = sph::Vec3{0.02, 0.02, 0.02};
  scene.capacity = 2000;
  scene.compressibility.max_fall_or_depth = 0.01;
  scene.effects.gravity.emplace();
  scene.effects.pressure.emplace();
  scene.effects.viscosity.emplace();
  scene.effects.adhesion.emplace();
  sph::PlaneShape plane;
  scene.tissue = {{.name = "tissue", .shape = plane, .slip = 0.0}};
  sph::WoundDescription wound;
  wound.name = "wound";
  wound.position = sph::Vec3{-0.008, 0.0, 0.0};
  wound.shape = sph::DiscPatch{0.003};
  wound.drive = sph::FlowDrive{4e-6};
  scene.wounds = {wound};
  sph::FluidBlock pool;
  pool.lower = sph::Vec3{0.0, -0.008, 0.0};
  pool.upper = sph::Vec3{0.012, 0.008, 0.004};
  pool.jitter = 0.15;
  scene.fluid_blocks = {pool};
  return scene;
}

/// The full block clots ten thousand times as fast and takes the longest steps: whatever platelets do seldom is due at each.
sph::WorldDescription clottingBlock() {
  sph::WorldDescription block = lab::stillBlock(lab::BlockModel::full, kParticles);
  block.effects.platelets->clot_speedup = 1e4;
  block.max_dt = std::numeric_limits<double>::infinity();
  return block;
}

std::vector<std::string> caseNames() {
  std::vector<std::string> names = lab::blockModelNames();
  names.emplace_back(kClotting);
  names.emplace_back(kWound);
  return names;
}

int complain(const std::string& message) {
  std::fprintf(stderr, "perf_guard: %s\n", message.c_str());
  return 2;
}

int count(const std::string& name, const std::string& target_name) {
  const std::vector<std::string> names = caseNames();
  if (std::find(names.begin(), names.end(), name) == names.end()) return complain("no case '" + name + "'; see --list");
  const auto target = sph::parseSimdTarget(target_name);
  if (!target) return complain(target.status().message());
  const bool still = name != kWound && name != kClotting;
  const sph::WorldDescription description = still            ? lab::stillBlock(lab::blockModelOf(name), kParticles)
                                            : name == kWound ? woundScene()
                                                             : clottingBlock();
  auto world = sph::createWorld(description, {.threads = 1, .simd = *target});
  if (!world) return complain(world.status().message());
  const double limit = still ? lab::kBlockStep : std::numeric_limits<double>::infinity();
  for (int k = 0; k < kWarmUpSteps; ++k) {
    if (Status status = (*world)->step(limit); !status.ok()) return complain(status.message());
  }
  if (!bleedsimCountedSteps(**world, kCountedSteps, limit)) return complain("a step failed");
  std::printf("%u particles, %d steps\n", (*world)->particleCount(), kCountedSteps);
  return 0;
}

}  // namespace
}  // namespace bleedsim::bench

int main(int argc, char** argv) {
  using namespace bleedsim;
  const std::vector<std::string> arguments{argv + 1, argv + argc};
  if (arguments.size() == 1 && arguments[0] == "--list") {
    for (const std::string& name : bench::caseNames()) std::puts(name.c_str());
    return 0;
  }
  if (arguments.size() == 1 && arguments[0] == "--targets") {
    for (const sph::SimdTarget target : sph::availableSimdTargets()) {
      if (target != sph::SimdTarget::avx512) std::puts(std::string{sph::simdTargetName(target)}.c_str());
    }
    return 0;
  }
  if (arguments.size() == 1 && arguments[0] == "--compiler") {
    std::puts(BLEEDSIM_COMPILER);
    return 0;
  }
  if (arguments.size() == 2) return bench::count(arguments[0], arguments[1]);
  return bench::complain("usage: perf_guard CASE TARGET | --list | --targets | --compiler");
}
