// Flush-to-zero and denormals-are-zero for the lifetime of the object, on the calling thread.
#pragma once

#include <cstdint>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace bleedsim::sph {

class FlushToZero {
 public:
#if defined(__SSE2__)
  FlushToZero() : saved_{_mm_getcsr()} { _mm_setcsr(static_cast<unsigned>(saved_) | kFlushBits); }
  ~FlushToZero() { _mm_setcsr(static_cast<unsigned>(saved_)); }
#elif defined(__aarch64__)
  FlushToZero() {
    asm volatile("mrs %0, fpcr" : "=r"(saved_));
    asm volatile("msr fpcr, %0" ::"r"(saved_ | (std::uint64_t{1} << 24)));
  }
  ~FlushToZero() { asm volatile("msr fpcr, %0" ::"r"(saved_)); }
#else
  FlushToZero() = default;
#endif
  FlushToZero(const FlushToZero&) = delete;
  FlushToZero& operator=(const FlushToZero&) = delete;

 private:
#if defined(__SSE2__)
  static constexpr unsigned kFlushBits = 0x8040;  // FTZ | DAZ of MXCSR
#endif
  std::uint64_t saved_ = 0;
};

}  // namespace bleedsim::sph
