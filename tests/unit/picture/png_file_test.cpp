// Images and PNG files.
#include "service/picture/png_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/support/temporary_folder.h"

namespace bleedsim::picture::test {
namespace {

using bleedsim::test::contentOf;
using bleedsim::test::TemporaryFolder;

using testing::HasSubstr;

Image patterned(int width, int height) {
  Image image = *Image::create(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.set(x, y, {static_cast<std::uint8_t>(x * 7), static_cast<std::uint8_t>(y * 11), static_cast<std::uint8_t>(x * y)});
    }
  }
  return image;
}

TEST(Image, refusesSizesThatAreNoneOrTooLarge) {
  for (const auto& [width, height] :
       {std::pair{0, 10}, {10, 0}, {-1, 10}, {Image::kMostSide + 1, 1}, {Image::kMostSide, Image::kMostSide}}) {
    const Result<Image> image = Image::create(width, height);
    ASSERT_FALSE(image.ok()) << width << " x " << height;
    EXPECT_EQ(image.status().code(), StatusCode::invalid_argument);
    EXPECT_THAT(image.status().message(), HasSubstr("16384"));
  }
  EXPECT_TRUE(Image::create(Image::kMostSide, 1).ok());
}

TEST(PngFile, bringsBackEveryPixel) {
  const TemporaryFolder folder;
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 2}, {257, 131}}) {
    const Image image = patterned(width, height);
    const std::filesystem::path path = folder.path() / "picture.png";
    const Status written = writePng(path, image);
    ASSERT_TRUE(written.ok()) << written.message();
    const Result<Image> read = readPng(path);
    ASSERT_TRUE(read.ok()) << read.status().message();
    EXPECT_EQ(*read, image) << width << " x " << height;
  }
  EXPECT_EQ(folder.files(), 1U) << "a temporary file was left";
}

TEST(PngFile, sameImageGivesSameBytes) {
  const TemporaryFolder folder;
  ASSERT_TRUE(writePng(folder.path() / "a.png", patterned(64, 48)).ok());
  ASSERT_TRUE(writePng(folder.path() / "b.png", patterned(64, 48)).ok());
  ASSERT_FALSE(contentOf(folder.path() / "a.png").empty());
  EXPECT_EQ(contentOf(folder.path() / "a.png"), contentOf(folder.path() / "b.png"));
}

TEST(PngFile, missingFolderIsNamedWithARemedy) {
  const TemporaryFolder folder;
  const Status status = writePng(folder.path() / "missing" / "picture.png", patterned(2, 2));
  EXPECT_EQ(status.code(), StatusCode::io);
  EXPECT_THAT(status.message(), HasSubstr("missing/picture.png'"));
  EXPECT_THAT(status.message(), HasSubstr("create its folder first"));
}

TEST(PngFile, folderInPlaceOfTheFileIsRefusedAndNothingIsLeft) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "taken.png");
  const Status status = writePng(folder.path() / "taken.png", patterned(2, 2));
  EXPECT_EQ(status.code(), StatusCode::io);
  EXPECT_THAT(status.message(), HasSubstr("it is a folder"));
  EXPECT_EQ(folder.files(), 1U);
}

TEST(PngFile, fullDiskIsAnError) {
  // Every write to this device fails with ENOSPC; a link to it stands where the temporary file will be opened.
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "picture.png";
  std::filesystem::create_symlink("/dev/full", folder.path() / ("picture.png.part" + std::to_string(::getpid())));
  const Status status = writePng(path, patterned(257, 131));
  EXPECT_EQ(status.code(), StatusCode::io);
  EXPECT_THAT(status.message(), HasSubstr("free space"));
  EXPECT_EQ(folder.files(), 0U);
}

TEST(PngFile, damagedFilesAreToldFromMissingOnes) {
  const TemporaryFolder folder;
  EXPECT_EQ(readPng(folder.path() / "none.png").status().code(), StatusCode::not_found);

  const std::filesystem::path path = folder.path() / "picture.png";
  ASSERT_TRUE(writePng(path, patterned(257, 131)).ok());
  const std::string whole = contentOf(path);
  for (const std::size_t size : {std::size_t{0}, std::size_t{5}, std::size_t{40}, whole.size() / 2}) {
    std::ofstream{path, std::ios::binary | std::ios::trunc} << whole.substr(0, size);
    const Result<Image> read = readPng(path);
    ASSERT_FALSE(read.ok()) << size << " of " << whole.size() << " bytes";
    EXPECT_EQ(read.status().code(), StatusCode::data_loss) << size;
  }
}

}  // namespace
}  // namespace bleedsim::picture::test
