#include "service/lab/paper/fig5.h"

#include <algorithm>
#include <fmt/format.h>

#include "service/lab/paper/body_picture.h"
#include "service/lab/paper/fit.h"
#include "service/lab/paper/gush.h"
#include "service/lab/paper/model_choice.h"
#include "service/lab/paper/paper_files.h"
#include "service/lab/side_by_side.h"

namespace bleedsim::lab {
namespace {

constexpr double kSampledPart = 0.1;  // of the particles, the last ones
constexpr std::size_t kRings = 24;

Status measure(Gush& gush, std::uint32_t particles, Fig5Run& run) {
  std::vector<double> counts;
  std::array<std::vector<double>, static_cast<std::size_t>(GushFigure::count)> samples;
  for (int k = 0; k < kSamples; ++k) {
    const double part = 1.0 - kSampledPart * (kSamples - 1 - k) / (kSamples - 1);
    if (Status status = gush.growTo(std::max(1u, static_cast<std::uint32_t>(part * particles))); !status.ok()) return status;
    counts.push_back(gush.emitted());
    const GushFigures figures = figuresOf(gush.body(), gush.world().description());
    for (std::size_t f = 0; f < samples.size(); ++f) samples[f].push_back(figures[f]);
  }
  for (std::size_t f = 0; f < samples.size(); ++f) {
    double sum = 0.0;
    for (const double value : samples[f]) sum += value;
    run.figures[f] = {.value = sum / kSamples, .scatter = scatterAboutTrend(counts, samples[f])};
  }
  return {};
}

/// `threads`: of each step.
Fig5Run runOne(const sph::WorldDescription& scene, const PaperOptions& options, int threads, const std::string& model,
               char letter) {
  Fig5Run run;
  run.model = model;
  run.letter = letter;
  auto gush = Gush::create(scene, {.threads = threads, .simd = options.simd}, options.particles);
  if (!gush) {
    run.failure = gush.status().message();
    return run;
  }
  if (Status status = measure(*gush, options.particles, run); !status.ok()) run.failure = status.message();
  run.platelet_change = gush->plateletChange();
  const GushBody body = gush->body();
  run.time = gush->world().time();
  run.emitted = gush->emitted();
  run.lost = run.emitted - std::min(run.emitted, gush->present());
  run.positions.assign(body.positions.begin(), body.positions.end());
  const GushSource source = sourceOf(scene);
  run.profile = heightProfile(run.positions, {.spacing = scene.spacing, .draw_radius = 0.0, .ground = source.z}, source.x,
                              source.y, 2.0 * scene.spacing, kRings);
  return run;
}

/// One view for all runs of a model, as wide as the median footprint needs: runs whose particles fly about do not shrink the
/// others.
BodyView viewOf(const std::vector<Fig5Run>& runs, const sph::WorldDescription& scene) {
  std::vector<double> radii;
  double height = 0.0;
  for (const Fig5Run& run : runs) {
    const Footprint footprint = footprintOf(run.positions, {.spacing = scene.spacing, .draw_radius = 0.0, .ground = 0.0});
    radii.push_back(footprint.equivalent_radius);
    height = std::max(height, footprint.mean_height);
  }
  std::sort(radii.begin(), radii.end());
  const GushSource source = sourceOf(scene);
  BodyView view;
  view.center = {source.x, source.y, source.z};
  view.radius = std::max(4.0 * scene.spacing, radii.empty() ? 0.0 : 1.25 * radii[radii.size() / 2]);
  view.height = std::min(std::max(4.0 * scene.spacing, 2.0 * height), view.radius);
  return view;
}

Status drawRuns(const std::vector<Fig5Run>& runs, const std::string& model, const sph::WorldDescription& scene,
                const PaperOptions& options) {
  std::vector<Fig5Run> own;
  for (const Fig5Run& run : runs) {
    if (run.model == model && !run.positions.empty()) own.push_back(run);
  }
  if (own.empty()) return {};
  const BodyView view = viewOf(own, scene);
  std::vector<picture::Image> images;
  for (const Fig5Run& run : own) {
    auto image = drawBody(run.positions, scene, view);
    if (!image) return image.status();
    images.push_back(std::move(*image));
  }
  std::vector<picture::SheetItem> items;
  for (std::size_t k = 0; k < own.size(); ++k) {
    const auto* variant = std::find_if(kFig5Variants.begin(), kFig5Variants.end(),
                                       [&](const Fig5Variant& one) { return one.letter == own[k].letter; });
    items.push_back(
        {.image = &images[k],
         .caption = fmt::format("({}) {}{}", own[k].letter, variant->title, own[k].failure.empty() ? "" : ": failed")});
  }
  picture::SheetStyle style;
  style.columns = 3;
  style.lettered = false;
  style.title = fmt::format("Fig. 5, {} model, {} particles", model, options.particles);
  auto sheet = picture::contactSheet(items, style);
  if (!sheet) return sheet.status();
  if (Status status = writePicture(options, "fig5_" + model, *sheet); !status.ok()) return status;

  picture::LinePlot plot;
  plot.title = fmt::format("Fig. 5: height about the wound, {} model", model);
  plot.x.label = "distance from the wound's axis, mm";
  plot.y.label = "mean height, mm";
  for (const Fig5Run& run : own) {
    picture::Series series{.name = fmt::format("({})", run.letter), .style = picture::SeriesStyle::line, .x = {}, .y = {}};
    for (std::size_t k = 0; k < run.profile.radius.size(); ++k) {
      series.x.push_back(1e3 * run.profile.radius[k]);
      series.y.push_back(1e3 * run.profile.height[k]);
    }
    plot.series.push_back(std::move(series));
  }
  return writeLinePlot(options, "fig5_profile_" + model, plot);
}

nlohmann::json toJson(const Fig5Run& run) {
  nlohmann::json json{{"model", run.model},
                      {"run", std::string(1, run.letter)},
                      {"emitted", run.emitted},
                      {"left_domain", run.lost},
                      {"time_s", run.time}};
  if (run.platelet_change) json["platelet_change"] = *run.platelet_change;
  if (!run.failure.empty()) {
    json["failure"] = run.failure;
    return json;
  }
  nlohmann::json figures = nlohmann::json::object();
  for (std::size_t f = 0; f < run.figures.size(); ++f) {
    figures[std::string{infoOf(static_cast<GushFigure>(f)).name}] = {{"value", run.figures[f].value},
                                                                     {"scatter", run.figures[f].scatter}};
  }
  json["figures"] = std::move(figures);
  json["profile"] = {{"radius_m", run.profile.radius}, {"height_m", run.profile.height}};
  return json;
}

std::string tableOf(const std::vector<Fig5Run>& runs) {
  std::string text = fmt::format("{:<18}", "");
  for (const Fig5Run& run : runs) text += fmt::format(" {:>11}", fmt::format("{} ({})", run.model, run.letter));
  text += '\n';
  for (std::size_t f = 0; f < static_cast<std::size_t>(GushFigure::count); ++f) {
    const GushFigureInfo& info = infoOf(static_cast<GushFigure>(f));
    text += fmt::format("{:<18}", info.title);
    for (const Fig5Run& run : runs)
      text += fmt::format(" {:>11}", run.failure.empty() ? fmt::format("{:.4g}", info.scale * run.figures[f].value) : "-");
    text += '\n';
  }
  text += fmt::format("{:<18}", "left the domain");
  for (const Fig5Run& run : runs) text += fmt::format(" {:>11}", run.lost);
  text += '\n';
  for (const Fig5Run& run : runs) {
    if (!run.failure.empty()) text += fmt::format("{} ({}): no figures: {}\n", run.model, run.letter, run.failure);
  }
  return text;
}

}  // namespace

sph::EffectSettings effectsOf(const sph::EffectSettings& scene, const Fig5Variant& variant) {
  sph::EffectSettings effects = scene;
  if (!variant.tension) effects.surface_tension.reset();
  if (!variant.platelets) effects.platelets.reset();
  if (!variant.radius) effects.core_radius.reset();
  if (!variant.repulsion) effects.repulsion.reset();
  return effects;
}

Result<std::vector<Fig5Run>> runFig5Variants(const PaperOptions& options, const ProgressReport& progress) {
  struct Job {
    sph::WorldDescription world;
    std::string model;
    char letter;
  };
  std::vector<Job> jobs;
  for (const ModelFace& face : facesOf(options.model)) {
    const auto scene = loadFace(options, "fig5", face);
    if (!scene) return scene.status();
    for (const Fig5Variant& variant : kFig5Variants) {
      jobs.push_back({*scene, face.name, variant.letter});
      jobs.back().world.effects = effectsOf(scene->effects, variant);
    }
  }
  std::vector<Fig5Run> runs(jobs.size());
  const int threads = std::max(1, options.threads / static_cast<int>(jobs.size()));
  runSideBySide(
      jobs.size(), options.threads,
      [&](std::size_t k) { runs[k] = runOne(jobs[k].world, options, threads, jobs[k].model, jobs[k].letter); },
      [&](std::size_t done) { progress(static_cast<double>(done) / static_cast<double>(jobs.size())); });
  const bool none = std::all_of(runs.begin(), runs.end(), [](const Fig5Run& run) { return !run.failure.empty(); });
  if (none) return Status{StatusCode::internal, "no run of Fig. 5 came to its end; the first one: " + runs.front().failure};
  return runs;
}

Result<PaperReport> runFig5(const PaperOptions& options, const ProgressReport& progress) {
  const auto runs = runFig5Variants(options, progress);
  if (!runs) return runs.status();
  const std::vector<Claim> claims = judgeFig5(*runs);
  PaperReport report;
  report.json = {{"experiment", "fig5"},
                 {"particles", options.particles},
                 {"runs", nlohmann::json::array()},
                 {"claims", nlohmann::json::array()}};
  for (const Fig5Run& run : *runs) report.json["runs"].push_back(toJson(run));
  for (const Claim& claim : claims) report.json["claims"].push_back(toJson(claim));
  report.text = fmt::format("Fig. 5, {} particles\n{}\n", options.particles, tableOf(*runs));
  for (const Claim& claim : claims) report.text += toText(claim);
  if (options.folder.empty()) return report;
  for (const ModelFace& face : facesOf(options.model)) {
    const auto scene = loadFace(options, "fig5", face);
    if (!scene) return scene.status();
    if (Status status = drawRuns(*runs, face.name, *scene, options); !status.ok()) return status;
  }
  return report;
}

}  // namespace bleedsim::lab
