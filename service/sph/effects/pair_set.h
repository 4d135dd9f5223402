// Which pair effects a scene enables: variants of one term are exclusive slots, never bits.
#pragma once

#include <cstddef>
#include <cstdint>

namespace bleedsim::sph {

enum class PressureTerm : std::uint8_t { none, variational, count };
enum class ViscosityTerm : std::uint8_t { none, uniform, harmonic, count };

struct PairSet {
  PressureTerm pressure = PressureTerm::none;
  ViscosityTerm viscosity = ViscosityTerm::none;

  static constexpr std::size_t kCount =
      static_cast<std::size_t>(PressureTerm::count) * static_cast<std::size_t>(ViscosityTerm::count);
  constexpr std::size_t index() const {
    return static_cast<std::size_t>(pressure) * static_cast<std::size_t>(ViscosityTerm::count) +
           static_cast<std::size_t>(viscosity);
  }
};

/// Places in the packed record that the force pass reads of each neighbour. Fields come in groups of four; a set of effects
/// takes as many groups as its members name, so an absent effect takes no memory and no bandwidth.
enum RecordField : int {
  kRecordX = 0,  ///< position / h
  kRecordY = 1,
  kRecordZ = 2,
  kRecordPressure = 3,  ///< pressure scale * p/rho^2
  kRecordVx = 4,        ///< m/s
  kRecordVy = 5,
  kRecordVz = 6,
  kRecordInverseDensity = 7,    ///< m^3/kg
  kRecordInverseViscosity = 8,  ///< 1/(Pa s)
};

constexpr int kMaxRecordGroups = 3;

constexpr int recordGroups(PairSet set) {
  if (set.viscosity == ViscosityTerm::harmonic) return 3;
  return set.viscosity == ViscosityTerm::uniform ? 2 : 1;
}

}  // namespace bleedsim::sph
