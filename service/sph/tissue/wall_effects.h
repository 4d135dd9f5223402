// Tissue in a step: samples the walls near particles once, then adds pressure, contact spring and friction (walls.md, model "E").
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "service/sph/aligned_array.h"
#include "service/sph/effects/adhesion.h"
#include "service/sph/executor.h"
#include "service/sph/neighbors/cell_grid.h"
#include "service/sph/particles.h"
#include "service/sph/passes/pair_passes.h"
#include "service/sph/tissue/tissue_field.h"
#include "service/sph/wound/wound_set.h"

namespace bleedsim::sph {

template <class Real>
struct WallConstants {
  Real h = 0;                 ///< m
  Real rest_density = 0;      ///< kg/m^3
  Real speed_of_sound2 = 0;   ///< c0^2
  Real viscosity_factor = 0;  ///< rest-lattice factor; 0 without viscosity
  Real viscosity = 0;         ///< Pa s, where particles carry none
  bool pressure = false;
  Adhesion<Real> adhesion;  ///< of acceleration 0 without the effect
};

template <class Real>
class WallEffects {
 public:
  WallEffects(TissueField<Real> field, const WallConstants<Real>& constants, std::uint32_t capacity, int shares)
      : field_{std::move(field)}, constants_{constants} {
    if (field_.empty()) return;
    share_ = AlignedArray<Real>{capacity, 17};
    touching_ = AlignedArray<Touching>{capacity, 19u, Uninitialized{}};
    counts_.resize(static_cast<std::size_t>(shares), Count{});
  }

  bool empty() const { return field_.empty(); }
  std::size_t bytes() const { return share_.bytes() + touching_.bytes(); }
  const TissueField<Real>& field() const { return field_; }
  /// The tissue's share of density per particle; null without tissue.
  const Real* share() const { return share_.empty() ? nullptr : share_.data(); }

  /// Particles of a throat see no tissue: they stand for it. Cells that lie deep in the blood are passed over.
  void sample(const CellGrid<Real>& grid, const Particles<Real>& p, const WoundSet& wounds, std::uint32_t count, int shares,
              Executor& executor) {
    if (field_.empty()) return;
    executor.run(shares, [&](int share) {
      const GridView<Real>& view = grid.view();
      const int first = grid.firstRow(share, shares, count);
      const int end = grid.firstRow(share + 1, shares, count);
      Count& own = counts_[static_cast<std::size_t>(share)];
      own.begin = view.rowBegin(first);
      Touching* const list = touching_.data() + own.begin;
      std::fill(share_.data() + own.begin, share_.data() + view.rowBegin(end), Real(0));
      std::uint32_t length = 0;
      Bounds<Real> bounds;
      for (int row = first; row < end; ++row) {
        if (view.rowBegin(row) == view.rowEnd(row)) continue;
        grid.narrow(1, row % view.size[1], bounds);
        grid.narrow(2, row / view.size[1], bounds);
        for (int x = 1; x < view.size[0] - 1; ++x) {
          const std::size_t cell = view.cell(row, x);
          if (view.start[cell] == view.start[cell + 1]) continue;
          grid.narrow(0, x, bounds);
          length += sampleCell(p, wounds, bounds, view.start[cell], view.start[cell + 1], list + length);
        }
      }
      own.touching = length;
    });
  }

  /// Calls visit(particle, wall, closed) for the particles of a share that touch tissue, by rising index. A share is that of the
  /// grid's rows in sample(), which must have been called with as many `shares`. `closed` is 1 less what an open wound takes of
  /// the tissue there.
  template <class Visit>
  void forEachTouching(int share, Visit&& visit) const {
    if (field_.empty()) return;
    for (const Touching& entry : touching(share)) visit(entry.particle, entry.wall, entry.closed);
  }

