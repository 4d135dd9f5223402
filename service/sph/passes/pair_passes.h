// The pair passes of one world: the variant picked for its effects, and the storage that they share.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>
#include <vector>

#include "service/sph/aligned_array.h"
#include "service/sph/effects/core_radius.h"
#include "service/sph/executor.h"
#include "service/sph/neighbors/cell_grid.h"
#include "service/sph/particles.h"
#include "service/sph/passes/list_stretches.h"
#include "service/sph/passes/pass_table.h"
#include "service/sph/quad.h"
#include "service/sph/running_code.h"
#include "service/sph/stage_clock.h"

namespace bleedsim::sph {

/// The constants of the passes, from the scene; see pass_jobs.h for their meaning.
template <class Real>
struct PairConstants {
  Real mass_weight = 0;
  Real rest_density = 0;
  Real stiffness = 0;
  Real background = 0;
  Real pressure_floor = 0;
  Real pressure_scale = 0;
  Real viscosity_scale = 0;
  Real repulsion_scale = 0;
  Real repulsion_contact = 0;
  Real repulsion_overlap = 2;
  Real repulsion_damping = 0;
  int repulsion_powers[2] = {6, 4};
};

/// What a world needs of the passes.
struct PairLayout {
  PairSet set;
  bool tissue = false;
  bool planar = false;
  int least_groups = 1;  ///< of record fields, for passes that the set does not name
  RecordField platelet_field = kRecordPlatelet;
};

template <class Real>
class PairPasses {
 public:
  /// `table` must hold the layout's set of effects: createWorld checks it. `support_ratio` is that of the largest radius;
  /// `lattice` comes with (34) of the sound model.
  PairPasses(const PassTable<Real>& table, const PairLayout& layout, const PairConstants<Real>& constants, std::uint32_t capacity,
             double support_ratio, int shares, const std::optional<LatticeFactors<Real>>& lattice = std::nullopt)
      : density_function_{table.density[layout.tissue ? 1 : 0][layout.set.core_radius ? 1 : 0]},
        force_functions_{forceOf(table, layout.set, false), forceOf(table, layout.set, true)},
        symmetric_{layout.set.pressure == PressureTerm::symmetric},
        planar_{layout.planar},
        platelet_field_{layout.platelet_field},
        groups_{std::max(layout.least_groups, recordGroups(layout.set))},
        constants_{constants},
        lattice_{lattice},
        record_{(std::size_t{capacity} + 1) * static_cast<std::size_t>(4 * groups_), 37},
        density_{capacity, 41},
        acceleration_{std::size_t{capacity} * 4, 43},
        former_acceleration_{std::size_t{capacity} * 4, 44},
        list_at_{capacity, 47},
        blocks_{capacity, 53},
        room_{roomFor(capacity, static_cast<std::size_t>(shares) * kDensityRoom<Real>)} {
    const double neighbors = 4.2 * support_ratio * support_ratio * support_ratio;
    const std::size_t per_particle = static_cast<std::size_t>(1.2 * neighbors) + 24;
    for (int share = 0; share < shares; ++share) {
      entries_.emplace_back(std::size_t{capacity} * per_particle + 64 * kMaxNeighbors, 59u, Uninitialized{});
      distances_.emplace_back(entries_.back().size(), 61u, Uninitialized{});
      lists_.push_back({.entries = entries_.back().data(), .distances = distances_.back().data()});
      stretches_.emplace_back(entries_.back().size());
    }
    overflowed_.resize(static_cast<std::size_t>(shares));
  }

