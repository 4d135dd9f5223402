#include "service/lab/paper/intruders.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <memory>

#include "service/sph/seeding.h"

namespace bleedsim::lab {
namespace {

std::uint32_t countOf(const sph::FluidBlock& block, double spacing) {
  const auto counts = sph::blockLattice(block, spacing);
  return static_cast<std::uint32_t>(counts[0] * counts[1] * counts[2]);
}

/// x, y, z by id, which counts from 1 in the order of seeding; particles that left the domain are not numbers.
class Tracked {
 public:
  Tracked(const sph::World& world, std::uint32_t count) : positions_(3 * std::size_t{count}, std::nanf("")) {
    sph::FrameBuffer frame;
    frame.reserve(world.description().capacity, 0);
    world.copyFrame(frame, 0);
    for (std::size_t k = 0; k < frame.count; ++k) {
      const std::size_t at = frame.id[k] - 1;
      for (std::size_t a = 0; a < 3; ++a) positions_[3 * at + a] = frame.position[3 * k + a];
    }
  }

  sph::Vec3 at(std::size_t i) const {
    return {double(positions_[3 * i]), double(positions_[3 * i + 1]), double(positions_[3 * i + 2])};
  }
  std::span<const float> all() const { return positions_; }
  std::vector<float> take() { return std::move(positions_); }

 private:
  std::vector<float> positions_;
};

class Mean {
 public:
  void add(double value) {
    if (!std::isfinite(value)) return;
    sum_ += value;
    ++count_;
  }
  double value() const { return count_ > 0 ? sum_ / count_ : 0.0; }

 private:
  double sum_ = 0.0;
  int count_ = 0;
};

IntruderFigures figuresOf(const Tracked& start, const Tracked& end, const sph::WorldDescription& scene, std::uint32_t block,
                          std::uint32_t all) {
  const sph::FluidBlock& body = scene.fluid_blocks.front();
  IntruderFigures figures;
  Mean edge;
  Mean inner;
  Mean fast;
  sph::Vec3 shift = sph::Vec3::Zero();
  int kept = 0;
  for (std::uint32_t i = 0; i < all; ++i) {
    const double moved = (end.at(i) - start.at(i)).norm();
    if (i >= block) {
      fast.add(moved);
      continue;
    }
    const sph::Vec3 from = start.at(i);
    const double depth =
        std::min({from.x() - body.lower.x(), body.upper.x() - from.x(), from.y() - body.lower.y(), body.upper.y() - from.y()});
    (depth < scene.spacing ? edge : inner).add(moved);
    if (!std::isfinite(moved)) continue;
    shift += end.at(i) - start.at(i);
    ++kept;
  }
  figures.edge_moved = edge.value();
  figures.inner_moved = inner.value();
  figures.block_moved = kept > 0 ? (shift / kept).norm() : 0.0;
  figures.intruders_moved = fast.value();
  return figures;
}

/// One world of a case.
class Crossing {
 public:
  static Result<Crossing> create(const sph::WorldDescription& description, const Passage& passage, const PaperOptions& options) {
    auto world = sph::createWorld(description, options.world());
    if (!world) return world.status();
    return Crossing{std::move(*world), description, passage};
  }

  /// Steps; during the passage of intruders every step is looked at.
  Status runUntil(double time) {
    const bool intruders = all_ > block_;
    while (world_->time() < time) {
      if (Status status = world_->step(std::numeric_limits<double>::infinity()); !status.ok()) return status;
      if (!intruders || world_->time() < passage_.enter || world_->time() > passage_.leave) continue;
      Tracked now{*world_, all_};
      const double area = sharedArea(now.all(), block_, 0.5 * description_.spacing);
      if (area > overlap_) {
        overlap_ = area;
        overlap_time_ = world_->time();
      }
      if (picture_.empty() && world_->time() >= passage_.middle()) {
        picture_ = now.take();
        pictured_time_ = world_->time();
      }
    }
    return {};
  }

