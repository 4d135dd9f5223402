// The particle side of a wound set as a test needs it: keeps the tagged particles and frees them when they are released.
#pragma once

#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>
#include <map>
#include <vector>

#include "service/lab/scene_parts.h"
#include "service/sph/wound/wound_set.h"

namespace bleedsim::sph {

inline WorldDescription plainDescription(double spacing = 0.001) {
  WorldDescription description;
  description.spacing = spacing;
  description.compressibility.design_speed = 0.5;
  return description;
}

using lab::discWound;

inline UpdateWound driveChange(std::uint32_t id, const WoundDrive& drive) {
  UpdateWound change;
  change.wound_id = id;
  change.drive = drive;
  return change;
}

inline UpdateWound moveChange(std::uint32_t id, const Vec3& position) {
  UpdateWound change;
  change.wound_id = id;
  change.position = position;
  return change;
}

class ThroatWorld {
 public:
  explicit ThroatWorld(const WorldDescription& description, std::size_t capacity = 1'000'000)
      : set{description, description.compressibility.mach_factor * description.compressibility.design_speed},
        capacity_{capacity} {}

  void step(double dt) {
    const InletStep done = set.advance(dt, [&](const InletSpawn& spawn) {
      if (tagged.size() >= capacity_) return false;
      const bool is_new = tagged.emplace(spawn.tag, spawn.state).second;
      EXPECT_TRUE(is_new) << "a tag that is still in use was given out";
      seen_crossing += spawn.state.phase != InletPhase::throat ? 1 : 0;  // right after a move: due in its first step
      return true;
    });
    emitted += done.emitted;
    refused += done.refused;
    for (auto it = tagged.begin(); it != tagged.end();) {
      const InletState before = it->second;
      it->second = set.kinematics(it->first);
      const bool crossed = before.phase == InletPhase::throat && it->second.phase != InletPhase::throat;
      seen_crossing += crossed ? 1 : 0;
      released += it->second.phase == InletPhase::released ? 1 : 0;
      it = it->second.phase == InletPhase::released ? tagged.erase(it) : std::next(it);
    }
  }

  WithdrawThroat withdrawing() {
    return [this](const Throat& throat) {
      for (auto it = tagged.begin(); it != tagged.end();) {
        const InletTag tag = unpackInletTag(it->first);
        if (tag.slot != throat.slot()) {
          ++it;
          continue;
        }
        const InletState state = throat.kinematics(tag);
        (state.phase == InletPhase::throat ? withdrawn : released) += 1;
        if (state.phase == InletPhase::emerging) freed.push_back(state.position);
        it = tagged.erase(it);
      }
    };
  }

  double nearestPair() const {
    double nearest = 1.0;
    for (auto a = tagged.begin(); a != tagged.end(); ++a) {
      for (auto b = std::next(a); b != tagged.end(); ++b) {
        nearest = std::min(nearest, (a->second.position - b->second.position).norm());
      }
    }
    return nearest;
  }

  WoundSet set;
  std::map<std::uint32_t, InletState> tagged;
  std::vector<Vec3> freed;  ///< where particles stood that a withdrawal set free, for the test to clear
  std::uint64_t emitted = 0, refused = 0, seen_crossing = 0, released = 0, withdrawn = 0;

 private:
  std::size_t capacity_;
};

}  // namespace bleedsim::sph
