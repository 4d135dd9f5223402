// Where frames wait for the user: the newest one, or a bounded queue. Not synchronised: the session's lock covers it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <utility>

#include "bleedsim/session.h"

namespace bleedsim::client {

class FrameBox {
 public:
  /// `capacity` of 1 is newest-wins.
  explicit FrameBox(std::size_t capacity) : capacity_{capacity} {}

  void put(FramePointer frame) {
    if (frames_.size() == capacity_) {
      frames_.pop_front();
      ++dropped_;
    }
    frames_.push_back(std::move(frame));
  }
  FramePointer take() {
    if (frames_.empty()) return nullptr;
    FramePointer frame = std::move(frames_.front());
    frames_.pop_front();
    return frame;
  }
  bool empty() const { return frames_.empty(); }
  std::uint64_t dropped() const { return dropped_; }

 private:
  std::size_t capacity_;
  std::deque<FramePointer> frames_;
  std::uint64_t dropped_ = 0;
};

}  // namespace bleedsim::client
