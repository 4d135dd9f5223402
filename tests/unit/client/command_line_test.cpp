#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "clients/bleedctl/context.h"
#include "clients/bleedctl/effect_settings.h"
#include "clients/bleedctl/json.h"

namespace bleedsim::bleedctl {
namespace {

int run(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "bleedctl");
  return runBleedctl(static_cast<int>(arguments.size()), arguments.data());
}

TEST(ParseVec3, ReadsThreeNumbers) {
  const auto parsed = parseVec3("0.01,-2e-3,+4");
  ASSERT_TRUE(parsed.ok());
  EXPECT_EQ(*parsed, (client::Vec3{0.01, -0.002, 4.0}));
}

TEST(ParseVec3, RefusesEverythingElse) {
  for (const char* text : {"", "1,2", "1,2,3,4", "1,2,", ",,", "a,b,c", "1, 2,3", "nan,0,0", "inf,0,0", "1e999,0,0", "1,2,3x"}) {
    EXPECT_FALSE(parseVec3(text).ok()) << text;
  }
}

TEST(Json, EscapesAndWritesNonFiniteAsNull) {
  EXPECT_EQ(jsonString("a\"b\\c\n"), "\"a\\\"b\\\\c\\u000a\"");
  EXPECT_EQ(jsonNumber(0.1), "0.1");
  EXPECT_EQ(jsonNumber(std::numeric_limits<double>::quiet_NaN()), "null");
  EXPECT_EQ(JsonObject{}.add("a", 1U).add("b", "x").add("c", true).text(), R"({"a": 1, "b": "x", "c": true})");
  EXPECT_EQ(JsonArray{}.raw("1").raw("{}").text(), "[1, {}]");
}

TEST(EffectSettings, AreReadFromNormalisedText) {
  const auto settings = effectSettings(
      "name: \"effects {\"\neffects {\n  gravity {\n    acceleration_m_per_s2 {\n      z: -9.81\n    }\n  }\n  pressure {\n  }\n"
      "  viscosity {\n    viscosity_pa_s: 0.01\n    solve: EXPLICIT\n  }\n  auto: \"platelets\"\n}\ntissue {\n  plane {\n  "
      "}\n}\n");
  ASSERT_EQ(settings.size(), 3U);
  EXPECT_EQ(settings.at("gravity"), "acceleration_m_per_s2 { z: -9.81 }");
  EXPECT_EQ(settings.at("pressure"), "");
  EXPECT_EQ(settings.at("viscosity"), "viscosity_pa_s: 0.01 solve: EXPLICIT");
  EXPECT_TRUE(effectSettings("").empty());
  EXPECT_TRUE(effectSettings("# no scene").empty());
}

TEST(CommandLine, AnswersWrongUseWithCodeTwo) {
  EXPECT_EQ(run({}), 2);
  EXPECT_EQ(run({"dance"}), 2);
  EXPECT_EQ(run({"status", "--loud"}), 2);
  EXPECT_EQ(run({"--domain", "231", "list"}), 2);
  EXPECT_EQ(run({"wound"}), 2);
  EXPECT_EQ(run({"wound", "add", "--at", "1,2", "--radius-mm", "3", "--flow-ml-per-s", "1"}), 2);
  EXPECT_EQ(run({"wound", "add", "--at", "1,2,3", "--radius-mm", "3"}), 2);
  EXPECT_EQ(run({"wound", "add", "--at", "0,0,0", "--radius-mm", "nan", "--flow-ml-per-s", "1"}), 2);
  EXPECT_EQ(run({"wound", "set", "4"}), 2);
  EXPECT_EQ(run({"pace", "fast"}), 2);
  EXPECT_EQ(run({"record", "-o", "a.mcap", "--compress", "gzip"}), 2);
  EXPECT_EQ(run({"record", "-o", "a.mcap", "--quantize", "12"}), 2);
  EXPECT_EQ(run({"export", "a.mcap"}), 2);
  EXPECT_EQ(run({"export", "a.mcap", "-o", "b", "--every", "0"}), 2);
  EXPECT_EQ(run({"export", "a.mcap", "-o", "b", "--format", "obj"}), 2);
  EXPECT_EQ(run({"render", "a.mcap", "-o", "b.png", "--size", "big"}), 2);
  EXPECT_EQ(run({"pace", "-1"}), 2);
  EXPECT_EQ(run({"pace", "1001"}), 2);
  EXPECT_EQ(run({"pace", "0.00001"}), 2);
  EXPECT_EQ(run({"step", "0"}), 2);
  EXPECT_EQ(run({"step", "10000001"}), 2);
  EXPECT_EQ(run({"watch", "--count", "-1"}), 2);
  EXPECT_EQ(run({"effect"}), 2);
  EXPECT_EQ(run({"effect", "on"}), 2);
  EXPECT_EQ(run({"effect", "off", "viscosity", "--set", "viscosity_pa_s: 1"}), 2);
}

TEST(CommandLine, NoFloatingOptionTakesAnythingButFiniteNumbers) {
  for (const char* value : {"nan", "-nan", "inf", "-inf", "1e999", "", "x"}) {
    EXPECT_EQ(run({"--timeout", value, "list"}), 2) << value;
    EXPECT_EQ(run({"record", "-o", "/nosuch/file", "--duration", value}), 2) << value;
    EXPECT_EQ(run({"record", "-o", "/nosuch/file", "--rate", value}), 2) << value;
    EXPECT_EQ(run({"pace", value}), 2) << value;
    EXPECT_EQ(run({"wound", "add", "--at", "0,0,0", "--radius-mm", value, "--flow-ml-per-s", "1"}), 2) << value;
    EXPECT_EQ(run({"wound", "add", "--at", "0,0,0", "--radius-mm", "1", "--flow-ml-per-s", value}), 2) << value;
    EXPECT_EQ(run({"wound", "add", "--at", "0,0,0", "--radius-mm", "1", "--pressure-mmhg", value}), 2) << value;
    EXPECT_EQ(run({"wound", "set", "1", "--radius-mm", value}), 2) << value;
    EXPECT_EQ(run({"wound", "set", "1", "--flow-ml-per-s", value}), 2) << value;
    EXPECT_EQ(run({"wound", "set", "1", "--pressure-mmhg", value}), 2) << value;
    EXPECT_EQ(run({"force", "--at", "0,0,0", "--radius-mm", value, "--newtons", "0,0,1"}), 2) << value;
    EXPECT_EQ(run({"force", "--at", "0,0,0", "--radius-mm", "1", "--newtons", "0,0,1", "--duration", value}), 2) << value;
  }
}

TEST(CommandLine, TellsOfRangesBeforeItSends) {
  const std::vector<const char*> add{"wound", "add", "--at", "0,0,0", "--radius-mm", "3", "--flow-ml-per-s", "1"};
  const auto with = [&add](std::size_t at, const char* value) {
    std::vector<const char*> arguments = add;
    arguments[at] = value;
    return run(arguments);
  };
  EXPECT_EQ(with(3, "0,10.1,0"), 2);
  EXPECT_EQ(with(5, "0.009"), 2);
  EXPECT_EQ(with(5, "101"), 2);
  EXPECT_EQ(with(7, "-0.1"), 2);
  EXPECT_EQ(with(7, "1001"), 2);
  EXPECT_EQ(run({"wound", "set", "1", "--pressure-mmhg", "1001"}), 2);
  EXPECT_EQ(run({"wound", "move", "1", "--at", "-11,0,0"}), 2);
  EXPECT_EQ(run({"force", "--at", "0,0,0", "--radius-mm", "10001", "--newtons", "0,0,1"}), 2);
  EXPECT_EQ(run({"force", "--at", "0,0,0", "--radius-mm", "1", "--newtons", "8e5,8e5,0"}), 2);
  EXPECT_EQ(run({"force", "--at", "0,0,0", "--radius-mm", "1", "--newtons", "0,0,1", "--duration", "0"}), 2);
}

TEST(CommandLine, HelpAndVersionSucceedForEveryCommand) {
  EXPECT_EQ(run({"--help"}), 0);
  EXPECT_EQ(run({"--version"}), 0);
  for (const char* command : {"list", "status", "watch", "pause", "resume", "reset", "step", "pace", "load", "shutdown", "force",
                              "record", "info", "export"}) {
    EXPECT_EQ(run({command, "--help"}), 0) << command;
  }
  for (const char* command : {"add", "move", "set", "remove"}) EXPECT_EQ(run({"wound", command, "--help"}), 0) << command;
  for (const char* command : {"list", "on", "off"}) EXPECT_EQ(run({"effect", command, "--help"}), 0) << command;
}

TEST(CommandLine, AMissingInterfaceOrFileHasItsOwnCode) {
  EXPECT_EQ(run({"list", "--interface", "nosuch0"}), 2);
  EXPECT_EQ(run({"--interface", "nosuch0", "list"}), 2);
  EXPECT_EQ(run({"load", "/nosuch/scene.textproto"}), 4);
}

}  // namespace
}  // namespace bleedsim::bleedctl
