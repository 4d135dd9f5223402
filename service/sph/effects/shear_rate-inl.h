// Pair sums of the corrected velocity gradient; equations, terms and source in shear_rate.h.
//   A = sum_j V_j (v_j - v_i) gradW^T        B = sum_j V_j (x_j - x_i) gradW^T        V = m/rho
// Positions are in h, so A comes out in m/s, times h.
#if defined(BLEEDSIM_SPH_EFFECTS_SHEAR_RATE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BLEEDSIM_SPH_EFFECTS_SHEAR_RATE_INL_H_
#undef BLEEDSIM_SPH_EFFECTS_SHEAR_RATE_INL_H_
#else
#define BLEEDSIM_SPH_EFFECTS_SHEAR_RATE_INL_H_
#endif

#include "service/sph/passes/pair_geometry-inl.h"
#include "service/sph/passes/shear_rate_job.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {

template <class L>
class ShearMoments {
 public:
  using V = typename L::V;
  using Real = typename L::Scalar;
  using Job = ShearRateJob<Real>;
  static constexpr int kGroups = 2;

  ShearMoments(const Job& job, std::uint32_t, const Real* record)
      : scale_{L::set(job.scale)},
        vx_{L::set(record[kRecordVx])},
        vy_{L::set(record[kRecordVy])},
        vz_{L::set(record[kRecordVz])} {}

  HWY_INLINE void pair(const Pair<L>& p) {
    const V weight = scale_ * p.field[kRecordInverseDensity] * p.gradient;
    const V gx = weight * p.dx;
    const V gy = weight * p.dy;
    const V gz = weight * p.dz;
    add(ax_, p.field[kRecordVx] - vx_, gx, gy, gz);
    add(ay_, p.field[kRecordVy] - vy_, gx, gy, gz);
    add(az_, p.field[kRecordVz] - vz_, gx, gy, gz);
    diagonal_[0] = L::mulAdd(p.dx, gx, diagonal_[0]);
    diagonal_[1] = L::mulAdd(p.dy, gy, diagonal_[1]);
    diagonal_[2] = L::mulAdd(p.dz, gz, diagonal_[2]);
    xy_ = L::mulAdd(p.dx, gy, xy_);
    yz_ = L::mulAdd(p.dy, gz, yz_);
    xz_ = L::mulAdd(p.dx, gz, xz_);
  }

  void finish(const Job& job, std::uint32_t i) const {
    Real* moments = job.moments + std::size_t{i} * kShearMoments;
    L::storeSums(ax_[0], ax_[1], ax_[2], diagonal_[0], moments);
    L::storeSums(ay_[0], ay_[1], ay_[2], diagonal_[1], moments + 4);
    L::storeSums(az_[0], az_[1], az_[2], diagonal_[2], moments + 8);
    L::storeSums(xy_, yz_, xz_, L::set(Real(0)), moments + 12);
  }

 private:
  HWY_INLINE static void add(V* row, V dv, V gx, V gy, V gz) {
    row[0] = L::mulAdd(dv, gx, row[0]);
    row[1] = L::mulAdd(dv, gy, row[1]);
    row[2] = L::mulAdd(dv, gz, row[2]);
  }

  V scale_;
  V vx_, vy_, vz_;
  V ax_[3] = {L::set(0), L::set(0), L::set(0)};
  V ay_[3] = {L::set(0), L::set(0), L::set(0)};
  V az_[3] = {L::set(0), L::set(0), L::set(0)};
  V diagonal_[3] = {L::set(0), L::set(0), L::set(0)};
  V xy_ = L::set(0);
  V yz_ = L::set(0);
  V xz_ = L::set(0);
};

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
