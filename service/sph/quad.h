// Four particles at a time, for the stages that move particles between the passes. These are the compiler's own vectors, in the
// build's baseline: they move memory more than they compute, and every lane does what a scalar would, so that results have the
// same bits with and without them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace bleedsim::sph {

template <class Real>
struct Quad {
  static constexpr std::uint32_t kWidth = 4;
  typedef Real Vector __attribute__((vector_size(kWidth * sizeof(Real))));  // an alias cannot carry a dependent size
  using Mask = decltype(Vector{} < Vector{});

  static Vector load(const Real* from) {
    Vector v;
    std::memcpy(&v, from, sizeof v);
    return v;
  }
  static void store(const Vector& v, Real* to) { std::memcpy(to, &v, sizeof v); }
  static Vector set(Real value) { return Vector{value, value, value, value}; }

  /// The columns of four rows of four.
  static void loadColumns(const Real* rows, Vector& a, Vector& b, Vector& c, Vector& d) {
    a = load(rows);
    b = load(rows + kWidth);
    c = load(rows + 2 * kWidth);
    d = load(rows + 3 * kWidth);
    transpose(a, b, c, d);
  }

  /// The other way; rows begin `stride` apart.
  static void storeColumns(Vector a, Vector b, Vector c, Vector d, Real* rows, std::size_t stride = kWidth) {
    transpose(a, b, c, d);
    store(a, rows);
    store(b, rows + stride);
    store(c, rows + 2 * stride);
    store(d, rows + 3 * stride);
  }

  /// Rows of four become columns, and columns rows.
  static void transpose(Vector& a, Vector& b, Vector& c, Vector& d) {
    const Vector ab_low = __builtin_shufflevector(a, b, 0, 4, 1, 5);
    const Vector ab_high = __builtin_shufflevector(a, b, 2, 6, 3, 7);
    const Vector cd_low = __builtin_shufflevector(c, d, 0, 4, 1, 5);
    const Vector cd_high = __builtin_shufflevector(c, d, 2, 6, 3, 7);
    a = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
    b = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
    c = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
    d = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
  }

  static bool all(const Mask& mask) {
    std::array<std::uint64_t, kWidth * sizeof(Real) / sizeof(std::uint64_t)> words;
    std::memcpy(words.data(), &mask, sizeof mask);
    std::uint64_t common = words[0];
    for (std::size_t k = 1; k < words.size(); ++k) common &= words[k];
    return common == ~std::uint64_t{0};
  }
  static Real least(const Vector& v) { return std::min(std::min(v[0], v[1]), std::min(v[2], v[3])); }
  static Real largest(const Vector& v) { return std::max(std::max(v[0], v[1]), std::max(v[2], v[3])); }
};

/// four(i) takes entries i to i + 3, or returns false and takes none of them, where one is a special case; one(i) takes each of
/// those and what is left at the end.
template <class Four, class One>
void inFours(std::uint32_t begin, std::uint32_t end, const Four& four, const One& one) {
  for (std::uint32_t i = begin; i < end;) {
    const std::uint32_t next = std::min(end, i + 4);
    if (next != i + 4 || !four(i)) {
      for (std::uint32_t k = i; k < next; ++k) one(k);
    }
    i = next;
  }
}

/// Whether all four of the entries are 0.
inline bool fourZeros(const std::uint32_t* entries) {
  std::array<std::uint64_t, 2> words;
  std::memcpy(words.data(), entries, sizeof words);
  return (words[0] | words[1]) == 0;
}

}  // namespace bleedsim::sph
