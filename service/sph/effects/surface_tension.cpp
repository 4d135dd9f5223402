#include "service/sph/effects/surface_tension.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "service/sph/smoothing_kernel.h"

namespace bleedsim::sph {
namespace {

constexpr double kJump = 1.56;     // surface_tension.h
constexpr double kSharpest = 2.0;  // |kappa| h
constexpr double kDamping = 0.2;   // nu over h sqrt(sigma/(rho0 h))
// Below this part along the tissue, a normal does not say where the contact line is.
constexpr double kLeastTangent = 0.1;

}  // namespace

template <class Real>
SurfaceTension<Real>::SurfaceTension(const SurfaceTensionSettings& settings, SweepFunction<CurvatureJob<Real>> sweep, double mass,
                                     double rest_density, double h, std::uint32_t capacity, StepScratch& scratch)
    : sweep_{sweep}, h_{static_cast<Real>(h)}, capacity_{capacity}, scratch_{scratch}, bodies_{capacity} {
  scratch.reserve(accelerationsAt(capacity) + std::size_t{capacity} * 4 * sizeof(Real));
  const KernelNorms norms = kernelNorms(KernelType::wendland_c2);
  const double gradient = mass / rest_density / (h * h * h) * norms.gradient / std::numbers::pi;
  const double kinematic = settings.coefficient / rest_density;
  normals_.scale = static_cast<Real>(gradient);
  normals_.cutoff = static_cast<Real>(settings.normal_cutoff);
  curvature_.ratio = static_cast<Real>(norms.gradient / norms.weight);
  curvature_.largest = static_cast<Real>(kSharpest);
  curvature_.scale = static_cast<Real>(kJump * kinematic / (h * h));
  curvature_.damping = static_cast<Real>(10.0 * kDamping * std::sqrt(kinematic * h) * gradient / (h * h));
  if (settings.contact_angle) {
    contact_ = {static_cast<Real>(std::cos(*settings.contact_angle)), static_cast<Real>(std::sin(*settings.contact_angle))};
  }
}

template <class Real>
SurfaceNormals<Real> SurfaceTension<Real>::begin(const Particles<Real>& p, const WallEffects<Real>& walls,
                                                 PairPasses<Real>& passes, int shares, Executor& executor) {
  if (!walls.empty()) {
    executor.run(shares, [&](int share) {
      walls.forEachTouching(share, [&](std::uint32_t i, const WallSample<Real>& wall, Real) {
        for (std::size_t a = 0; a < 3; ++a) passes.record(i)[kRecordNormalX + a] = h_ * wall.gradient[a];
      });
    });
  }
  const std::size_t reals = std::size_t{capacity_} * 4;
  totals_ = scratch_.take<Total>(0, capacity_);
  normal_ = scratch_.take<Real>(normalsAt(capacity_), reals);
  acceleration_ = scratch_.take<Real>(accelerationsAt(capacity_), reals);
  curvature_.normal = normal_;
  curvature_.acceleration = acceleration_;
  SurfaceNormals<Real> normals = normals_;
  normals.normal = normal_;
  normals.driver = p.driver.data();
  normals.record = passes.record(0);
  return normals;
}

template <class Real>
void SurfaceTension<Real>::add(const CellGrid<Real>& grid, const Particles<Real>& p, const WallEffects<Real>& walls,
                               PairPasses<Real>& passes, std::uint32_t count, int shares, Executor& executor) {
  if (!walls.empty()) meetTissue(walls, passes, shares, executor);
  passes.sweep(grid, p, count, shares, executor, sweep_, curvature_);
  addFreed(grid, p, passes, count, shares, executor);
}

/// Marks what tissue holds, and turns the normals at the contact line.
template <class Real>
void SurfaceTension<Real>::meetTissue(const WallEffects<Real>& walls, PairPasses<Real>& passes, int shares, Executor& executor) {
  executor.run(shares, [&](int share) {
    walls.forEachTouching(share, [&](std::uint32_t i, const WallSample<Real>& wall, Real closed) {
      Real* const normal = normal_ + std::size_t{i} * 4;
      Real* const surface = passes.record(i) + kRecordNormalX;
      normal[3] = Real(1);
      const bool open_wound = closed < Real(1);
      if (contact_ && !open_wound && surface[3] > Real(0)) turn(wall, surface, normal);
    });
  });
}

/// `surface` holds nhat, `normal` n h.
template <class Real>
void SurfaceTension<Real>::turn(const WallSample<Real>& wall, Real* surface, Real* normal) const {
  const std::array<Real, 3>& out = wall.normal;
  const Real across = surface[0] * out[0] + surface[1] * out[1] + surface[2] * out[2];
  const Real tangent[3] = {surface[0] - across * out[0], surface[1] - across * out[1], surface[2] - across * out[2]};
  const Real part = std::sqrt(tangent[0] * tangent[0] + tangent[1] * tangent[1] + tangent[2] * tangent[2]);
  if (part < static_cast<Real>(kLeastTangent)) return;
  const Real own = std::clamp(wall.distance / h_, Real(0), Real(1));
  Real turned[3];
  for (std::size_t a = 0; a < 3; ++a) {
    turned[a] = own * surface[a] + (Real(1) - own) * (contact_->sine / part * tangent[a] - contact_->cosine * out[a]);
  }
  const Real size = std::sqrt(turned[0] * turned[0] + turned[1] * turned[1] + turned[2] * turned[2]);
  if (!(size > Real(0))) return;
  const Real length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
  for (std::size_t a = 0; a < 3; ++a) {
    surface[a] = turned[a] / size;
    normal[a] = length * surface[a];
  }
}

template <class Real>
typename SurfaceTension<Real>::Total SurfaceTension<Real>::totalOf(std::uint32_t begin, std::uint32_t end) const {
  Total total{{0.0, 0.0, 0.0}, end - begin, false};
  for (std::uint32_t i = begin; i < end; ++i) {
    for (std::size_t a = 0; a < 3; ++a) total.acceleration[a] += static_cast<double>(acceleration_[std::size_t{i} * 4 + a]);
    total.held = total.held || normal_[std::size_t{i} * 4 + 3] != Real(0);
  }
  return total;
}

/// Adds tension to the accelerations, less its mean over each body that nothing holds.
template <class Real>
void SurfaceTension<Real>::addFreed(const CellGrid<Real>& grid, const Particles<Real>& p, PairPasses<Real>& passes,
                                    std::uint32_t count, int shares, Executor& executor) {
  bodies_.find(grid, p, count, shares, executor);
  const auto first_of = [&](int share) { return grid.view().rowBegin(grid.firstRow(share, shares, count)); };
  executor.run(shares, [&](int share) {
    const std::uint32_t end = first_of(share + 1);
    for (std::uint32_t first = first_of(share); first < end; first = bodies_.cellEnd(first)) {
      totals_[first] = totalOf(first, bodies_.cellEnd(first));
    }
  });
  for (std::uint32_t first = 0; first < count; first = bodies_.cellEnd(first)) {
    const Total& cell = totals_[first];
    Total& body = totals_[bodies_.bodyOf(first)];
    if (&cell == &body) continue;
    for (std::size_t a = 0; a < 3; ++a) body.acceleration[a] += cell.acceleration[a];
    body.particles += cell.particles;
    body.held = body.held || cell.held;
  }
  executor.run(shares, [&](int share) {
    const std::uint32_t end = first_of(share + 1);
    for (std::uint32_t first = first_of(share); first < end; first = bodies_.cellEnd(first)) {
      const Total& body = totals_[bodies_.bodyOf(first)];
      Real mean[3] = {};
      for (std::size_t a = 0; a < 3 && !body.held; ++a) {
        mean[a] = static_cast<Real>(body.acceleration[a] / static_cast<double>(body.particles));
      }
      for (std::uint32_t i = first; i < bodies_.cellEnd(first); ++i) {
        Real* sum = passes.acceleration() + std::size_t{i} * 4;
        for (std::size_t a = 0; a < 3; ++a) sum[a] += acceleration_[std::size_t{i} * 4 + a] - mean[a];
      }
    }
  });
}

template class SurfaceTension<float>;
template class SurfaceTension<double>;

}  // namespace bleedsim::sph