  /// Packs what the set of effects reads of the `length` particles from `begin` on.
  void pack(std::size_t begin, std::size_t length, const Particles<Real>& p) {
    packVectors(begin, length, kRecordX, p.x.data(), p.y.data(), p.z.data());
    if (groups_ > 1) packVectors(begin, length, kRecordVx, p.vx.data(), p.vy.data(), p.vz.data());
    for (std::size_t i = begin; groups_ > 2 && i < begin + length; ++i) {
      packRadius(record(i), p.radius.empty() ? Real(1) : p.radius[i]);
      setInverseViscosity(i, p.inverse_viscosity.empty() ? Real(1) : p.inverse_viscosity[i]);
      record(i)[platelet_field_] = p.platelet.empty() ? Real(0) : p.platelet[i];
      if (groups_ > 3) std::fill_n(record(i) + kRecordNormalX, 4, Real(0));
    }
  }

  /// Densities, pressures and neighbour lists of the `count` sorted and packed particles; returns how many took the slow path.
  std::uint64_t density(const CellGrid<Real>& grid, const Particles<Real>& p, const Real* wall_share, std::uint32_t count,
                        int shares, Executor& executor) {
    setDummy(count);
    lists_kept_ = true;
    executor.run(shares, [&](int share) {
      DensityJob<Real> job = densityJob(grid, p, wall_share, count, share);
      job.row_begin = grid.firstRow(share, shares, count);
      job.row_end = grid.firstRow(share + 1, shares, count);
      density_function_(job);
      overflowed_[static_cast<std::size_t>(share)] = job.overflowed;
    });
    return overflowed(shares);
  }

  /// density() and a walk over its lists in one, the walk one layer of cells behind: lists and records are in the caches still.
  /// Not with periodic sides, where the first row waits for the last. `keep`: another walk over the lists will follow; without it
  /// their room is used again and again. `walk_part` gets the walk's part of the time.
  template <class Job>
  std::uint64_t densityAndSweep(const CellGrid<Real>& grid, const Particles<Real>& p, const Real* wall_share, std::uint32_t count,
                                int shares, Executor& executor, void (*function)(const Job&), const Job& job, bool keep,
                                double& walk_part) {
    setDummy(count);
    lists_kept_ = keep;
    const int layer = grid.view().size[1] + 1;  // a row needs the densities of so many rows before and behind it
    StageClock times;                           // of the first share
    executor.run(shares, [&](int share) {
      DensityJob<Real> densities = densityJob(grid, p, wall_share, count, share);
      Job walk = sweepJob(grid, p, count, share, job);
      const int begin = grid.firstRow(share, shares, count);
      const int end = grid.firstRow(share + 1, shares, count);
      const int own = begin + (share == 0 ? 0 : layer);  // the rows before wait for the other share
      int walked = own;
      ListStretches& stretches = stretches_[static_cast<std::size_t>(share)];
      if (!keep) stretches.begin(grid.view(), begin, end, own, *densities.lists);
      for (int row = begin; row < end;) {
        if (share == 0) times.start();
        densities.row_begin = row;
        row = grid.view().rowsWith(ListStretches::kChunk, row, end);
        densities.row_end = row;
        if (!keep) stretches.prepare(densities.row_begin, walked, *densities.lists);
        density_function_(densities);
        if (!keep) stretches.note(densities.row_begin, densities.row_end, *densities.lists);
        if (share == 0) times.lap(Stage::density);
        if (row - layer <= walked) continue;
        walk.row_begin = walked;
        walk.row_end = row - layer;
        function(walk);
        walked = walk.row_end;
        if (share == 0) times.lap(Stage::force);
      }
      overflowed_[static_cast<std::size_t>(share)] = densities.overflowed;
    });
    executor.run(shares, [&](int share) {
      Job walk = sweepJob(grid, p, count, share, job);
      const int begin = grid.firstRow(share, shares, count);
      const int end = grid.firstRow(share + 1, shares, count);
      const int own = share == 0 ? begin : std::min(end, begin + layer);
      if (share == 0) times.start();
      walk.row_begin = begin;
      walk.row_end = own;
      function(walk);
      walk.row_begin = std::max(own, end - layer);
      walk.row_end = end;
      function(walk);
      if (share == 0) times.lap(Stage::force);
    });
    walk_part = times.part(Stage::force);
    return overflowed(shares);
  }

