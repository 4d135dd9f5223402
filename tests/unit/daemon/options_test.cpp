#include "service/daemon/options.h"

#include <cstdlib>
#include <gtest/gtest.h>
#include <vector>

namespace bleedsim::daemon {
namespace {

std::variant<Options, ExitCode> parse(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "bleedd");
  return parseOptions(static_cast<int>(arguments.size()), arguments.data());
}

TEST(Options, HaveDefaults) {
  const auto parsed = parse({"--scene", "a.textproto"});
  const auto* options = std::get_if<Options>(&parsed);
  ASSERT_NE(options, nullptr);
  EXPECT_EQ(options->scene, "a.textproto");
  EXPECT_EQ(options->session, "bleed");
  EXPECT_EQ(options->domain, 0U);
  EXPECT_EQ(options->pace.mode, dds::PaceMode::real_time);
  EXPECT_FALSE(options->frame_rate || options->duration);
  EXPECT_EQ(options->log.level, "info");
  EXPECT_FALSE(options->log.file);
  EXPECT_GE(options->world.threads, 1);
}

TEST(Options, AreRead) {
  const auto parsed =
      parse({"--scene",    "a",    "--session",    "OR_1",        "--domain",  "9",          "--interface", "eth7",
             "--pace",     "0.25", "--frame-rate", "30",          "--threads", "2",          "--simd",      "scalar",
             "--duration", "5",    "--check",      "--log-level", "debug",     "--log-file", "bleedd.log"});
  const auto* options = std::get_if<Options>(&parsed);
  ASSERT_NE(options, nullptr);
  EXPECT_EQ(options->session, "OR_1");
  EXPECT_EQ(options->domain, 9U);
  EXPECT_EQ(options->interface, "eth7");
  EXPECT_EQ(options->pace.mode, dds::PaceMode::factor);
  EXPECT_EQ(options->pace.factor, 0.25);
  EXPECT_EQ(options->frame_rate, 30.0);
  EXPECT_EQ(options->duration, 5.0);
  EXPECT_EQ(options->world.threads, 2);
  EXPECT_EQ(options->world.simd, sph::SimdTarget::scalar);
  EXPECT_TRUE(options->check);
  EXPECT_EQ(options->log.level, "debug");
  EXPECT_EQ(options->log.file, "bleedd.log");
}

TEST(Options, SayWhereCheckpointsAre) {
  const auto folder_of = [](std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), {"--scene", "a", "--session", "OR_1"});
    const auto parsed = parse(arguments);
    return std::get<Options>(parsed).checkpoint_folder;
  };
  setenv("STATE_DIRECTORY", "/var/lib/bleedsim:/other", 1);
  EXPECT_FALSE(folder_of({}));
  EXPECT_EQ(folder_of({"--checkpoint-dir", "/data"}), "/data/OR_1");
  EXPECT_EQ(folder_of({"--checkpoint-every", "2.5"}), "/var/lib/bleedsim/OR_1");
  unsetenv("STATE_DIRECTORY");
  setenv("XDG_STATE_HOME", "/state", 1);
  EXPECT_EQ(folder_of({"--resume"}), "/state/bleedsim/OR_1");
  unsetenv("XDG_STATE_HOME");
  setenv("HOME", "/home/me", 1);
  EXPECT_EQ(folder_of({"--resume"}), "/home/me/.local/state/bleedsim/OR_1");
  const auto parsed = parse({"--scene", "a", "--checkpoint-every", "2.5", "--checkpoint-dir", "b", "--resume"});
  EXPECT_EQ(std::get<Options>(parsed).checkpoint_every, 2.5);
  EXPECT_TRUE(std::get<Options>(parsed).resume);
}

TEST(Options, WrongOnesAreUsageErrors) {
  const std::vector<std::vector<const char*>> wrong{
      {},
      {"--scene"},
      {"--scene", "a", "--session", "with space"},
      {"--scene", "a", "--session", "*"},
      {"--scene", "a", "--domain", "500"},
      {"--scene", "a", "--pace", "fast"},
      {"--scene", "a", "--log-level", "loud"},
      {"--scene", "a", "--log-file"},
      {"--scene", "a", "--pace", "0"},
      {"--scene", "a", "--pace", "nan"},
      {"--scene", "a", "--frame-rate", "0"},
      {"--scene", "a", "--frame-rate", "0.5"},
      {"--scene", "a", "--frame-rate", "1001"},
      {"--scene", "a", "--frame-rate", "nan"},
      {"--scene", "a", "--frame-rate", "inf"},
      {"--scene", "a", "--pace", "inf"},
      {"--scene", "a", "--duration", "nan"},
      {"--scene", "a", "--duration", "inf"},
      {"--scene", "a", "--duration", "1e999"},
      {"--scene", "a", "--threads", "0"},
      {"--scene", "a", "--threads", "65"},
      {"--scene", "a", "--simd", "mmx"},
      {"--scene", "a", "--duration", "-1"},
      {"--scene", "a", "--unknown"},
  };
  for (const std::vector<const char*>& arguments : wrong) {
    const auto parsed = parse(arguments);
    const auto* code = std::get_if<ExitCode>(&parsed);
    ASSERT_NE(code, nullptr) << testing::PrintToString(arguments);
    EXPECT_EQ(*code, ExitCode::usage);
  }
}

TEST(Options, HelpVersionAndEffectsNeedNoScene) {
  EXPECT_EQ(std::get<ExitCode>(parse({"--help"})), ExitCode::ok);
  EXPECT_EQ(std::get<ExitCode>(parse({"--version"})), ExitCode::ok);
  EXPECT_TRUE(std::get<Options>(parse({"--list-effects"})).list_effects);
}

}  // namespace
}  // namespace bleedsim::daemon
