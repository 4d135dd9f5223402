#include "service/lab/paper/table2.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <memory>

#include "service/lab/paper/paper_files.h"
#include "service/lab/paper/paper_scene.h"
#include "service/sph/seeding.h"

namespace bleedsim::lab {
namespace {

constexpr int kMeshSteps = 15;  // in a turn
constexpr double kAnyStep = std::numeric_limits<double>::infinity();

struct PaperRates {
  std::uint32_t particles;
  double complete, mesh;  // frames/s
};
constexpr std::array kPaperRates{PaperRates{12000, 9.3, 25.0}, PaperRates{15000, 7.5, 23.0}, PaperRates{18000, 5.7, 19.0},
                                 PaperRates{22000, 4.4, 16.0}};

const char* nameOf(Search search) { return search == Search::complete ? "complete search" : "cube mesh"; }

std::optional<double> paperRate(std::uint32_t particles, Search search) {
  for (const PaperRates& row : kPaperRates) {
    if (row.particles == particles) return search == Search::complete ? row.complete : row.mesh;
  }
  return std::nullopt;
}

/// The scene with `particles` in its first block, to a whole layer.
Result<sph::WorldDescription> bodyOf(const sph::WorldDescription& scene, std::uint32_t particles) {
  if (scene.fluid_blocks.empty()) return Status{StatusCode::invalid_argument, "the scene needs a fluid block"};
  sph::WorldDescription body = scene;
  body.wounds.clear();
  sph::FluidBlock& block = body.fluid_blocks.front();
  body.fluid_blocks.resize(1);
  const auto counts = sph::blockLattice(block, scene.spacing);
  const double layer = static_cast<double>(std::max<std::uint64_t>(1, counts[0] * counts[1]));
  const double layers = std::max(1.0, std::round(particles / layer));
  block.upper.z() = block.lower.z() + layers * scene.spacing;
  body.capacity = static_cast<std::uint32_t>(layer * layers);
  return body;
}

/// One body under one search, stepped in turns with the others, so that a busy machine slows all of them alike.
class Runner {
 public:
  static Result<Runner> create(const sph::WorldDescription& body, Search search, const PaperOptions& options) {
    sph::WorldOptions world_options = options.world();
    world_options.complete_search = search == Search::complete;
    auto world = sph::createWorld(body, world_options);
    if (!world) return world.status();
    return Runner{std::move(*world), search};
  }

  Status turn() {
    using Clock = std::chrono::steady_clock;
    const int steps = search_ == Search::complete ? 1 : kMeshSteps;
    for (int step = 0; step < steps; ++step) {
      const Clock::time_point start = Clock::now();
      if (Status status = world_->step(kAnyStep); !status.ok()) return status;
      seconds_.push_back(std::chrono::duration<double>(Clock::now() - start).count());
    }
    return {};
  }

  RateRow row() const {
    std::vector<double> sorted = seconds_;
    std::sort(sorted.begin(), sorted.end());
    sph::WorldStats stats;
    world_->collectStats(stats);
    RateRow row;
    row.particles = stats.particles;
    row.search = search_;
    row.rate = 1.0 / sorted[sorted.size() / 4];  // what others do on the machine only ever slows a step
    std::vector<double> rates;
    for (const double seconds : sorted) rates.push_back(1.0 / seconds);
    row.median_rate = 1.0 / sorted[sorted.size() / 2];
    row.scatter = medianOf(std::move(rates)).scatter;
    row.dt = stats.dt;
    row.paper_rate = paperRate(stats.particles, search_);
    row.steps = static_cast<std::uint32_t>(stats.step);
    return row;
  }

 private:
  Runner(std::unique_ptr<sph::World> world, Search search) : world_{std::move(world)}, search_{search} {}

