// Options and arguments of bleedctl with a wrong value, without one and twice, and files that are none: the exit code, and a
// message that says what is possible. Nothing here reaches a session.
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <unistd.h>
#include <vector>

#include "clients/bleedctl/context.h"
#include "service/status/request_limits.h"

namespace bleedsim::bleedctl {
namespace {

using testing::HasSubstr;

struct Outcome {
  int code;
  std::string errors;
};

Outcome run(const std::vector<std::string>& arguments) {
  std::vector<const char*> argv{"bleedctl"};
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  testing::internal::CaptureStderr();
  const int code = runBleedctl(static_cast<int>(argv.size()), argv.data());
  return {code, testing::internal::GetCapturedStderr()};
}

struct BadLine {
  const char* name;
  std::vector<std::string> arguments;
  const char* message;
};

class BadCommandLineTest : public testing::TestWithParam<BadLine> {};

TEST_P(BadCommandLineTest, HasCodeTwoAndTellsTheWayOut) {
  const Outcome outcome = run(GetParam().arguments);
  EXPECT_EQ(outcome.code, kUsage);
  EXPECT_THAT(outcome.errors, HasSubstr(GetParam().message));
  EXPECT_THAT(outcome.errors, HasSubstr("--help' for what is possible"));
}

INSTANTIATE_TEST_SUITE_P(
    Global, BadCommandLineTest,
    testing::Values(
        BadLine{"nothing", {}, "which command? There are list, status"},
        BadLine{"unknown_command", {"dance"}, "there is no command 'dance'; there are list"},
        BadLine{"unknown_option", {"--loud"}, "there is no option '--loud', and no command was given"},
        BadLine{"option_of_another", {"list", "--count=1"}, "not expected: --count"},
        BadLine{"stray", {"list", "list"}, "not expected: list"},
        BadLine{"domain_high", {"--domain", "231", "list"}, "--domain: Value 231 not in range 0 to 230"},
        BadLine{"domain_text", {"list", "--domain", "x"}, "--domain: Value x not in range 0 to 230"},
        BadLine{"domain_valueless", {"list", "--domain"}, "--domain: 1 required"},
        BadLine{"domain_again", {"--domain", "1", "list", "--domain", "999"}, "--domain: Value 999 not in range 0 to 230"},
        BadLine{"interface_valueless", {"list", "--interface"}, "--interface: 1 required NAME missing"},
        BadLine{"session_valueless", {"list", "--session"}, "--session: 1 required NAME missing"},
        BadLine{"timeout_valueless", {"list", "--timeout"}, "--timeout: 1 required S missing"},
        BadLine{"timeout_nan", {"list", "--timeout", "nan"}, "'nan' is not a number from 0 to 86400"},
        BadLine{"timeout_long", {"list", "--timeout", "86401"}, "'86401' is not a number from 0 to 86400"},
        BadLine{"json_value", {"list", "--json=no"}, "json was given a disallowed flag override"}),
    [](const auto& tested) { return std::string{tested.param.name}; });

INSTANTIATE_TEST_SUITE_P(
    Control, BadCommandLineTest,
    testing::Values(BadLine{"step_countless", {"step"}, "N is required"},
                    BadLine{"step_none", {"step", "0"}, "N: Value 0 not in range 1 to 10000000"},
                    BadLine{"step_half", {"step", "1.5"}, "N: Value 1.5 not in range 1 to 10000000"},
                    BadLine{"step_negative", {"step", "-1"}, "N: Value -1 not in range 1 to 10000000"},
                    BadLine{"step_twice", {"step", "1", "2"}, "not expected: 2"},
                    BadLine{"pace_valueless", {"pace"}, "PACE is required"},
                    BadLine{"pace_word", {"pace", "fast"}, "use realtime, max or a factor from 0.0001 to 1000"},
                    BadLine{"pace_twice", {"pace", "1", "2"}, "not expected: 2"},
                    BadLine{"load_fileless", {"load"}, "FILE is required"},
                    BadLine{"lease_short", {"lease", "--seconds", "0.5"}, "'0.5' is not a number from 1 to 86400"},
                    BadLine{"watch_count", {"watch", "--count", "x"}, "--count: Value x not in range 0 to"},
                    BadLine{"watch_count_valueless", {"watch", "--count"}, "--count: 1 required"},
                    BadLine{"watch_count_twice", {"watch", "--count", "1", "--count", "2"}, "--count: At Most 1 required"},
                    BadLine{"effect_nameless", {"effect", "on"}, "NAME is required"},
                    BadLine{"effect_set_valueless", {"effect", "on", "viscosity", "--set"}, "--set: 1 required"},
                    BadLine{"effect_none", {"effect"}, "which command? There are"}),
    [](const auto& tested) { return std::string{tested.param.name}; });

INSTANTIATE_TEST_SUITE_P(
    Wounds, BadCommandLineTest,
    testing::Values(
        BadLine{"none", {"wound"}, "which command? There are add, move, set, remove"},
        BadLine{"unknown", {"wound", "open"}, "there is no command 'open'; there are add"},
        BadLine{"add_placeless", {"wound", "add", "--radius-mm", "1", "--flow-ml-per-s", "1"}, "--at is required"},
        BadLine{"add_sizeless", {"wound", "add", "--at", "0,0,0", "--flow-ml-per-s", "1"}, "--radius-mm is required"},
        BadLine{"at_words", {"wound", "add", "--at", "here"}, "'here' is not X,Y,Z: write three finite numbers with commas"},
        BadLine{"at_far", {"wound", "move", "1", "--at", "0,0,11"}, "-10 to 10"},
        BadLine{"at_twice", {"wound", "move", "1", "--at", "0,0,0", "--at", "0,0,0"}, "--at: At Most 1 required"},
        BadLine{"at_valueless", {"wound", "move", "1", "--at"}, "--at: 1 required X,Y,Z missing"},
        BadLine{"radius", {"wound", "set", "1", "--radius-mm", "0.001"}, "0.01 to 100"},
        BadLine{"flow", {"wound", "set", "1", "--flow-ml-per-s", "1001"}, "0 to 1000"},
        BadLine{"pressure", {"wound", "set", "1", "--pressure-mmhg", "-1"}, "0 to 1000"},
        BadLine{"normal", {"wound", "set", "1", "--normal", "up"}, "'up' is not X,Y,Z"},
        BadLine{"idless", {"wound", "remove"}, "ID is required"},
        BadLine{"id_empty", {"wound", "remove", ""}, "give the ID or the name of a wound"},
        BadLine{"ids", {"wound", "remove", "1", "2"}, "not expected: 2"},
        BadLine{"force_lengthless", {"force", "--at", "0,0,0"}, "--radius-mm is required"},
        BadLine{"force_strong", {"force", "--at", "0,0,0", "--radius-mm", "1", "--newtons", "8e5,8e5,0"}, "--newtons"},
        BadLine{"force_duration",
                {"force", "--at", "0,0,0", "--radius-mm", "1", "--newtons", "0,0,1", "--duration", "0"},
                "--duration"}),
    [](const auto& tested) { return std::string{tested.param.name}; });

INSTANTIATE_TEST_SUITE_P(
    Recordings, BadCommandLineTest,
    testing::Values(BadLine{"record_outless", {"record"}, "--output is required"},
                    BadLine{"record_out_valueless", {"record", "-o"}, "--output: 1 required FILE missing"},
                    BadLine{"record_out_twice", {"record", "-o", "a", "-o", "b"}, "--output: At Most 1 required"},
                    BadLine{"record_frames", {"record", "-o", "a", "--frames", "0"}, "--frames: Value 0 not in range 1"},
                    BadLine{"record_rate", {"record", "-o", "a", "--rate", "nan"}, "'nan' is not a number from"},
                    BadLine{"record_duration", {"record", "-o", "a", "--duration", "-1"}, "'-1' is not a number from"},
                    BadLine{"info_fileless", {"info"}, "FILE is required"},
                    BadLine{"info_files", {"info", "a", "b"}, "not expected: b"},
                    BadLine{"recover_outless", {"recover", "a"}, "--output is required"},
                    BadLine{"export_outless", {"export", "a"}, "--output is required"}),
    [](const auto& tested) { return std::string{tested.param.name}; });

/// Files of each kind that is neither a scene nor a recording.
class BadFile : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_ / "folder");
    write("empty", "");
    write("noise", std::string(5000, '\xa7') + std::string(5000, '\0'));
    write("huge", std::string(kMaxSceneBytes + 1, ' '));
    write("locked", "name: 'a'");
    std::filesystem::permissions(folder_ / "locked", std::filesystem::perms::none);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream{folder_ / name, std::ios::binary} << bytes;
  }
  void expect(const std::vector<std::string>& command, const std::string& file, const std::string& message) const {
    std::vector<std::string> arguments = command;
    arguments.insert(arguments.begin() + 1, (folder_ / file).string());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, kFile) << command[0] << " " << file;
    EXPECT_THAT(outcome.errors, HasSubstr(message)) << command[0] << " " << file;
    EXPECT_THAT(outcome.errors, HasSubstr(file)) << "names the file";
  }

  std::filesystem::path folder_ = std::filesystem::path{testing::TempDir()} / ("bad_files_" + std::to_string(getpid()));
};

