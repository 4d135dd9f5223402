// The sweeps in double precision: the scalar twin only.
#include "service/sph/passes/make_sweeps-inl.h"

namespace bleedsim::sph {

const SweepTable<double>& referenceSweeps(const SweepChoice& choice) {
  return *HWY_NAMESPACE::sweepsOf<HWY_NAMESPACE::ScalarLanes<double>>(choice);
}

}  // namespace bleedsim::sph
