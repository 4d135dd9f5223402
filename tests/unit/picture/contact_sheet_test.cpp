// Where pictures and captions lie on a sheet.
#include "service/picture/contact_sheet.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vector>

namespace bleedsim::picture::test {
namespace {

using testing::HasSubstr;

constexpr Color kRed{200, 0, 0};
constexpr Color kGreen{0, 200, 0};

struct Box {
  int left = 1 << 20, right = -1, top = 1 << 20, bottom = -1;
};

Box boxOf(const Image& sheet, Color color) {
  Box box;
  for (int y = 0; y < sheet.height(); ++y) {
    for (int x = 0; x < sheet.width(); ++x) {
      if (sheet.at(x, y) == color)
        box = {std::min(box.left, x), std::max(box.right, x), std::min(box.top, y), std::max(box.bottom, y)};
    }
  }
  return box;
}

std::size_t inkIn(const Image& sheet, const Box& box) {
  std::size_t count = 0;
  for (int y = box.top; y <= box.bottom; ++y) {
    for (int x = box.left; x <= box.right; ++x) count += sheet.at(x, y) != kWhite ? 1 : 0;
  }
  return count;
}

TEST(ContactSheet, laysPicturesInRowsWithoutCaptions) {
  const Image gray = *Image::create(100, 60, {99, 99, 99});
  const Image red = *Image::create(100, 60, kRed);
  const std::vector<SheetItem> items{{&gray, ""}, {&gray, ""}, {&gray, ""}, {&gray, ""}, {&red, ""}};
  const Result<Image> sheet = contactSheet(items, {.columns = 3, .gap = 10, .lettered = false});
  ASSERT_TRUE(sheet.ok()) << sheet.status().message();
  EXPECT_EQ(sheet->width(), 3 * 110 + 10);
  EXPECT_EQ(sheet->height(), 2 * 70 + 10);
  // The fifth is the second of the second row.
  const Box box = boxOf(*sheet, kRed);
  EXPECT_EQ(box.left, 10 + 110);
  EXPECT_EQ(box.right, 10 + 110 + 99);
  EXPECT_EQ(box.top, 10 + 70);
  EXPECT_EQ(box.bottom, 10 + 70 + 59);
}

TEST(ContactSheet, smallerPicturesStandInTheMiddleOfTheirCell) {
  const Image large = *Image::create(100, 60, kRed);
  const Image small = *Image::create(40, 20, kGreen);
  const std::vector<SheetItem> items{{&large, ""}, {&small, ""}};
  const Result<Image> sheet = contactSheet(items, {.columns = 2, .gap = 0, .lettered = false});
  ASSERT_TRUE(sheet.ok());
  const Box box = boxOf(*sheet, kGreen);
  EXPECT_EQ(box.left, 100 + 30);
  EXPECT_EQ(box.top, 20);
}

TEST(ContactSheet, captionsStandBelowTheirPicture) {
  const Image red = *Image::create(300, 200, kRed);
  const std::vector<SheetItem> items{{&red, "with a caption"}, {&red, ""}};
  const Result<Image> lettered = contactSheet(items, {.columns = 2, .gap = 10});
  const Result<Image> plain = contactSheet(items, {.columns = 2, .gap = 10, .lettered = false});
  ASSERT_TRUE(lettered.ok() && plain.ok());
  const auto below = [](const Image& sheet, int column) {
    return inkIn(sheet, {10 + column * 310, 309 + column * 310, 210, sheet.height() - 1});
  };
  EXPECT_GT(below(*lettered, 0), below(*lettered, 1));
  EXPECT_GT(below(*lettered, 1), 0U) << "the letter alone";
  EXPECT_GT(below(*plain, 0), 0U);
  EXPECT_EQ(below(*plain, 1), 0U);
}

TEST(ContactSheet, titleMovesAllDown) {
  const Image red = *Image::create(300, 200, kRed);
  const std::vector<SheetItem> items{{&red, ""}};
  const Result<Image> sheet = contactSheet(items, {.gap = 10, .lettered = false, .title = "Fig. 5"});
  ASSERT_TRUE(sheet.ok());
  const Box box = boxOf(*sheet, kRed);
  EXPECT_GT(box.top, 20);
  EXPECT_EQ(box.bottom - box.top, 199);
  EXPECT_GT(inkIn(*sheet, {0, sheet->width() - 1, 0, box.top - 1}), 20U);
}

TEST(ContactSheet, columnsAreChosenNearASquare) {
  const Image red = *Image::create(10, 10, kRed);
  for (const auto& [count, columns] : {std::pair{1, 1}, {2, 2}, {4, 2}, {6, 3}, {10, 4}}) {
    const std::vector<SheetItem> items(static_cast<std::size_t>(count), SheetItem{&red, ""});
    const Result<Image> sheet = contactSheet(items, {.gap = 0, .lettered = false});
    ASSERT_TRUE(sheet.ok());
    EXPECT_EQ(sheet->width(), 10 * columns) << count;
  }
}

TEST(ContactSheet, refusesWhatMakesNoSheet) {
  const Image red = *Image::create(10, 10, kRed);
  EXPECT_THAT(contactSheet({}).status().message(), HasSubstr("at least one"));
  EXPECT_THAT(contactSheet(std::vector<SheetItem>(27, {&red, ""})).status().message(), HasSubstr("26"));
  EXPECT_THAT(contactSheet(std::vector<SheetItem>{{nullptr, ""}}).status().message(), HasSubstr("missing"));
  EXPECT_FALSE(contactSheet(std::vector<SheetItem>{{&red, ""}}, {.columns = -1}).ok());
  EXPECT_FALSE(contactSheet(std::vector<SheetItem>{{&red, ""}}, {.gap = 1001}).ok());
  const Image wide = *Image::create(Image::kMostSide, 1, kRed);
  EXPECT_THAT(contactSheet(std::vector<SheetItem>(2, {&wide, ""}), {.columns = 2}).status().message(), HasSubstr("16384"));
}

}  // namespace
}  // namespace bleedsim::picture::test
