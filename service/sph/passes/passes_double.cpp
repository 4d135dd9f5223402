// The double precision reference: the scalar twin only.
#include "service/sph/passes/make_table-inl.h"

namespace bleedsim::sph {

const PassTable<double>& referencePasses() {
  static constexpr PassTable<double> kTable = HWY_NAMESPACE::makeTable<HWY_NAMESPACE::ScalarLanes<double>>();
  return kTable;
}

}  // namespace bleedsim::sph
