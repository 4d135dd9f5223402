// Which pair effects a scene enables: variants of one term are exclusive slots, never bits.
#pragma once

#include <cstddef>
#include <cstdint>

namespace bleedsim::sph {

enum class PressureTerm : std::uint8_t { none, variational, symmetric, count };  ///< (16), (17)
enum class ViscosityTerm : std::uint8_t { none, uniform, harmonic, count };

struct PairSet {
  PressureTerm pressure = PressureTerm::none;
  ViscosityTerm viscosity = ViscosityTerm::none;
  bool tension = false;      ///< the normals of surface_tension are summed along
  bool repulsion = false;    ///< (35)(36)
  bool core_radius = false;  ///< (34): every particle has a support radius of its own

  static constexpr std::size_t kCount =
      static_cast<std::size_t>(PressureTerm::count) * static_cast<std::size_t>(ViscosityTerm::count) * 8;

  constexpr std::size_t index() const {
    return ((static_cast<std::size_t>(pressure) * static_cast<std::size_t>(ViscosityTerm::count) +
             static_cast<std::size_t>(viscosity)) *
                8 +
            (tension ? 4 : 0) + (repulsion ? 2 : 0) + (core_radius ? 1 : 0));
  }
  static constexpr PairSet at(std::size_t index) {
    constexpr auto kViscosities = static_cast<std::size_t>(ViscosityTerm::count);
    return {static_cast<PressureTerm>(index / 8 / kViscosities), static_cast<ViscosityTerm>(index / 8 % kViscosities),
            (index & 4) != 0, (index & 2) != 0, (index & 1) != 0};
  }
  /// No effect acts in the pair loop.
  constexpr bool empty() const {
    return pressure == PressureTerm::none && viscosity == ViscosityTerm::none && !tension && !repulsion;
  }
  /// A support radius of their own makes viscosity differ between particles: its factor travels in 1/mu.
  constexpr bool legal() const { return viscosity != ViscosityTerm::uniform || !core_radius; }

  friend constexpr bool operator==(const PairSet&, const PairSet&) = default;
};

/// Places in the packed record that the force pass reads of each neighbour. Fields come in groups of four; a set of effects
/// takes as many groups as its members name, so an absent effect takes no memory and no bandwidth.
enum RecordField : int {
  kRecordX = 0,  ///< position / h
  kRecordY = 1,
  kRecordZ = 2,
  kRecordPressure = 3,         ///< pressure scale * p/rho^2, or p for (17); of the sound model
  kRecordLiteralPlatelet = 3,  ///< P in the literal model, which has its pressure from the density
  kRecordVx = 4,               ///< m/s
  kRecordVy = 5,
  kRecordVz = 6,
  kRecordInverseDensity = 7,    ///< m^3/kg
  kRecordInverseViscosity = 8,  ///< 1/(Pa s)
  kRecordPlatelet = 9,          ///< P, 0 to 1; of the sound model
  kRecordInverseRadius = 10,    ///< h/h_i; 1 without (34)
  kRecordRadiusFactor = 11,     ///< (h/h_i)^d times the lattice's mass factor at h_i; 1 without (34)
  kRecordNormalX = 12,          ///< unit surface normal, out of nothing into the fluid; 0 in the bulk
  kRecordNormalY = 13,
  kRecordNormalZ = 14,
  kRecordSurfaceWeight = 15,  ///< how far the particle counts as surface, 0 to 1
};

constexpr int kMaxRecordGroups = 4;
constexpr int kPlateletGroups = 3;  ///< that the diffusion of platelets reads

/// The fourth group is what `tension` writes for its second walk.
constexpr int recordGroups(PairSet set) {
  if (set.tension) return 4;
  if (set.viscosity == ViscosityTerm::harmonic || set.core_radius) return 3;
  return set.viscosity == ViscosityTerm::uniform || set.pressure == PressureTerm::symmetric || set.repulsion ? 2 : 1;
}

}  // namespace bleedsim::sph