  /// Adds to the accelerations. Velocities are those of the half step. With `drag`, friction goes there as a rate in 1/s, one for
  /// each particle, instead of into the accelerations.
  void addForces(const Particles<Real>& p, PairPasses<Real>& passes, int shares, Executor& executor, Real* drag) const {
    if (field_.empty()) return;
    executor.run(shares, [&](int share) {
      for (const Touching& entry : touching(share)) addForce(entry, p, passes, drag);
    });
  }

  /// The safety net: particles found behind tissue are put back in front of it, their velocity into it is taken. Returns how
  /// many.
  std::uint64_t project(Particles<Real>& p, int shares, Executor& executor) {
    if (field_.empty()) return 0;
    executor.run(shares, [&](int share) {
      Count& count = counts_[static_cast<std::size_t>(share)];
      count.projected = 0;
      for (const Touching& entry : touching(share)) {
        if (entry.wall.distance < Real(0) && projectOne(entry.particle, p)) ++count.projected;
      }
    });
    std::uint64_t projected = 0;
    for (int share = 0; share < shares; ++share) projected += counts_[static_cast<std::size_t>(share)].projected;
    return projected;
  }

 private:
  struct Touching {
    std::uint32_t particle;
    Real closed;
    WallSample<Real> wall;
  };
  struct alignas(64) Count {
    std::uint32_t begin = 0;  // in touching_
    std::uint32_t touching = 0;
    std::uint64_t projected = 0;
  };

  std::span<const Touching> touching(int share) const {
    const Count& own = counts_[static_cast<std::size_t>(share)];
    return {touching_.data() + own.begin, own.touching};
  }

  /// Of the particles from `begin` to `end`, those of a cell with these bounds; returns how many touch.
  std::uint32_t sampleCell(const Particles<Real>& p, const WoundSet& wounds, const Bounds<Real>& bounds, std::uint32_t begin,
                           std::uint32_t end, Touching* list) {
    using Nearness = typename TissueField<Real>::Nearness;
    std::array<Real, 3> lower = bounds.lower;
    std::array<Real, 3> upper = bounds.upper;
    for (std::size_t a = 0; a < 3; ++a) {
      lower[a] *= constants_.h;
      upper[a] *= constants_.h;
    }
    const auto near = field_.nearby(lower, upper);
    if (near.nearness == Nearness::none) return 0;
    const WoundSet* const open = wounds.mayOpen(asVec3(lower), asVec3(upper)) ? &wounds : nullptr;
    switch (near.nearness) {
      case Nearness::plane:
        return sampleLone<Nearness::plane>(p, open, near, begin, end, list);
      case Nearness::hollow:
        return sampleLone<Nearness::hollow>(p, open, near, begin, end, list);
      default:
        return sampleAny(p, open, begin, end, list);
    }
  }

  std::uint32_t sampleAny(const Particles<Real>& p, const WoundSet* open, std::uint32_t begin, std::uint32_t end,
                          Touching* list) {
    std::uint32_t length = 0;
    for (std::uint32_t i = begin; i < end; ++i) {
      if (p.driver[i] != 0) continue;
      const std::array<Real, 3> x = placeOf(p, i);
      Touching& entry = list[length];
      if (!field_.sample(x[0], x[1], x[2], entry.wall, radiusOf(p, i))) continue;
      entry.particle = i;
      close(open, x, entry);
      ++length;
    }
    return length;
  }

  /// Two loops: who touches is a coin's toss, at which a processor guesses wrong, and what follows would wait for it.
  template <typename TissueField<Real>::Nearness kNearness>
  std::uint32_t sampleLone(const Particles<Real>& p, const WoundSet* open, const typename TissueField<Real>::Nearby& near,
                           std::uint32_t begin, std::uint32_t end, Touching* list) {
    std::uint32_t length = 0;
    for (std::uint32_t i = begin; i < end; ++i) {
      const std::array<Real, 3> x = placeOf(p, i);
      const bool touches = field_.template touchesLone<kNearness>(near, x[0], x[1], x[2]);
      list[length].particle = i;
      length += static_cast<std::uint32_t>(touches) & static_cast<std::uint32_t>(p.driver[i] == 0);
    }
    for (std::uint32_t k = 0; k < length; ++k) {
      Touching& entry = list[k];
      const std::array<Real, 3> x = placeOf(p, entry.particle);
      field_.template sampleLone<kNearness>(near, x[0], x[1], x[2], entry.wall, radiusOf(p, entry.particle));
      close(open, x, entry);
    }
    return length;
  }

