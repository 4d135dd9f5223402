// Fixed-size storage for hot arrays: one allocation at creation, padded for whole-vector access, staggered against aliasing.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <new>
#include <span>
#include <sys/mman.h>
#include <type_traits>
#include <utility>

namespace bleedsim::sph {

/// Storage that is too large to be touched before it is used.
struct Uninitialized {};

/// Storage that is read and written all the time: in one huge page, where the system has them, however small it is. In pages from
/// all over the memory it is luck whether they fall into the same sets of the second-level cache.
struct HugePage {};

/// `size` elements of a trivial type, zeroed unless told otherwise, aligned to 64 bytes, readable and writable 64 bytes (16
/// floats) past the end. `lane` shifts the start by whole cache lines: a dozen arrays that are equal modulo 4 KB would fight for
/// the same cache sets.
template <class T>
class AlignedArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  AlignedArray() = default;
  explicit AlignedArray(std::size_t size, unsigned lane = 0) { std::memset(allocate(size, lane), 0, neededFor(size, lane)); }
  AlignedArray(std::size_t size, unsigned lane, Uninitialized) { allocate(size, lane); }
  AlignedArray(std::size_t size, HugePage) { allocateIn(kHugePage, size, 0); }
  AlignedArray(AlignedArray&& other) noexcept { swap(other); }
  AlignedArray& operator=(AlignedArray&& other) noexcept {
    swap(other);
    return *this;
  }
  AlignedArray(const AlignedArray&) = delete;
  AlignedArray& operator=(const AlignedArray&) = delete;
  ~AlignedArray() { std::free(memory_); }

  void swap(AlignedArray& other) noexcept {
    std::swap(memory_, other.memory_);
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
  }

  T* data() { return data_; }
  const T* data() const { return data_; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  std::size_t bytes() const { return size_ * sizeof(T); }
  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  std::span<T> span() { return {data_, size_}; }
  std::span<const T> span() const { return {data_, size_}; }

 private:
  static constexpr std::size_t kPage = 4096;
  static constexpr std::size_t kPadding = 256;
  static constexpr std::size_t kHugePage = std::size_t{2} << 20;
  /// From here on an array gets huge pages, however much of the last one stays empty: worth 1 to 3 % with 20 000 particles, which
  /// then hold 9 MB more. bytes() is without it, as without all padding.
  static constexpr std::size_t kLarge = kHugePage / 8;

  static std::size_t offsetOf(unsigned lane) { return 64 * ((lane * 7) % 61); }
  static std::size_t neededFor(std::size_t size, unsigned lane) { return offsetOf(lane) + size * sizeof(T) + kPadding; }
  static std::size_t pageOf(std::size_t needed) { return needed < kLarge ? kPage : kHugePage; }
  static std::size_t roundedTo(std::size_t page, std::size_t needed) { return (needed + page - 1) / page * page; }
  std::byte* allocate(std::size_t size, unsigned lane) { return allocateIn(pageOf(neededFor(size, lane)), size, lane); }
  std::byte* allocateIn(std::size_t page, std::size_t size, unsigned lane) {
    const std::size_t bytes = roundedTo(page, neededFor(size, lane));
    memory_ = static_cast<std::byte*>(std::aligned_alloc(page, bytes));
    if (memory_ == nullptr) throw std::bad_alloc{};
    // A wish: without huge pages it is only slower, by some 6 % with a million particles.
    if (page == kHugePage) static_cast<void>(::madvise(memory_, bytes, MADV_HUGEPAGE));
    data_ = reinterpret_cast<T*>(memory_ + offsetOf(lane));
    size_ = size;
    return memory_;
  }

  std::byte* memory_ = nullptr;
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace bleedsim::sph
