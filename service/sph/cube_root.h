// The cube root by own arithmetic: the library's bits differ between machines.
#pragma once

#include <bit>
#include <cstdint>
#include <type_traits>

namespace bleedsim::sph {

/// x^(1/3) of a normal x > 0, within 4 ulp. A third of the exponent's bits starts within 4 %; Halley's step cubes the relative
/// error (e -> 2/3 e^3), so that two steps serve float and three serve double.
template <class Real>
Real cubeRoot(Real x) {
  using Bits = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;
  constexpr Bits kOffset = sizeof(Real) == 4 ? static_cast<Bits>(0x2a51199au) : static_cast<Bits>(0x2a9f789300000000ull);
  Real root = std::bit_cast<Real>(static_cast<Bits>(std::bit_cast<Bits>(x) / 3 + kOffset));
  for (int k = 0; k < (sizeof(Real) == 4 ? 2 : 3); ++k) {
    const Real cube = root * root * root;
    root += root * ((x - cube) / (cube + cube + x));
  }
  return root;
}

}  // namespace bleedsim::sph
