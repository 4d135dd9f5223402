// What the density and force passes are given: plain views of the world's arrays, the same for every SIMD target.
#pragma once

#include <cstddef>
#include <cstdint>

#include "service/sph/neighbors/grid_view.h"

namespace bleedsim::sph {

constexpr int kMaxNeighbors = 192;           ///< a list's length; more go the slow path
constexpr std::uint8_t kOverflowList = 255;  ///< in DensityJob::blocks: this particle takes the slow path

/// How far the dummy that pads lists is in every list, over h: beyond all support.
template <class Real>
inline constexpr Real kFarDistance = Real(1e6);

/// What a density pass keeps of a cell at work, for each thread, bytes; on a page's border.
template <class Real>
inline constexpr std::size_t kDensityRoom = sizeof(Real) * 32768;

/// The support radius that a density pass weighs a pair with: h for all, the mean of both particles' kernels (the sound model's
/// (34)), or the particle's own (the literal model's).
enum class SupportRadius : std::uint8_t { common, mean, own };

/// The padded neighbour lists of one share. An entry is the neighbour's record offset in scalars; beside it stands the distance,
/// so that no walk over the lists takes a root: it would wait for the neighbour's place.
template <class Real>
struct alignas(64) NeighborLists {
  std::uint32_t* entries = nullptr;
  Real* distances = nullptr;  ///< / h
  std::size_t used = 0;
  std::size_t end = 0;         ///< of the room at work
  std::size_t next_begin = 0;  ///< of the room to go on in when that is full (ListStretches); empty: none
  std::size_t next_end = 0;

  /// Whether there is room to go on in; then it is at work.
  bool goOn() {
    if (next_begin == next_end) return false;
    used = next_begin;
    end = next_end;
    next_begin = next_end;
    return true;
  }
};

template <class Real>
struct DensityJob {
  GridView<Real> grid;
  int row_begin = 0, row_end = 0;
  const Real* x = nullptr;  ///< position / h
  const Real* y = nullptr;
  const Real* z = nullptr;
  const Real* radius = nullptr;  ///< own support radius / h; null without (34)
  const Real* share = nullptr;   ///< the tissue's share of density, 1; null without tissue
  std::uint32_t count = 0;       ///< particles; record `count` is the far dummy
  int groups = 1;                ///< record groups
  Real reach2 = 1;               ///< squared search radius / h^2: 1, or of the largest particle with (34)
  Real mass_weight = 0;          ///< m / h^3 * the kernel's norm: density = mass_weight * sum of the kernel's polynomial
  Real rest_density = 0;         ///< kg/m^3
  Real stiffness = 0;            ///< c0^2, m^2/s^2; 0 without pressure
  Real background = 0;           ///< Pa
  Real pressure_floor = 0;       ///< Pa: 0, or none in the literal model
  Real pressure_scale = 0;       ///< makes the record's pressure term, kRecordPressure; 0: it has none
  bool symmetric = false;        ///< kRecordPressure is for (17)

  std::byte* room = nullptr;  ///< kDensityRoom, of this share alone
  NeighborLists<Real>* lists = nullptr;
  std::uint32_t* list_at = nullptr;  ///< per particle, in the share's entries
  std::uint8_t* blocks = nullptr;    ///< per particle, list length in vectors, or kOverflowList
  Real* record = nullptr;
  Real* density = nullptr;       ///< kg/m^3
  std::uint64_t overflowed = 0;  ///< particles on the slow path
};

/// What every walk over the neighbour lists needs (list_sweep-inl.h).
template <class Real>
struct SweepJob {
  GridView<Real> grid;
  int row_begin = 0, row_end = 0;
  std::uint32_t count = 0;
  const Real* x = nullptr;  ///< position / h
  const Real* y = nullptr;
  const Real* z = nullptr;
  const Real* record = nullptr;
  const std::uint32_t* entries = nullptr;
  const Real* distances = nullptr;
  const std::uint32_t* list_at = nullptr;
  const std::uint8_t* blocks = nullptr;
  Real reach2 = 1;  ///< as in DensityJob
  int groups = 1;   ///< record groups: the stride
};

/// Surface normals, effects/surface_tension.h. Particle i's record starts with the tissue's share of n h in its normal fields and
/// ends with the fields of RecordField: unit normal and weight, zeros where the particle is no surface.
template <class Real>
struct SurfaceNormals {
  const std::uint32_t* driver = nullptr;  ///< particles of a throat stand for tissue and are never surface
  Real scale = 0;                         ///< V0/h^3 x the gradient's norm, 1
  Real cutoff = 0;                        ///< of |n| h
  Real* record = nullptr;                 ///< record 0, to write
  Real* normal = nullptr;                 ///< 4 per particle: n h; 1 for a particle of a throat, else 0
};

template <class Real>
struct ForceJob : SweepJob<Real> {
  Real viscosity_scale = 0;    ///< uniform: K mu; harmonic: 2 K; K = calibrated kernel prefactor
  Real repulsion_scale = 0;    ///< D* c0^2 dx/h^2, m/s^2
  Real repulsion_contact = 0;  ///< distance at which particles touch, /h
  Real repulsion_overlap = 2;  ///< largest pe: deeper in, the push stays
  Real repulsion_damping = 0;  ///< 1/s
  int repulsion_powers[2] = {6, 4};
  SurfaceNormals<Real> normals;  ///< of sets with tension
  Real* acceleration = nullptr;  ///< 4 per particle: x, y, z in m/s^2; 0
};

template <class Real>
using DensityFunction = void (*)(DensityJob<Real>&);
template <class Real>
using ForceFunction = void (*)(const ForceJob<Real>&);

}  // namespace bleedsim::sph
