// The small font.
#include "service/picture/text.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

#include "service/picture/glyphs.h"

namespace bleedsim::picture::test {
namespace {

struct Ink {
  int left = 1 << 20, right = -1, top = 1 << 20, bottom = -1;
  std::size_t pixels = 0;
};

Ink inkOf(const Image& image) {
  Ink ink;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      if (image.at(x, y) == kWhite) continue;
      ink = {std::min(ink.left, x), std::max(ink.right, x), std::min(ink.top, y), std::max(ink.bottom, y), ink.pixels + 1};
    }
  }
  return ink;
}

TEST(Text, everyCharacterHasAGlyphOfItsOwn) {
  std::set<std::pair<Glyph, int>> seen;
  for (char c = ' '; c <= '~'; ++c) {
    EXPECT_TRUE(seen.insert({glyphOf(c), dropOf(c)}).second) << c;
    for (const std::uint8_t row : glyphOf(c)) EXPECT_LT(row, 1 << kGlyphColumns) << c;
  }
  EXPECT_EQ(glyphOf('\n'), glyphOf('?'));
  EXPECT_EQ(glyphOf(static_cast<char>(0xc3)), glyphOf('?'));
}

TEST(Text, inkStaysWithinTheMeasuredSize) {
  for (const double dot : {1.0, 2.0, 2.7}) {
    Image image = *Image::create(400, 60);
    const std::string text = "HgjpqyW|";
    drawText(image, 20, 20, text, {dot, kInk});
    const Ink ink = inkOf(image);
    ASSERT_GT(ink.pixels, 100U);
    // Soft edges may reach one pixel beyond.
    EXPECT_GE(ink.left, 19);
    EXPECT_GE(ink.top, 19);
    EXPECT_LE(ink.right, 20 + textWidth(text, dot));
    EXPECT_LE(ink.bottom, 20 + textHeight(dot));
    EXPECT_GE(ink.bottom, 20 + textHeight(dot) - 3) << "descenders hang lower";
  }
}

TEST(Text, leavesOutWhatIsOutsideThePicture) {
  Image image = *Image::create(10, 10);
  drawText(image, -30, -5, "a long text over all edges", {3.0, kInk});
  drawText(image, 1000, 1000, "far", {3.0, kInk});
  fillRectangle(image, -5, -5, 7, 7, kInk);
  EXPECT_EQ(image.at(1, 1), kInk);
  fillRectangle(image, 8, 8, 100, 100, kInk, 0.5);
  EXPECT_EQ(image.at(9, 9), (Color{145, 145, 148}));  // half way from 255 to 34, 34 and 40, rounded
}

TEST(Text, wrapsAtBlanksAndCutsTheRest) {
  const double dot = 1.0;
  const int width = textWidth("0123456789", dot);
  EXPECT_EQ(wrapText("one two three four", dot, width, 9), (std::vector<std::string>{"one two", "three four"}));
  EXPECT_EQ(wrapText("", dot, width, 9), (std::vector<std::string>{}));
  EXPECT_EQ(wrapText("one two three four", dot, width, 1), (std::vector<std::string>{"one two..."}));
  EXPECT_EQ(wrapText("averyveryverylongword", dot, width, 2), (std::vector<std::string>{"averyve..."}));
}

TEST(Text, numbersAreShort) {
  EXPECT_EQ(shortNumber(0.0025), "0.0025");
  EXPECT_EQ(shortNumber(1.0 / 3.0), "0.3333");
  EXPECT_EQ(shortNumber(1e9), "1e+09");
}

}  // namespace
}  // namespace bleedsim::picture::test
