// bleedlab as a program: small runs of every experiment, its JSON and its files. Figures are not judged here; that they are
// there, finite and consistent is.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "tests/support/child_process.h"

namespace bleedsim::lab_test {
namespace {

using Json = nlohmann::json;

/// A folder of its own, gone with the test.
class Folder {
 public:
  explicit Folder(const std::string& name)
      : path_{std::filesystem::path{testing::TempDir()} / ("bleedlab_" + name + "_" + std::to_string(getpid()))} {
    std::filesystem::remove_all(path_);
  }
  ~Folder() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string text() const { return path_.string(); }
  bool has(const std::string& file) const {
    return std::filesystem::exists(path_ / file) && std::filesystem::file_size(path_ / file) > 0;
  }

 private:
  std::filesystem::path path_;
};

/// stdout of a run that must succeed, as JSON: it must hold one object and nothing else.
Json runJson(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), BLEEDLAB_PATH);
  arguments.push_back("--json");
  const test::Finished finished = test::runProcess(arguments, false);
  EXPECT_EQ(finished.code, 0) << finished.output;
  Json json = Json::parse(finished.output, nullptr, false);
  EXPECT_TRUE(json.is_object()) << finished.output;
  return json;
}

std::vector<std::string> paper(const std::string& name, std::vector<std::string> more) {
  std::vector<std::string> arguments{"paper", name, "--scenes", std::string{SCENE_DIR} + "/paper"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

bool isVerdict(const Json& json) { return json == "holds" || json == "does not" || json == "depends"; }

TEST(PaperCommands, Table2HasARowForEachCountAndSearch) {
  const Folder folder{"table2"};
  const Json json = runJson(paper("table2", {"--counts", "1000,2000", "--seconds", "0.2", "-o", folder.text()}));
  ASSERT_EQ(json["rows"].size(), 4u);
  for (const Json& row : json["rows"]) {
    EXPECT_TRUE(row["particles"] == 1000 || row["particles"] == 2000);
    EXPECT_TRUE(row["search"] == "mesh" || row["search"] == "complete");
    EXPECT_GT(row["frames_per_s"].get<double>(), 0.0);
    EXPECT_LE(row["frames_per_s_median"].get<double>(), row["frames_per_s"].get<double>()) << "the fastest quarter is faster";
    EXPECT_GE(row["frames_per_s_scatter"].get<double>(), 0.0);
    EXPECT_EQ(row["reaches_20_frames_per_s"].get<bool>(), row["frames_per_s"].get<double>() >= 20.0);
    EXPECT_TRUE(row["paper_frames_per_s"].is_null()) << "the paper has other counts";
  }
  ASSERT_EQ(json["fits"].size(), 2u);
  EXPECT_LT(json["fits"][1]["ours"]["exponent"].get<double>(), 0.0);
  EXPECT_TRUE(json["fits"][1]["ours"]["standard_error"].is_null()) << "of two counts";
  EXPECT_TRUE(json["fits"][1]["paper"]["standard_error"].is_number());
  EXPECT_TRUE(folder.has("table2.csv"));
  EXPECT_TRUE(folder.has("table2.json"));
  EXPECT_TRUE(folder.has("table2.txt"));
}

void expectFig5(const std::string& model) {
  const Folder folder{"fig5_" + model};
  const Json json = runJson(paper("fig5", {"--particles", "300", "--model", model, "-o", folder.text()}));
  ASSERT_EQ(json["runs"].size(), 6u);
  int with_figures = 0;
  for (const Json& run : json["runs"]) {
    EXPECT_EQ(run["model"], model);
    if (!run.contains("figures")) continue;
    ++with_figures;
    EXPECT_GE(run["emitted"].get<int>(), 300);
    for (const auto& [name, figure] : run["figures"].items()) {
      EXPECT_TRUE(std::isfinite(figure["value"].get<double>())) << name;
      EXPECT_GE(figure["scatter"].get<double>(), 0.0) << name;
    }
    EXPECT_GT(run["figures"]["area_m2"]["value"].get<double>(), 0.0);
    EXPECT_GT(run["figures"]["nearest_m"]["value"].get<double>(), 0.0);
  }
  EXPECT_EQ(with_figures, 6);
  EXPECT_EQ(json["claims"].size(), 15u);
  for (const Json& claim : json["claims"]) EXPECT_TRUE(isVerdict(claim["verdict"])) << claim.dump();
  EXPECT_TRUE(folder.has("fig5_" + model + ".png"));
  EXPECT_TRUE(folder.has("fig5_profile_" + model + ".csv"));
}

TEST(PaperCommands, Fig5SoundHasSixRunsAndAVerdictForEachSentence) { expectFig5("sound"); }
TEST(PaperCommands, Fig5LiteralHasSixRunsAndAVerdictForEachSentence) { expectFig5("literal"); }

TEST(PaperCommands, Fig5DoesNotDependOnTheNumberOfThreads) {
  const std::vector<std::string> options{"--particles", "100", "--model", "sound", "--threads"};
  const auto with = [&](const char* threads) {
    std::vector<std::string> all = options;
    all.emplace_back(threads);
    return runJson(paper("fig5", all));
  };
  EXPECT_EQ(with("1"), with("3"));
}

void expectGrowth(const std::string& name) {
  const Folder folder{name};
  const Json json = runJson(paper(name, {"--particles", "500", "-o", folder.text()}));
  ASSERT_EQ(json["points"].size(), 24u);
  double time = 0.0;
  for (const Json& point : json["points"]) {
    EXPECT_GT(point["time_s"].get<double>(), time);
    time = point["time_s"].get<double>();
    EXPECT_EQ(point.contains("covered_part"), name == "fig8");
  }
  EXPECT_GE(json["points"].back()["particles"].get<int>(), 500);
  EXPECT_GT(json["points"].back()["area_m2"].get<double>(), json["points"].front()["area_m2"].get<double>());
  EXPECT_TRUE(folder.has(name + ".png"));
  EXPECT_TRUE(folder.has(name + "_area.csv"));
}

TEST(PaperCommands, Fig6Grows) { expectGrowth("fig6"); }
TEST(PaperCommands, Fig8GrowsAndTellsWhatIsCovered) { expectGrowth("fig8"); }

TEST(PaperCommands, Fig2HasFourRunsInEachModel) {
  const Folder folder{"fig2"};
  const Json json = runJson(paper("fig2", {"--duration", "0.4", "-o", folder.text()}));
  ASSERT_EQ(json["runs"].size(), 8u);
  std::map<std::string, double> overlap;
  for (const Json& run : json["runs"]) {
    EXPECT_EQ(run["failure"], "");
    EXPECT_EQ(run["seeds"], json["seeds"]);
    const Json& figures = run["figures"];
    const bool intruders = run["intruders"].get<bool>();
    // Intruders at 1 m/s are within the block from 54 to 180 ms; they run for as long again, to 306 ms.
    EXPECT_NEAR(run["time_s"].get<double>(), intruders ? 0.306 : 0.4, 0.001);
    // Rounding of 0.3 s of steps in float: 1e-6 of the momentum a step, 600 steps.
    EXPECT_LT(figures["momentum_drift"]["value"].get<double>(), 1e-3) << run.dump();
    EXPECT_EQ(figures["intruders_moved_m"]["value"].get<double>() > 0.0, intruders);
    EXPECT_GT(figures["edge_moved_m"]["scatter"].get<double>(), 0.0) << "seeds differ";
    if (!intruders) continue;
    EXPECT_GE(figures["overlap_time_s"]["value"].get<double>(), 0.054);
    EXPECT_LE(figures["overlap_time_s"]["value"].get<double>(), 0.181);
    overlap[run["model"].get<std::string>() + (run["repulsion"].get<bool>() ? " with" : " without")] =
        figures["overlap_m2"]["value"].get<double>();
  }
  // Three discs of 3 mm radius cannot share more than their own area.
  for (const auto& [name, area] : overlap) EXPECT_LE(area, 3.0 * 28.3e-6 * 1.02) << name;
  EXPECT_GT(overlap["sound without"], overlap["sound with"]);
  EXPECT_GT(overlap["literal without"], overlap["literal with"]);
  EXPECT_EQ(json["claims"].size(), 6u);
  EXPECT_TRUE(folder.has("fig2_sound.png"));
  EXPECT_TRUE(folder.has("fig2_literal.png"));
}

TEST(PaperCommands, ClaimsHaveNumbersAndVerdicts) {
  const Json json = runJson(paper("claims", {"--counts", "1000,2000", "--seconds", "0.2"}));
  EXPECT_EQ(json["claims"].size(), 9u);
  for (const Json& claim : json["claims"]) {
    EXPECT_TRUE(isVerdict(claim["verdict"])) << claim.dump();
    ASSERT_FALSE(claim["evidence"].empty()) << claim.dump();
    for (const Json& evidence : claim["evidence"])
      EXPECT_TRUE(evidence["without"]["value"].is_number()) << claim["sentence"] << ' ' << evidence.dump();
  }
}

TEST(EffectsCommand, MeasuresEveryEffect) {
  const Json json =
      runJson({"effects", std::string{SCENE_DIR} + "/paper/table2.textproto", "--particles", "1000", "--seconds", "0.01"});
  EXPECT_EQ(json["effects"].size(), 9u);
  for (const Json& effect : json["effects"]) {
    EXPECT_FALSE(effect.contains("refusal")) << effect.dump();
    EXPECT_GE(effect["alone"]["added_us_scatter"].get<double>(), 0.0);
    EXPECT_TRUE(effect["alone"]["added_us_above_noise"].is_boolean());
  }
  EXPECT_GT(json["all"]["us_per_particle_step"].get<double>(), 0.0);
}

TEST(EffectsCommand, NamesWhatAutoLeftOut) {
  const Folder folder{"auto"};
  std::filesystem::create_directories(folder.text());
  const std::string scene = folder.text() + "/auto.textproto";
  // A block of 40 mm is far above three capillary lengths.
  std::ofstream{scene} << R"(
    domain { lower_m { x: -0.1 y: -0.1 z: -0.1 } upper_m { x: 0.1 y: 0.1 z: 0.1 } capacity: 2000 }
    resolution { spacing_m: 0.004 }
    compressibility { design_speed_m_per_s: 0.3 }
    effects { gravity {} pressure {} surface_tension {} auto: "surface_tension" }
    fluid_blocks { lower_m { z: 0.0 } upper_m { x: 0.04 y: 0.04 z: 0.04 } })";
  const Json json = runJson({"effects", scene, "--particles", "1000", "--seconds", "0.01"});
  for (const Json& effect : json["effects"]) {
    EXPECT_EQ(effect.contains("left_out_by_auto"), effect["name"] == "surface_tension") << effect.dump();
    if (effect["name"] == "surface_tension") { EXPECT_FALSE(effect["in_scene"].get<bool>()); }
  }
}

}  // namespace
}  // namespace bleedsim::lab_test
