// Repulsion of particles in contact, added to the other forces.
//
// Equations (35), (36) of the paper:
//   pe = (r_i + r_j)/d >= 1:   f_i = D (pe^n1 - pe^n2)/d^2 along x_i - x_j, else 0
// terms: D N m^2; r contact radius m; d distance m. Here a_i = D* c0^2 dx (pe^n1 - pe^n2)/d^2 with D* = D/(m c0^2 dx), which
// is 1.5 where the contact is as stiff as the fluid.
// Deviation from the paper: D has a scale; pe is capped (and d with it) at 2 or where a pair comes near the bound on
// accelerations (contactOverlap), beyond which the force stays, so that the cap keeps momentum; a damping
// a_i -= g (pe - 1) (v_ij . e) e takes the energy that a finite time step would pump into contacts.
#if defined(BLEEDSIM_SPH_EFFECTS_REPULSION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BLEEDSIM_SPH_EFFECTS_REPULSION_INL_H_
#undef BLEEDSIM_SPH_EFFECTS_REPULSION_INL_H_
#else
#define BLEEDSIM_SPH_EFFECTS_REPULSION_INL_H_
#endif

#include "service/sph/effects/power_gap-inl.h"
#include "service/sph/passes/pair_geometry-inl.h"
#include "service/sph/passes/pass_jobs.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {

template <class L>
class Repulsion {
 public:
  using V = typename L::V;
  using Real = typename L::Scalar;
  static constexpr int kGroups = 2;

  Repulsion(const ForceJob<Real>& job, const Real* record)
      : job_{job},
        gap_{job.repulsion_powers},
        vx_{L::set(record[kRecordVx])},
        vy_{L::set(record[kRecordVy])},
        vz_{L::set(record[kRecordVz])} {}

  HWY_INLINE void pair(const Pair<L>& p, PairSums<L>& sums) const {
    const V contact = L::set(job_.repulsion_contact);
    const V one = L::set(Real(1));
    const V deepest = L::set(job_.repulsion_overlap / job_.repulsion_contact);
    const V inverse_distance = inverseDistance<L>(p.q);
    const V capped = L::min(inverse_distance, deepest);
    const V pe = L::max(contact * capped, one);
    const V push = L::set(job_.repulsion_scale) * gap_(pe) * (capped * capped);
    const V closing =
        L::mulAdd(p.field[kRecordVz] - vz_, p.dz, L::mulAdd(p.field[kRecordVy] - vy_, p.dy, (p.field[kRecordVx] - vx_) * p.dx));
    const V drag = L::set(job_.repulsion_damping) * (pe - one) * closing * (inverse_distance * inverse_distance);
    const V along = L::subMul(drag, push, inverse_distance);
    sums.ax = L::mulAdd(along, p.dx, sums.ax);
    sums.ay = L::mulAdd(along, p.dy, sums.ay);
    sums.az = L::mulAdd(along, p.dz, sums.az);
  }

 private:
  const ForceJob<Real>& job_;
  PowerGap<L> gap_;
  V vx_, vy_, vz_;
};

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
