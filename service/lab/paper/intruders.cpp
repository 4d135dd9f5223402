#include "service/lab/paper/intruders.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <numbers>

#include "service/lab/paper/claim.h"
#include "service/lab/paper/model_choice.h"
#include "service/lab/paper/paper_files.h"
#include "service/picture/scene_picture.h"
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

/// In which the fastest intruder crosses two and a half lengths of the block: through it, and not yet out of the domain.
double passageTime(const sph::WorldDescription& scene) {
  double speed = 0.0;
  for (const sph::FluidBlock& block : scene.fluid_blocks) speed = std::max(speed, block.velocity.norm());
  const sph::FluidBlock& body = scene.fluid_blocks.front();
  return speed > 0.0 ? 2.5 * (body.upper - body.lower).head<2>().maxCoeff() / speed : 0.0;
}

IntruderRun runOne(const sph::WorldDescription& scene, const PaperOptions& options, bool intruders, bool repulsion) {
  IntruderRun run;
  run.repulsion = repulsion;
  run.intruders = intruders;
  run.name = fmt::format("{}, {} (36)", intruders ? "intruders" : "at rest", repulsion ? "with" : "without");
  sph::WorldDescription description = scene;
  if (!intruders) description.fluid_blocks.resize(1);
  if (!repulsion) description.effects.repulsion.reset();
  run.block_count = countOf(scene.fluid_blocks.front(), scene.spacing);
  std::uint32_t all = 0;
  for (const sph::FluidBlock& block : description.fluid_blocks) all += countOf(block, scene.spacing);
  auto world = sph::createWorld(description, options.world());
  if (!world) {
    run.failure = world.status().message();
    return run;
  }
  sph::WorldStats stats;
  (*world)->collectStats(stats);
  const sph::Vec3 momentum = stats.momentum;
  const Tracked start{**world, all};
  const auto run_until = [&](double time) {
    while (run.failure.empty() && (*world)->time() < time) {
      if (Status status = (*world)->step(std::numeric_limits<double>::infinity()); !status.ok()) run.failure = status.message();
    }
  };
  run_until(passageTime(scene));
  run.passage = figuresOf(start, Tracked{**world, all}, description, run.block_count, all);
  run.passage.time = (*world)->time();
  (*world)->collectStats(stats);
  if (intruders && momentum.norm() > 0.0) run.passage.momentum_drift = (stats.momentum - momentum).norm() / momentum.norm();
  if (!intruders) run_until(options.duration);
  Tracked end{**world, all};
  run.figures = intruders ? run.passage : figuresOf(start, end, description, run.block_count, all);
  run.figures.time = (*world)->time();
  run.positions = end.take();
  run.figures.overlap = overlapOf(run.positions, 0.5 * scene.spacing);
  return run;
}

Result<picture::Image> draw(const IntruderRun& run, const sph::WorldDescription& scene) {
  picture::SceneStyle style;
  style.width = 760;
  style.height = 520;
  style.grid = false;
  style.value_name = "0: block, 1: intruder";
  style.values = picture::Range{0.0, 1.0};
  const sph::FluidBlock& body = scene.fluid_blocks.front();
  const sph::Vec3 size = body.upper - body.lower;
  picture::Bounds bounds;
  bounds.lower = body.lower - 0.5 * size;
  bounds.upper = body.upper + sph::Vec3{size.x(), 0.5 * size.y(), 0.0};  // room for the colour bar
  picture::FitOptions fit;
  fit.aspect = static_cast<double>(style.width) / style.height;
  fit.projection = picture::Camera::Projection::orthographic;
  const auto camera = picture::fitCamera(bounds, picture::NamedView::top, fit);
  if (!camera) return camera.status();
  std::vector<float> values;
  for (std::size_t i = 0; i < run.positions.size() / 3; ++i) values.push_back(i < run.block_count ? 0.15F : 0.9F);
  picture::ParticleCloud cloud;
  cloud.positions = run.positions;
  cloud.radius_m = 0.5 * scene.spacing;
  cloud.values = values;
  auto drawn = picture::drawScene(cloud, {}, *camera, style);
  if (!drawn) return drawn.status();
  return std::move(drawn->image);
}

