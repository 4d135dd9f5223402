#include "service/daemon/frame_mailbox.h"

#include <utility>

namespace bleedsim::daemon {

FrameMailbox::Buffers FrameMailbox::makeBuffers(std::uint32_t capacity) {
  Buffers buffers;
  for (std::unique_ptr<dds::FrameSnapshot>& buffer : buffers) {
    buffer = std::make_unique<dds::FrameSnapshot>();
    buffer->reserve(capacity);
  }
  return buffers;
}

void FrameMailbox::renew(Buffers buffers) {
  back_ = std::move(buffers[0]);
  const std::lock_guard lock{mutex_};
  if (fresh_) ++overwritten_;
  fresh_ = false;
  middle_ = std::move(buffers[1]);
  new_front_ = std::move(buffers[2]);
}

void FrameMailbox::store() {
  const std::lock_guard lock{mutex_};
  std::swap(back_, middle_);
  if (fresh_) ++overwritten_;
  fresh_ = true;
}

const dds::FrameSnapshot* FrameMailbox::load() {
  const std::lock_guard lock{mutex_};
  if (new_front_) front_ = std::move(new_front_);
  if (!fresh_) return nullptr;
  std::swap(front_, middle_);
  fresh_ = false;
  return front_.get();
}

std::uint64_t FrameMailbox::overwritten() const {
  const std::lock_guard lock{mutex_};
  return overwritten_;
}

}  // namespace bleedsim::daemon
