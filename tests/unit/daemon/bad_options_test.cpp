// Every option of bleedd with a wrong value, without one and twice: exit code 2 and a message that says what is possible.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "service/daemon/options.h"

namespace bleedsim::daemon {
namespace {

using testing::HasSubstr;

struct BadOptions {
  const char* name;
  std::vector<const char*> arguments;
  const char* message;
};

class BadOptionsTest : public testing::TestWithParam<BadOptions> {};

TEST_P(BadOptionsTest, AreUsageErrorsWithTheWayOut) {
  std::vector<const char*> arguments = GetParam().arguments;
  arguments.insert(arguments.begin(), "bleedd");
  testing::internal::CaptureStderr();
  const auto parsed = parseOptions(static_cast<int>(arguments.size()), arguments.data());
  const std::string told = testing::internal::GetCapturedStderr();
  const auto* code = std::get_if<ExitCode>(&parsed);
  ASSERT_NE(code, nullptr) << "was accepted";
  EXPECT_EQ(*code, ExitCode::usage);
  EXPECT_THAT(told, HasSubstr(GetParam().message));
  EXPECT_THAT(told, HasSubstr("--help"));
}

INSTANTIATE_TEST_SUITE_P(
    All, BadOptionsTest,
    testing::Values(
        BadOptions{"nothing", {}, "which scene? Give --scene FILE"},
        BadOptions{"scene_valueless", {"--scene"}, "--scene: 1 required FILE missing"},
        BadOptions{"scene_empty", {"--scene="}, "--scene: 1 required FILE missing"},
        BadOptions{"scene_blank", {"--scene", ""}, "which scene? Give --scene FILE"},
        BadOptions{"scene_twice", {"--scene", "a", "--scene", "b"}, "--scene: At Most 1 required but received 2"},
        BadOptions{"session_wrong", {"--scene", "a", "--session", "a/b"}, "use 1 to 64 letters, digits, '_' or '-'"},
        BadOptions{"session_blank", {"--scene", "a", "--session", ""}, "use 1 to 64 letters, digits, '_' or '-'"},
        BadOptions{"session_valueless", {"--scene", "a", "--session"}, "--session: 1 required NAME missing"},
        BadOptions{"session_twice", {"--scene", "a", "--session", "x", "--session", "y"}, "--session: At Most 1 required"},
        BadOptions{"domain_high", {"--scene", "a", "--domain", "231"}, "--domain: Value 231 not in range 0 to 230"},
        BadOptions{"domain_negative", {"--scene", "a", "--domain", "-1"}, "--domain: Value -1 not in range 0 to 230"},
        BadOptions{"domain_text", {"--scene", "a", "--domain", "x"}, "--domain: Value x not in range 0 to 230"},
        BadOptions{"domain_valueless", {"--scene", "a", "--domain"}, "--domain: 1 required"},
        BadOptions{"domain_twice", {"--scene", "a", "--domain", "1", "--domain", "2"}, "--domain: At Most 1 required"},
        BadOptions{"interface_valueless", {"--scene", "a", "--interface"}, "--interface: 1 required NAME missing"},
        BadOptions{
            "interface_twice", {"--scene", "a", "--interface", "x", "--interface", "y"}, "--interface: At Most 1 required"},
        BadOptions{"pace_wrong", {"--scene", "a", "--pace", "fast"}, "use realtime, max or a factor from 0.0001 to 1000"},
        BadOptions{"pace_nan", {"--scene", "a", "--pace", "nan"}, "use realtime, max or a factor from 0.0001 to 1000"},
        BadOptions{"pace_valueless", {"--scene", "a", "--pace"}, "--pace: 1 required PACE missing"},
        BadOptions{"pace_twice", {"--scene", "a", "--pace", "1", "--pace", "2"}, "--pace: At Most 1 required"},
        BadOptions{"rate_nan", {"--scene", "a", "--frame-rate", "nan"}, "'nan' is not a number from 1 to 1000"},
        BadOptions{"rate_low", {"--scene", "a", "--frame-rate", "0.5"}, "'0.5' is not a number from 1 to 1000"},
        BadOptions{"rate_valueless", {"--scene", "a", "--frame-rate"}, "--frame-rate: 1 required HZ missing"},
        BadOptions{"rate_twice", {"--scene", "a", "--frame-rate", "9", "--frame-rate", "9"}, "--frame-rate: At Most 1 required"},
        BadOptions{"threads_none", {"--scene", "a", "--threads", "0"}, "--threads: Value 0 not in range 1 to 64"},
        BadOptions{"threads_half", {"--scene", "a", "--threads", "1.5"}, "--threads: Value 1.5 not in range 1 to 64"},
        BadOptions{"threads_valueless", {"--scene", "a", "--threads"}, "--threads: 1 required"},
        BadOptions{"threads_twice", {"--scene", "a", "--threads", "1", "--threads", "1"}, "--threads: At Most 1 required"},
        BadOptions{"simd_wrong", {"--scene", "a", "--simd", "mmx"}, "use auto, scalar, avx2 or avx512"},
        BadOptions{"simd_valueless", {"--scene", "a", "--simd"}, "--simd: 1 required TARGET missing"},
        BadOptions{"simd_twice", {"--scene", "a", "--simd", "auto", "--simd", "auto"}, "--simd: At Most 1 required"},
        BadOptions{"duration_huge", {"--scene", "a", "--duration", "1e999"}, "'1e999' is not a number from 0 to 1e+09"},
        BadOptions{"duration_valueless", {"--scene", "a", "--duration"}, "--duration: 1 required SECONDS missing"},
        BadOptions{"duration_twice", {"--scene", "a", "--duration", "1", "--duration", "2"}, "--duration: At Most 1 required"},
        BadOptions{"every_none", {"--scene", "a", "--checkpoint-every", "0"}, "'0' is not a number from 0.001 to 1e+09"},
        BadOptions{"every_nan", {"--scene", "a", "--checkpoint-every", "nan"}, "'nan' is not a number from 0.001 to 1e+09"},
        BadOptions{"every_valueless", {"--scene", "a", "--checkpoint-every"}, "--checkpoint-every: 1 required SECONDS missing"},
        BadOptions{"every_twice",
                   {"--scene", "a", "--checkpoint-every", "1", "--checkpoint-every", "2"},
                   "--checkpoint-every: At Most 1 required"},
        BadOptions{"dir_valueless", {"--scene", "a", "--checkpoint-dir"}, "--checkpoint-dir: 1 required DIR missing"},
        BadOptions{"dir_blank", {"--scene", "a", "--checkpoint-dir", ""}, "where are checkpoints to be kept?"},
        BadOptions{"dir_twice",
                   {"--scene", "a", "--checkpoint-dir", "b", "--checkpoint-dir", "c"},
                   "--checkpoint-dir: At Most 1 required"},
        BadOptions{"resume_value", {"--scene", "a", "--resume=no"}, "resume was given a disallowed flag override"},
        BadOptions{"check_value", {"--scene", "a", "--check=no"}, "check was given a disallowed flag override"},
        BadOptions{"list_value", {"--list-effects=no"}, "list-effects was given a disallowed flag override"},
        BadOptions{"json_value", {"--list-effects", "--json=no"}, "json was given a disallowed flag override"},
        BadOptions{"json_alone", {"--scene", "a", "--json"}, "--json requires --list-effects"},
        BadOptions{"unknown", {"--scene", "a", "--colour"}, "not expected: --colour"},
        BadOptions{"stray", {"--scene", "a", "b"}, "not expected: b"}),
    [](const auto& tested) { return std::string{tested.param.name}; });

}  // namespace
}  // namespace bleedsim::daemon
