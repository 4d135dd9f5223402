// What the machine can do at most, measured beside what the solver does: the two sides of the roofline.
#pragma once

#include <cstddef>
#include <memory>

namespace bleedsim::lab {

/// Of all threads together.
struct Ceiling {
  double gflops = 0.0;       ///< GFLOP/s, fused multiply-adds of registers in single precision, the widest vectors there are
  double gigabytes_s = 0.0;  ///< GB/s, triad a = b + s c, 12 bytes an element
};

/// Elements of each of the triad's three arrays: far beyond the caches.
inline constexpr std::size_t kTriadElements = std::size_t{16} << 20;

class Ceilings {
 public:
  /// `threads`: as many as the solver that is compared has.
  explicit Ceilings(int threads, std::size_t elements = kTriadElements);
  ~Ceilings();
  Ceilings(Ceilings&&) noexcept;

  /// A few hundredths of a second.
  Ceiling measure();

 private:
  struct Arrays;
  std::unique_ptr<Arrays> arrays_;
};

}  // namespace bleedsim::lab
