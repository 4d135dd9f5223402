// Surface tension as printed: the colour field.
//
// Equations (21)-(23) of the paper, Morris 2000, Mueller 2003, with spiky (30)(31):
//   n = sum_j m/rho_j grad_i W   lap C = sum_j m/rho_j lap_i W   f = -eps lap C n/|n|   a_i = f/rho_i   where |n| h > cut-off
// terms: C 1; n 1/m; eps N/m; f N/m^3; a m/s^2. The kernel that the paper names for tension is spiky: lap W ~ -1/r near the
// middle. A particle's own term (r = 0) has no value and is left out; pairs closer than h/1e6 likewise.
// Deviation from the paper: it says "only near the surface" and no number; the cut-off on |n| is LiteralSettings::normal_cutoff.
#if defined(BLEEDSIM_SPH_EFFECTS_LITERAL_TENSION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BLEEDSIM_SPH_EFFECTS_LITERAL_TENSION_INL_H_
#undef BLEEDSIM_SPH_EFFECTS_LITERAL_TENSION_INL_H_
#else
#define BLEEDSIM_SPH_EFFECTS_LITERAL_TENSION_INL_H_
#endif

#include <cmath>

#include "service/sph/passes/literal_job.h"
#include "service/sph/passes/pair_geometry-inl.h"
#include "service/sph/passes/paper_kernels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {

template <class L>
class LiteralTension {
 public:
  using V = typename L::V;
  using Real = typename L::Scalar;
  static constexpr int kGroups = 2;

  LiteralTension(const LiteralJob<Real>& job, const Real* record)
      : inverse_density_{record[kRecordInverseDensity]}, turns_{L::set(job.turns)} {}

  HWY_INLINE void pair(const Pair<L>& p, const PaperWeights<L>& w, PairSums<L>&) {
    const V volume = p.field[kRecordInverseDensity];
    const V slope = volume * w.gradient;
    nx_ = L::mulAdd(slope, p.dx, nx_);
    ny_ = L::mulAdd(slope, p.dy, ny_);
    nz_ = L::mulAdd(slope, p.dz, nz_);
    const V laplacian = L::subMul(L::set(Real(2)) * volume * w.complement, turns_, slope);
    laplacian_ = laplacian_ + L::ifBelow(p.q, L::set(Real(1e-6)), L::set(Real(0)), laplacian);
  }

  /// Adds to the acceleration of the particle whose neighbours were all seen. `inverse_radius2`: (h/h_i)^2, as |n| h_i counts.
  void finish(const LiteralJob<Real>& job, Real inverse_radius2, Real* acceleration) const {
    alignas(64) Real field[4];  // n, lap C, without their norms
    L::storeSums(nx_, ny_, nz_, laplacian_, field);
    const Real length2 = field[0] * field[0] + field[1] * field[1] + field[2] * field[2];
    if (!(length2 > job.tension_cutoff2 * inverse_radius2)) return;
    const Real scale = -job.tension_scale * field[3] * inverse_density_ / std::sqrt(length2);
    for (int a = 0; a < 3; ++a) acceleration[a] += scale * field[a];
  }

 private:
  Real inverse_density_;
  V turns_;
  V nx_ = L::set(Real(0));
  V ny_ = L::set(Real(0));
  V nz_ = L::set(Real(0));
  V laplacian_ = L::set(Real(0));
};

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
