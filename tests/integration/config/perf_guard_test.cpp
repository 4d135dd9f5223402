// How config/perf-guard judges counts of instructions; the counting itself is CI's.
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/child_process.h"
#include "tests/support/temporary_folder.h"

namespace bleedsim::config_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class PerfGuardTest : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    const std::filesystem::path file = temporary_.path() / name;
    std::ofstream{file} << text;
    return file.string();
  }
  test::Finished judge(const std::string& counts, const std::string& reference) const {
    return test::runProcess({PERF_GUARD, "--judge", write("counts", counts), write("reference", reference)});
  }

 private:
  test::TemporaryFolder temporary_;
};

constexpr const char* kReference = "# by hand\ncompiler GNU-12.2.0\npaper scalar 1000000\npaper avx2 200000\n";

TEST_F(PerfGuardTest, LetsCountsWithinFivePercentPass) {
  const test::Finished judged = judge("compiler GNU-12.2.0\npaper scalar 1049000\npaper avx2 191000\n", kReference);
  EXPECT_EQ(judged.code, 0) << judged.output;
  EXPECT_THAT(judged.output, AllOf(HasSubstr("ok paper scalar"), HasSubstr("ok paper avx2"), Not(HasSubstr("--renew"))));
}

TEST_F(PerfGuardTest, FailsOnMoreAndTellsCaseFiguresAndTheWayOut) {
  const test::Finished judged = judge("compiler GNU-12.2.0\npaper scalar 1000000\npaper avx2 212000\n", kReference);
  EXPECT_EQ(judged.code, 1) << judged.output;
  EXPECT_THAT(judged.output, HasSubstr("FAILED paper avx2: reference 200000, now 212000 instructions (+6.00 %)"));
  EXPECT_THAT(judged.output, HasSubstr("config/perf-guard --renew"));
  EXPECT_THAT(judged.output, HasSubstr("ok paper scalar"));
}

TEST_F(PerfGuardTest, OnlyHintsOnFewer) {
  const test::Finished judged = judge("compiler GNU-12.2.0\npaper scalar 900000\npaper avx2 200000\n", kReference);
  EXPECT_EQ(judged.code, 0) << judged.output;
  EXPECT_THAT(judged.output, HasSubstr("fewer paper scalar: reference 1000000, now 900000 instructions (-10.00 %)"));
  EXPECT_THAT(judged.output, HasSubstr("--renew"));
}

TEST_F(PerfGuardTest, NamesAnotherCompilerAndStillFailsOnlyOnTheCount) {
  const test::Finished same = judge("compiler GNU-13.1.0\npaper scalar 1000000\npaper avx2 200000\n", kReference);
  EXPECT_EQ(same.code, 0) << same.output;
  EXPECT_THAT(same.output, AllOf(HasSubstr("made by GNU-12.2.0"), HasSubstr("this build by GNU-13.1.0"), HasSubstr("--renew")));
  EXPECT_EQ(judge("compiler GNU-13.1.0\npaper scalar 1100000\n", kReference).code, 1);
}

TEST_F(PerfGuardTest, FailsOnACaseWithoutReferenceAndNamesWhatIsNotCounted) {
  const test::Finished judged = judge("compiler GNU-12.2.0\npaper scalar 1000000\nwound scalar 5\n", kReference);
  EXPECT_EQ(judged.code, 1) << judged.output;
  EXPECT_THAT(judged.output, HasSubstr("FAILED wound scalar: no reference, 5 now"));
  EXPECT_THAT(judged.output, HasSubstr("not counted here: paper avx2"));
}

TEST_F(PerfGuardTest, RefusesWhatHoldsNoCounts) {
  EXPECT_EQ(judge("", kReference).code, 2);
  EXPECT_EQ(judge("compiler GNU-12.2.0\n", kReference).code, 2);
  const test::Finished wrong = judge("paper scalar many\n", kReference);
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.output, HasSubstr("not \"CASE TARGET INSTRUCTIONS\": paper scalar many"));
  EXPECT_EQ(test::runProcess({PERF_GUARD, "--judge", "/nosuch"}).code, 2);
  EXPECT_EQ(test::runProcess({PERF_GUARD, "--count"}).code, 2);
}

// The file in the tree has every case for both targets: against itself nothing is missing.
TEST_F(PerfGuardTest, TheReferenceHasEveryCase) {
  const test::Finished judged = test::runProcess({PERF_GUARD, "--judge", INSTRUCTIONS});
  EXPECT_EQ(judged.code, 0) << judged.output;
  for (const char* name : {"paper", "reduced", "full", "clotting", "wound"}) {
    for (const char* target : {"scalar", "avx2"}) {
      EXPECT_THAT(judged.output, HasSubstr(std::string{"ok "} + name + " " + target + ": ")) << judged.output;
    }
  }
}

}  // namespace
}  // namespace bleedsim::config_test
