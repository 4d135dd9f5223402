// The literal model in double precision: the scalar twin only.
#include "service/sph/passes/make_literal-inl.h"

namespace bleedsim::sph {

const LiteralTable<double>& referenceLiteralPasses(bool periodic) {
  return *HWY_NAMESPACE::literalTableOf<HWY_NAMESPACE::ScalarLanes<double>>(periodic);
}

}  // namespace bleedsim::sph
