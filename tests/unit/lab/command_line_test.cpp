// bleedlab's command line: what it refuses, and what it says then.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "service/lab/app.h"

namespace bleedsim::lab {
namespace {

struct Outcome {
  int code;
  std::string errors;
};

Outcome run(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "bleedlab");
  testing::internal::CaptureStderr();
  const int code = runLab(static_cast<int>(arguments.size()), arguments.data());
  return {code, testing::internal::GetCapturedStderr()};
}

TEST(CommandLine, WithoutACommandItListsThem) {
  const Outcome outcome = run({});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.errors, testing::HasSubstr("effects, paper"));
}

TEST(CommandLine, WithoutAnExperimentItListsThem) {
  const Outcome outcome = run({"paper"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.errors, testing::HasSubstr("fig2, fig5, fig6, fig8, table2, claims, all"));
}

TEST(CommandLine, UnknownCommandsModelsAndTargetsAreRefused) {
  EXPECT_EQ(run({"paper", "fig9"}).code, 2);
  const Outcome model = run({"paper", "fig5", "--model", "true"});
  EXPECT_EQ(model.code, 2);
  EXPECT_THAT(model.errors, testing::HasSubstr("sound"));
  const Outcome target = run({"paper", "table2", "--simd", "mmx"});
  EXPECT_EQ(target.code, 2);
  EXPECT_THAT(target.errors, testing::HasSubstr("scalar"));
}

TEST(CommandLine, NumbersOutOfRangeAreRefused) {
  EXPECT_EQ(run({"paper", "fig5", "--particles", "5"}).code, 2);
  EXPECT_EQ(run({"paper", "table2", "--counts", "1000,many"}).code, 2);
  EXPECT_EQ(run({"paper", "table2", "--seconds", "0"}).code, 2);
  EXPECT_EQ(run({"effects", "nowhere.textproto", "--threads", "0"}).code, 2);
}

TEST(CommandLine, AMissingSceneIsNamedWithTheFolder) {
  const Outcome outcome = run({"paper", "table2", "--scenes", "/nonexistent"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.errors, testing::HasSubstr("/nonexistent"));
  EXPECT_THAT(outcome.errors, testing::HasSubstr("--scenes"));
}

}  // namespace
}  // namespace bleedsim::lab
