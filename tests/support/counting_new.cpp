#include "tests/support/counting_new.h"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::uint64_t> allocations{0};

void* countedAttempt(std::size_t size, std::size_t alignment) noexcept {
  ++allocations;
  const std::size_t whole = (size == 0 ? alignment : size + alignment - 1) / alignment * alignment;
  return std::aligned_alloc(alignment, whole);
}

void* countedAllocation(std::size_t size, std::size_t alignment) {
  if (void* memory = countedAttempt(size, alignment)) return memory;
  throw std::bad_alloc{};
}

}  // namespace

std::uint64_t bleedsim::test::allocationCount() { return allocations.load(); }

// In a file of their own: inlined into a caller, the compiler takes new and free for a mismatched pair.
void* operator new(std::size_t size) { return countedAllocation(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return countedAllocation(size, static_cast<std::size_t>(alignment));
}
// std::stable_sort takes its buffer by this one.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return countedAttempt(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  return countedAttempt(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
