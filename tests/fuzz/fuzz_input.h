// The bytes that libFuzzer gives, taken as values, and what a target does with a broken promise.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace bleedsim::fuzz {

class FuzzInput {
 public:
  FuzzInput(const std::uint8_t* data, std::size_t size) : rest_{data, size} {}

  /// Any bit pattern; zeros once the bytes have run out.
  template <class T>
  T take() {
    T value{};
    takeInto(value);
    return value;
  }
  /// Overwrites `value` with bytes as they come: padding, booleans and unterminated texts included.
  template <class T>
  void takeInto(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::size_t bytes = std::min(sizeof value, rest_.size());
    std::memcpy(&value, rest_.data(), bytes);
    rest_ = rest_.subspan(bytes);
  }
  /// Up to `most` elements, in memory of exactly their size.
  template <class T>
  std::vector<T> takeList(std::size_t most) {
    std::vector<T> list(std::min(most, rest_.size() / sizeof(T)));
    list.shrink_to_fit();
    for (T& element : list) takeInto(element);
    return list;
  }
  std::span<const std::uint8_t> rest() const { return rest_; }

 private:
  std::span<const std::uint8_t> rest_;
};

/// libFuzzer keeps the input of an abort.
inline void require(bool holds, const char* promise) {
  if (holds) return;
  std::fprintf(stderr, "broken: %s\n", promise);
  std::abort();
}

}  // namespace bleedsim::fuzz
