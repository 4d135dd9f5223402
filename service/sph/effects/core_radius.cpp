#include "service/sph/effects/core_radius.h"

#include "service/sph/cube_root.h"
#include "service/sph/rest_lattice.h"
#include "service/sph/share_range.h"

namespace bleedsim::sph {

template <class Real>
LatticeFactors<Real>::LatticeFactors(const SmoothingKernel& kernel, double spacing, const RadiusBounds& bounds) : scale_{bounds} {
  const RestLattice at_h = calibrateRestLattice(kernel, spacing, 1.0);
  const auto nodes = radiusNodes(bounds);
  for (std::size_t k = 0; k < kRadiusNodes; ++k) {
    const RestLattice own = calibrateRestLattice({kernel.type, nodes[k] * kernel.h}, spacing, 1.0, kernel.h);
    mass_[k] = static_cast<Real>(own.particle_mass / at_h.particle_mass);
    viscosity_[k] = static_cast<Real>(own.viscosity_factor / at_h.viscosity_factor);
  }
}

template <class Real>
CoreRadius<Real>::CoreRadius(const CoreRadiusSettings& settings, double rest_density, int shares)
    : smallest_{static_cast<Real>(settings.smallest)},
      largest_{static_cast<Real>(settings.largest)},
      relaxation_{static_cast<Real>(settings.relaxation)},
      least_ratio_{smallest_ * smallest_ * smallest_},
      most_ratio_{largest_ * largest_ * largest_},
      rest_density_{static_cast<Real>(rest_density)},
      largest_of_share_(static_cast<std::size_t>(shares)) {}

template <class Real>
Real CoreRadius<Real>::update(Particles<Real>& p, const Real* density, std::uint32_t count, int shares, Executor& executor) {
  executor.run(shares, [&](int share) {
    const ShareRange range{count, share, shares};
    Real most = Real(1);
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      if (p.driver[i] != 0) continue;
      const Real volume = Real(1) / (Real(1) + followed(density[i] / rest_density_ - Real(1)));
      const Real ratio = std::min(std::max(least_ratio_, volume), most_ratio_);
      const Real moved = p.radius[i] + relaxation_ * (cubeRoot(ratio) - p.radius[i]);
      p.radius[i] = std::min(std::max(smallest_, moved), largest_);
      most = std::max(most, p.radius[i]);
    }
    largest_of_share_[static_cast<std::size_t>(share)].radius = most;
  });
  Real most = Real(1);
  for (int share = 0; share < shares; ++share) most = std::max(most, largest_of_share_[static_cast<std::size_t>(share)].radius);
  return most;
}

template class LatticeFactors<float>;
template class LatticeFactors<double>;
template class CoreRadius<float>;
template class CoreRadius<double>;

}  // namespace bleedsim::sph
