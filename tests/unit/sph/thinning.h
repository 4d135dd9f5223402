// Shear rates read back through the viscosity of a frame: a Carreau law that falls strictly has one shear rate for each
// viscosity.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "service/sph/effects/rheology.h"
#include "tests/support/scenes.h"

namespace bleedsim::sph {

inline CarreauYasudaRheology steepLaw() {
  return {.zero_shear = 1.0, .infinite_shear = 1e-6, .time = 10.0, .power = 0.1, .transition = 2.0};
}

/// g of steepLaw()'s viscosity, 1/s. A float's rounding of mu, 6e-8, is 1e-7 of g for g > 1 and 4e-5 1/s near g = 0.
inline double shearRateAt(double viscosity) {
  const CarreauYasudaRheology law = steepLaw();
  const double thinned = (viscosity - law.infinite_shear) / (law.zero_shear - law.infinite_shear);
  return std::sqrt(std::max(0.0, std::pow(thinned, law.transition / (law.power - 1.0)) - 1.0)) / law.time;
}

/// Cuts the description's only block into cubes of one particle, each with the velocity of `field` at its middle.
inline WorldDescription withFlow(WorldDescription description, const std::function<Vec3(const Vec3&)>& field) {
  const FluidBlock whole = description.fluid_blocks.at(0);
  description.effects.viscosity->rheology = steepLaw();
  description.fluid_blocks.clear();
  const double dx = description.spacing;
  const Vec3 counts = ((whole.upper - whole.lower) / dx).array().round();
  for (int k = 0; k < counts.z(); ++k) {
    for (int j = 0; j < counts.y(); ++j) {
      for (int i = 0; i < counts.x(); ++i) {
        FluidBlock one = whole;
        one.lower = whole.lower + dx * Vec3{double(i), double(j), double(k)};
        one.upper = one.lower + Vec3::Constant(dx);
        one.velocity = field(one.lower + Vec3::Constant(0.5 * dx));
        description.fluid_blocks.push_back(one);
      }
    }
  }
  return description;
}

/// Of every particle of a world that has not moved yet: visit(position in m, shear rate in 1/s).
inline void forEachShearRate(const World& world, const std::function<void(const Vec3&, double)>& visit) {
  const FrameBuffer frame = test::frameOf(world);
  for (std::size_t i = 0; i < frame.count; ++i) visit(test::positionOf(frame, i), shearRateAt(double(frame.viscosity[i])));
}

}  // namespace bleedsim::sph
