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
      : job_{job}, vx_{L::set(record[kRecordVx])}, vy_{L::set(record[kRecordVy])}, vz_{L::set(record[kRecordVz])} {}

  HWY_INLINE void pair(const Pair<L>& p, PairSums<L>& sums) const {
    const V contact = L::set(job_.repulsion_contact);
    const V zero = L::set(Real(0));
    const V one = L::set(Real(1));
    // A particle is its own neighbour: at zero distance there is no direction and so no force.
    const V inverse_distance = one / L::sqrt(L::max(p.q2, L::set(Real(1e-12))));
    const V inverse_capped = L::min(inverse_distance, L::set(job_.repulsion_overlap / job_.repulsion_contact));
    const V pe = L::max(contact * inverse_capped, one);
    const V strength = L::max(power(pe, job_.repulsion_powers[0]) - power(pe, job_.repulsion_powers[1]), zero);
    const V push = L::set(job_.repulsion_scale) * strength * (inverse_capped * inverse_capped);
    const V ex = p.dx * inverse_distance;
    const V ey = p.dy * inverse_distance;
    const V ez = p.dz * inverse_distance;
    const V closing =
        L::mulAdd(p.field[kRecordVz] - vz_, ez, L::mulAdd(p.field[kRecordVy] - vy_, ey, (p.field[kRecordVx] - vx_) * ex));
    const V along = L::subMul(L::set(job_.repulsion_damping) * (pe - one) * closing, push, one);
    sums.ax = L::mulAdd(along, ex, sums.ax);
    sums.ay = L::mulAdd(along, ey, sums.ay);
    sums.az = L::mulAdd(along, ez, sums.az);
  }

 private:
  HWY_INLINE static V power(V base, int exponent) {
    V result = base;
    for (int k = 1; k < exponent; ++k) result = result * base;
    return result;
  }

  const ForceJob<Real>& job_;
  V vx_, vy_, vz_;
};

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