  std::unique_ptr<sph::World> world_;
  Search search_;
  std::vector<double> seconds_;
};

PowerFit fitOf(const std::vector<RateRow>& rows, Search search) {
  std::vector<double> counts;
  std::vector<double> rates;
  for (const RateRow& row : rows) {
    if (row.search != search) continue;
    counts.push_back(row.particles);
    rates.push_back(row.rate);
  }
  return fitPower(counts, rates);
}

PowerFit paperFit(Search search) {
  std::vector<double> counts;
  std::vector<double> rates;
  for (const PaperRates& row : kPaperRates) {
    counts.push_back(row.particles);
    rates.push_back(search == Search::complete ? row.complete : row.mesh);
  }
  return fitPower(counts, rates);
}

nlohmann::json toJson(const PowerFit& fit) {
  return {{"exponent", fit.exponent},
          {"standard_error", fit.exponent_error ? nlohmann::json(*fit.exponent_error) : nlohmann::json(nullptr)},
          {"r2", fit.r2},
          {"inversely_proportional", verdictName(inverseVerdict(fit))}};
}

nlohmann::json toJson(const RateTable& table, const PaperOptions& options) {
  nlohmann::json rows = nlohmann::json::array();
  for (const RateRow& row : table.rows) {
    nlohmann::json one{{"particles", row.particles},
                       {"search", row.search == Search::complete ? "complete" : "mesh"},
                       {"frames_per_s", row.rate},
                       {"frames_per_s_median", row.median_rate},
                       {"frames_per_s_scatter", row.scatter},
                       {"steps", row.steps},
                       {"dt_s", row.dt},
                       {"simulated_s_per_s", row.rate * row.dt},
                       {"reaches_20_frames_per_s", row.rate >= kSmoothRate}};
    one["paper_frames_per_s"] = row.paper_rate ? nlohmann::json(*row.paper_rate) : nlohmann::json(nullptr);
    rows.push_back(std::move(one));
  }
  nlohmann::json fits = nlohmann::json::array();
  for (const RateFit& fit : table.fits) {
    fits.push_back({{"search", fit.search == Search::complete ? "complete" : "mesh"},
                    {"ours", toJson(fit.ours)},
                    {"paper", toJson(fit.paper)}});
  }
  return {{"experiment", "table2"},
          {"threads", options.threads},
          {"simd", table.simd},
          {"smooth_frames_per_s", kSmoothRate},
          {"frames_per_s_is", "one step a frame, by the fastest quarter of the steps; frames_per_s_median by the median step"},
          {"rows", std::move(rows)},
          {"fits", std::move(fits)}};
}

std::string shown(const PowerFit& fit) {
  const std::string error = fit.exponent_error ? fmt::format(" +- {:.2f}", *fit.exponent_error) : std::string{};
  return fmt::format("{:.2f}{} (R^2 {:.3f})", fit.exponent, error, fit.r2);
}

std::string toText(const RateTable& table, const PaperOptions& options) {
  std::string text = fmt::format(
      "Table II: frames (= steps) per second, {} thread{}, {}; enough is {:.0f}\n"
      "frames/s by the fastest quarter of the steps, which others on the machine leave alone; beside it by the median step, with "
      "the median absolute deviation\n",
      options.threads, options.threads == 1 ? "" : "s", table.simd, kSmoothRate);
  text += fmt::format("{:>9}  {:<15} {:>10} {:>10} {:>8} {:>8} {:>8} {:>9}\n", "particles", "search", "frames/s", "median", "+-",
                      "paper", "enough", "sim. s/s");
  for (const RateRow& row : table.rows) {
    text += fmt::format("{:>9}  {:<15} {:>10.2f} {:>10.2f} {:>8.2f} {:>8} {:>8} {:>9.2g}\n", row.particles, nameOf(row.search),
                        row.rate, row.median_rate, row.scatter, row.paper_rate ? fmt::format("{:.1f}", *row.paper_rate) : "-",
                        row.rate >= kSmoothRate ? "yes" : "no", row.rate * row.dt);
  }
  for (const RateFit& fit : table.fits) {
    text += fmt::format(
        "{}: frames/s ~ particles^{}, the paper's own numbers ^{}: \"inversely proportional\" {} here, {} for the "
        "paper's numbers\n",
        nameOf(fit.search), shown(fit.ours), shown(fit.paper), verdictName(inverseVerdict(fit.ours)),
        verdictName(inverseVerdict(fit.paper)));
  }
  return text;
}

picture::LinePlot plotOf(const RateTable& table) {
  picture::LinePlot plot;
  plot.title = "Frames per second (one step a frame)";
  plot.x = {.label = "particles", .log = true, .lower = {}, .upper = {}};
  plot.y = {.label = "frames per second", .log = true, .lower = {}, .upper = {}};
  for (const Search search : {Search::complete, Search::mesh}) {
    picture::Series ours{
        .name = fmt::format("{}, here", nameOf(search)), .style = picture::SeriesStyle::line_with_points, .x = {}, .y = {}};
    picture::Series paper{
        .name = fmt::format("{}, paper", nameOf(search)), .style = picture::SeriesStyle::line_with_points, .x = {}, .y = {}};
    for (const RateRow& row : table.rows) {
      if (row.search != search) continue;
      ours.x.push_back(row.particles);
      ours.y.push_back(row.rate);
    }
    for (const PaperRates& row : kPaperRates) {
      paper.x.push_back(row.particles);
      paper.y.push_back(search == Search::complete ? row.complete : row.mesh);
    }
    plot.series.push_back(std::move(ours));
    plot.series.push_back(std::move(paper));
  }
  plot.lines = {{.direction = picture::ReferenceLine::Direction::horizontal, .at = kSmoothRate, .label = "20 frames/s"}};
  return plot;
}

}  // namespace

Verdict inverseVerdict(const PowerFit& fit) {
  if (!fit.exponent_error) return Verdict::depends;
  const double off = std::abs(fit.exponent + 1.0);
  const double reach = 2.0 * *fit.exponent_error;
  if (off - reach > kInverseWithin) return Verdict::does_not;
  return off + reach <= kInverseWithin && fit.r2 >= 0.98 ? Verdict::holds : Verdict::depends;
}

Result<RateTable> measureRates(const sph::WorldDescription& scene, const PaperOptions& options, const ProgressReport& progress) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  std::vector<Runner> runners;
  for (const std::uint32_t particles : options.counts) {
    const auto body = bodyOf(scene, particles);
    if (!body) return body.status();
    for (const Search search : {Search::complete, Search::mesh}) {
      auto runner = Runner::create(*body, search, options);
      if (!runner) return runner.status();
      runners.push_back(std::move(*runner));
    }
  }
  // A turn begins where at least half of it fits into the time.
  for (double spent = 0.0, turn = 0.0; spent + 0.5 * turn < options.seconds;) {
    for (Runner& runner : runners) {
      if (Status status = runner.turn(); !status.ok()) return status;
    }
    const double now = std::chrono::duration<double>(Clock::now() - start).count();
    turn = now - spent;
    spent = now;
    progress(std::min(1.0, spent / options.seconds));
  }
  RateTable table;
  for (const Runner& runner : runners) table.rows.push_back(runner.row());
  if (options.counts.size() > 1) {
    for (const Search search : {Search::complete, Search::mesh})
      table.fits.push_back({.search = search, .ours = fitOf(table.rows, search), .paper = paperFit(search)});
  }
  const sph::SimdTarget target = options.simd == sph::SimdTarget::automatic ? sph::availableSimdTargets().front() : options.simd;
  table.simd = sph::simdTargetName(target);
  return table;
}

Result<PaperReport> runTable2(const PaperOptions& options, const ProgressReport& progress) {
  const auto scene = loadPaperScene(options, "table2");
  if (!scene) return scene.status();
  const auto table = measureRates(scene->world, options, progress);
  if (!table) return table.status();
  if (!options.folder.empty()) {
    if (Status status = writeLinePlot(options, "table2", plotOf(*table)); !status.ok()) return status;
  }
  return PaperReport{toJson(*table, options), toText(*table, options)};
}

}  // namespace bleedsim::lab