Status drawSheet(const std::vector<IntruderRun>& runs, const sph::WorldDescription& scene, const PaperOptions& options,
                 const std::string& model) {
  std::vector<picture::Image> images;
  std::vector<std::string> captions;
  for (const IntruderRun& run : runs) {
    if (run.positions.empty()) continue;
    auto image = draw(run, scene);
    if (!image) return image.status();
    images.push_back(std::move(*image));
    captions.push_back(fmt::format("{}, {:.3g} s", run.name, run.figures.time));
  }
  std::vector<picture::SheetItem> items;
  for (std::size_t k = 0; k < images.size(); ++k) items.push_back({.image = &images[k], .caption = captions[k]});
  picture::SheetStyle style;
  style.columns = 2;
  style.title = fmt::format("Fig. 2, {} model: a block in two dimensions", model);
  auto sheet = picture::contactSheet(items, style);
  if (!sheet) return sheet.status();
  return writePicture(options, "fig2_" + model, *sheet);
}

std::vector<Claim> claimsOf(const std::vector<IntruderRun>& runs, double spacing, const std::string& model) {
  const auto find = [&](bool intruders, bool repulsion) -> const IntruderRun* {
    for (const IntruderRun& run : runs) {
      if (run.intruders == intruders && run.repulsion == repulsion && run.failure.empty()) return &run;
    }
    return nullptr;
  };
  using Figure = double IntruderFigures::*;
  const auto value = [&](const IntruderRun* run, Figure figure, double unit) -> std::optional<Measured> {
    if (run == nullptr) return std::nullopt;
    return Measured{run->figures.*figure / unit, 0.0};
  };
  const auto beyond = [&](const IntruderRun* run, const IntruderRun* undisturbed) -> std::optional<Measured> {
    if (run == nullptr || undisturbed == nullptr) return std::nullopt;
    return Measured{(run->passage.inner_moved - undisturbed->passage.inner_moved) / spacing, 0.0};
  };
  const auto claim = [&](const char* sentence, const char* figure, const char* first, const std::optional<Measured>& one,
                         const char* second, const std::optional<Measured>& other, Direction claimed) {
    Claim made{.sentence = sentence,
               .figure = figure,
               .with = first,
               .without = second,
               .claimed = claimed,
               .evidence = {compare(model, one, other, claimed)},
               .verdict = Verdict::depends};
    conclude(made);
    return made;
  };
  const IntruderRun* rest = find(false, false);
  const IntruderRun* bare = find(true, false);
  const IntruderRun* repelled = find(true, true);
  return {
      claim("at rest, particles on the edge diffuse, further than inner ones", "moved, spacings", "inner",
            value(rest, &IntruderFigures::inner_moved, spacing), "edge", value(rest, &IntruderFigures::edge_moved, spacing),
            Direction::larger),
      claim("at rest, inner particles stay, within a spacing", "moved, spacings", "a spacing", Measured{1.0, 0.0}, "inner",
            value(rest, &IntruderFigures::inner_moved, spacing), Direction::smaller),
      claim("without (36) fast particles overlap the block's", "overlapped part of the area", "with (36)",
            value(repelled, &IntruderFigures::overlap, 1.0), "without", value(bare, &IntruderFigures::overlap, 1.0),
            Direction::larger),
      claim("without (36) fast particles pass through", "intruders moved, spacings", "with (36)",
            value(repelled, &IntruderFigures::intruders_moved, spacing), "without",
            value(bare, &IntruderFigures::intruders_moved, spacing), Direction::larger),
      claim("without (36) the block is not moved, with it it is", "block's centre moved, spacings", "with (36)",
            value(repelled, &IntruderFigures::block_moved, spacing), "without",
            value(bare, &IntruderFigures::block_moved, spacing), Direction::smaller),
      claim("(36) changes the block's structure", "inner particles moved beyond those at rest so far, spacings", "with (36)",
            beyond(repelled, find(false, true)), "without", beyond(bare, rest), Direction::smaller),
  };
}

}  // namespace

