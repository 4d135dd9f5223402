#include "service/lab/bench/still_block.h"

#include <algorithm>
#include <cmath>

namespace bleedsim::lab {
namespace {

constexpr double kSpacing = 0.001;  // m
constexpr double kAround = 10.0;    // spacings between the block and the domain's sides

void addPaperEffects(sph::WorldDescription& block) {
  block.model = sph::Model::literal;
  block.literal.pressure = sph::PressureForm::variational;
  block.literal.repulsion = 1e-13;  // N m^2: 60 m/s^2 between the nearest pairs
  block.literal.contact_radius = 0.45;
  block.effects.surface_tension.emplace();
  block.effects.platelets.emplace();
  block.effects.repulsion.emplace();
}

void addSoundEffects(sph::WorldDescription& block) {
  block.effects.surface_tension.emplace();
  block.effects.platelets.emplace();
  block.effects.core_radius.emplace();
  block.effects.repulsion.emplace();
  block.effects.repulsion->strength = 1e-4;
  block.effects.repulsion->damping = 1e-4;
  block.effects.viscosity->solve = sph::ViscositySolve::explicit_;
}

}  // namespace

const std::vector<std::string>& blockModelNames() {
  static const std::vector<std::string> kNames{"paper", "reduced", "full"};
  return kNames;
}

BlockModel blockModelOf(const std::string& name) {
  const auto& names = blockModelNames();
  return static_cast<BlockModel>(std::find(names.begin(), names.end(), name) - names.begin());
}

sph::WorldDescription stillBlock(BlockModel model, std::uint32_t particles) {
  const double side = std::max(1.0, std::round(std::cbrt(static_cast<double>(particles))));
  const sph::Vec3 size = sph::Vec3::Constant(side * kSpacing);
  sph::WorldDescription block;
  block.spacing = kSpacing;
  block.support_ratio = 2.0;
  block.rest_density = 1000.0;
  block.domain.lower = sph::Vec3::Constant(-kAround * kSpacing);
  block.domain.upper = size + sph::Vec3::Constant(kAround * kSpacing);
  block.capacity = static_cast<std::uint32_t>(side * side * side);
  block.compressibility = {.mach_factor = 10.0, .design_speed = 0.1, .max_fall_or_depth = 0.0};
  block.max_dt = kBlockStep;
  block.effects.gravity.emplace();
  block.effects.pressure.emplace();
  block.effects.viscosity.emplace();
  block.effects.viscosity->viscosity = 0.004;
  if (model == BlockModel::paper) addPaperEffects(block);
  if (model == BlockModel::full) addSoundEffects(block);
  sph::FluidBlock fluid;
  fluid.upper = size;
  fluid.jitter = 0.3;
  block.fluid_blocks = {fluid};
  return block;
}

}  // namespace bleedsim::lab
