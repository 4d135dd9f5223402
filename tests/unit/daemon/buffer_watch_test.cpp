#include "service/daemon/buffer_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace bleedsim::daemon {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(BufferWatch, WarnsOnceForEachSizeThatDoesNotFitTwice) {
  BufferWatch watch{1'000'000};
  EXPECT_FALSE(watch.note(500'000)) << "two of them just fit";
  const auto warning = watch.note(500'001);
  ASSERT_TRUE(warning.has_value());
  EXPECT_THAT(*warning, AllOf(HasSubstr("hold 1000 kB"), HasSubstr("are 1000 kB"), HasSubstr("rmem_max=4194304")));
  EXPECT_FALSE(watch.note(500'001)) << "nothing has changed";
  EXPECT_TRUE(watch.note(3'000'000));
  EXPECT_FALSE(watch.note(3'000'000));
  EXPECT_FALSE(watch.note(100));
  EXPECT_TRUE(watch.note(3'000'000)) << "it fitted in between";
}

TEST(BufferWatch, AsksForAsMuchAsIsNeeded) {
  BufferWatch watch{212'992};
  EXPECT_THAT(watch.note(8'000'000).value_or(""), HasSubstr("rmem_max=16000000"));
}

TEST(BufferWatch, SaysNothingWhenTheLimitIsNotKnown) { EXPECT_FALSE(BufferWatch{0}.note(1'000'000'000)); }

}  // namespace
}  // namespace bleedsim::daemon