  IntruderFigures figures() const {
    IntruderFigures figures = figuresOf(start_, Tracked{*world_, all_}, description_, block_, all_);
    figures.time = world_->time();
    figures.overlap = overlap_;
    figures.overlap_time = overlap_time_;
    sph::WorldStats stats;
    world_->collectStats(stats);
    if (momentum_.norm() > 0.0 && all_ > block_) figures.momentum_drift = (stats.momentum - momentum_).norm() / momentum_.norm();
    return figures;
  }

  /// Of the middle of the passage; of now where there was none.
  void picture(IntruderRun& run) {
    const bool none = picture_.empty();
    run.positions = none ? Tracked{*world_, all_}.take() : std::move(picture_);
    run.pictured_time = none ? world_->time() : pictured_time_;
  }

 private:
  Crossing(std::unique_ptr<sph::World> world, const sph::WorldDescription& description, const Passage& passage)
      : world_{std::move(world)},
        description_{description},
        passage_{passage},
        block_{countOf(description.fluid_blocks.front(), description.spacing)},
        all_{allOf(description)},
        start_{*world_, all_} {
    sph::WorldStats stats;
    world_->collectStats(stats);
    momentum_ = stats.momentum;
  }

  static std::uint32_t allOf(const sph::WorldDescription& description) {
    std::uint32_t all = 0;
    for (const sph::FluidBlock& block : description.fluid_blocks) all += countOf(block, description.spacing);
    return all;
  }

