// The second walk of surface tension in the curvature form: curvature and the force, from normals that are known. Equations,
// terms, source and deviation stand in surface_tension.h.
#if defined(BLEEDSIM_SPH_EFFECTS_CURVATURE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BLEEDSIM_SPH_EFFECTS_CURVATURE_INL_H_
#undef BLEEDSIM_SPH_EFFECTS_CURVATURE_INL_H_
#else
#define BLEEDSIM_SPH_EFFECTS_CURVATURE_INL_H_
#endif

#include "service/sph/passes/curvature_job.h"
#include "service/sph/passes/kernels-inl.h"
#include "service/sph/passes/pair_geometry-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {

/// kappa h = -(norms) sum_j w_j (nhat_j - nhat_i) . h grad W / sum_j w_j W, and the damping of the surface.
template <class L, bool kRadius>
class CurvatureBody {
 public:
  using V = typename L::V;
  using Real = typename L::Scalar;
  using Job = CurvatureJob<Real>;
  using Kernel = WendlandC2<L>;
  static constexpr int kGroups = 2;

  CurvatureBody(const Job& job, std::uint32_t, const Real* record)
      : record_{job.record},
        own_{record},
        x_{L::set(record[kRecordNormalX])},
        y_{L::set(record[kRecordNormalY])},
        z_{L::set(record[kRecordNormalZ])},
        vx_{L::set(record[kRecordVx])},
        vy_{L::set(record[kRecordVy])},
        vz_{L::set(record[kRecordVz])} {
    if constexpr (kRadius) {
      own_inverse_ = L::set(record[kRecordInverseRadius]);
      own_factor_ = L::set(record[kRecordRadiusFactor]);
    }
  }

  bool needed() const { return own_[kRecordSurfaceWeight] > Real(0); }

  HWY_INLINE void pair(const Pair<L>& p) {
    V surface[4];
    L::gatherGroup(record_ + kRecordNormalX, p.list, surface);
    const V gradient = surface[3] * p.gradient;
    const V turn = along(p, surface[0] - x_, surface[1] - y_, surface[2] - z_);
    divergence_ = L::mulAdd(gradient, turn, divergence_);
    weight_ = L::mulAdd(surface[3], kernelOf(p), weight_);
    const V apart = along(p, p.field[kRecordVx] - vx_, p.field[kRecordVy] - vy_, p.field[kRecordVz] - vz_);
    const V drag = gradient * apart / (p.q2 + L::set(Real(0.01)));
    ax_ = L::mulAdd(drag, p.dx, ax_);
    ay_ = L::mulAdd(drag, p.dy, ay_);
    az_ = L::mulAdd(drag, p.dz, az_);
  }

  void finish(const Job& job, std::uint32_t i) const {
    Real* acceleration = job.acceleration + std::size_t{i} * 4;
    acceleration[3] = Real(0);
    if (!needed()) {
      for (int a = 0; a < 3; ++a) acceleration[a] = Real(0);
      return;
    }
    alignas(64) Real curve[4];
    alignas(64) Real drag[4];
    L::storeSums(divergence_, weight_, L::set(Real(0)), L::set(Real(0)), curve);
    L::storeSums(ax_, ay_, az_, L::set(Real(0)), drag);
    const Real raw = -job.ratio * curve[0] / curve[1];  // the particle itself keeps the divisor above 0
    const Real curvature = raw > job.largest ? job.largest : raw < -job.largest ? -job.largest : raw;
    const Real weight = own_[kRecordSurfaceWeight];
    for (int a = 0; a < 3; ++a) {
      const Real normal = job.normal[std::size_t{i} * 4 + static_cast<std::size_t>(a)];
      acceleration[a] = weight * (job.scale * curvature * normal + job.damping * drag[a]);
    }
  }

 private:
  HWY_INLINE static V along(const Pair<L>& p, V x, V y, V z) { return L::mulAdd(z, p.dz, L::mulAdd(y, p.dy, x * p.dx)); }
  HWY_INLINE V kernelOf(const Pair<L>& p) const {
    if constexpr (kRadius) {
      const V theirs = p.field[kRecordRadiusFactor] * Kernel::weight(p.q * p.field[kRecordInverseRadius]);
      const V both = L::mulAdd(own_factor_, Kernel::weight(p.q * own_inverse_), theirs);
      return L::set(Real(0.5)) * both;
    } else {
      return Kernel::weight(p.q);
    }
  }

  const Real* record_;
  const Real* own_;
  V x_, y_, z_;
  V vx_, vy_, vz_;
  V own_inverse_ = L::set(Real(1));
  V own_factor_ = L::set(Real(1));
  V divergence_ = L::set(Real(0));
  V weight_ = L::set(Real(0));
  V ax_ = L::set(Real(0));
  V ay_ = L::set(Real(0));
  V az_ = L::set(Real(0));
};

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
