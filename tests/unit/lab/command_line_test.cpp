// bleedlab's command line: what it refuses, and what it says then.
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

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
  EXPECT_THAT(outcome.errors,
              testing::HasSubstr("effects, paper, hardcases, torture, replay, validate, accuracy, choose, bench"));
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

struct BadLine {
  const char* name;
  std::vector<const char*> arguments;
  const char* message;
};

class BadCommandLineTest : public testing::TestWithParam<BadLine> {};

TEST_P(BadCommandLineTest, HasCodeTwoAndTellsTheWayOut) {
  const Outcome outcome = run(GetParam().arguments);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.errors, testing::HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    All, BadCommandLineTest,
    testing::Values(
        BadLine{"sceneless", {"effects"}, "scene is required"}, BadLine{"scenes", {"effects", "a", "b"}, "not expected: b"},
        BadLine{"missing_scene", {"effects", "/nosuch.textproto"}, "does not exist; give the path of a scene file"},
        BadLine{"folder", {"effects", "/"}, "is a folder; give the path of a scene file"},
        BadLine{"device", {"effects", "/dev/zero"}, "is not a regular file; give the path of a scene file"},
        BadLine{"particles", {"effects", "a", "--particles", "999"}, "--particles: Value 999 not in range 1000 to 1000000"},
        BadLine{"particles_valueless", {"effects", "a", "--particles"}, "--particles: 1 required"},
        BadLine{
            "particles_twice", {"effects", "a", "--particles", "1000", "--particles", "1000"}, "--particles: At Most 1 required"},
        BadLine{"threads", {"effects", "a", "--threads", "65"}, "--threads: Value 65 not in range 1 to 64"},
        BadLine{"threads_valueless", {"effects", "a", "--threads"}, "--threads: 1 required"},
        BadLine{"threads_twice", {"effects", "a", "--threads", "1", "--threads", "1"}, "--threads: At Most 1 required"},
        BadLine{"simd_valueless", {"effects", "a", "--simd"}, "--simd: 1 required"},
        BadLine{"simd_twice", {"effects", "a", "--simd", "auto", "--simd", "auto"}, "--simd: At Most 1 required"},
        BadLine{"seconds_nan", {"effects", "a", "--seconds", "nan"}, "'nan' is not a number from 0.01 to 3600"},
        BadLine{"seconds_valueless", {"effects", "a", "--seconds"}, "--seconds: 1 required"},
        BadLine{"output_valueless", {"effects", "a", "-o"}, "--output: 1 required DIR missing"},
        BadLine{"output_twice", {"effects", "a", "-o", "x", "-o", "y"}, "--output: At Most 1 required"},
        BadLine{"json_value", {"effects", "a", "--json=no"}, "json was given a disallowed flag override"},
        BadLine{"duration_nan", {"paper", "fig2", "--duration", "nan"}, "'nan' is not a number from 0.001 to 10000"},
        BadLine{"table_seconds_inf", {"paper", "table2", "--seconds", "inf"}, "'inf' is not a number from 0.01 to 3600"},
        BadLine{"counts_valueless", {"paper", "table2", "--counts"}, "--counts"},
        BadLine{"scenes_valueless", {"paper", "table2", "--scenes"}, "--scenes: 1 required DIR missing"},
        BadLine{"model_valueless", {"paper", "fig5", "--model"}, "--model"},
        BadLine{"hard_case", {"hardcases", "--case", "easy"}, "coincident_particles"},
        BadLine{"hard_model", {"hardcases", "--model", "true"}, "literal"},
        BadLine{"hard_threads", {"hardcases", "--threads", "0"}, "--threads: Value 0 not in range 1 to 64"},
        BadLine{"torture_seed", {"torture", "--seed", "-1"}, "--seed"},
        BadLine{"torture_count", {"torture", "--count", "0"}, "--count: Value 0 not in range 1 to 10000000"},
        BadLine{"torture_steps", {"torture", "--steps", "0"}, "--steps: Value 0 not in range 1 to 1000000"},
        BadLine{"torture_model", {"torture", "--model", "both"}, "sound"},
        BadLine{"unknown_case", {"validate", "--case", "gravity"}, "no case 'gravity'; the cases are interpolation, "},
        BadLine{"unknown_preset", {"validate", "--preset", "coarse"}, "coarse not in {standard,fine}"},
        BadLine{"across_few", {"validate", "--across", "7"}, "--across: Value 7 not in range 8 to 160"},
        BadLine{"support_nan", {"validate", "--support", "nan"}, "'nan' is not a number from 1.5 to 3.5"},
        BadLine{"cfl_unstable", {"validate", "--cfl", "0.5"}, "'0.5' is not a number from 0.01 to 0.4"},
        BadLine{"mach_low", {"validate", "--mach", "1"}, "'1' is not a number from 5 to 50"},
        BadLine{"precision", {"validate", "--precision", "half"}, "half not in {float,double}"},
        BadLine{"double_vectors", {"validate", "--precision", "double", "--simd", "avx2"}, "runs on the scalar target only"},
        BadLine{"accuracy_case", {"accuracy", "--cases", "nothing"}, "no case 'nothing'"},
        BadLine{"accuracy_figureless", {"accuracy", "--cases", "free_fall"}, "has no figure to judge accuracy by"},
        BadLine{"accuracy_knob", {"accuracy", "--knobs", "colour"}, "colour not in {spacing,cfl,mach,support,precision,threads}"},
        BadLine{"accuracy_minutes", {"accuracy", "--minutes", "0"}, "'0' is not a number from 0.01 to 600"},
        BadLine{"accuracy_chapter", {"accuracy", "--chapter", "a.md"}, "--chapter requires --output"},
        BadLine{"accuracy_chapter_missing", {"accuracy", "-o", "a", "--chapter", "/nosuch.md"}, "cannot read '/nosuch.md'"},
        BadLine{"accuracy_chapter_without_its_place",
                {"accuracy", "-o", "a", "--chapter", SCENE_DIR "/round_wound.textproto"},
                "needs one line '<!-- begin bleedlab accuracy -->'"},
        BadLine{"choose_sceneless", {"choose"}, "--scene is required"},
        BadLine{"choose_scene", {"choose", "--scene", "/nosuch.textproto"}, "does not exist; give the path of a scene file"},
        BadLine{"choose_budget", {"choose", "--scene", "a", "--budget-ms", "-1"}, "'-1' is not a number from 0.01 to 100000"},
        BadLine{"choose_error", {"choose", "--scene", "a", "--error", "2"}, "'2' is not a number from 0.0001 to 1"},
        BadLine{"choose_literal", {"choose", "--scene", SCENE_DIR "/literal.textproto"}, "the literal model has no accuracy"},
        BadLine{"choose_results",
                {"choose", "--scene", SCENE_DIR "/round_wound.textproto", "--results", "/nosuch.json"},
                "cannot open '/nosuch.json'"},
        BadLine{"bench_model", {"bench", "--model", "true"}, "true not in {paper,reduced,full}"},
        BadLine{"bench_particles", {"bench", "--particles", "999"}, "--particles: Value 999 not in range 1000 to 1000000"},
        BadLine{"bench_particles_many", {"bench", "--particles", "20000,1000001"}, "Value 1000001 not in range 1000 to 1000000"},
        BadLine{"bench_threads", {"bench", "--threads", "1,0"}, "--threads: Value 0 not in range 1 to 64"},
        BadLine{"bench_seconds", {"bench", "--seconds", "nan"}, "'nan' is not a number from 0.01 to 3600"},
        BadLine{"bench_warm_up", {"bench", "--scene", "a", "--warm-up", "-1"}, "'-1' is not a number from 0 to 1000"},
        BadLine{"bench_warm_up_block", {"bench", "--warm-up", "1"}, "--warm-up requires --scene"},
        BadLine{"bench_scene_and_model", {"bench", "--scene", "a", "--model", "paper"}, "excludes"},
        BadLine{"bench_scene_and_particles", {"bench", "--scene", "a", "--particles", "1000"}, "excludes"},
        BadLine{"bench_scene", {"bench", "--scene", "/nosuch.textproto"}, "does not exist; give the path of a scene file"},
        BadLine{"bench_simd", {"bench", "--simd", "mmx"}, "use auto, scalar, avx2 or avx512"},
        BadLine{
            "bench_compare", {"bench", "--compare", "/nosuch.json"}, "'/nosuch.json' is not a file that can be compared with"},
        BadLine{"bench_compare_scene",
                {"bench", "--compare", SCENE_DIR "/round_wound.textproto"},
                "is not a result of 'bleedlab bench --json'"}),
    [](const auto& tested) { return std::string{tested.param.name}; });