  std::unique_ptr<sph::World> world_;
  sph::WorldDescription description_;
  Passage passage_;
  std::uint32_t block_ = 0;
  std::uint32_t all_ = 0;
  Tracked start_;
  sph::Vec3 momentum_ = sph::Vec3::Zero();
  double overlap_ = 0.0;
  double overlap_time_ = 0.0;
  std::vector<float> picture_;
  double pictured_time_ = 0.0;
};

/// One seed of a case.
Status runSeed(const sph::WorldDescription& description, const Passage& passage, const PaperOptions& options, IntruderRun& run) {
  auto crossing = Crossing::create(description, passage, options);
  if (!crossing) return crossing.status();
  // As long again as the passage takes: what the block does with those that it has caught is part of the figure.
  const double end = passage.leave + (passage.leave - passage.enter);
  if (Status status = crossing->runUntil(end); !status.ok()) return status;
  run.passage.push_back(crossing->figures());
  if (!run.intruders) {
    if (Status status = crossing->runUntil(options.duration); !status.ok()) return status;
  }
  run.figures.push_back(crossing->figures());
  if (run.positions.empty()) crossing->picture(run);
  return {};
}

IntruderRun runCase(const sph::WorldDescription& scene, const PaperOptions& options, bool intruders, bool repulsion,
                    const std::function<void()>& progress) {
  IntruderRun run;
  run.repulsion = repulsion;
  run.intruders = intruders;
  run.name = fmt::format("{}, {} (36)", intruders ? "intruders" : "at rest", repulsion ? "with" : "without");
  run.block_count = countOf(scene.fluid_blocks.front(), scene.spacing);
  sph::WorldDescription description = scene;
  if (!intruders) description.fluid_blocks.resize(1);
  if (!repulsion) description.effects.repulsion.reset();
  const Passage passage = passageOf(scene);
  for (std::uint64_t seed = 0; seed < kIntruderSeeds && run.failure.empty(); ++seed) {
    description.seed = scene.seed + seed;
    if (Status status = runSeed(description, passage, options, run); !status.ok()) run.failure = status.message();
    progress();
  }
  return run;
}

}  // namespace

Passage passageOf(const sph::WorldDescription& scene) {
  const sph::FluidBlock& body = scene.fluid_blocks.front();
  Passage passage{.enter = std::numeric_limits<double>::infinity(), .leave = 0.0};
  for (std::size_t k = 1; k < scene.fluid_blocks.size(); ++k) {
    const sph::FluidBlock& block = scene.fluid_blocks[k];
    double enter = 0.0;
    double leave = std::numeric_limits<double>::infinity();
    for (Eigen::Index a = 0; a < 2; ++a) {
      const double speed = block.velocity[a];
      if (speed == 0.0) {
        if (block.upper[a] <= body.lower[a] || block.lower[a] >= body.upper[a]) leave = 0.0;
        continue;
      }
      const double first = (body.lower[a] - block.upper[a]) / speed;
      const double last = (body.upper[a] - block.lower[a]) / speed;
      enter = std::max(enter, std::min(first, last));
      leave = std::min(leave, std::max(first, last));
    }
    if (!(leave > enter) || !std::isfinite(leave)) continue;
    passage.enter = std::min(passage.enter, enter);
    passage.leave = std::max(passage.leave, leave);
  }
  return passage.leave > 0.0 ? passage : Passage{};
}

double sharedArea(std::span<const float> positions, std::size_t block, double radius) {
  const double cell = radius / 16.0;
  const std::size_t count = positions.size() / 3;
  const auto x = [&](std::size_t i) { return static_cast<double>(positions[3 * i]); };
  const auto y = [&](std::size_t i) { return static_cast<double>(positions[3 * i + 1]); };
  std::vector<std::pair<std::int64_t, std::int64_t>> shared;
  std::vector<std::size_t> near;
  for (std::size_t i = block; i < count; ++i) {
    near.clear();
    for (std::size_t k = 0; k < std::min(block, count); ++k) {
      if (std::hypot(x(k) - x(i), y(k) - y(i)) < 2.0 * radius) near.push_back(k);
    }
    if (near.empty()) continue;
    const auto index = [cell](double at) { return static_cast<std::int64_t>(std::floor(at / cell)); };
    for (std::int64_t row = index(y(i) - radius); row <= index(y(i) + radius); ++row) {
      for (std::int64_t column = index(x(i) - radius); column <= index(x(i) + radius); ++column) {
        const double at_x = (static_cast<double>(column) + 0.5) * cell;
        const double at_y = (static_cast<double>(row) + 0.5) * cell;
        const auto covers = [&](std::size_t k) { return std::hypot(at_x - x(k), at_y - y(k)) <= radius; };
        if (covers(i) && std::any_of(near.begin(), near.end(), covers)) shared.emplace_back(row, column);
      }
    }
  }
  std::sort(shared.begin(), shared.end());
  const auto different = std::unique(shared.begin(), shared.end()) - shared.begin();
  return static_cast<double>(different) * cell * cell;
}

Measured IntruderRun::figure(double IntruderFigures::*figure) const {
  std::vector<double> values;
  for (const IntruderFigures& one : figures) values.push_back(one.*figure);
  return meanOf(values);
}

Result<std::vector<IntruderRun>> runIntruders(const sph::WorldDescription& scene, const PaperOptions& options,
                                              const ProgressReport& progress) {
  if (scene.fluid_blocks.size() < 2) {
    return Status{StatusCode::invalid_argument, "the scene needs a block at rest and, after it, blocks that move: the intruders"};
  }
  if (!(passageOf(scene).leave > 0.0)) {
    return Status{StatusCode::invalid_argument, "no block from the second on flies through the first"};
  }
  std::vector<IntruderRun> runs;
  int done = 0;
  for (const bool intruders : {false, true}) {
    for (const bool repulsion : {false, true}) {
      runs.push_back(runCase(scene, options, intruders, repulsion, [&] { progress(++done / (4.0 * kIntruderSeeds)); }));
    }
  }
  const bool none = std::all_of(runs.begin(), runs.end(), [](const IntruderRun& run) { return !run.failure.empty(); });
  if (none) return Status{StatusCode::internal, "no run of Fig. 2 came to its end; the first one: " + runs.front().failure};
  return runs;
}

}  // namespace bleedsim::lab
