// The literal model in a step: viscosity by platelets (26), the fused pair loop, and platelets in time (27). literal_model.h says
// what acts; an absent term takes nothing.
//
//   mu_i = b exp(-a P_i)   P_i += dt dP_i/dt   terms: P 0 to 1; mu, b Pa s; a 1. Particles of a throat keep their P.
// Deviation from the paper: none.
#pragma once

#include <cstdint>
#include <limits>
#include <type_traits>

#include "service/sph/executor.h"
#include "service/sph/literal_model.h"
#include "service/sph/neighbors/cell_grid.h"
#include "service/sph/own_math.h"
#include "service/sph/particles.h"
#include "service/sph/passes/literal_table.h"
#include "service/sph/passes/pair_passes.h"
#include "service/sph/share_range.h"

namespace bleedsim::sph {

template <class Real>
class LiteralForces {
 public:
  /// `target` is one of this build and machine. `viscosity_varies`: particles carry their own.
  LiteralForces(const WorldDescription& description, const RestLattice& lattice, double speed_of_sound, bool viscosity_varies,
                SimdTarget target)
      : job_{literalJob<Real>(description, lattice, speed_of_sound, viscosity_varies)} {
    const LiteralSet set = literalSet(description);
    const auto& periodic = description.domain.periodic;
    force_ = tableFor(target, periodic[0] || periodic[1] || periodic[2]).force[set.index()];
    diffuses_ = set.platelets;
    thickens_ = set.platelets && set.viscosity;
    if (thickens_) law_ = thickening(description);
  }

  /// Viscosity from platelets; before add().
  void thicken(Particles<Real>& p, PairPasses<Real>& passes, std::uint32_t count, int shares, Executor& executor) const {
    if (!thickens_) return;
    executor.run(shares, [&](int share) {
      const ShareRange range{count, share, shares};
      Real last_platelet = std::numeric_limits<Real>::quiet_NaN();  // neighbours mostly have the same
      Real inverse = 0;
      for (std::uint32_t i = range.begin; i < range.end; ++i) {
        if (p.platelet[i] != last_platelet) {
          last_platelet = p.platelet[i];
          const double viscosity = law_.scale * ownExp(-law_.exponent * static_cast<double>(last_platelet));
          inverse = static_cast<Real>(1.0 / viscosity);
        }
        p.inverse_viscosity[i] = inverse;
        passes.record(i)[kRecordInverseViscosity] = inverse;
      }
    });
  }

  /// Accelerations and the platelets' rates of particles whose densities are known.
  void add(const CellGrid<Real>& grid, const Particles<Real>& p, PairPasses<Real>& passes, std::uint32_t count, int shares,
           Executor& executor) const {
    if (force_ == nullptr) {
      passes.clearAccelerations(grid, count, shares, executor);
      return;
    }
    passes.sweep(grid, p, count, shares, executor, force_, job(passes));
  }

  /// What add() runs; null where no term acts.
  LiteralFunction<Real> function() const { return force_; }
  LiteralJob<Real> job(PairPasses<Real>& passes) const {
    LiteralJob<Real> job = job_;
    job.acceleration = passes.acceleration();
    return job;
  }

  /// Closes a step of dt seconds.
  void diffuse(Particles<Real>& p, const PairPasses<Real>& passes, Real dt, std::uint32_t count, int shares,
               Executor& executor) const {
    if (!diffuses_) return;
    executor.run(shares, [&](int share) {
      const ShareRange range{count, share, shares};
      for (std::uint32_t i = range.begin; i < range.end; ++i) {
        if (p.driver[i] == 0) p.platelet[i] += dt * passes.acceleration()[std::size_t{i} * 4 + 3];
      }
    });
  }

  std::uintptr_t forceCode() const { return codeOf(force_); }

 private:
  static const LiteralTable<Real>& tableFor([[maybe_unused]] SimdTarget target, bool periodic) {
    if constexpr (std::is_same_v<Real, double>)
      return referenceLiteralPasses(periodic);
    else
      return literalPasses(target, periodic);
  }

  LiteralJob<Real> job_;
  LiteralFunction<Real> force_ = nullptr;
  Thickening law_;
  bool diffuses_ = false;
  bool thickens_ = false;
};

}  // namespace bleedsim::sph
