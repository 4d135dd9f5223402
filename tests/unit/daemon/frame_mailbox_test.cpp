#include "service/daemon/frame_mailbox.h"

#include <atomic>
#include <gtest/gtest.h>
#include <thread>

#include "service/daemon/wakeup.h"

namespace bleedsim::daemon {
namespace {

void put(FrameMailbox& mailbox, std::uint64_t step) {
  mailbox.back()->frame.step = step;
  mailbox.store();
}

TEST(FrameMailbox, TheNewestWinsAndTheOthersAreCounted) {
  FrameMailbox mailbox;
  EXPECT_EQ(mailbox.load(), nullptr);
  mailbox.renew(FrameMailbox::makeBuffers(4));
  put(mailbox, 1);
  put(mailbox, 2);
  put(mailbox, 3);
  const dds::FrameSnapshot* frame = mailbox.load();
  ASSERT_NE(frame, nullptr);
  EXPECT_EQ(frame->frame.step, 3U);
  EXPECT_EQ(mailbox.overwritten(), 2U);
  EXPECT_EQ(mailbox.load(), nullptr);
}

TEST(FrameMailbox, TheReadersFrameOutlivesARenewal) {
  FrameMailbox mailbox;
  mailbox.renew(FrameMailbox::makeBuffers(4));
  put(mailbox, 1);
  const dds::FrameSnapshot* held = mailbox.load();
  put(mailbox, 2);
  mailbox.renew(FrameMailbox::makeBuffers(8));
  EXPECT_EQ(mailbox.overwritten(), 1U);
  EXPECT_EQ(held->frame.step, 1U);
  put(mailbox, 3);
  EXPECT_EQ(mailbox.load()->frame.step, 3U);
}

TEST(FrameMailbox, TwoThreadsSeeWholeFramesInOrder) {
  constexpr std::uint64_t kLast = 20'000;
  FrameMailbox mailbox;
  mailbox.renew(FrameMailbox::makeBuffers(4));
  Wakeup wakeup;
  std::thread writer{[&] {
    for (std::uint64_t step = 1; step <= kLast; ++step) {
      mailbox.back()->epoch = static_cast<std::uint32_t>(step);
      put(mailbox, step);
      wakeup.notify();
    }
  }};
  std::uint64_t seen = 0;
  std::uint64_t frames = 0;
  while (seen < kLast) {
    wakeup.wait({});
    while (const dds::FrameSnapshot* frame = mailbox.load()) {
      EXPECT_GT(frame->frame.step, seen);
      EXPECT_EQ(frame->epoch, frame->frame.step) << "a frame that was being written";
      seen = frame->frame.step;
      ++frames;
    }
  }
  writer.join();
  EXPECT_EQ(frames + mailbox.overwritten(), kLast);
}

}  // namespace
}  // namespace bleedsim::daemon
