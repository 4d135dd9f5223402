// The problems of one scene, gathered so that a person sees them all at once.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "service/scene/limits.h"
#include "service/status/status.h"

namespace bleedsim::scene {

class ProblemList {
 public:
  /// Further problems are counted, not kept.
  static constexpr std::size_t kMaxKept = 200;

  /// Bytes of one problem; the rest is cut off.
  static constexpr std::size_t kMaxBytes = 1000;

  /// "where: what"; `where` is a field's path or a place in the text.
  void add(std::string_view where, std::string_view what);

  /// Adds a problem unless the value is in the range. Values that are not finite are reported by reportNonFinite alone.
  void requireInRange(std::string_view path, double value, const Range& range);

  /// Whether a problem lies at this field or within it.
  bool concerns(std::string_view path) const;

  /// True once further problems are only counted: describing them is not worth the time.
  bool full() const { return count_ >= kMaxKept; }
  bool empty() const { return count_ == 0; }
  std::size_t count() const { return count_; }

  /// ok, or invalid_argument with one problem per line.
  Status toStatus() const;
  /// ok, or invalid_argument with the first problem alone and how many there are beside it.
  Status firstToStatus() const;

 private:
  std::vector<std::string> kept_;
  std::size_t count_ = 0;
};

}  // namespace bleedsim::scene
