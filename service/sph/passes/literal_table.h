// The compiled passes of the literal model of one SIMD target: poly6 density passes of one kind of boundary, and one force pass
// for each set of the paper's terms, which serves both kinds.
#pragma once

#include <array>

#include "service/sph/effects/literal_set.h"
#include "service/sph/passes/literal_job.h"
#include "service/sph/passes/pass_table.h"

namespace bleedsim::sph {

template <class Real>
struct LiteralTable {
  PassTable<Real> passes;  ///< density only
  std::array<LiteralFunction<Real>, LiteralSet::kCount> force{};
};

/// `target` is one of this build and machine, and not `automatic`.
const LiteralTable<float>& literalPasses(SimdTarget target, bool periodic);
/// The reference in double precision; scalar only.
const LiteralTable<double>& referenceLiteralPasses(bool periodic);

}  // namespace bleedsim::sph
