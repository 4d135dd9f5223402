#include "service/lab/paper/growth.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <variant>

#include "service/lab/footprint.h"
#include "service/lab/height_map.h"
#include "service/lab/paper/body_picture.h"
#include "service/lab/paper/gush.h"
#include "service/lab/paper/gush_figures.h"
#include "service/lab/paper/paper_files.h"
#include "service/lab/paper/paper_scene.h"

namespace bleedsim::lab {
namespace {

constexpr std::uint32_t kPoints = 24;
constexpr std::uint32_t kPictures = 6;  // of the points, evenly

GrowthPoint pointOf(Gush& gush, const std::optional<Rim>& rim) {
  const sph::WorldDescription& scene = gush.world().description();
  const GushBody body = gush.body();
  const Footprint footprint =
      footprintOf(body.positions, {.spacing = scene.spacing, .draw_radius = 0.0, .ground = sourceOf(scene).z});
  GrowthPoint point{.time = gush.world().time(),
                    .particles = gush.emitted(),
                    .area = footprint.area,
                    .largest_height = footprint.largest_height,
                    .covered = {}};
  if (rim) point.covered = coveredPart(body.positions, scene.spacing, *rim);
  return point;
}

Status drawGrowth(const Growth& growth, const sph::WorldDescription& scene, const PaperOptions& options,
                  const std::string& name) {
  const GushSource source = sourceOf(scene);
  const std::optional<Rim> rim = rimOf(scene);
  const GrowthPoint& last = growth.points.back();
  BodyView view;
  view.center = {source.x, source.y, source.z};
  view.radius = rim ? 1.1 * rim->radius : 1.2 * std::sqrt(last.area / std::numbers::pi);
  view.height = std::min(last.largest_height, view.radius);
  view.from_above = rim.has_value();
  std::vector<picture::Image> images;
  for (const std::vector<float>& positions : growth.positions) {
    auto image = drawBody(positions, scene, view);
    if (!image) return image.status();
    images.push_back(std::move(*image));
  }
  std::vector<picture::SheetItem> items;
  for (std::size_t k = 0; k < images.size(); ++k) {
    const GrowthPoint& point = growth.points[growth.pictured[k]];
    items.push_back({.image = &images[k], .caption = fmt::format("{} particles, {:.3f} s", point.particles, point.time)});
  }
  picture::SheetStyle style;
  style.columns = 3;
  style.title =
      name == "fig8" ? "Fig. 8: a round wound at the bottom of a hollow, from above" : "Fig. 6: growth from a round wound";
  auto sheet = picture::contactSheet(items, style);
  if (!sheet) return sheet.status();
  if (Status status = writePicture(options, name, *sheet); !status.ok()) return status;

  picture::LinePlot plot;
  plot.title = "Footprint against time";
  plot.x.label = "time, s";
  plot.y.label = "area, cm^2";
  picture::Series area{.name = "footprint", .style = picture::SeriesStyle::line_with_points, .x = {}, .y = {}};
  for (const GrowthPoint& point : growth.points) {
    area.x.push_back(point.time);
    area.y.push_back(1e4 * point.area);
  }
  plot.series = {std::move(area)};
  return writeLinePlot(options, name + "_area", plot);
}

nlohmann::json toJson(const Growth& growth, const PaperOptions& options, const std::string& name) {
  nlohmann::json points = nlohmann::json::array();
  for (const GrowthPoint& point : growth.points) {
    nlohmann::json row{{"time_s", point.time},
                       {"particles", point.particles},
                       {"area_m2", point.area},
                       {"largest_height_m", point.largest_height}};
    if (point.covered) row["covered_part"] = *point.covered;
    points.push_back(std::move(row));
  }
  nlohmann::json json{{"experiment", name},
                      {"particles", options.particles},
                      {"points", std::move(points)},
                      {"area_by_particles", {{"exponent", growth.area_by_count.exponent}, {"r2", growth.area_by_count.r2}}}};
  if (growth.points.back().covered)
    json["covered_at_particles"] = growth.covered_at ? nlohmann::json(*growth.covered_at) : nlohmann::json(nullptr);
  return json;
}

std::string toText(const Growth& growth, const std::string& name) {
  std::string text = fmt::format("{}: growth\n{:>9} {:>9} {:>10} {:>10} {:>9}\n", name == "fig8" ? "Fig. 8" : "Fig. 6",
                                 "particles", "time s", "area cm2", "highest mm", "covered");
  for (const GrowthPoint& point : growth.points) {
    text += fmt::format("{:>9} {:>9.4f} {:>10.3f} {:>10.2f} {:>9}\n", point.particles, point.time, 1e4 * point.area,
                        1e3 * point.largest_height, point.covered ? fmt::format("{:.1f} %", 1e2 * *point.covered) : "-");
  }
  text += fmt::format("area ~ particles^{:.2f} (R^2 {:.3f}): 1 for a layer of one height, 2/3 for a body that keeps its shape\n",
                      growth.area_by_count.exponent, growth.area_by_count.r2);
  if (growth.points.back().covered) {
    text += growth.covered_at ? fmt::format("\"covered\": holds from {} particles on\n", *growth.covered_at)
                              : fmt::format("\"covered\": does not hold up to {} particles\n", growth.points.back().particles);
  }
  return text;
}

}  // namespace

std::optional<Rim> rimOf(const sph::WorldDescription& scene) {
  for (const sph::TissueDescription& tissue : scene.tissue) {
    if (const auto* bowl = std::get_if<sph::BowlShape>(&tissue.shape)) {
      return Rim{.x = bowl->rim_center.x(),
                 .y = bowl->rim_center.y(),
                 .radius = std::sqrt(bowl->depth * (2.0 * bowl->sphere_radius - bowl->depth))};
    }
  }
  return std::nullopt;
}

double coveredPart(std::span<const float> positions, double spacing, const Rim& rim) {
  const HeightMap map = drawHeightMap(positions, 0.5 * spacing, 0.75 * spacing, 0.0);
  std::size_t covered = 0;
  for (std::size_t row = 0; row < map.rows; ++row) {
    for (std::size_t column = 0; column < map.columns; ++column) {
      if (std::hypot(map.x(column) - rim.x, map.y(row) - rim.y) <= rim.radius && map.covered(column, row)) ++covered;
    }
  }
  const double area = static_cast<double>(covered) * map.cell * map.cell;
  return std::min(1.0, area / (std::numbers::pi * rim.radius * rim.radius));
}

Result<Growth> growBlood(const sph::WorldDescription& scene, const PaperOptions& options, const ProgressReport& progress) {
  auto gush = Gush::create(scene, options.world(), options.particles);
  if (!gush) return gush.status();
  const std::optional<Rim> rim = rimOf(scene);
  Growth growth;
  std::vector<double> counts;
  std::vector<double> areas;
  for (std::uint32_t k = 1; k <= kPoints; ++k) {
    const auto wanted = static_cast<std::uint32_t>(std::uint64_t{options.particles} * k / kPoints);
    if (Status status = gush->growTo(std::max(1u, wanted)); !status.ok()) return status;
    const GrowthPoint point = pointOf(*gush, rim);
    if (point.covered && *point.covered >= kCovered && !growth.covered_at) growth.covered_at = point.particles;
    counts.push_back(point.particles);
    areas.push_back(point.area);
    growth.points.push_back(point);
    if (k % (kPoints / kPictures) == 0) {
      const GushBody body = gush->body();
      growth.positions.emplace_back(body.positions.begin(), body.positions.end());
      growth.pictured.push_back(growth.points.size() - 1);
    }
    progress(static_cast<double>(k) / kPoints);
  }
  growth.area_by_count = fitPower(counts, areas);
  return growth;
}

Result<PaperReport> runGrowth(const PaperOptions& options, const std::string& name, const ProgressReport& progress) {
  const auto scene = loadPaperScene(options, name);
  if (!scene) return scene.status();
  const sph::WorldDescription& world = scene->world;
  const auto growth = growBlood(world, options, progress);
  if (!growth) return growth.status();
  if (!options.folder.empty()) {
    if (Status status = drawGrowth(*growth, world, options, name); !status.ok()) return status;
  }
  return PaperReport{toJson(*growth, options, name), toText(*growth, name)};
}

}  // namespace bleedsim::lab
