// The pair passes of one world: the variant picked for its effects, and the storage that they share.
#pragma once

#include <algorithm>
#include <vector>

#include "service/sph/aligned_array.h"
#include "service/sph/executor.h"
#include "service/sph/neighbors/cell_grid.h"
#include "service/sph/particles.h"
#include "service/sph/passes/pass_table.h"

namespace bleedsim::sph {

/// The constants of the passes, from the scene; see pass_jobs.h for their meaning.
template <class Real>
struct PairConstants {
  Real mass_weight = 0;
  Real rest_density = 0;
  Real stiffness = 0;
  Real background = 0;
  Real pressure_scale = 0;
  Real viscosity_scale = 0;
};

template <class Real>
class PairPasses {
 public:
  PairPasses(const PassTable<Real>& table, PairSet set, bool periodic, bool tissue, const PairConstants<Real>& constants,
             std::uint32_t capacity, double support_ratio, int shares)
      : density_function_{table.density[periodic ? 1 : 0][tissue ? 1 : 0]},
        force_function_{table.force[periodic ? 1 : 0][set.index()]},
        groups_{recordGroups(set)},
        constants_{constants},
        record_{(std::size_t{capacity} + 1) * static_cast<std::size_t>(4 * groups_), 37},
        density_{capacity, 41},
        acceleration_{std::size_t{capacity} * 4, 43},
        list_at_{capacity, 47},
        blocks_{capacity, 53} {
    const double neighbors = 4.2 * support_ratio * support_ratio * support_ratio;
    const std::size_t per_particle = static_cast<std::size_t>(1.2 * neighbors) + 24;
    for (int share = 0; share < shares; ++share) {
      entries_.emplace_back(std::size_t{capacity} * per_particle + 64 * kMaxNeighbors, 59u, Uninitialized{});
      lists_.push_back({.entries = entries_.back().data(), .capacity = entries_.back().size()});
    }
    overflowed_.resize(static_cast<std::size_t>(shares));
  }

  /// Packs what the set of effects reads of particle i.
  void pack(std::size_t i, const Particles<Real>& p) {
    Real* record = record_.data() + i * static_cast<std::size_t>(4 * groups_);
    record[kRecordX] = p.x[i];
    record[kRecordY] = p.y[i];
    record[kRecordZ] = p.z[i];
    if (groups_ > 1) {
      record[kRecordVx] = p.vx[i];
      record[kRecordVy] = p.vy[i];
      record[kRecordVz] = p.vz[i];
    }
    if (groups_ > 2) record[kRecordInverseViscosity] = p.inverse_viscosity[i];
  }

  /// Densities, pressures and neighbour lists of the `count` sorted and packed particles; returns how many took the slow path.
  std::uint64_t density(const CellGrid<Real>& grid, const Particles<Real>& p, const Real* wall_share, std::uint32_t count,
                        int shares, Executor& executor) {
    Real* dummy = record_.data() + std::size_t{count} * static_cast<std::size_t>(4 * groups_);
    for (int k = 0; k < 4 * groups_; ++k)
      dummy[k] = k <= kRecordZ ? Real(1e6) : (k == kRecordInverseViscosity ? Real(1) : Real(0));
    executor.run(shares, [&](int share) {
      NeighborLists& lists = lists_[static_cast<std::size_t>(share)];
      lists.used = 0;
      DensityJob<Real> job;
      job.grid = grid.view();
      job.row_begin = grid.firstRow(share, shares, count);
      job.row_end = grid.firstRow(share + 1, shares, count);
      job.x = p.x.data();
      job.y = p.y.data();
      job.z = p.z.data();
      job.share = wall_share;
      job.count = count;
      job.groups = groups_;
      job.mass_weight = constants_.mass_weight;
      job.rest_density = constants_.rest_density;
      job.stiffness = constants_.stiffness;
      job.background = constants_.background;
      job.pressure_scale = constants_.pressure_scale;
      job.lists = &lists;
      job.list_at = list_at_.data();
      job.blocks = blocks_.data();
      job.record = record_.data();
      job.density = density_.data();
      density_function_(job);
      overflowed_[static_cast<std::size_t>(share)] = job.overflowed;
    });
    std::uint64_t overflowed = 0;
    for (int share = 0; share < shares; ++share) overflowed += overflowed_[static_cast<std::size_t>(share)];
    return overflowed;
  }

  /// Accelerations by all pair effects; zero when the scene has none. `shares` as in density().
  void force(const CellGrid<Real>& grid, const Particles<Real>& p, std::uint32_t count, int shares, Executor& executor) {
    executor.run(shares, [&](int share) {
      ForceJob<Real> job;
      job.grid = grid.view();
      job.row_begin = grid.firstRow(share, shares, count);
      job.row_end = grid.firstRow(share + 1, shares, count);
      if (force_function_ == nullptr) {
        std::fill(acceleration_.data() + 4 * std::size_t{job.grid.rowBegin(job.row_begin)},
                  acceleration_.data() + 4 * std::size_t{job.grid.rowBegin(job.row_end)}, Real(0));
        return;
      }
      job.count = count;
      job.x = p.x.data();
      job.y = p.y.data();
      job.z = p.z.data();
      job.record = record_.data();
      job.entries = lists_[static_cast<std::size_t>(share)].entries;
      job.list_at = list_at_.data();
      job.blocks = blocks_.data();
      job.viscosity_scale = constants_.viscosity_scale;
      job.acceleration = acceleration_.data();
      force_function_(job);
    });
  }

  Real* acceleration() { return acceleration_.data(); }
  const Real* acceleration() const { return acceleration_.data(); }
  const Real* density() const { return density_.data(); }
  void moveDensity(std::size_t to, std::size_t from) { density_[to] = density_[from]; }
  /// Of the equation of state, Pa.
  Real pressureAt(Real density) const {
    return std::max(Real(0), constants_.background + constants_.stiffness * (density - constants_.rest_density));
  }

 private:
  DensityFunction<Real> density_function_;
  ForceFunction<Real> force_function_;
  int groups_;
  PairConstants<Real> constants_;
  AlignedArray<Real> record_;
  AlignedArray<Real> density_;       // kg/m^3
  AlignedArray<Real> acceleration_;  // 4 per particle, m/s^2
  AlignedArray<std::uint32_t> list_at_;
  AlignedArray<std::uint8_t> blocks_;
  std::vector<AlignedArray<std::uint32_t>> entries_;
  std::vector<NeighborLists> lists_;
  std::vector<std::uint64_t> overflowed_;
};

}  // namespace bleedsim::sph
