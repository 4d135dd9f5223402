// The literal model: the paper's method as printed with only the sign of (31) mended, so that its claims can be tested.
//
// The presence of an effect's settings enables its printed term; the numbers come from LiteralSettings, except those named here:
//
//   effect of the scene   printed term                       file
//   pressure              (17) or (16), (19) (20)            effects/literal_pressure-inl.h   p = k (rho - rho0), never clamped
//   surface_tension       (21)-(23)                          effects/literal_tension-inl.h
//   viscosity             (25), mu by ViscositySettings      effects/literal_viscosity-inl.h  or a block's own viscosity
//   platelets             (26) (27), P by PlateletSettings::fresh or a block's own            effects/literal_platelets-inl.h
//                         mu of every particle is then (26)                                   effects/literal_forces.h
//   repulsion             (35) (36), Table I's else-branch   effects/literal_repulsion-inl.h
//   core_radius           (34), lambda = h/dx; within bounds         effects/literal_core_radius.h, literal_core_radius-inl.h
//   gravity, applied_force                                   as in the sound model
//
// Kernels: poly6 for density, spiky for pressure and tension, the Laplacian of (33) for viscosity and platelets.
// Time: symplectic Euler, v += a dt, x += v dt, P += dP/dt dt, at the least of the sound model's limits and max_dt.
// What the paper does not say and what is done:
//   particle mass   calibrated, so that the rest lattice sums to rho0 with poly6 (m = 0.99 rho0 dx^3 at h = 2 dx)
//   tissue          the sound model's (tissue/), its share of density made with poly6; the paper has no boundary
//   bounds          on speed and acceleration as in the sound model, each use counted; no other clamp
//   (28)            sums accelerations: a_i of (36) is f/m
//   h               one for all particles without core_radius
// One layer (WorldDescription::planar) is a domain of both models; see model_rules.h.
#pragma once

#include "service/sph/effects/literal_set.h"
#include "service/sph/passes/literal_job.h"
#include "service/sph/rest_lattice.h"
#include "service/sph/world_description.h"

namespace bleedsim::sph {

/// The printed terms that a description enables.
LiteralSet literalSet(const WorldDescription& description);

/// mu = scale exp(-exponent P), (26).
struct Thickening {
  double scale = 0.0;     ///< b, Pa s
  double exponent = 0.0;  ///< a
};
/// invalid unless the description has viscosity and platelets.
Thickening thickening(const WorldDescription& description);

/// The largest viscosity that a particle can have, Pa s: (27) leaves P within the values that it starts with.
double largestLiteralViscosity(const WorldDescription& description);

/// k, m^2/s^2.
double literalStiffness(const WorldDescription& description, double speed_of_sound);

/// The literal terms' own limit of the time step, s: 0.25 sqrt(rho0 dx^3/(2 pi eps)), 0.045 h^2/k of platelets for the smallest
/// h, and 0.1 dx/c0 with repulsion.
double literalTimeStep(const WorldDescription& description, double speed_of_sound);

/// The constants of the force pass.
template <class Real>
LiteralJob<Real> literalJob(const WorldDescription& description, const RestLattice& lattice, double speed_of_sound,
                            bool viscosity_varies);

extern template LiteralJob<float> literalJob(const WorldDescription&, const RestLattice&, double, bool);
extern template LiteralJob<double> literalJob(const WorldDescription&, const RestLattice&, double, bool);

}  // namespace bleedsim::sph