TEST_F(BadFile, IsNoSceneToLoad) {
  expect({"load"}, "missing", "check the path and its permissions");
  expect({"load"}, "folder", "is a folder: give a .textproto scene in it");
  expect({"load"}, "empty", "is empty: give a .textproto scene");
  expect({"load"}, "huge", "is larger than 1048576 bytes: is it a scene?");
  EXPECT_EQ(run({"load", "/dev/zero"}).code, kFile) << "never ends";
  if (geteuid() != 0) expect({"load"}, "locked", "check the path and its permissions");
}

TEST_F(BadFile, IsNoRecording) {
  const std::string out = (folder_ / "out").string();
  for (const std::vector<std::string>& command :
       std::vector<std::vector<std::string>>{{"info"}, {"recover", "-o", out}, {"export", "-o", out}}) {
    expect(command, "missing", "No such file");
    expect(command, "folder", "not a regular file");
    expect(command, "empty", "is no recording: it has 0 bytes; give a file that 'bleedctl record' wrote");
    expect(command, "noise", "is no recording: it does not start as an MCAP file");
    if (geteuid() != 0) expect(command, "locked", "Permission denied");
    EXPECT_FALSE(std::filesystem::exists(out)) << command[0] << " leaves nothing behind";
  }
}

}  // namespace
}  // namespace bleedsim::bleedctl
