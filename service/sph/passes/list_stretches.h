// The room of a share's neighbour lists in stretches, of which those behind the walk are written again: lists that nobody reads a
// second time then stay in the caches, however many particles there are.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "service/sph/neighbors/grid_view.h"
#include "service/sph/passes/pass_jobs.h"

namespace bleedsim::sph {

class ListStretches {
 public:
  /// Particles of the rows that densities and the walk behind them take in turns.
  static constexpr std::uint32_t kChunk = 512;

  /// For lists with room for `capacity` entries. No function allocates later.
  explicit ListStretches(std::size_t capacity) : capacity_{capacity}, stretches_(capacity / kShortest + 1) {}

  /// Cuts the room for densities that are computed by kChunk particles and a row at a time, and begins the lists anew in the
  /// first stretch. Rows before `first_walked` keep their lists. One stretch holds all where they would be too few.
  template <class Real>
  void begin(const GridView<Real>& view, int row_begin, int row_end, int first_walked, NeighborLists<Real>& lists) {
    std::size_t longest = 0;
    for (int row = row_begin; row < row_end; ++row) {
      longest = std::max(longest, std::size_t{view.rowEnd(row) - view.rowBegin(row)});
    }
    size_ = (longest + kChunk + 2) * kMaxNeighbors;
    count_ = capacity_ / size_ < kFewest ? 1 : capacity_ / size_;
    first_walked_ = first_walked;
    for (std::size_t k = 0; k < count_; ++k) stretches_[k] = {};
    at_work_ = 0;
    offer(lists, 0);
    static_cast<void>(lists.goOn());
  }

  /// Before the densities of the rows from `row` on; all rows from the first that is walked to `walked` have been.
  template <class Real>
  void prepare(int row, int walked, NeighborLists<Real>& lists) {
    if (stretches_[at_work_].first_row < 0) stretches_[at_work_].first_row = row;
    if (lists.end - lists.used >= size_) return;
    for (std::size_t k = 0; k < count_; ++k) {
      const Stretch& stretch = stretches_[k];
      const bool read = stretch.first_row >= first_walked_ && stretch.last_row < walked;
      if (k == at_work_ || (stretch.first_row >= 0 && !read)) continue;
      offer(lists, k);
      return;
    }
  }

  /// After the densities of the rows from `row` to before `end`.
  template <class Real>
  void note(int row, int end, NeighborLists<Real>& lists) {
    stretches_[at_work_].last_row = end - 1;
    if (offered_ != at_work_ && lists.next_begin == lists.next_end) {
      at_work_ = offered_;
      stretches_[at_work_] = {row, end - 1};
    }
    offered_ = at_work_;
    lists.next_begin = lists.next_end;
  }

 private:
  // A stretch takes whatever one chunk may need, so that the room it goes on in is enough.
  static constexpr std::size_t kShortest = std::size_t{kChunk} * kMaxNeighbors;
  static constexpr std::size_t kFewest = 4;

  struct Stretch {
    int first_row = -1;  ///< of those that may have lists here; -1: none
    int last_row = -1;
  };

  template <class Real>
  void offer(NeighborLists<Real>& lists, std::size_t k) {
    offered_ = k;
    lists.next_begin = k * size_;
    lists.next_end = k + 1 == count_ ? capacity_ : (k + 1) * size_;
  }

  std::size_t capacity_ = 0;
  std::vector<Stretch> stretches_;
  std::size_t size_ = 0;
  std::size_t count_ = 1;
  std::size_t at_work_ = 0;
  std::size_t offered_ = 0;
  int first_walked_ = 0;
};

}  // namespace bleedsim::sph
