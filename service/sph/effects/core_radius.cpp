#include "service/sph/effects/core_radius.h"

#include "service/sph/cube_root.h"
#include "service/sph/rest_lattice.h"

namespace bleedsim::sph {

constexpr double kArrived = 1e-5;  // so near to the radius that it goes to, over h, a particle is there

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
      mover_{shares} {}

template <class Real>
Real CoreRadius<Real>::update(Particles<Real>& p, const Real* density, std::uint32_t count, int shares, Executor& executor) {
  const auto law = [smallest = smallest_, largest = largest_, relaxation = relaxation_, least = least_ratio_, most = most_ratio_,
                    rest = rest_density_](Real rho, Real radius) {
    const Real volume = Real(1) / (Real(1) + followed(rho / rest - Real(1)));
    const Real wanted = cubeRoot(std::min(std::max(least, volume), most));
    const Real moved = radius + relaxation * (wanted - radius);
    // A radius that stays a rounding away from h for ever would be packed with divisions in every step.
    const Real reached = std::abs(moved - wanted) < static_cast<Real>(kArrived) ? wanted : moved;
    return std::min(std::max(smallest, reached), largest);
  };
  return mover_.move(p, density, count, shares, executor, law);
}

template class LatticeFactors<float>;
template class LatticeFactors<double>;
template class CoreRadius<float>;
template class CoreRadius<double>;

}  // namespace bleedsim::sph
