// Shear rate of each particle, for blood that thins (rheology.h) and for its platelets (platelets.h).
//
// Not in the paper; the corrected gradient is that of Randles & Libersky 1996 and Bonet & Lok 1999:
//   g = sqrt(2 D:D)   D = (grad v + grad v^T)/2   grad v = A B^-1
//   A = sum_j V_j (v_j - v_i) gradW^T             B = sum_j V_j (x_j - x_i) gradW^T             V = m/rho
// terms: g 1/s; v m/s; V m^3; B dimensionless, the unit matrix in the bulk. A linear velocity has its exact gradient wherever B
// can be inverted, also at a free surface.
//
// Tissue: its layers move as friction has it (walls.md), v(depth) = -v_i depth/d~, d~ = max(d, dx/4). With the wall's share L, S
// = |grad L| and e the unit vector against grad L they add, exactly for a plane and layers that are infinitely thin,
//   B += L I + d~ S e e^T            A += (1 - slip) (S + L/d~) v_i e^T
// which keeps the gradient of a shear flow over the wall exact whatever L and S are. In edges e points out of the edge.
//
// Few neighbours: where the mean t of B's eigenvalues is below 0.01, or det B < 0.05 t^3 (pairs, filaments, films in the air), B
// + (t/10 + 0.001) I is inverted instead: directions without neighbours get no gradient, and an isolated particle g = 0.
#pragma once

#include <cstdint>

#include "service/sph/aligned_array.h"
#include "service/sph/executor.h"
#include "service/sph/neighbors/cell_grid.h"
#include "service/sph/particles.h"
#include "service/sph/passes/pair_passes.h"
#include "service/sph/passes/sweep_table.h"
#include "service/sph/rest_lattice.h"
#include "service/sph/step_scratch.h"
#include "service/sph/tissue/wall_effects.h"
#include "service/sph/world_description.h"

namespace bleedsim::sph {

/// Whether an effect of the scene reads the shear rate.
bool shearRateNeeded(const EffectSettings& effects);

template <class Real>
class ShearRate {
 public:
  /// `sweep` as of the world's tables; `scratch` outlives this.
  ShearRate(const WorldDescription& description, const RestLattice& lattice, SweepFunction<ShearRateJob<Real>> sweep,
            StepScratch& scratch);

  /// After density: from the records and the walls that were sampled with the same `shares`.
  void update(const CellGrid<Real>& grid, const Particles<Real>& p, const WallEffects<Real>& walls, PairPasses<Real>& passes,
              std::uint32_t count, int shares, Executor& executor);

  const Real* data() const { return rate_.data(); }  ///< g by particle, 1/s
  std::uintptr_t code() const { return codeOf(sweep_); }
  std::size_t bytes() const { return rate_.bytes(); }

 private:
  void addWall(const Particles<Real>& p, std::uint32_t i, const WallSample<Real>& wall, Real* moments) const;

  SweepFunction<ShearRateJob<Real>> sweep_;
  Real h_;               // m
  Real least_distance_;  // dx/4, in h
  Real scale_;
  StepScratch& scratch_;
  AlignedArray<Real> rate_;
};

/// g of the moments that ShearRateJob describes, times h: m/s.
template <class Real>
Real shearRateOf(const Real* moments);

extern template class ShearRate<float>;
extern template class ShearRate<double>;

}  // namespace bleedsim::sph