  /// Accelerations by all pair effects, but for viscosity where it is solved implicitly. Zero when there is none. `shares` as in
  /// density(); `job` by forceJob().
  void force(const CellGrid<Real>& grid, const Particles<Real>& p, std::uint32_t count, int shares, Executor& executor,
             bool viscous, const ForceJob<Real>& job) {
    const ForceFunction<Real> function = forceFunction(viscous);
    if (function == nullptr) {
      clearAccelerations(grid, count, shares, executor);
      return;
    }
    sweep(grid, p, count, shares, executor, function, job);
  }

  void clearAccelerations(const CellGrid<Real>& grid, std::uint32_t count, int shares, Executor& executor) {
    executor.run(shares, [&](int share) {
      const auto begin = grid.view().rowBegin(grid.firstRow(share, shares, count));
      const auto end = grid.view().rowBegin(grid.firstRow(share + 1, shares, count));
      std::fill(acceleration_.data() + 4 * std::size_t{begin}, acceleration_.data() + 4 * std::size_t{end}, Real(0));
    });
  }

  /// What force() runs; null where no effect acts in the pair loop.
  ForceFunction<Real> forceFunction(bool viscous) const { return force_functions_[viscous ? 1 : 0]; }
  /// Sets with tension want normals, too (SurfaceTension::begin).
  ForceJob<Real> forceJob() {
    ForceJob<Real> job;
    job.viscosity_scale = constants_.viscosity_scale;
    job.repulsion_scale = growth_ * growth_ * growth_ * constants_.repulsion_scale;
    job.repulsion_contact = growth_ * constants_.repulsion_contact;
    job.repulsion_overlap = constants_.repulsion_overlap;
    job.repulsion_damping = constants_.repulsion_damping;
    std::copy_n(constants_.repulsion_powers, 2, job.repulsion_powers);
    job.acceleration = acceleration_.data();
    return job;
  }

  /// Runs a walk over the lists that density() made: `function` with a copy of `job` for each share, its SweepJob part filled.
  template <class Job>
  void sweep(const CellGrid<Real>& grid, const Particles<Real>& p, std::uint32_t count, int shares, Executor& executor,
             void (*function)(const Job&), const Job& job) {
    assert(lists_kept_);
    executor.run(shares, [&](int share) {
      Job own = sweepJob(grid, p, count, share, job);
      own.row_begin = grid.firstRow(share, shares, count);
      own.row_end = grid.firstRow(share + 1, shares, count);
      function(own);
    });
  }

  /// The one place where a record gets its 1/mu, 1/(Pa s), with the lattice's factor on mu at the particle's own radius; the set
  /// of effects must have the third group.
  void setInverseViscosity(std::size_t i, Real inverse_viscosity) {
    const Real factor = viscosityFactor(i);
    record(i)[kRecordInverseViscosity] = factor != Real(1) ? inverse_viscosity / factor : inverse_viscosity;
  }
  /// The lattice's factor on mu at particle i's own radius, over that at h.
  Real viscosityFactor(std::size_t i) const {
    const Real inverse_radius = record_[i * static_cast<std::size_t>(4 * groups_) + kRecordInverseRadius];
    return lattice_ && inverse_radius != Real(1) ? lattice_->viscosity(Real(1) / inverse_radius) : Real(1);
  }

  /// How far the lists reach, over h: at least 1 and at least the largest radius that pack() will see.
  Real reach() const { return reach_; }
  void setReach(Real reach) { reach_ = reach; }

  /// The packed record of particle i (RecordField), for stages that write into it.
  Real* record(std::size_t i) { return record_.data() + i * static_cast<std::size_t>(4 * groups_); }