  /// What the wounds that may be `open` there, if any, leave of a wall; with that the sample of the entry's particle is complete.
  void close(const WoundSet* open, const std::array<Real, 3>& x, Touching& entry) {
    entry.closed = Real(1);
    if (open != nullptr) {
      entry.closed -= static_cast<Real>(open->openFraction(asVec3(x)));
      closeBy(entry.closed, entry.wall);
    }
    share_[entry.particle] = entry.wall.share;
  }

  std::array<Real, 3> placeOf(const Particles<Real>& p, std::uint32_t i) const {
    return {p.x[i] * constants_.h, p.y[i] * constants_.h, p.z[i] * constants_.h};
  }
  static Real radiusOf(const Particles<Real>& p, std::uint32_t i) { return p.radius.empty() ? Real(1) : p.radius[i]; }

  static Vec3 asVec3(const std::array<Real, 3>& v) {
    return Eigen::Map<const Eigen::Matrix<Real, 3, 1>>{v.data()}.template cast<double>();
  }

  static void closeBy(Real closed, WallSample<Real>& wall) {
    if (closed == Real(1)) return;
    wall.share *= closed;
    wall.friction *= closed;
    for (std::size_t a = 0; a < 3; ++a) {
      wall.gradient[a] *= closed;
      wall.spring[a] *= closed;
    }
  }

  void addForce(const Touching& entry, const Particles<Real>& p, PairPasses<Real>& passes, Real* drag_rates) const {
    const std::uint32_t i = entry.particle;
    const Real density = passes.density()[i];
    const Real pressure = constants_.pressure ? passes.pressureAt(density) : Real(0);
    const Real push = -constants_.rest_density * pressure / (density * density);
    Real drag = Real(0);
    if (constants_.viscosity_factor > Real(0)) {
      const Real viscosity = p.inverse_viscosity.empty() ? constants_.viscosity : Real(1) / p.inverse_viscosity[i];
      drag = constants_.viscosity_factor * passes.viscosityFactor(i) * viscosity / density * entry.wall.friction;
    }
    if (drag_rates != nullptr) {
      drag_rates[i] = drag;
      drag = Real(0);
    }
    const Real pull = entry.closed * constants_.adhesion.along(entry.wall.distance);
    Real* a = passes.acceleration() + std::size_t{i} * 4;
    const Real v[3] = {p.vx[i], p.vy[i], p.vz[i]};
    for (std::size_t k = 0; k < 3; ++k) {
      a[k] += push * entry.wall.gradient[k] + constants_.speed_of_sound2 * entry.wall.spring[k] + drag * v[k] +
              pull * entry.wall.normal[k];
    }
  }

  bool projectOne(std::uint32_t i, Particles<Real>& p) const {
    std::array<Real, 3> position{p.x[i] * constants_.h, p.y[i] * constants_.h, p.z[i] * constants_.h};
    std::array<Real, 3> normal{};
    if (!field_.project(position, normal)) return false;
    p.x[i] = position[0] / constants_.h;
    p.y[i] = position[1] / constants_.h;
    p.z[i] = position[2] / constants_.h;
    const Real into = std::min(Real(0), p.vx[i] * normal[0] + p.vy[i] * normal[1] + p.vz[i] * normal[2]);
    p.vx[i] -= into * normal[0];
    p.vy[i] -= into * normal[1];
    p.vz[i] -= into * normal[2];
    return true;
  }

  TissueField<Real> field_;
  WallConstants<Real> constants_;
  AlignedArray<Real> share_;
  AlignedArray<Touching> touching_;  // a share's from the place of its first particle on
  std::vector<Count> counts_;
};

}  // namespace bleedsim::sph