double overlapOf(std::span<const float> positions, double radius) {
  const double cell = radius / 8.0;
  std::vector<std::pair<std::int64_t, std::int64_t>> cells;
  for (std::size_t i = 0; 3 * i + 1 < positions.size(); ++i) {
    const double x = static_cast<double>(positions[3 * i]);
    const double y = static_cast<double>(positions[3 * i + 1]);
    if (!std::isfinite(x) || !std::isfinite(y)) continue;
    const auto first = [&](double at) { return static_cast<std::int64_t>(std::ceil((at - radius) / cell - 0.5)); };
    const auto last = [&](double at) { return static_cast<std::int64_t>(std::floor((at + radius) / cell - 0.5)); };
    for (std::int64_t row = first(y); row <= last(y); ++row) {
      for (std::int64_t column = first(x); column <= last(x); ++column) {
        const double dx = (static_cast<double>(column) + 0.5) * cell - x;
        const double dy = (static_cast<double>(row) + 0.5) * cell - y;
        if (dx * dx + dy * dy <= radius * radius) cells.emplace_back(row, column);
      }
    }
  }
  if (cells.empty()) return 0.0;
  const auto all = static_cast<double>(cells.size());
  std::sort(cells.begin(), cells.end());
  const auto different = static_cast<double>(std::unique(cells.begin(), cells.end()) - cells.begin());
  return 1.0 - different / all;
}

Result<std::vector<IntruderRun>> runIntruders(const sph::WorldDescription& scene, const PaperOptions& options,
                                              const ProgressReport& progress) {
  if (scene.fluid_blocks.size() < 2) {
    return Status{StatusCode::invalid_argument, "the scene needs a block at rest and, after it, blocks that move: the intruders"};
  }
  std::vector<IntruderRun> runs;
  for (const bool intruders : {false, true}) {
    for (const bool repulsion : {false, true}) {
      runs.push_back(runOne(scene, options, intruders, repulsion));
      progress(static_cast<double>(runs.size()) / 4.0);
    }
  }
  const bool none = std::all_of(runs.begin(), runs.end(), [](const IntruderRun& run) { return !run.failure.empty(); });
  if (none) return Status{StatusCode::internal, "no run of Fig. 2 came to its end; the first one: " + runs.front().failure};
  return runs;
}

Result<PaperReport> runFig2(const PaperOptions& options, const ProgressReport& progress) {
  PaperReport report;
  report.json = {{"experiment", "fig2"},
                 {"duration_s", options.duration},
                 {"runs", nlohmann::json::array()},
                 {"claims", nlohmann::json::array()}};
  report.text = "Fig. 2, two dimensions; lengths in spacings\n";
  const std::vector<ModelFace> faces = facesOf(options.model);
  std::vector<Claim> claims;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto world = loadFace(options, "fig2", faces[f]);
    if (!world) return world.status();
    const auto parts = static_cast<double>(faces.size());
    const auto runs = runIntruders(*world, options, [&](double part) { progress((static_cast<double>(f) + part) / parts); });
    if (!runs) return runs.status();
    report.text += fmt::format("{:<8} {:<26} {:>7} {:>7} {:>7} {:>10} {:>8} {:>10}\n", faces[f].name, "run", "edge", "inner",
                               "block", "intruders", "overlap", "momentum");
    for (const IntruderRun& run : *runs) {
      const IntruderFigures& figures = run.figures;
      report.json["runs"].push_back({{"model", faces[f].name},
                                     {"run", run.name},
                                     {"intruders", run.intruders},
                                     {"repulsion", run.repulsion},
                                     {"failure", run.failure},
                                     {"time_s", figures.time},
                                     {"edge_moved_m", figures.edge_moved},
                                     {"inner_moved_m", figures.inner_moved},
                                     {"block_moved_m", figures.block_moved},
                                     {"intruders_moved_m", figures.intruders_moved},
                                     {"overlap", figures.overlap},
                                     {"momentum_drift", figures.momentum_drift}});
      const double dx = world->spacing;
      report.text +=
          fmt::format("{:<8} {:<26} {:>7.2f} {:>7.2f} {:>7.2f} {:>10.2f} {:>8.4f} {:>10.2e}{}\n", "", run.name,
                      figures.edge_moved / dx, figures.inner_moved / dx, figures.block_moved / dx, figures.intruders_moved / dx,
                      figures.overlap, figures.momentum_drift, run.failure.empty() ? "" : "  " + run.failure);
    }
    std::vector<Claim> own = claimsOf(*runs, world->spacing, faces[f].name);
    if (claims.empty()) {
      claims = std::move(own);
    } else {
      for (std::size_t k = 0; k < own.size(); ++k) claims[k].evidence.push_back(own[k].evidence.front());
    }
    if (options.folder.empty()) continue;
    if (Status status = drawSheet(*runs, *world, options, faces[f].name); !status.ok()) return status;
  }
  for (Claim& claim : claims) {
    conclude(claim);
    report.json["claims"].push_back(toJson(claim));
    report.text += toText(claim);
  }
  return report;
}

}  // namespace bleedsim::lab