  std::size_t bytes() const {
    return record_.bytes() + density_.bytes() + 2 * acceleration_.bytes() + list_at_.bytes() + blocks_.bytes() + room_.bytes();
  }
  std::size_t listBytes() const {
    std::size_t sum = 0;
    for (const AlignedArray<std::uint32_t>& entries : entries_) sum += entries.bytes();
    for (const AlignedArray<Real>& distances : distances_) sum += distances.bytes();
    return sum;
  }

  std::uintptr_t densityCode() const { return codeOf(density_function_); }
  std::uintptr_t forceCode(bool viscous) const { return codeOf(forceFunction(viscous)); }

  Real* acceleration() { return acceleration_.data(); }
  const Real* acceleration() const { return acceleration_.data(); }
  /// Puts the accelerations aside, or back: those of a step's end are written beside those that it began with.
  void exchangeAccelerations() { acceleration_.swap(former_acceleration_); }
  /// What exchangeAccelerations() put aside, or the next accelerations' room until they are computed.
  Real* formerAcceleration() { return former_acceleration_.data(); }
  const Real* density() const { return density_.data(); }
  Real* density() { return density_.data(); }
  void moveDensity(std::size_t to, std::size_t from) { density_[to] = density_[from]; }
  /// The contact distance of repulsion over its own, 0 to 1. Contacts stay as stiff as they are: force over distance goes with
  /// the strength over the distance's cube.
  void setContactGrowth(Real growth) { growth_ = growth; }
  /// Takes the densities and accelerations of passes of the same capacity.
  void adopt(PairPasses& from) {
    density_.swap(from.density_);
    acceleration_.swap(from.acceleration_);
  }
  /// Of the equation of state, Pa.
  Real pressureAt(Real density) const {
    return std::max(constants_.pressure_floor,
                    constants_.background + constants_.stiffness * (density - constants_.rest_density));
  }

 private:
  /// Few particles never ask for more than their own pages.
  static AlignedArray<std::byte> roomFor(std::uint32_t capacity, std::size_t bytes) {
    constexpr std::uint32_t kManyParticles = 4096;
    if (capacity < kManyParticles) return {bytes, 0, Uninitialized{}};
    return {bytes, HugePage{}};
  }

  void setDummy(std::uint32_t count) {
    Real* dummy = record_.data() + std::size_t{count} * static_cast<std::size_t>(4 * groups_);
    for (int k = 0; k < 4 * groups_; ++k) dummy[k] = dummyField(k);
  }

  std::uint64_t overflowed(int shares) const {
    std::uint64_t sum = 0;
    for (int share = 0; share < shares; ++share) sum += overflowed_[static_cast<std::size_t>(share)];
    return sum;
  }

  /// All but the rows; the share's lists begin anew.
  DensityJob<Real> densityJob(const CellGrid<Real>& grid, const Particles<Real>& p, const Real* wall_share, std::uint32_t count,
                              int share) {
    NeighborLists<Real>& lists = lists_[static_cast<std::size_t>(share)];
    lists.used = 0;
    lists.end = entries_[static_cast<std::size_t>(share)].size();
    lists.next_begin = lists.next_end = 0;
    DensityJob<Real> job;
    job.grid = grid.view();
    job.x = p.x.data();
    job.y = p.y.data();
    job.z = p.z.data();
    job.radius = p.radius.data();
    job.share = wall_share;
    job.count = count;
    job.groups = groups_;
    job.mass_weight = constants_.mass_weight;
    job.rest_density = constants_.rest_density;
    job.stiffness = constants_.stiffness;
    job.background = constants_.background;
    job.pressure_floor = constants_.pressure_floor;
    job.pressure_scale = constants_.pressure_scale;
    job.symmetric = symmetric_;
    job.reach2 = reach_ * reach_;
    job.room = room_.data() + static_cast<std::size_t>(share) * kDensityRoom<Real>;
    job.lists = &lists;
    job.list_at = list_at_.data();
    job.blocks = blocks_.data();
    job.record = record_.data();
    job.density = density_.data();
    return job;
  }

