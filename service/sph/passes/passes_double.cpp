// The double precision reference: the scalar twin only.
#include "service/sph/passes/literal_table.h"
#include "service/sph/passes/make_table-inl.h"

namespace bleedsim::sph {
namespace {

template <template <class> class Kernel, HWY_NAMESPACE::SetRange kRange>
const PassTable<double>& tableOf(bool periodic) {
  using Lanes = HWY_NAMESPACE::ScalarLanes<double>;
  static constexpr PassTable<double> kBounded = HWY_NAMESPACE::makeTable<Lanes, Kernel, false, kRange>();
  static constexpr PassTable<double> kPeriodic = HWY_NAMESPACE::makeTable<Lanes, Kernel, true, kRange>();
  return periodic ? kPeriodic : kBounded;
}

}  // namespace

const PassTable<double>& referencePasses(const PassChoice& choice) {
  if (choice.literal) return referenceLiteralPasses(choice.periodic).passes;
  if (choice.kernel == KernelType::cubic_spline)
    return tableOf<HWY_NAMESPACE::CubicSpline, HWY_NAMESPACE::SetRange::plain>(choice.periodic);
  return tableOf<HWY_NAMESPACE::WendlandC2, HWY_NAMESPACE::SetRange::all>(choice.periodic);
}

}  // namespace bleedsim::sph
