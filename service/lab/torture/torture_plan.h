// A random scene with what happens to it: made of one seed, and small enough to be made smaller.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "idl/scene.pb.h"
#include "service/scene/change_effect.h"
#include "service/sph/command.h"
#include "service/sph/world.h"

namespace bleedsim::lab {

/// A command before a step.
struct TimedCommand {
  int step = 0;
  sph::Command command;
};

/// An effect is switched, or gets other settings, before a step.
struct TimedChange {
  int step = 0;
  scene::EffectChange change;
};

/// From a step on, steps are asked to be no longer than this.
struct TimedLimit {
  int step = 0;
  double limit = 0.0;  ///< s; what is no time must be refused and leave no trace
};

struct TorturePlan {
  std::uint64_t seed = 0;
  scene::Scene scene;
  std::vector<TimedCommand> commands;
  std::vector<TimedChange> changes;  ///< after the commands of their steps
  std::vector<TimedLimit> limits;
  int steps = 0;
  int threads = 1;
  sph::Precision precision = sph::Precision::float32;
};

/// The same for the same seed on every machine.
TorturePlan makePlan(std::uint64_t seed, scene::Scene::Model model, int steps);

/// The scene as text that bleedd reads, behind the plan's commands and switches as comments.
std::string toText(const TorturePlan& plan);

std::uint64_t particlesOf(const TorturePlan& plan);  ///< that its blocks seed, about

}  // namespace bleedsim::lab
