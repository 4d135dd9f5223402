// Viscosity of each particle where it changes with time: by shear rate and by platelets.
//
// Carreau 1972 and Yasuda 1979 with the constants of Cho & Kensey 1991; Casson 1959, regularised after Papanastasiou 1987:
//   Carreau-Yasuda   mu_fresh = mu_inf + (mu_0 - mu_inf) (1 + (lambda g)^a)^((n - 1)/a)
//   Casson           sqrt(mu_fresh) = sqrt(mu_c) + sqrt(tau_y (1 - exp(-g/g_r))/g)
//   Newtonian        mu_fresh = the effect's viscosity
// Equation (26) of the paper, with its a chosen by the fresh blood at hand (physics.md section 3):
//   mu = b exp(-a P)   a = ln(b/mu_fresh)/0.99, so that mu = mu_fresh at P = 0.99 and b at P = 0
// terms: g shear rate 1/s (shear_rate.h); mu Pa s; tau_y Pa; lambda s; P 0 to 1. A block that brings a viscosity of its own has
// it as mu_fresh at any shear rate. Deviation from the paper: it knows no shear thinning, and its a and b are constants without a
// value.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "service/sph/effect_settings.h"
#include "service/sph/executor.h"
#include "service/sph/own_math.h"
#include "service/sph/particles.h"
#include "service/sph/passes/pair_passes.h"
#include "service/status/status.h"

namespace bleedsim::sph {

/// P at which blood has the viscosity of its flow curve.
constexpr double kFreshPlatelet = 0.99;

/// mu_fresh at the shear rate g >= 0 (1/s), Pa s.
template <class Real>
Real viscosityAt(const CarreauYasudaRheology& law, Real g) {
  const Real x = static_cast<Real>(law.time) * g;
  const Real powered = law.transition == 2.0 ? x * x : ownPow(x, static_cast<Real>(law.transition));
  const Real thinned = ownPow(Real(1) + powered, static_cast<Real>((law.power - 1.0) / law.transition));
  return static_cast<Real>(law.infinite_shear) + static_cast<Real>(law.zero_shear - law.infinite_shear) * thinned;
}

template <class Real>
Real viscosityAt(const CassonRheology& law, Real g) {
  const Real x = g / static_cast<Real>(law.regularisation_shear_rate);
  // (1 - exp(-x))/x; by its series where the difference would cancel, to x^5/720 = 1e-13.
  const Real kept = x < Real(0.01)
                        ? Real(1) - x * (Real(0.5) - x * (Real(1) / Real(6) - x * (Real(1) / Real(24) - x / Real(120))))
                        : (Real(1) - ownExp(-x)) / x;
  const Real root = static_cast<Real>(std::sqrt(law.viscosity)) +
                    std::sqrt(static_cast<Real>(law.yield_stress / law.regularisation_shear_rate) * kept);
  return root * root;
}

/// (26): mu at P of blood that has mu_fresh > 0 at P = 0.99 and `clot` > 0 at P = 0, Pa s.
template <class Real>
Real thickened(Real mu_fresh, Real clot, Real platelet) {
  return clot * ownPow(mu_fresh / clot, platelet / static_cast<Real>(kFreshPlatelet));
}

/// The largest mu_fresh: all laws thin with shear.
template <class Real>
Real viscosityAtRest(const ViscositySettings& settings) {
  if (const auto* carreau = std::get_if<CarreauYasudaRheology>(&settings.rheology)) return viscosityAt(*carreau, Real(0));
  if (const auto* casson = std::get_if<CassonRheology>(&settings.rheology)) return viscosityAt(*casson, Real(0));
  return static_cast<Real>(settings.viscosity);
}

/// Whether viscosity depends on the shear rate.
inline bool viscosityThins(const EffectSettings& effects) {
  return effects.viscosity && !std::holds_alternative<NewtonianRheology>(effects.viscosity->rheology);
}

/// Whether particles' viscosity changes while the scene runs.
inline bool viscosityChanges(const EffectSettings& effects) {
  return effects.viscosity && (effects.platelets || viscosityThins(effects));
}

/// invalid_argument with the value and what is allowed.
Status checkRheology(const ViscositySettings& settings);

template <class Real>
class EffectiveViscosity {
 public:
  /// Of a scene in which viscosityChanges().
  EffectiveViscosity(const EffectSettings& effects, int shares);

  /// After density and before forces: gives every particle and its record the 1/mu that acts in this step, and returns the
  /// largest mu, Pa s. `shear_rate` in 1/s may be null where no rheology asks for it.
  double update(Particles<Real>& p, PairPasses<Real>& passes, const Real* shear_rate, std::uint32_t count, int shares,
                Executor& executor);

 private:
  template <class FreshAt>
  Real updateRange(Particles<Real>& p, PairPasses<Real>& passes, std::uint32_t begin, std::uint32_t end,
                   const FreshAt& fresh_at) const;

  ViscositySettings settings_;
  std::optional<Real> clot_;   // b, Pa s
  std::vector<Real> largest_;  // of each share, Pa s
};

extern template class EffectiveViscosity<float>;
extern template class EffectiveViscosity<double>;

}  // namespace bleedsim::sph
