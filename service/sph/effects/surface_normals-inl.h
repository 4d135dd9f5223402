// The first walk of surface tension, along with the forces: the normals. Equations, terms, source and deviation stand in
// surface_tension.h.
#if defined(BLEEDSIM_SPH_EFFECTS_SURFACE_NORMALS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BLEEDSIM_SPH_EFFECTS_SURFACE_NORMALS_INL_H_
#undef BLEEDSIM_SPH_EFFECTS_SURFACE_NORMALS_INL_H_
#else
#define BLEEDSIM_SPH_EFFECTS_SURFACE_NORMALS_INL_H_
#endif

#include <algorithm>
#include <cmath>
#include <limits>

#include "service/sph/passes/pair_geometry-inl.h"
#include "service/sph/passes/pass_jobs.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {

/// n h = V0 sum_j h grad W + the tissue's share, and the weight w.
template <class L>
class NormalSums {
 public:
  using V = typename L::V;
  using Real = typename L::Scalar;

  HWY_INLINE void pair(const Pair<L>& p) {
    x_ = L::mulAdd(p.gradient, p.dx, x_);
    y_ = L::mulAdd(p.gradient, p.dy, y_);
    z_ = L::mulAdd(p.gradient, p.dz, z_);
  }

  /// Writes particle i's normal. Fields that no force reads: the walk goes on meanwhile.
  void finish(const ForceJob<Real>& job, std::uint32_t i) const {
    alignas(64) Real sums[4];
    L::storeSums(x_, y_, z_, L::set(Real(0)), sums);
    write(job.normals, job.normals.record + std::size_t{i} * static_cast<std::uint32_t>(4 * job.groups) + kRecordNormalX, sums,
          i);
  }

 private:
  /// Compiled once, not for every set of effects.
  HWY_NOINLINE static void write(const SurfaceNormals<Real>& job, Real* surface, const Real* sums, std::uint32_t i) {
    Real* normal = job.normal + std::size_t{i} * 4;
    Real square = Real(0);
    for (int a = 0; a < 3; ++a) {
      normal[a] = job.scale * sums[a] + surface[a];
      square += normal[a] * normal[a];
    }
    const bool driven = job.driver[i] != 0;
    normal[3] = static_cast<Real>(driven);
    // Without a branch: which particle stands at a surface is hard to guess. The least length only keeps the division whole.
    const auto kept = static_cast<Real>(!driven && square > job.cutoff * job.cutoff);
    const Real length = std::sqrt(square);
    const Real unit = kept / std::max(length, std::numeric_limits<Real>::min());
    for (int a = 0; a < 3; ++a) surface[a] = normal[a] * unit;
    surface[3] = kept * std::min(std::max(length / job.cutoff - Real(1), Real(0)), Real(1));
  }

  V x_ = L::set(Real(0));
  V y_ = L::set(Real(0));
  V z_ = L::set(Real(0));
};

/// What a set of effects without tension has in place of NormalSums.
template <class L>
struct NoNormals {
  HWY_INLINE void pair(const Pair<L>&) const {}
  HWY_INLINE void finish(const ForceJob<typename L::Scalar>&, std::uint32_t) const {}
};

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
