#include "service/sph/effects/platelets.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace bleedsim::sph {
namespace {

Status refusal(const char* name, double value, const char* allowed) {
  return {StatusCode::invalid_argument,
          std::string{"platelets."} + name + " is " + std::to_string(value) + "; it must be " + allowed};
}

}  // namespace

Status checkPlatelets(const PlateletSettings& s) {
  if (!(s.fresh >= 0.0 && s.fresh <= 1.0)) return refusal("fresh", s.fresh, "between 0 and 1");
  struct Rate {
    const char* name;
    double value;
  };
  for (const Rate& rate : {Rate{"diffusivity", s.diffusivity}, Rate{"activation_rate", s.activation_rate},
                           Rate{"wall_rate", s.wall_rate}, Rate{"air_rate", s.air_rate}, Rate{"clot_speedup", s.clot_speedup}}) {
    if (!(rate.value >= 0.0) || !std::isfinite(rate.value)) return refusal(rate.name, rate.value, "finite and not negative");
  }
  if (!(s.shear_gate > 0.0)) return refusal("shear_gate", s.shear_gate, "greater than 0");
  if (!(s.clot_viscosity > 0.0) || !std::isfinite(s.clot_viscosity)) {
    return refusal("clot_viscosity", s.clot_viscosity, "a finite number greater than 0");
  }
  return {};
}

template <class Real>
Clotting<Real>::Clotting(const PlateletSettings& settings, SweepFunction<PlateletJob<Real>> sweep, double laplacian,
                         double spacing, double rest_density, const TissueField<Real>& tissue)
    : sweep_{sweep},
      scale_{static_cast<Real>(0.5 * laplacian * settings.diffusivity)},
      longest_step_{0.005 / (settings.clot_speedup * (settings.activation_rate + settings.wall_rate + settings.air_rate) +
                             settings.diffusivity / (spacing * spacing))},
      activation_{static_cast<Real>(settings.clot_speedup * settings.activation_rate)},
      wall_{static_cast<Real>(settings.clot_speedup * settings.wall_rate)},
      air_{static_cast<Real>(settings.clot_speedup * settings.air_rate)},
      inverse_gate_{static_cast<Real>(1.0 / settings.shear_gate)},
      inverse_density_{static_cast<Real>(1.0 / rest_density)} {
  if (!tissue.empty()) inverse_share_ = Real(1) / tissue.planeShareAt(static_cast<Real>(0.5 * spacing));
}

template <class Real>
void Clotting<Real>::diffuse(const CellGrid<Real>& grid, const Particles<Real>& p, PairPasses<Real>& passes, std::uint32_t count,
                             int shares, Executor& executor) const {
  PlateletJob<Real> job;
  job.scale = scale_;
  job.acceleration = passes.acceleration();
  passes.sweep(grid, p, count, shares, executor, sweep_, job);
}

template <class Real>
void Clotting<Real>::advance(Particles<Real>& p, const PairPasses<Real>& passes, const Real* shear_rate,
                             const WallEffects<Real>& walls, const CellGrid<Real>& grid, Real dt, std::uint32_t count, int shares,
                             Executor& executor) const {
  executor.run(shares, [&](int share) {
    const std::uint32_t end = grid.view().rowBegin(grid.firstRow(share + 1, shares, count));
    for (std::uint32_t i = grid.view().rowBegin(grid.firstRow(share, shares, count)); i < end; ++i) {
      if (p.driver[i] != 0) continue;
      const Real old = p.platelet[i];
      const Real calm = shear_rate == nullptr ? Real(1) : std::max(Real(0), Real(1) - shear_rate[i] * inverse_gate_);
      const Real filled = passes.density()[i] * inverse_density_;
      const Real air = std::clamp((Real(0.9) - filled) * Real(2.5), Real(0), Real(1));
      const Real sinks = activation_ * calm * (Real(1) - old) + air_ * air;
      const Real diffused = old + dt * passes.acceleration()[std::size_t{i} * 4 + 3];
      p.platelet[i] = std::clamp(diffused / (Real(1) + dt * sinks), Real(0), Real(1));
    }
    walls.forEachTouching(share, [&](std::uint32_t i, const WallSample<Real>& wall, Real) {
      const Real contact = std::min(Real(1), walls.field().planeShareAt(wall.distance) * inverse_share_);
      p.platelet[i] /= Real(1) + dt * wall_ * contact;
    });
  });
}

template class Clotting<float>;
template class Clotting<double>;

}  // namespace bleedsim::sph
