#include "clients/bleedctl/terminal_rows.h"

#include <gtest/gtest.h>

namespace bleedsim::bleedctl {
namespace {

TEST(TerminalRows, ARowIsCutBetweenCharacters) {
  EXPECT_EQ(cutToColumns("running 1 s", 20), "running 1 s");
  EXPECT_EQ(cutToColumns("running 1 s", 7), "running");
  EXPECT_EQ(cutToColumns("a\xC3\xA4z", 2), "a") << "half of a character is none";
  EXPECT_EQ(cutToColumns("a\xC3\xA4z", 3), "a\xC3\xA4");
  EXPECT_EQ(cutToColumns("a", 0), "");
}

TEST(TerminalRows, StandWhereTheOnesBeforeStood) {
  EXPECT_EQ(overwriteRows(0, {"one", "two"}, 80), "\rone\x1b[K\r\ntwo\x1b[K\x1b[J");
  EXPECT_EQ(overwriteRows(1, {"one"}, 80), "\rone\x1b[K\x1b[J");
  EXPECT_EQ(overwriteRows(3, {"one", "two"}, 80), "\r\x1b[2Aone\x1b[K\r\ntwo\x1b[K\x1b[J");
}

TEST(TerminalRows, NoneIsWiderThanTheTerminal) { EXPECT_EQ(overwriteRows(1, {"abcdef"}, 4), "\rabcd\x1b[K\x1b[J"); }

}  // namespace
}  // namespace bleedsim::bleedctl
