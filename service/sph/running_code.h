// Which compiled instantiations step a world: what an absent effect must be no part of.
#pragma once

#include <cstdint>

namespace bleedsim::sph {

/// Addresses of the code that the next step runs; 0: it runs none. Equal numbers are the same instantiation.
struct RunningCode {
  std::uintptr_t density = 0;
  std::uintptr_t pair_forces = 0;      ///< the fused loop over all pair effects
  std::uintptr_t shear_rate = 0;       ///< sweep of rheologies and of platelets' shear gate
  std::uintptr_t platelets = 0;        ///< sweep of their diffusion, in the steps in which it is due
  std::uintptr_t curvature = 0;        ///< second walk of surface tension; its first is a part of pair_forces
  std::uintptr_t viscous_product = 0;  ///< sweep of the implicit viscosity; 0 where it is explicit in the next step

  friend bool operator==(const RunningCode&, const RunningCode&) = default;
};

/// 0 of null.
template <class Result, class Job>
std::uintptr_t codeOf(Result (*function)(Job)) {
  return reinterpret_cast<std::uintptr_t>(function);
}

}  // namespace bleedsim::sph
