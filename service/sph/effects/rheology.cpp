#include "service/sph/effects/rheology.h"

#include <algorithm>
#include <string>

#include "service/sph/share_range.h"

namespace bleedsim::sph {
namespace {

Status refusal(const char* name, double value, const char* allowed) {
  return {StatusCode::invalid_argument, std::string{name} + " is " + std::to_string(value) + "; it must be " + allowed};
}

bool isPositive(double value) { return value > 0.0 && std::isfinite(value); }

Status checkLaw(const NewtonianRheology&) { return {}; }

Status checkLaw(const CarreauYasudaRheology& law) {
  constexpr const char* kPositive = "a finite number greater than 0";
  if (!isPositive(law.zero_shear)) return refusal("the viscosity at rest of Carreau-Yasuda's law", law.zero_shear, kPositive);
  if (!isPositive(law.infinite_shear)) {
    return refusal("the viscosity at high shear of Carreau-Yasuda's law", law.infinite_shear, kPositive);
  }
  if (!isPositive(law.time)) return refusal("the time of Carreau-Yasuda's law", law.time, kPositive);
  if (!isPositive(law.transition)) return refusal("the transition of Carreau-Yasuda's law", law.transition, kPositive);
  if (!(law.power > 0.0 && law.power <= 1.0)) {
    return refusal("the power of Carreau-Yasuda's law", law.power, "greater than 0 and at most 1");
  }
  return {};
}

Status checkLaw(const CassonRheology& law) {
  constexpr const char* kPositive = "a finite number greater than 0";
  if (!isPositive(law.viscosity)) return refusal("the viscosity of Casson's law", law.viscosity, kPositive);
  if (!isPositive(law.regularisation_shear_rate)) {
    return refusal("the regularisation shear rate of Casson's law", law.regularisation_shear_rate, kPositive);
  }
  if (!(law.yield_stress >= 0.0) || !std::isfinite(law.yield_stress)) {
    return refusal("the yield stress of Casson's law", law.yield_stress, "finite and not negative");
  }
  return {};
}

}  // namespace

Status checkRheology(const ViscositySettings& settings) {
  return std::visit([](const auto& law) { return checkLaw(law); }, settings.rheology);
}

template <class Real>
EffectiveViscosity<Real>::EffectiveViscosity(const EffectSettings& effects, int shares)
    : settings_{*effects.viscosity}, largest_(static_cast<std::size_t>(shares)) {
  if (effects.platelets) clot_ = static_cast<Real>(effects.platelets->clot_viscosity);
}

template <class Real>
double EffectiveViscosity<Real>::update(Particles<Real>& p, PairPasses<Real>& passes, const Real* shear_rate, std::uint32_t count,
                                        int shares, Executor& executor) {
  executor.run(shares, [&](int share) {
    const ShareRange range{count, share, shares};
    Real& largest = largest_[static_cast<std::size_t>(share)];
    if (const auto* carreau = std::get_if<CarreauYasudaRheology>(&settings_.rheology)) {
      largest =
          updateRange(p, passes, range.begin, range.end, [&](std::uint32_t i) { return viscosityAt(*carreau, shear_rate[i]); });
    } else if (const auto* casson = std::get_if<CassonRheology>(&settings_.rheology)) {
      largest =
          updateRange(p, passes, range.begin, range.end, [&](std::uint32_t i) { return viscosityAt(*casson, shear_rate[i]); });
    } else {
      const Real viscosity = static_cast<Real>(settings_.viscosity);
      largest = updateRange(p, passes, range.begin, range.end, [viscosity](std::uint32_t) { return viscosity; });
    }
  });
  return static_cast<double>(*std::max_element(largest_.begin(), largest_.begin() + shares));
}

template <class Real>
template <class FreshAt>
Real EffectiveViscosity<Real>::updateRange(Particles<Real>& p, PairPasses<Real>& passes, std::uint32_t begin, std::uint32_t end,
                                           const FreshAt& fresh_at) const {
  Real largest = 0;
  for (std::uint32_t i = begin; i < end; ++i) {
    const Real own = p.own_viscosity.empty() ? Real(0) : p.own_viscosity[i];
    Real viscosity = own > Real(0) ? own : fresh_at(i);
    if (clot_) viscosity = thickened(viscosity, *clot_, p.platelet[i]);
    p.inverse_viscosity[i] = Real(1) / viscosity;
    passes.setInverseViscosity(i, p.inverse_viscosity[i]);
    largest = std::max(largest, viscosity);
  }
  return largest;
}

template class EffectiveViscosity<float>;
template class EffectiveViscosity<double>;

}  // namespace bleedsim::sph
