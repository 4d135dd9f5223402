// Fills a PassTable: the list of pair effects and of every set of them that is compiled.
#if defined(BLEEDSIM_SPH_PASSES_MAKE_TABLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BLEEDSIM_SPH_PASSES_MAKE_TABLE_INL_H_
#undef BLEEDSIM_SPH_PASSES_MAKE_TABLE_INL_H_
#else
#define BLEEDSIM_SPH_PASSES_MAKE_TABLE_INL_H_
#endif

#include "service/sph/effects/pressure-inl.h"
#include "service/sph/effects/viscosity-inl.h"
#include "service/sph/passes/density_pass-inl.h"
#include "service/sph/passes/force_pass-inl.h"
#include "service/sph/passes/pass_table.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {

template <class L, bool kPeriodic>
constexpr std::array<ForceFunction<typename L::Scalar>, PairSet::kCount> forcePasses() {
  using Pressure = VariationalPressure<L>;
  using Uniform = Viscosity<L, false>;
  using Harmonic = Viscosity<L, true>;
  constexpr auto kNone = PressureTerm::none;
  constexpr auto kVariational = PressureTerm::variational;
  static_assert(PairSet::kCount <= 128, "an effect that needs more sets becomes a sweep of its own");
  std::array<ForceFunction<typename L::Scalar>, PairSet::kCount> table{};
  table[PairSet{kNone, ViscosityTerm::uniform}.index()] = &ForcePass<L, kPeriodic, Uniform>::run;
  table[PairSet{kNone, ViscosityTerm::harmonic}.index()] = &ForcePass<L, kPeriodic, Harmonic>::run;
  table[PairSet{kVariational, ViscosityTerm::none}.index()] = &ForcePass<L, kPeriodic, Pressure>::run;
  table[PairSet{kVariational, ViscosityTerm::uniform}.index()] = &ForcePass<L, kPeriodic, Pressure, Uniform>::run;
  table[PairSet{kVariational, ViscosityTerm::harmonic}.index()] = &ForcePass<L, kPeriodic, Pressure, Harmonic>::run;
  return table;
}

template <class L>
constexpr PassTable<typename L::Scalar> makeTable() {
  PassTable<typename L::Scalar> table;
  table.lanes = L::kWidth;
  table.density = {{{&DensityPass<L, false, false>::run, &DensityPass<L, false, true>::run},
                    {&DensityPass<L, true, false>::run, &DensityPass<L, true, true>::run}}};
  table.force = {forcePasses<L, false>(), forcePasses<L, true>()};
  return table;
}

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
