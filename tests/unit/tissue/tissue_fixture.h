// The rest lattice and a field over it, for the tests of this folder.
#pragma once

#include <gtest/gtest.h>

#include "service/sph/rest_lattice.h"
#include "service/sph/tissue/tissue_field.h"

namespace bleedsim::sph {

constexpr double kSpacing = 0.001;
constexpr double kRestDensity = 1060.0;

inline ShareSettings settingsFor(double support_ratio) {
  ShareSettings settings;
  settings.kernel.h = support_ratio * kSpacing;
  settings.spacing = kSpacing;
  settings.rest_density = kRestDensity;
  settings.particle_mass = calibrateRestLattice(settings.kernel, kSpacing, kRestDensity).particle_mass;
  return settings;
}

inline TissueDescription tissueOf(TissueShape shape, double slip = 0.0) {
  return {.name = "test", .shape = std::move(shape), .slip = slip};
}

template <class Real>
TissueField<Real> fieldOf(const std::vector<TissueDescription>& tissue, double support_ratio) {
  auto field = TissueField<Real>::create(tissue, settingsFor(support_ratio));
  EXPECT_TRUE(field.ok()) << field.status().message();
  return field.ok() ? std::move(*field) : TissueField<Real>{};
}

/// A stream of points that does not depend on a library's generator.
class PointStream {
 public:
  double next(double from, double to) {
    state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
    return from + (to - from) * static_cast<double>(state_ >> 11) / 9007199254740992.0;
  }
  Vec3 nextPoint(double from, double to) {
    const double x = next(from, to);
    const double y = next(from, to);
    return {x, y, next(from, to)};
  }

 private:
  std::uint64_t state_ = 20240607;
};

}  // namespace bleedsim::sph
