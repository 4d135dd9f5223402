#include "service/scene/convert.h"

#include "service/scene/convert_effects.h"
#include "service/scene/effect_names.h"
#include "service/scene/fill_defaults.h"
#include "service/status/units.h"

namespace bleedsim::scene {
namespace {

sph::Vec3 toVec3(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

std::vector<sph::Vec2> toPoints(const google::protobuf::RepeatedPtrField<Vec2>& points) {
  std::vector<sph::Vec2> result;
  result.reserve(static_cast<std::size_t>(points.size()));
  for (const Vec2& point : points) result.emplace_back(point.u(), point.v());
  return result;
}

sph::TissueDescription toTissue(const Tissue& tissue) {
  sph::TissueDescription result;
  result.name = tissue.name();
  result.slip = tissue.slip();
  if (tissue.has_box()) {
    const BoxTissue& box = tissue.box();
    result.shape = sph::BoxShape{.lower = toVec3(box.lower_m()),
                                 .upper = toVec3(box.upper_m()),
                                 .obstacle = box.side() == BoxTissue::OBSTACLE,
                                 .open_top = box.open_top()};
  } else if (tissue.has_bowl()) {
    const BowlTissue& bowl = tissue.bowl();
    result.shape = sph::BowlShape{toVec3(bowl.rim_center_m()), bowl.sphere_radius_m(), bowl.depth_m()};
  } else {
    result.shape = sph::PlaneShape{toVec3(tissue.plane().point_m()), toVec3(tissue.plane().normal()).normalized()};
  }
  return result;
}

sph::PatchShape toPatch(const Wound& wound) {
  switch (wound.shape_case()) {
    case Wound::kEllipse:
      return sph::EllipsePatch{wound.ellipse().semi_axis_u_m(), wound.ellipse().semi_axis_v_m()};
    case Wound::kPolygon:
      return sph::PolygonPatch{toPoints(wound.polygon().points_m())};
    case Wound::kPolyline:
      return sph::PolylinePatch{toPoints(wound.polyline().points_m()), wound.polyline().width_m()};
    case Wound::kDisc:
    case Wound::SHAPE_NOT_SET:
      break;
  }
  return sph::DiscPatch{wound.disc().radius_m()};
}

sph::WoundDrive toDrive(const Wound& wound) {
  if (wound.has_pressure()) {
    return sph::PressureDriveSettings{.inlet_pressure = pascalsFromMmHg(wound.pressure().inlet_pressure_mmhg()),
                                      .discharge_coefficient = wound.pressure().discharge_coefficient()};
  }
  return sph::FlowDrive{cubicMetresFromMl(wound.flow_ml_per_s())};
}

sph::WoundDescription toWound(const Wound& wound) {
  return {.name = wound.name(),
          .position = toVec3(wound.position_m()),
          .normal = toVec3(wound.normal()).normalized(),
          .tangent = toVec3(wound.tangent()),
          .shape = toPatch(wound),
          .drive = toDrive(wound)};
}

sph::FluidBlock toFluidBlock(const FluidBlock& block) {
  sph::FluidBlock result{.lower = toVec3(block.lower_m()),
                         .upper = toVec3(block.upper_m()),
                         .velocity = toVec3(block.velocity_m_per_s()),
                         .jitter = block.jitter(),
                         .viscosity = std::nullopt,
                         .platelet = std::nullopt};
  if (block.has_viscosity_pa_s()) result.viscosity = block.viscosity_pa_s();
  if (block.has_platelet()) result.platelet = block.platelet();
  return result;
}

}  // namespace

sph::Domain convertDomain(const Domain& domain) {
  return {.lower = toVec3(domain.lower_m()),
          .upper = toVec3(domain.upper_m()),
          .periodic = {domain.periodic_x(), domain.periodic_y(), domain.periodic_z()}};
}

sph::WorldDescription convertWorld(const Scene& scene) {
  sph::WorldDescription world;
  world.seed = scene.seed();
  world.domain = convertDomain(scene.domain());
  world.capacity = scene.domain().capacity();
  world.spacing = scene.resolution().spacing_m();
  world.support_ratio = scene.resolution().support_ratio();
  world.rest_density = scene.fluid().density_kg_per_m3();
  world.compressibility = {.mach_factor = scene.compressibility().mach_factor(),
                           .design_speed = scene.compressibility().design_speed_m_per_s(),
                           .max_fall_or_depth = scene.compressibility().max_fall_or_depth_m()};
  const bool spline = scene.resolution().kernel() == Resolution::CUBIC_SPLINE;
  world.kernel = spline ? sph::KernelType::cubic_spline : sph::KernelType::wendland_c2;
  Effects effects = scene.effects();
  if (scene.model() == Scene::LITERAL) fillEffects(effects);  // numbers that this model does not read, but that must be valid
  world.effects = convertEffects(effects, spline);
  for (const Tissue& tissue : scene.tissue()) world.tissue.push_back(toTissue(tissue));
  for (const Wound& wound : scene.wounds()) world.wounds.push_back(toWound(wound));
  for (const FluidBlock& block : scene.fluid_blocks()) world.fluid_blocks.push_back(toFluidBlock(block));
  world.max_wounds = scene.commands().max_wounds();
  if (scene.has_max_dt_s()) world.max_dt = scene.max_dt_s();
  world.planar = scene.domain().planar();
  if (scene.model() == Scene::LITERAL) {
    world.model = sph::Model::literal;
    world.literal = convertLiteral(scene.literal());
  }
  return world;
}

SceneDescription convert(const Scene& scene) {
  return {.name = scene.name(),
          .description = scene.description(),
          .frame_id = scene.frame_id(),
          .world = convertWorld(scene),
          .frame_rate = scene.output().frame_rate_hz(),
          .attributes = convertAttributes(scene.output()),
          .horizon = scene.has_horizon_s() ? std::optional{scene.horizon_s()} : std::nullopt,
          .instrument_expiry = scene.commands().instrument_expiry_s(),
          .normalized_text = {},
          .effects = enabledEffects(scene.effects()),
          .decisions = {},
          .warnings = {},
          .tension_below = 0.0,
          .former_settings = {}};
}

}  // namespace bleedsim::scene
