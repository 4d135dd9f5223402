#include "service/lab/paper/gush_figures.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>
#include <vector>

#include "service/lab/footprint.h"
#include "service/lab/spread.h"

namespace bleedsim::lab {
namespace {

constexpr std::array<GushFigureInfo, static_cast<std::size_t>(GushFigure::count)> kInfo{{
    {"area_m2", "area cm2", 1e4},
    {"serration", "serration", 1.0},
    {"roughness_m", "roughness mm", 1e3},
    {"sphericity", "sphericity", 1.0},
    {"mean_height_m", "height mm", 1e3},
    {"height_at_source_m", "source height mm", 1e3},
    {"gush_width_m", "gush width mm", 1e3},
    {"nearest_m", "nearest mm", 1e3},
    {"nearest_percentile_m", "nearest 1 % mm", 1e3},
    {"pieces", "pieces", 1.0},
    {"alone_share", "alone %", 1e2},
}};

std::vector<float> risingFasterThan(double speed, const GushBody& body) {
  std::vector<float> positions;
  for (std::size_t i = 0; i < body.count(); ++i) {
    if (static_cast<double>(body.velocities[3 * i + 2]) <= speed) continue;
    const auto own = body.positions.subspan(3 * i, 3);
    positions.insert(positions.end(), own.begin(), own.end());
  }
  return positions;
}

}  // namespace

const GushFigureInfo& infoOf(GushFigure figure) { return kInfo[static_cast<std::size_t>(figure)]; }

GushSource sourceOf(const sph::WorldDescription& scene) {
  const sph::WoundDescription& wound = scene.wounds.front();
  GushSource source{.x = wound.position.x(),
                    .y = wound.position.y(),
                    .z = wound.position.z(),
                    .radius = 4.0 * scene.spacing,
                    .exit_speed = 0.0};
  if (const auto* disc = std::get_if<sph::DiscPatch>(&wound.shape)) source.radius = disc->radius;
  if (const auto* ellipse = std::get_if<sph::EllipsePatch>(&wound.shape))
    source.radius = std::sqrt(ellipse->semi_axis_u * ellipse->semi_axis_v);
  if (const auto* drive = std::get_if<sph::FlowDrive>(&wound.drive))
    source.exit_speed = drive->flow / (std::numbers::pi * source.radius * source.radius);
  return source;
}

GushFigures figuresOf(const GushBody& body, const sph::WorldDescription& scene) {
  const GushSource source = sourceOf(scene);
  const double dx = scene.spacing;
  const FootprintOptions options{.spacing = dx, .draw_radius = 0.0, .ground = source.z};
  const Footprint footprint = footprintOf(body.positions, options);
  const HeightProfile profile = heightProfile(body.positions, options, source.x, source.y, source.radius, 2);
  const NeighborDistances distances = neighborDistances(body.positions, scene.supportRadius());
  const std::vector<float> rising = risingFasterThan(0.5 * source.exit_speed, body);
  const double count = std::max(1.0, static_cast<double>(body.count()));

  GushFigures figures{};
  const auto set = [&](GushFigure figure, double value) { figures[static_cast<std::size_t>(figure)] = value; };
  set(GushFigure::area, footprint.area);
  set(GushFigure::serration, footprint.serration);
  set(GushFigure::roughness, footprint.roughness);
  set(GushFigure::sphericity, footprint.sphericity);
  set(GushFigure::mean_height, footprint.mean_height);
  set(GushFigure::height_at_source, profile.height[1]);
  set(GushFigure::gush_width, gushWidth(rising, {.center_x = source.x,
                                                 .center_y = source.y,
                                                 .lower = source.z + dx,
                                                 .upper = source.z + 3.0 * dx,
                                                 .reach = 2.0 * source.radius}));
  set(GushFigure::nearest, distances.smallest);
  set(GushFigure::nearest_percentile, distances.first_percentile);
  set(GushFigure::pieces, footprint.pieces);
  set(GushFigure::alone, distances.alone / count);
  return figures;
}

}  // namespace bleedsim::lab
