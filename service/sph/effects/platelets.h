// Platelets: what makes blood clot.
//
// Equation (27) of the paper, dP/dt = k lap P, whose diffusion is a pair term (platelets-inl.h), and the sinks of physics.md
// section 3:
//   dP/dt = div(k grad P) - s [r phi(g) P (1 - P) + k_w A_w P + k_a A_a P]
//   phi = max(0, 1 - g/g_0)   A_w = min(1, L(d)/L(dx/2))   A_a = clamp((0.9 - f)/0.4, 0, 1)   f = rho_i/rho0
// terms: P 0 to 1, fresh blood 0.99; k m^2/s; r, k_w, k_a 1/s; s clot_speedup; g shear rate 1/s (shear_rate.h), g_0 shear_gate; d
// m to the nearest tissue, L its share of density there. A wound lies on tissue and counts as such, whatever its throat holds
// open: its rim is what platelets stick to; blood in a throat stays fresh. f, the filled part of the support, is rho_i/rho0 with
// the tissue's share in it, not sum_j V_j W with V_j = m/rho_j: that one is 1 for an isolated particle, which has air all around.
// rho_i/rho0 is 0.2 to 0.5 there, so A_a = 1; it is 1 in the bulk. Deviation from the paper: its diffusion alone conserves the
// sum of P and so never clots. In time: P <- (P + dt diffusion)/(1 + dt sinks/P), the walls' sink after the others: first order
// like the explicit form, but never below 0; then P is held within 0 and 1. dt is that of several solver steps, of which the last
// gives diffusion, shear rates and surfaces: all of them are slow against it.
// Where particles have support radii of their own (34), diffusion keeps the rest lattice's factor of h: that of viscosity travels
// in 1/mu, and the records have no room for another. k then acts as 0.89 k at 0.9 h and 1.03 k at 1.3 h (h = 2 dx; 1.01 and 1.04
// at 2.5 dx, 0.97 and 1.01 at 3 dx); radii are h but at surfaces and in films.
#pragma once

#include <cstdint>

#include "service/sph/effect_settings.h"
#include "service/sph/executor.h"
#include "service/sph/neighbors/cell_grid.h"
#include "service/sph/particles.h"
#include "service/sph/passes/pair_passes.h"
#include "service/sph/passes/sweep_table.h"
#include "service/sph/tissue/wall_effects.h"
#include "service/status/status.h"

namespace bleedsim::sph {

/// Clotting takes minutes, a step less than a millisecond: it is advanced every so many steps, by all their time.
constexpr std::uint64_t kClottingSteps = 8;

/// invalid_argument with the value and what is allowed.
Status checkPlatelets(const PlateletSettings& settings);

template <class Real>
class Clotting {
 public:
  /// `spacing` dx in m, `rest_density` in kg/m^3; `laplacian` is the prefactor K of viscosity-inl.h.
  Clotting(const PlateletSettings& settings, SweepFunction<PlateletJob<Real>> sweep, double laplacian, double spacing,
           double rest_density, const TissueField<Real>& tissue);

  /// The most time that advance() may be given, s: 1/200 of the shortest time in which a sink or diffusion over dx would act.
  double longestStep() const { return longest_step_; }

  /// Writes the rates of diffusion into the fourth component of the accelerations, after the pair forces.
  void diffuse(const CellGrid<Real>& grid, const Particles<Real>& p, PairPasses<Real>& passes, std::uint32_t count, int shares,
               Executor& executor) const;
  std::uintptr_t code() const { return codeOf(sweep_); }

  /// Closes dt seconds: diffusion from the fourth component of the accelerations, then the sinks. `shear_rate` in 1/s,
  /// or null: 0 everywhere. `shares` as in the sampling of the walls.
  void advance(Particles<Real>& p, const PairPasses<Real>& passes, const Real* shear_rate, const WallEffects<Real>& walls,
               const CellGrid<Real>& grid, Real dt, std::uint32_t count, int shares, Executor& executor) const;

 private:
  SweepFunction<PlateletJob<Real>> sweep_;
  Real scale_;              // PlateletJob
  double longest_step_;     // s
  Real activation_;         // s r, 1/s
  Real wall_;               // s k_w, 1/s
  Real air_;                // s k_a, 1/s
  Real inverse_gate_;       // 1/g_0, s
  Real inverse_density_;    // 1/rho0
  Real inverse_share_ = 0;  // 1/L(dx/2)
};

extern template class Clotting<float>;
extern template class Clotting<double>;

}  // namespace bleedsim::sph
