// Which of the paper's terms act in the literal model's pair loop: 3 x 2^5 sets. literal_model.h says how a scene's effects map
// onto them.
#pragma once

#include <cstddef>

#include "service/sph/effects/pair_set.h"

namespace bleedsim::sph {

struct LiteralSet {
  PressureTerm pressure = PressureTerm::none;  ///< (16) or (17)
  bool tension = false;                        ///< (21)-(23)
  bool viscosity = false;                      ///< (25)
  bool platelets = false;                      ///< (27)
  bool repulsion = false;                      ///< (35)(36), alone between particles in contact
  bool core_radius = false;                    ///< (34): every particle sees others within a support radius of its own

  static constexpr std::size_t kCount = static_cast<std::size_t>(PressureTerm::count) * 32;
  static_assert(kCount <= 128, "an effect that needs more sets becomes a sweep of its own");

  constexpr std::size_t index() const {
    return static_cast<std::size_t>(pressure) * 32 + (tension ? 16 : 0) + (viscosity ? 8 : 0) + (platelets ? 4 : 0) +
           (repulsion ? 2 : 0) + (core_radius ? 1 : 0);
  }
  static constexpr LiteralSet at(std::size_t index) {
    return {static_cast<PressureTerm>(index / 32),
            (index & 16) != 0,
            (index & 8) != 0,
            (index & 4) != 0,
            (index & 2) != 0,
            (index & 1) != 0};
  }
  /// No term acts in the pair loop: a radius alone moves nothing.
  constexpr bool empty() const { return index() <= 1; }

  friend constexpr bool operator==(const LiteralSet&, const LiteralSet&) = default;
};

/// Groups of record fields (pair_set.h) that a set reads, of the particle itself included.
constexpr int literalRecordGroups(LiteralSet set) {
  if (set.viscosity || set.platelets || set.core_radius) return 3;
  return set.pressure != PressureTerm::none || set.tension ? 2 : 1;
}

}  // namespace bleedsim::sph
