// Numbers as colours.
#include "service/picture/color_map.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace bleedsim::picture::test {
namespace {

double luma(Color color) { return 0.2126 * color.r + 0.7152 * color.g + 0.0722 * color.b; }

TEST(ColorMap, lightnessRisesAllTheWay) {
  double before = -1.0;
  for (int i = 0; i <= 100; ++i) {
    const double now = luma(mapColor(i / 100.0));
    EXPECT_GT(now, before) << i;
    before = now;
  }
}

TEST(ColorMap, endsAreHeldAndNotANumberIsGrey) {
  EXPECT_EQ(mapColor(-5.0), mapColor(0.0));
  EXPECT_EQ(mapColor(7.0), mapColor(1.0));
  EXPECT_EQ(mapColor(std::nan("")), kNotANumberColor);
  EXPECT_NE(mapColor(0.0), mapColor(1.0));
}

TEST(ColorMap, rangeIsThatOfTheFiniteValues) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto range = rangeOf(std::vector<float>{2.0F, nan, -1.0F, std::numeric_limits<float>::infinity()});
  ASSERT_TRUE(range);
  EXPECT_EQ(range->lower, -1.0);
  EXPECT_EQ(range->upper, 2.0);
  EXPECT_EQ(range->share(0.5), 0.5);
  EXPECT_FALSE(rangeOf(std::vector<float>{nan}));
  for (const float value : {0.0F, 5.0F, -3e9F}) {
    const auto single = rangeOf(std::vector<float>{value, value});
    ASSERT_TRUE(single);
    EXPECT_LT(single->lower, single->upper) << value;
  }
}

}  // namespace
}  // namespace bleedsim::picture::test
