// Implicit viscosity: (I - dt D) v = v*, solved by conjugate gradients after the closing kick, for blood so thick that the
// explicit limit 0.045 h^2 rho/mu would rule the time step (clots).
//
// physics.md section 2. D is the central form of viscous_product-inl.h plus the friction of tissue, both symmetric and negative,
// so the matrix is symmetric and positive definite. Matrix-free: a product is one sweep over the neighbour lists with the vector
// in the records' velocity fields. The start is v*. Particles of a throat keep the velocity that their wound gives them.
// No preconditioner: the residual dt D v* has no net momentum where nothing holds the blood, and plain directions keep it so
// whatever the tolerance. Jacobi's do not: neighbours of 0.004 and 10 Pa s lost 7e-3 of their momentum. Nor do they save: of a
// scaled clot in thin blood the smooth motions are as small as those of a plain one are large.
// Sums run over blocks of fixed size combined in order, so results are bit-equal for any number of threads.
// Deviation from the paper: it only knows explicit viscosity. First order in time, where the explicit form is second.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "service/sph/aligned_array.h"
#include "service/sph/executor.h"
#include "service/sph/neighbors/cell_grid.h"
#include "service/sph/particles.h"
#include "service/sph/passes/pair_passes.h"
#include "service/sph/passes/sweep_table.h"
#include "service/sph/share_range.h"
#include "service/sph/step_scratch.h"

namespace bleedsim::sph {

struct ImplicitSettings {
  double tolerance = 1e-2;  ///< of |residual| over |right-hand side|
  int max_iterations = 100;
};

struct SolveOutcome {
  int iterations = 0;
  bool converged = true;  ///< false: the best that max_iterations gave is in place
  bool finite = true;     ///< false: what is in place is no velocity
};

template <class Real>
class ImplicitViscosity {
 public:
  /// `scratch` outlives this and is left alone in solve().
  ImplicitViscosity(const ImplicitSettings& settings, SweepFunction<ViscousProductJob<Real>> product, Real scale,
                    std::uint32_t capacity, StepScratch& scratch)
      : settings_{settings},
        product_function_{product},
        scale_{scale},
        scratch_{scratch},
        drag_{capacity, 71},
        partial_((capacity + kBlock - 1) / kBlock) {
    scratch.reserve(productsAt(capacity) + std::size_t{capacity} * 4 * sizeof(Real));
  }

  std::uintptr_t code() const { return codeOf(product_function_); }
  std::size_t bytes() const { return drag_.bytes(); }

  /// Friction of tissue on particle i as a rate, 1/s, <= 0; all zero after clearDrag().
  Real* drag() { return drag_.data(); }
  void clearDrag(std::uint32_t count) { std::fill_n(drag_.data(), count, Real(0)); }

  /// Turns the velocities v* of the free particles into v. Needs lists, densities and 1/mu of this step in `passes`; the records'
  /// velocities are used up.
  SolveOutcome solve(double dt, const CellGrid<Real>& grid, Particles<Real>& p, PairPasses<Real>& passes, std::uint32_t count,
                     int shares, Executor& executor) {
    const Sweep s{grid, p, passes, count, shares, executor, static_cast<Real>(dt)};
    const auto capacity = static_cast<std::uint32_t>(drag_.size());
    residual_ = scratch_.take<Real>(0, std::size_t{capacity} * 4);
    product_ = scratch_.take<Real>(productsAt(capacity), std::size_t{capacity} * 4);
    const double enough = settings_.tolerance * settings_.tolerance * start(s);
    double residual2 = sumOf(s, [&](std::uint32_t i) { return square(residualOf(i)); });
    SolveOutcome outcome;
    double before = 0.0;
    for (; residual2 > enough; ++outcome.iterations) {
      if (outcome.iterations == settings_.max_iterations) {
        outcome.converged = false;
        break;
      }
      turn(s, outcome.iterations == 0 ? Real(0) : static_cast<Real>(residual2 / before));
      multiply(s);
      const double curvature = applyMatrix(s);
      if (!(curvature > 0.0)) {  // rounding has eaten the direction
        outcome.converged = false;
        break;
      }
      before = residual2;
      residual2 = advance(s, static_cast<Real>(residual2 / curvature));
    }
    outcome.finite = std::isfinite(residual2);
    return outcome;
  }

 private:
  static constexpr std::uint32_t kBlock = 512;  // particles of a partial sum

  struct Sweep {
    const CellGrid<Real>& grid;
    Particles<Real>& particles;
    PairPasses<Real>& passes;
    std::uint32_t count;
    int shares;
    Executor& executor;
    Real dt;
  };

