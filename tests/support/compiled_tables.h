// The compiled passes that a description runs, for rigs that do without a world.
#pragma once

#include <type_traits>

#include "service/sph/passes/pass_table.h"
#include "service/sph/passes/sweep_table.h"
#include "service/sph/world_setup.h"

namespace bleedsim::test {

/// In double precision the target is the scalar twin; otherwise this machine must have it.
template <class Real>
const sph::PassTable<Real>& passesOf(const sph::WorldDescription& description, [[maybe_unused]] sph::SimdTarget target) {
  if constexpr (std::is_same_v<Real, double>)
    return sph::referencePasses(sph::passChoice(description));
  else
    return *sph::findPasses(target, sph::passChoice(description));
}

template <class Real>
const sph::SweepTable<Real>& sweepsOf(const sph::SweepChoice& choice, [[maybe_unused]] sph::SimdTarget target) {
  if constexpr (std::is_same_v<Real, double>)
    return sph::referenceSweeps(choice);
  else
    return *sph::findSweeps(target, choice);
}

}  // namespace bleedsim::test
