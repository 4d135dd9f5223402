#include "service/sph/effects/shear_rate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "service/sph/effects/rheology.h"

namespace bleedsim::sph {

bool shearRateNeeded(const EffectSettings& effects) {
  const bool gated =
      effects.platelets && effects.platelets->activation_rate > 0.0 && std::isfinite(effects.platelets->shear_gate);
  return viscosityThins(effects) || gated;
}

template <class Real>
ShearRate<Real>::ShearRate(const WorldDescription& description, const RestLattice& lattice,
                           SweepFunction<ShearRateJob<Real>> sweep, StepScratch& scratch)
    : sweep_{sweep},
      h_{static_cast<Real>(description.supportRadius())},
      least_distance_{static_cast<Real>(0.25 / description.support_ratio)},
      scale_{static_cast<Real>(kernelNorms(KernelType::wendland_c2).gradient * lattice.particle_mass /
                               (std::numbers::pi * std::pow(description.supportRadius(), 3)))},
      scratch_{scratch},
      rate_{description.capacity, 67} {
  scratch.reserve(rate_.size() * kShearMoments * sizeof(Real));
}

template <class Real>
void ShearRate<Real>::update(const CellGrid<Real>& grid, const Particles<Real>& p, const WallEffects<Real>& walls,
                             PairPasses<Real>& passes, std::uint32_t count, int shares, Executor& executor) {
  ShearRateJob<Real> job;
  job.scale = scale_;
  job.moments = scratch_.take<Real>(0, rate_.size() * kShearMoments);
  passes.sweep(grid, p, count, shares, executor, sweep_, job);
  executor.run(shares, [&](int share) {
    walls.forEachTouching(share, [&](std::uint32_t i, const WallSample<Real>& wall, Real) {
      addWall(p, i, wall, job.moments + std::size_t{i} * kShearMoments);
    });
    const std::uint32_t end = grid.view().rowBegin(grid.firstRow(share + 1, shares, count));
    for (std::uint32_t i = grid.view().rowBegin(grid.firstRow(share, shares, count)); i < end; ++i) {
      rate_[i] = shearRateOf(job.moments + std::size_t{i} * kShearMoments) / h_;
    }
  });
}

template <class Real>
void ShearRate<Real>::addWall(const Particles<Real>& p, std::uint32_t i, const WallSample<Real>& wall, Real* moments) const {
  const Real slope =
      std::sqrt(wall.gradient[0] * wall.gradient[0] + wall.gradient[1] * wall.gradient[1] + wall.gradient[2] * wall.gradient[2]);
  std::array<Real, 3> out = wall.normal;
  if (slope > Real(0)) {
    for (std::size_t a = 0; a < 3; ++a) out[a] = -wall.gradient[a] / slope;
  }
  const Real distance = std::max(wall.distance / h_, least_distance_);
  const Real strength = slope * h_;
  const Real normal_part = distance * strength;
  const Real drag = wall.grip * (strength + wall.share / distance);
  const Real v[3] = {p.vx[i], p.vy[i], p.vz[i]};
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 0; b < 3; ++b) moments[4 * a + b] += drag * v[a] * out[b];
    moments[4 * a + 3] += wall.share + normal_part * out[a] * out[a];
  }
  moments[12] += normal_part * out[0] * out[1];
  moments[13] += normal_part * out[1] * out[2];
  moments[14] += normal_part * out[0] * out[2];
}

template <class Real>
Real shearRateOf(const Real* moments) {
  Real xx = moments[3];
  Real yy = moments[7];
  Real zz = moments[11];
  const Real xy = moments[12];
  const Real yz = moments[13];
  const Real xz = moments[14];
  const auto determinant = [&] { return xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz); };
  const Real mean = (xx + yy + zz) / Real(3);
  Real det = determinant();
  if (!(mean > Real(0.01) && det > Real(0.05) * mean * mean * mean)) {
    const Real lift = Real(0.1) * mean + Real(0.001);
    xx += lift;
    yy += lift;
    zz += lift;
    det = determinant();
  }
  const Real inverse = Real(1) / det;
  const Real cofactor[3][3] = {{yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy},
                               {xz * yz - xy * zz, xx * zz - xz * xz, xy * xz - xx * yz},
                               {xy * yz - xz * yy, xy * xz - xx * yz, xx * yy - xy * xy}};
  Real gradient[3][3];
  for (int a = 0; a < 3; ++a) {
    const Real* row = moments + 4 * a;
    for (int c = 0; c < 3; ++c) {
      gradient[a][c] = (row[0] * cofactor[0][c] + row[1] * cofactor[1][c] + row[2] * cofactor[2][c]) * inverse;
    }
  }
  Real squares = Real(0);  // 2 D:D
  for (int a = 0; a < 3; ++a) {
    for (int c = 0; c < 3; ++c) {
      const Real twice = gradient[a][c] + gradient[c][a];
      squares += Real(0.5) * twice * twice;
    }
  }
  return std::sqrt(squares);
}

template float shearRateOf(const float*);
template double shearRateOf(const double*);
template class ShearRate<float>;
template class ShearRate<double>;

}  // namespace bleedsim::sph
