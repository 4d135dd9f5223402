// What Fig. 2 says: its sentences, its sheet of pictures and its table.
#include <algorithm>
#include <fmt/format.h>
#include <utility>

#include "service/lab/paper/intruders.h"
#include "service/lab/paper/model_choice.h"
#include "service/lab/paper/paper_files.h"
#include "service/picture/scene_picture.h"

namespace bleedsim::lab {
namespace {

struct Column {
  const char* json;
  const char* title;
  double IntruderFigures::*figure;
  bool length;  ///< shown in spacings
};
constexpr std::array kColumns{
    Column{"edge_moved_m", "edge", &IntruderFigures::edge_moved, true},
    Column{"inner_moved_m", "inner", &IntruderFigures::inner_moved, true},
    Column{"block_moved_m", "block", &IntruderFigures::block_moved, true},
    Column{"intruders_moved_m", "intruders", &IntruderFigures::intruders_moved, true},
    Column{"overlap_m2", "overlap mm2", &IntruderFigures::overlap, false},
    Column{"overlap_time_s", "at s", &IntruderFigures::overlap_time, false},
    Column{"momentum_drift", "momentum", &IntruderFigures::momentum_drift, false},
};

nlohmann::json toJson(const IntruderRun& run, const std::string& model) {
  nlohmann::json json{{"model", model},
                      {"run", run.name},
                      {"intruders", run.intruders},
                      {"repulsion", run.repulsion},
                      {"failure", run.failure},
                      {"time_s", run.figure(&IntruderFigures::time).value},
                      {"seeds", run.figures.size()}};
  nlohmann::json figures = nlohmann::json::object();
  for (const Column& column : kColumns) {
    const Measured measured = run.figure(column.figure);
    figures[column.json] = {{"value", measured.value}, {"scatter", measured.scatter}};
  }
  json["figures"] = std::move(figures);
  return json;
}

std::string tableOf(const std::vector<IntruderRun>& runs, const std::string& model, double spacing) {
  std::string text = fmt::format("{:<8} {:<26}", model, "run");
  for (const Column& column : kColumns) text += fmt::format(" {:>17}", column.title);
  text += '\n';
  for (const IntruderRun& run : runs) {
    text += fmt::format("{:<8} {:<26}", "", run.name);
    for (const Column& column : kColumns) {
      const double unit = column.length ? spacing : (column.figure == &IntruderFigures::overlap ? 1e-6 : 1.0);
      const Measured measured = run.figure(column.figure);
      text += fmt::format(" {:>17}", fmt::format("{:.3g} +- {:.2g}", measured.value / unit, measured.scatter / unit));
    }
    text += run.failure.empty() ? "\n" : "  " + run.failure + '\n';
  }
  return text;
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
    captions.push_back(fmt::format("{}, {:.3g} s", run.name, run.pictured_time));
  }
  std::vector<picture::SheetItem> items;
  for (std::size_t k = 0; k < images.size(); ++k) items.push_back({.image = &images[k], .caption = captions[k]});
  picture::SheetStyle style;
  style.columns = 2;
  style.title = fmt::format("Fig. 2, {} model: a block in two dimensions, at rest and while intruders pass", model);
  auto sheet = picture::contactSheet(items, style);
  if (!sheet) return sheet.status();
  return writePicture(options, "fig2_" + model, *sheet);
}

}  // namespace

std::vector<Claim> judgeIntruders(const std::vector<IntruderRun>& runs, double spacing, const std::string& model) {
  const auto find = [&](bool intruders, bool repulsion) -> const IntruderRun* {
    for (const IntruderRun& run : runs) {
      if (run.intruders == intruders && run.repulsion == repulsion && run.failure.empty()) return &run;
    }
    return nullptr;
  };
  using Figure = double IntruderFigures::*;
  const auto value = [&](const IntruderRun* run, Figure figure, double unit) -> std::optional<Measured> {
    if (run == nullptr) return std::nullopt;
    const Measured measured = run->figure(figure);
    return Measured{measured.value / unit, measured.scatter / unit};
  };
  // Seed by seed, so that what one block does anyhow cancels.
  const auto beyond = [&](const IntruderRun* run, const IntruderRun* undisturbed) -> std::optional<Measured> {
    if (run == nullptr || undisturbed == nullptr) return std::nullopt;
    std::vector<double> differences;
    for (std::size_t k = 0; k < run->passage.size(); ++k)
      differences.push_back((run->passage[k].inner_moved - undisturbed->passage[k].inner_moved) / spacing);
    return meanOf(differences);
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
      claim("without (36) fast particles overlap the block's", "largest overlap of intruders and block while they pass, mm^2",
            "with (36)", value(repelled, &IntruderFigures::overlap, 1e-6), "without",
            value(bare, &IntruderFigures::overlap, 1e-6), Direction::larger),
      claim("without (36) fast particles pass through", "intruders moved, spacings", "with (36)",
            value(repelled, &IntruderFigures::intruders_moved, spacing), "without",
            value(bare, &IntruderFigures::intruders_moved, spacing), Direction::larger),
      claim("without (36) the block is moved less than with it", "block's centre moved, spacings", "with (36)",
            value(repelled, &IntruderFigures::block_moved, spacing), "without",
            value(bare, &IntruderFigures::block_moved, spacing), Direction::smaller),
      claim("(36) changes the block's structure", "inner particles moved beyond those at rest so far, spacings", "with (36)",
            beyond(repelled, find(false, true)), "without", beyond(bare, rest), Direction::smaller),
  };
}

Result<PaperReport> runFig2(const PaperOptions& options, const ProgressReport& progress) {
  PaperReport report;
  report.json = {{"experiment", "fig2"},
                 {"duration_s", options.duration},
                 {"seeds", kIntruderSeeds},
                 {"runs", nlohmann::json::array()},
                 {"claims", nlohmann::json::array()}};
  report.text = fmt::format(
      "Fig. 2, two dimensions; lengths in spacings, overlap the largest during the passage; {} seeds, mean +- "
      "standard error\n",
      kIntruderSeeds);
  const std::vector<ModelFace> faces = facesOf(options.model);
  std::vector<Claim> claims;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto world = loadFace(options, "fig2", faces[f]);
    if (!world) return world.status();
    const auto parts = static_cast<double>(faces.size());
    const auto runs = runIntruders(*world, options, [&](double part) { progress((static_cast<double>(f) + part) / parts); });
    if (!runs) return runs.status();
    report.text += tableOf(*runs, faces[f].name, world->spacing);
    for (const IntruderRun& run : *runs) report.json["runs"].push_back(toJson(run, faces[f].name));
    std::vector<Claim> own = judgeIntruders(*runs, world->spacing, faces[f].name);
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
