// The literal model's fused pair loop as a body of the list sweep: only the terms of its set are compiled into it.
#if defined(BLEEDSIM_SPH_PASSES_LITERAL_PASS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BLEEDSIM_SPH_PASSES_LITERAL_PASS_INL_H_
#undef BLEEDSIM_SPH_PASSES_LITERAL_PASS_INL_H_
#else
#define BLEEDSIM_SPH_PASSES_LITERAL_PASS_INL_H_
#endif

#include <algorithm>
#include <type_traits>

#include "service/sph/effects/literal_core_radius-inl.h"
#include "service/sph/effects/literal_platelets-inl.h"
#include "service/sph/effects/literal_pressure-inl.h"
#include "service/sph/effects/literal_repulsion-inl.h"
#include "service/sph/effects/literal_set.h"
#include "service/sph/effects/literal_tension-inl.h"
#include "service/sph/effects/literal_viscosity-inl.h"
#include "service/sph/passes/list_sweep-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {

/// Bodies with radii of their own are compact (list_sweep-inl.h): code is bounded, and their lists are the longer ones.
template <bool kCompact>
struct CompactIf {};
template <>
struct CompactIf<true> {
  static constexpr bool kCompact = true;
};

template <class L, LiteralSet kSet>
class LiteralBody : public CompactIf<kSet.core_radius> {
 public:
  using V = typename L::V;
  using Real = typename L::Scalar;
  using Job = LiteralJob<Real>;

 private:
  /// A term that the set has not.
  template <int kTerm>
  struct Absent {
    static constexpr int kGroups = 1;
    Absent(const Job&, const Real*) {}
    void pair(const Pair<L>&, const PaperWeights<L>&, PairSums<L>&) const {}
  };

  using Pressure = std::conditional_t<kSet.pressure != PressureTerm::none, LiteralPressure<L, kSet.pressure>, Absent<0>>;
  using Tension = std::conditional_t<kSet.tension, LiteralTension<L>, Absent<1>>;
  using Viscosity = std::conditional_t<kSet.viscosity, LiteralViscosity<L>, Absent<2>>;
  using Platelets = std::conditional_t<kSet.platelets, LiteralPlatelets<L>, Absent<3>>;
  using Repulsion = std::conditional_t<kSet.repulsion, LiteralRepulsion<L>, Absent<4>>;

 public:
  static constexpr int kGroups =
      std::max({Pressure::kGroups, Tension::kGroups, Viscosity::kGroups, Platelets::kGroups, Repulsion::kGroups});

  LiteralBody(const Job& job, std::uint32_t, const Real* record)
      : own_{record},
        pressure_{job, record},
        tension_{job, record},
        viscosity_{job, record},
        platelets_{job, record},
        repulsion_{job, record} {}

  HWY_INLINE void pair(const Pair<L>& p) {
    PaperWeights<L> w = own_.weights(p);
    if constexpr (kSet.repulsion) {
      w.gradient = repulsion_.apart(p, w.gradient);
      w.complement = repulsion_.apart(p, w.complement);
    }
    pressure_.pair(p, w, sums_);
    tension_.pair(p, w, sums_);
    viscosity_.pair(p, w, sums_);
    platelets_.pair(p, w, sums_);
    repulsion_.pair(p, w, sums_);
  }

  void finish(const Job& job, std::uint32_t i) const {
    Real* acceleration = job.acceleration + static_cast<std::size_t>(i) * 4;
    sums_.store(acceleration);
    if constexpr (kSet.tension) tension_.finish(job, own_.inverse2(), acceleration);
  }
  Real reach2() const { return own_.reach2(); }

 private:
  [[no_unique_address]] CoreRadiusOf<L, kSet.core_radius> own_;
  [[no_unique_address]] Pressure pressure_;
  [[no_unique_address]] Tension tension_;
  [[no_unique_address]] Viscosity viscosity_;
  [[no_unique_address]] Platelets platelets_;
  [[no_unique_address]] Repulsion repulsion_;
  PairSums<L> sums_ = PairSums<L>::zero();
};

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
