// What may change in a running world. Commands are keyed to a step: World::apply acts before the next step.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>

#include "service/sph/world_description.h"

namespace bleedsim::sph {

/// Names one force source; instruments and one-off forces share the space, the caller keeps the keys apart.
using ForceKey = std::uint64_t;

struct AddWound {
  WoundDescription wound;
};
struct UpdateWound {
  std::uint32_t wound_id = 0;
  std::optional<std::string> name;
  std::optional<Vec3> position;
  std::optional<Vec3> normal;
  std::optional<Vec3> tangent;
  std::optional<PatchShape> shape;
  std::optional<WoundDrive> drive;
};
struct RemoveWound {
  std::uint32_t wound_id = 0;
};

/// `force` newtons on the fluid within `radius`, shared by kernel weight so that the sum is exactly `force`. Replaces the
/// source of the same key.
struct SetForce {
  ForceKey key = 0;
  Vec3 position = Vec3::Zero();
  double radius = 0.0;                                     ///< m
  Vec3 force = Vec3::Zero();                               ///< N
  double until = std::numeric_limits<double>::infinity();  ///< simulated time at which the source ends, s
};
struct RemoveForce {
  ForceKey key = 0;
};

using Command = std::variant<AddWound, UpdateWound, RemoveWound, SetForce, RemoveForce>;

}  // namespace bleedsim::sph
