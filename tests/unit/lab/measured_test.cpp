// Medians and means of numbers that can be summed by hand.
#include "service/lab/measured.h"

#include <cmath>
#include <gtest/gtest.h>

namespace bleedsim::lab {
namespace {

TEST(MedianOf, IsNotMovedByOneDisturbedSample) {
  const Measured odd = medianOf({3.0, 1.0, 100.0, 2.0, 4.0});
  EXPECT_DOUBLE_EQ(odd.value, 3.0);
  EXPECT_DOUBLE_EQ(odd.scatter, 1.0);  // of 0 2 97 1 1
  const Measured even = medianOf({4.0, 1.0, 2.0, 3.0});
  EXPECT_DOUBLE_EQ(even.value, 2.5);
  EXPECT_DOUBLE_EQ(even.scatter, 1.0);  // of 1.5 1.5 0.5 0.5
  EXPECT_EQ(medianOf({}).value, 0.0);
}

// 1 2 3: a standard deviation of 1, over sqrt(3).
TEST(MeanOf, HasTheStandardError) {
  const std::vector<double> values{1.0, 2.0, 3.0};
  EXPECT_DOUBLE_EQ(meanOf(values).value, 2.0);
  EXPECT_DOUBLE_EQ(meanOf(values).scatter, 1.0 / std::sqrt(3.0));
  EXPECT_EQ(meanOf(std::span{values}.first(1)).scatter, 0.0);
  EXPECT_EQ(meanOf({}).value, 0.0);
}

}  // namespace
}  // namespace bleedsim::lab
