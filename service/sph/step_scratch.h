// Room in which the effects of a step work one after the other, so that each does not keep memory of its own that lies idle while
// the others work. Nothing in it outlives the stage that wrote it.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <memory>
#include <type_traits>

#include "service/sph/aligned_array.h"

namespace bleedsim::sph {

class StepScratch {
 public:
  /// Between two parts of a layout, so that rows of one particle do not meet in the first-level cache.
  static constexpr std::size_t kApart = 7 * 64;

  /// For an effect when it is made: this many bytes will be asked for in a step.
  void reserve(std::size_t bytes) { wanted_ = std::max(wanted_, bytes); }
  /// Once, when all effects are made.
  void allocate() {
    if (wanted_ != 0) room_ = AlignedArray<std::byte>{wanted_, 61u};
  }

  std::size_t bytes() const { return room_.bytes(); }

  /// `count` objects from byte `from` on, which is a multiple of their alignment; without values, and what was there is gone.
  template <class T>
  T* take(std::size_t from, std::size_t count) {
    static_assert(std::is_trivially_default_constructible_v<T> && std::is_trivially_destructible_v<T>);
    assert(from % alignof(T) == 0 && from + count * sizeof(T) <= room_.bytes());
    T* const first = reinterpret_cast<T*>(room_.data() + from);
    std::uninitialized_default_construct_n(first, count);
    return first;
  }

 private:
  std::size_t wanted_ = 0;
  AlignedArray<std::byte> room_;
};

}  // namespace bleedsim::sph
