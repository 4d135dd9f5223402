// Tissue in a step: samples the walls near particles once, then adds pressure, contact spring and friction (walls.md, model "E").
#pragma once

#include <cstdint>
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
    for (int share = 0; share < shares; ++share) touching_.emplace_back(capacity, 19u, Uninitialized{});
    counts_.resize(static_cast<std::size_t>(shares), Count{});
  }

  bool empty() const { return field_.empty(); }
  std::size_t bytes() const {
    std::size_t sum = share_.bytes();
    for (const AlignedArray<Touching>& list : touching_) sum += list.bytes();
    return sum;
  }
  const TissueField<Real>& field() const { return field_; }
  /// The tissue's share of density per particle; null without tissue.
  const Real* share() const { return share_.empty() ? nullptr : share_.data(); }

  /// Particles of a throat see no tissue: they stand for it. Cells that lie deep in the blood are passed over.
  void sample(const CellGrid<Real>& grid, const Particles<Real>& p, const WoundSet& wounds, std::uint32_t count, int shares,
              Executor& executor) {
    if (field_.empty()) return;
    executor.run(shares, [&](int share) {
      const GridView<Real>& view = grid.view();
      Touching* const list = touching_[static_cast<std::size_t>(share)].data();
      std::uint32_t length = 0;
      const int end = grid.firstRow(share + 1, shares, count);
      for (int row = grid.firstRow(share, shares, count); row < end; ++row) {
        if (view.rowBegin(row) == view.rowEnd(row)) continue;
        for (int x = 1; x < view.size[0] - 1; ++x) {
          const std::size_t cell = view.cell(row, x);
          if (view.start[cell] != view.start[cell + 1]) {
            length += sampleCell(p, wounds, view.start[cell], view.start[cell + 1], list + length);
          }
        }
      }
      counts_[static_cast<std::size_t>(share)].touching = length;
    });
  }

  /// Calls visit(particle, wall, closed) for the particles of a share that touch tissue, by rising index. A share is that of the
  /// grid's rows in sample(), which must have been called with as many `shares`. `closed` is 1 less what an open wound takes of
  /// the tissue there.
  template <class Visit>
  void forEachTouching(int share, Visit&& visit) const {
    if (field_.empty()) return;
    const Touching* list = touching_[static_cast<std::size_t>(share)].data();
    for (std::uint32_t k = 0; k < counts_[static_cast<std::size_t>(share)].touching; ++k) {
      visit(list[k].particle, list[k].wall, list[k].closed);
    }
  }

  /// Adds to the accelerations. Velocities are those of the half step. With `drag`, friction goes there as a rate in 1/s, one for
  /// each particle, instead of into the accelerations.
  void addForces(const Particles<Real>& p, PairPasses<Real>& passes, int shares, Executor& executor, Real* drag) const {
    if (field_.empty()) return;
    executor.run(shares, [&](int share) {
      const Touching* list = touching_[static_cast<std::size_t>(share)].data();
      for (std::uint32_t k = 0; k < counts_[static_cast<std::size_t>(share)].touching; ++k) addForce(list[k], p, passes, drag);
    });
  }

  /// The safety net: particles found behind tissue are put back in front of it, their velocity into it is taken. Returns how
  /// many.
  std::uint64_t project(Particles<Real>& p, int shares, Executor& executor) {
    if (field_.empty()) return 0;
    executor.run(shares, [&](int share) {
      Count& count = counts_[static_cast<std::size_t>(share)];
      count.projected = 0;
      for (std::uint32_t k = 0; k < count.touching; ++k) {
        const Touching& entry = touching_[static_cast<std::size_t>(share)][k];
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
    std::uint32_t touching = 0;
    std::uint64_t projected = 0;
  };

  /// Of the particles from `begin` to `end`, one cell's; returns how many touch.
  std::uint32_t sampleCell(const Particles<Real>& p, const WoundSet& wounds, std::uint32_t begin, std::uint32_t end,
                           Touching* list) {
    std::fill(share_.data() + begin, share_.data() + end, Real(0));
    std::array<Real, 3> lower{p.x[begin], p.y[begin], p.z[begin]};
    std::array<Real, 3> upper = lower;
    for (std::uint32_t i = begin + 1; i < end; ++i) {
      lower = {std::min(lower[0], p.x[i]), std::min(lower[1], p.y[i]), std::min(lower[2], p.z[i])};
      upper = {std::max(upper[0], p.x[i]), std::max(upper[1], p.y[i]), std::max(upper[2], p.z[i])};
    }
    for (std::size_t a = 0; a < 3; ++a) {
      lower[a] *= constants_.h;
      upper[a] *= constants_.h;
    }
    using Nearness = typename TissueField<Real>::Nearness;
    const auto near = field_.nearby(lower, upper);
    if (near.nearness == Nearness::none) return 0;
    const bool near_wound = wounds.mayOpen(asVec3(lower), asVec3(upper));
    const WoundSet* const open = near_wound ? &wounds : nullptr;
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
  std::vector<AlignedArray<Touching>> touching_;
  std::vector<Count> counts_;
};

}  // namespace bleedsim::sph