  /// In the scratch, behind the residuals.
  static std::size_t productsAt(std::uint32_t capacity) { return std::size_t{capacity} * 4 * sizeof(Real) + StepScratch::kApart; }

  Real* residualOf(std::uint32_t i) { return residual_ + std::size_t{i} * 4; }
  Real* productOf(std::uint32_t i) { return product_ + std::size_t{i} * 4; }

  static double square(const Real* v) {
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) sum += static_cast<double>(v[k]) * static_cast<double>(v[k]);
    return sum;
  }

  /// With v* as the start the residual is dt D v*. Returns |v*|^2.
  double start(const Sweep& s) {
    const Particles<Real>& p = s.particles;
    forEach(s, [&](std::uint32_t i) {
      Real* vector = s.passes.record(i) + kRecordVx;
      vector[0] = p.vx[i];
      vector[1] = p.vy[i];
      vector[2] = p.vz[i];
    });
    multiply(s);
    return sumOf(s, [&](std::uint32_t i) {
      const Real v[3] = {p.vx[i], p.vy[i], p.vz[i]};
      const bool fixed = p.driver[i] != 0;
      for (std::size_t k = 0; k < 3; ++k) residualOf(i)[k] = fixed ? Real(0) : s.dt * (productOf(i)[k] + drag_[i] * v[k]);
      return fixed ? 0.0 : square(v);
    });
  }

  /// The next direction, into the records: the residual and `keep` of the one before.
  void turn(const Sweep& s, Real keep) {
    forEach(s, [&](std::uint32_t i) {
      Real* vector = s.passes.record(i) + kRecordVx;
      for (std::size_t k = 0; k < 3; ++k) vector[k] = residualOf(i)[k] + keep * vector[k];
    });
  }

  void multiply(const Sweep& s) {
    ViscousProductJob<Real> job;
    job.scale = scale_;
    job.product = product_;
    s.passes.sweep(s.grid, s.particles, s.count, s.shares, s.executor, product_function_, job);
  }

  /// Matrix times direction; returns the direction's product with it.
  double applyMatrix(const Sweep& s) {
    return sumOf(s, [&](std::uint32_t i) {
      if (s.particles.driver[i] != 0) return 0.0;
      const Real* vector = s.passes.record(i) + kRecordVx;
      double sum = 0.0;
      for (std::size_t k = 0; k < 3; ++k) {
        productOf(i)[k] = vector[k] - s.dt * (productOf(i)[k] + drag_[i] * vector[k]);
        sum += static_cast<double>(productOf(i)[k]) * static_cast<double>(vector[k]);
      }
      return sum;
    });
  }

  /// Goes along the direction; returns |residual|^2.
  double advance(const Sweep& s, Real length) {
    Particles<Real>& p = s.particles;
    return sumOf(s, [&](std::uint32_t i) {
      if (p.driver[i] != 0) return 0.0;
      const Real* vector = s.passes.record(i) + kRecordVx;
      p.vx[i] += length * vector[0];
      p.vy[i] += length * vector[1];
      p.vz[i] += length * vector[2];
      for (std::size_t k = 0; k < 3; ++k) residualOf(i)[k] -= length * productOf(i)[k];
      return square(residualOf(i));
    });
  }

  template <class Visit>
  static void forEach(const Sweep& s, const Visit& visit) {
    s.executor.run(s.shares, [&](int share) {
      const ShareRange range{s.count, share, s.shares};
      for (std::uint32_t i = range.begin; i < range.end; ++i) visit(i);
    });
  }

  /// term(i) of every particle, summed in an order that does not depend on the shares.
  template <class Term>
  double sumOf(const Sweep& s, const Term& term) {
    const std::uint32_t blocks = (s.count + kBlock - 1) / kBlock;
    s.executor.run(s.shares, [&](int share) {
      const ShareRange range{blocks, share, s.shares};
      for (std::uint32_t b = range.begin; b < range.end; ++b) {
        const std::uint32_t end = std::min(s.count, (b + 1) * kBlock);
        double sum = 0.0;
        for (std::uint32_t i = b * kBlock; i < end; ++i) sum += term(i);
        partial_[b] = sum;
      }
    });
    double sum = 0.0;
    for (std::uint32_t b = 0; b < blocks; ++b) sum += partial_[b];
    return sum;
  }

  ImplicitSettings settings_;
  SweepFunction<ViscousProductJob<Real>> product_function_;
  Real scale_;
  StepScratch& scratch_;
  Real* residual_ = nullptr;  // these two in the scratch: 4 per particle, m/s; the last is not used
  Real* product_ = nullptr;   // 4 per particle
  AlignedArray<Real> drag_;   // 1/s
  std::vector<double> partial_;
};

}  // namespace bleedsim::sph
