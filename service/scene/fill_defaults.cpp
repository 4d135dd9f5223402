#include "service/scene/fill_defaults.h"

#include <algorithm>
#include <vector>

#include "service/scene/number_walk.h"
#include "service/scene/sound_only.h"
#include "service/sph/effect_settings.h"

namespace bleedsim::scene {
namespace {

void fillVec3(Vec3& vector, double x, double y, double z) {
  vector.set_x(x);
  vector.set_y(y);
  vector.set_z(z);
}

void fillTissue(Tissue& tissue) {
  if (!tissue.has_slip()) tissue.set_slip(0.0);
  if (tissue.has_plane()) tissue.mutable_plane()->mutable_point_m();
  if (tissue.has_bowl()) tissue.mutable_bowl()->mutable_rim_center_m();
}

void fillWound(Wound& wound) {
  wound.mutable_position_m();
  if (!wound.has_normal()) fillVec3(*wound.mutable_normal(), 0.0, 0.0, 1.0);
  const Vec3& tangent = wound.tangent();
  if (wound.has_tangent() && tangent.x() == 0.0 && tangent.y() == 0.0 && tangent.z() == 0.0) wound.clear_tangent();
  if (wound.has_pressure() && !wound.pressure().has_discharge_coefficient()) {
    wound.mutable_pressure()->set_discharge_coefficient(0.61);
  }
}

/// Rising, each once; NONE beside another attribute is kept for the check that refuses it.
void sortAttributes(Output& output) {
  std::vector<int> values{output.attributes().begin(), output.attributes().end()};
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  if (values == std::vector<int>{Output::NONE}) values.clear();
  output.mutable_attributes()->Assign(values.begin(), values.end());
}

void fillLiteral(Literal& literal) {
  const sph::LiteralSettings standard;
  if (!literal.has_pressure()) literal.set_pressure(Literal::SYMMETRIC);
  if (!literal.has_tension_n_per_m()) literal.set_tension_n_per_m(standard.tension);
  if (!literal.has_normal_cutoff()) literal.set_normal_cutoff(standard.normal_cutoff);
  if (!literal.has_thickening_pa_s()) literal.set_thickening_pa_s(standard.thickening);
  if (!literal.has_platelet_diffusivity_m2_per_s()) literal.set_platelet_diffusivity_m2_per_s(standard.platelet_diffusivity);
  if (!literal.has_power_1()) literal.set_power_1(static_cast<std::uint32_t>(standard.power_1));
  if (!literal.has_power_2()) literal.set_power_2(static_cast<std::uint32_t>(standard.power_2));
  if (!literal.has_contact_radius()) literal.set_contact_radius(standard.contact_radius);
}

}  // namespace

void fillDefaults(Scene& scene) {
  if (!scene.has_seed()) scene.set_seed(1);
  if (scene.frame_id().empty()) scene.set_frame_id("bleedsim");
  if (!scene.has_model()) scene.set_model(Scene::SOUND);
  const bool literal = scene.model() == Scene::LITERAL;
  if (literal) fillLiteral(*scene.mutable_literal());
  if (scene.has_resolution()) {
    Resolution& resolution = *scene.mutable_resolution();
    if (!resolution.has_support_ratio()) resolution.set_support_ratio(2.0);
    if (!literal && !resolution.has_kernel()) resolution.set_kernel(Resolution::WENDLAND_C2);
  }
  if (!scene.fluid().has_density_kg_per_m3()) scene.mutable_fluid()->set_density_kg_per_m3(1060.0);
  if (scene.has_compressibility() && !scene.compressibility().has_mach_factor()) {
    scene.mutable_compressibility()->set_mach_factor(10.0);
  }
  const Effects written = scene.effects();
  fillEffects(*scene.mutable_effects());
  if (literal) dropSoundOnlyDefaults(written, *scene.mutable_effects());
  for (Tissue& tissue : *scene.mutable_tissue()) fillTissue(tissue);
  for (Wound& wound : *scene.mutable_wounds()) fillWound(wound);
  for (FluidBlock& block : *scene.mutable_fluid_blocks()) block.mutable_velocity_m_per_s();
  Output& output = *scene.mutable_output();
  if (!output.has_frame_rate_hz()) output.set_frame_rate_hz(60.0);
  sortAttributes(output);
  Commands& commands = *scene.mutable_commands();
  if (!commands.has_instrument_expiry_s()) commands.set_instrument_expiry_s(0.1);
  if (!commands.has_max_wounds()) commands.set_max_wounds(64);
  clearNegativeZeros(scene);
}

}  // namespace bleedsim::scene