// The machine-readable result goes to stdout, alone, or to a file; the cheapest case of each command stands for it.
TEST(CommandLine, JsonGoesWhereItIsAsked) {
  const std::string file = testing::TempDir() + "lab_command_line.json";
  for (const std::vector<const char*>& command : {std::vector<const char*>{"validate", "--case", "interpolation"},
                                                  {"hardcases", "--case", "bad_commands", "--model", "sound"}}) {
    std::vector<const char*> line = command;
    line.push_back("--json");
    testing::internal::CaptureStdout();
    EXPECT_EQ(run(line).code, 0);
    const std::string printed = testing::internal::GetCapturedStdout();
    line.push_back(file.c_str());
    testing::internal::CaptureStdout();
    EXPECT_EQ(run(line).code, 0);
    const std::string table = testing::internal::GetCapturedStdout();
    EXPECT_TRUE(nlohmann::json::accept(printed)) << printed;
    EXPECT_FALSE(nlohmann::json::accept(table)) << "the table stays";
    std::ifstream in{file};
    EXPECT_TRUE(nlohmann::json::accept(in));
  }
  std::filesystem::remove(file);
}

// Scripts tell by the code whether what was judged holds: 8 rows across resolve no vortex.
TEST(CommandLine, AMissedThresholdHasACodeOfItsOwn) {
  testing::internal::CaptureStdout();
  const Outcome missed = run({"validate", "--case", "taylor_green", "--across", "8"});
  EXPECT_EQ(missed.code, 1);
  EXPECT_THAT(missed.errors, testing::HasSubstr("bleedlab: taylor_green misses its threshold: decay_rate is "));
  EXPECT_THAT(testing::internal::GetCapturedStdout(), testing::HasSubstr("| misses |"));
  testing::internal::CaptureStdout();
  EXPECT_EQ(run({"validate", "--case", "platelet_spread", "--across", "12"}).code, 0);
  testing::internal::GetCapturedStdout();
}

TEST(CommandLine, WhatCannotBeWrittenIsNoMiss) {
  EXPECT_EQ(run({"validate", "--case", "interpolation", "-o", "/proc/nosuch"}).code, 4);
  testing::internal::CaptureStdout();
  EXPECT_EQ(run({"hardcases", "--case", "bad_commands", "--model", "sound", "--json", "/proc/nosuch"}).code, 4);
  testing::internal::GetCapturedStdout();
}

TEST(CommandLine, AMissingSceneIsNamedWithTheFolder) {
  const Outcome outcome = run({"paper", "table2", "--scenes", "/nonexistent"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.errors, testing::HasSubstr("/nonexistent"));
  EXPECT_THAT(outcome.errors, testing::HasSubstr("--scenes"));
}

}  // namespace
}  // namespace bleedsim::lab