  /// `job` with its SweepJob part filled, but for the rows.
  template <class Job>
  Job sweepJob(const CellGrid<Real>& grid, const Particles<Real>& p, std::uint32_t count, int share, const Job& job) const {
    Job own = job;
    own.grid = grid.view();
    own.count = count;
    own.x = p.x.data();
    own.y = p.y.data();
    own.z = p.z.data();
    own.record = record_.data();
    own.entries = lists_[static_cast<std::size_t>(share)].entries;
    own.distances = lists_[static_cast<std::size_t>(share)].distances;
    own.list_at = list_at_.data();
    own.blocks = blocks_.data();
    own.reach2 = reach_ * reach_;
    own.groups = groups_;
    return own;
  }

  static ForceFunction<Real> forceOf(const PassTable<Real>& table, PairSet set, bool viscous) {
    if (!viscous) set.viscosity = ViscosityTerm::none;
    return table.force[set.index()];
  }

  /// A group of the record that begins with a vector; its fourth field is 0 until a pass writes it.
  void packVectors(std::size_t begin, std::size_t length, RecordField field, const Real* x, const Real* y, const Real* z) {
    using Q = Quad<Real>;
    const auto stride = static_cast<std::size_t>(4 * groups_);
    Real* to = record(begin) + field;
    std::size_t i = begin;
    for (; i + Q::kWidth <= begin + length; i += Q::kWidth, to += Q::kWidth * stride) {
      Q::storeColumns(Q::load(x + i), Q::load(y + i), Q::load(z + i), Q::set(Real(0)), to, stride);
    }
    for (; i < begin + length; ++i, to += stride) {
      to[0] = x[i];
      to[1] = y[i];
      to[2] = z[i];
      to[3] = Real(0);
    }
  }

  void packRadius(Real* record, Real radius) const {
    if (radius == Real(1)) {
      record[kRecordInverseRadius] = record[kRecordRadiusFactor] = Real(1);
      return;
    }
    const Real inverse = Real(1) / radius;
    record[kRecordInverseRadius] = inverse;
    const Real factor = inverse * inverse * (planar_ ? Real(1) : inverse);
    record[kRecordRadiusFactor] = factor * (lattice_ ? lattice_->mass(radius) : Real(1));
  }

  /// The far dummy touches nothing and keeps every division defined.
  static Real dummyField(int field) {
    if (field <= kRecordZ) return Real(1e6);
    const bool divisor = field == kRecordInverseViscosity || field == kRecordInverseRadius || field == kRecordRadiusFactor;
    return divisor ? Real(1) : Real(0);
  }

  DensityFunction<Real> density_function_;
  std::array<ForceFunction<Real>, 2> force_functions_;  // [with viscosity]
  bool symmetric_;
  bool planar_;
  RecordField platelet_field_;
  int groups_;
  PairConstants<Real> constants_;
  Real growth_ = 1;                              // of the contact distance
  std::optional<LatticeFactors<Real>> lattice_;  // with (34) of the sound model
  AlignedArray<Real> record_;
  AlignedArray<Real> density_;       // kg/m^3
  AlignedArray<Real> acceleration_;  // 4 per particle, m/s^2
  AlignedArray<Real> former_acceleration_;
  AlignedArray<std::uint32_t> list_at_;
  AlignedArray<std::uint8_t> blocks_;
  AlignedArray<std::byte> room_;  // of the density passes, for each share
  std::vector<AlignedArray<std::uint32_t>> entries_;
  std::vector<AlignedArray<Real>> distances_;
  std::vector<NeighborLists<Real>> lists_;
  std::vector<ListStretches> stretches_;
  bool lists_kept_ = true;  // all of the last densities' lists stand
  std::vector<std::uint64_t> overflowed_;
  Real reach_ = 1;
};

}  // namespace bleedsim::sph
