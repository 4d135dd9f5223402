#include "service/transport/receive_buffer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace bleedsim::transport {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr std::size_t kPlainKernel = 212'992;

TEST(BufferWatch, WarnsOnceForEachSizeThatDoesNotFitTwice) {
  BufferWatch watch{1'000'000};
  EXPECT_FALSE(watch.note(500'000)) << "two of them just fit";
  EXPECT_TRUE(watch.note(500'001));
  EXPECT_FALSE(watch.note(500'001)) << "nothing has changed";
  EXPECT_TRUE(watch.note(3'000'000));
  EXPECT_FALSE(watch.note(3'000'000));
  EXPECT_FALSE(watch.note(100));
  EXPECT_TRUE(watch.note(3'000'000)) << "it fitted in between";
}

TEST(BufferWatch, SaysWhatThereIsWhatIsNeededAndTheRemedy) {
  BufferWatch watch{kPlainKernel};
  const std::string warning = watch.note(2'800'000).value_or("");
  EXPECT_THAT(warning, AllOf(HasSubstr("grants receive buffers of 212 kB"), HasSubstr("need 5600 kB"),
                             HasSubstr("sysctl -w net.core.rmem_max=67108864"), Not(HasSubstr("smaller capacity"))));
}

TEST(BufferWatch, HasAnotherRemedyForFramesAboveWhatIsAskedFor) {
  constexpr std::size_t kHuge = 40'000'000;
  const std::string tuned = BufferWatch{std::size_t{1} << 30}.note(kHuge).value_or("");
  EXPECT_THAT(tuned, AllOf(HasSubstr("grants receive buffers of 67108 kB"), HasSubstr("need 80000 kB"),
                           HasSubstr("smaller capacity"), Not(HasSubstr("sysctl"))));
  const std::string plain = BufferWatch{kPlainKernel}.note(kHuge).value_or("");
  EXPECT_THAT(plain, AllOf(HasSubstr("sysctl"), HasSubstr("smaller capacity")));
}

TEST(BufferWatch, SaysNothingWhenTheLimitIsNotKnown) { EXPECT_FALSE(BufferWatch{0}.note(1'000'000'000)); }

}  // namespace
}  // namespace bleedsim::transport
