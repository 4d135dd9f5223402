// The part of a Markdown file that a command writes.
#include "service/lab/markdown_block.h"

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sstream>

namespace bleedsim::lab {
namespace {

using testing::HasSubstr;

constexpr const char* kText = "before\n<!-- begin x -->\nold\n<!-- end x -->\nafter\n";

TEST(MarkdownBlock, ReplacesWhatStandsBetweenItsLines) {
  const auto replaced = withBlock(kText, "x", "new\nlines\n");
  ASSERT_TRUE(replaced.ok()) << replaced.status().message();
  EXPECT_EQ(*replaced, "before\n<!-- begin x -->\nnew\nlines\n<!-- end x -->\nafter\n");
  EXPECT_EQ(*withBlock(*replaced, "x", "old\n"), kText) << "and again";
  EXPECT_EQ(*withBlock("<!-- begin x -->\n<!-- end x -->\n", "x", "y\n"), "<!-- begin x -->\ny\n<!-- end x -->\n");
}

TEST(MarkdownBlock, NeedsOneLineOfEachKindInTheirOrder) {
  for (const char* text : {"", "<!-- begin x -->\n", "<!-- end x -->\n<!-- begin x -->\n", "a <!-- begin x -->\n<!-- end x -->\n",
                           "<!-- begin x -->\n<!-- begin x -->\n<!-- end x -->\n", "<!-- begin y -->\n<!-- end y -->\n"}) {
    const auto replaced = withBlock(text, "x", "new\n");
    ASSERT_FALSE(replaced.ok()) << text;
    EXPECT_THAT(replaced.status().message(),
                HasSubstr("needs one line '<!-- begin x -->' and, after it, one line '<!-- end x -->'"));
  }
}

TEST(MarkdownBlock, LeavesAFileThatItCannotChange) {
  const std::filesystem::path file = std::filesystem::path{testing::TempDir()} / "bleedsim_markdown_block.md";
  std::ofstream{file, std::ios::binary} << kText;
  EXPECT_TRUE(checkBlock(file.string(), "x").ok());
  const Status refused = replaceBlock(file.string(), "y", "new\n");
  EXPECT_THAT(refused.message(), testing::AllOf(HasSubstr(file.string()), HasSubstr("<!-- begin y -->")));
  ASSERT_TRUE(replaceBlock(file.string(), "x", "new\n").ok());
  std::ostringstream text;
  text << std::ifstream{file}.rdbuf();
  EXPECT_EQ(text.str(), "before\n<!-- begin x -->\nnew\n<!-- end x -->\nafter\n");
  EXPECT_FALSE(std::filesystem::exists(file.string() + ".new"));
  std::filesystem::remove(file);
  EXPECT_EQ(checkBlock(file.string(), "x").code(), StatusCode::not_found);
  EXPECT_EQ(checkBlock(testing::TempDir(), "x").code(), StatusCode::not_found);
}

}  // namespace
}  // namespace bleedsim::lab
