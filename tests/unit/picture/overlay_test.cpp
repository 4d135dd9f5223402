// Scale bar, colour bar and caption.
#include "service/picture/overlay.h"

#include <algorithm>
#include <gtest/gtest.h>

#include "service/picture/text.h"

namespace bleedsim::picture::test {
namespace {

TEST(Overlay, roundLengthsAreOneTwoOrFive) {
  const auto is = [](double most, double length, const char* text) {
    const ScaleLength scale = roundLength(most);
    EXPECT_NEAR(scale.length_m, length, 1e-9 * length) << most;
    EXPECT_EQ(scale.text, text) << most;
  };
  is(0.0123, 0.01, "10 mm");
  is(0.001, 0.001, "1 mm");
  is(0.00099, 0.0005, "500 um");
  is(0.0049, 0.002, "2 mm");
  is(0.005, 0.005, "5 mm");
  is(3.0, 2.0, "2 m");
  is(1500.0, 1000.0, "1 km");
  is(3e-7, 2e-7, "200 nm");
}

TEST(Overlay, scaleBarIsAsLongAsItSays) {
  // 10 pixels a millimetre on 800 pixels: at most 200 pixels, so 20 mm.
  Image image = *Image::create(800, 600, {90, 90, 90});
  drawScaleBar(image, 10000.0);
  int longest = 0;
  for (int y = 0; y < image.height(); ++y) {
    int run = 0;
    for (int x = 0; x < image.width(); ++x) {
      run = image.at(x, y) == kWhite ? run + 1 : 0;
      longest = std::max(longest, run);
    }
  }
  EXPECT_EQ(longest, 200);
}

TEST(Overlay, colorBarRunsFromTheGreatestToTheLeast) {
  Image image = *Image::create(400, 300);
  drawColorBar(image, {0.0, 1.0}, "speed (m/s)");
  int least = -1;
  int greatest = -1;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      if (image.at(x, y) == mapColor(0.0)) least = y;
      if (image.at(x, y) == mapColor(1.0) && greatest < 0) greatest = y;
    }
  }
  EXPECT_GE(greatest, 0);
  EXPECT_EQ(least - greatest + 1, 300 * 2 / 5);
}

TEST(Overlay, captionTakesTheUpperEdgeOnly) {
  Image image = *Image::create(400, 300);
  const Image empty = image;
  drawCaption(image, "");
  EXPECT_EQ(image, empty);
  drawCaption(image, "a caption");
  EXPECT_NE(image.at(399, 0), kWhite);
  EXPECT_EQ(image.at(200, 150), kWhite);
}

}  // namespace
}  // namespace bleedsim::picture::test
