// The scenes of the paper's experiments say why each number stands in them.
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <string>
#include <vector>

#include "service/lab/paper/claims.h"
#include "service/lab/paper/paper_scene.h"

namespace bleedsim::lab {
namespace {

std::vector<std::filesystem::path> paperScenes() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator{PAPER_SCENE_DIR}) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// The line without its comment and its texts.
std::string codeOf(const std::string& line) {
  std::string code;
  bool text = false;
  for (const char c : line) {
    if (c == '#' && !text) break;
    if (c == '"') text = !text;
    if (!text) code += c;
  }
  return code;
}

/// Whether a number stands in the code: a digit that belongs to no name.
bool hasNumber(const std::string& code) {
  bool name = false;
  for (const char c : code) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalpha(letter) != 0 || c == '_')
      name = true;
    else if (std::isdigit(letter) == 0)
      name = false;
    else if (!name)
      return true;
  }
  return false;
}

std::string fieldOf(const std::string& code) {
  const auto first = code.find_first_not_of(' ');
  return first == std::string::npos ? "" : code.substr(first, code.find_first_of(" :{", first) - first);
}

/// Numbers of the lines with a number and without a comment on them, right above them, or on the first of a run of the same
/// field.
std::vector<int> unexplained(std::istream& text) {
  std::vector<int> lines;
  std::string line;
  std::string field;  // that the line before explains
  bool above = false;
  for (int number = 1; std::getline(text, line); ++number) {
    const std::string code = codeOf(line);
    const bool comment = line.size() > code.size();
    const bool explained = comment || above || (!field.empty() && fieldOf(code) == field);
    if (hasNumber(code) && !explained) lines.push_back(number);
    field = hasNumber(code) && explained ? fieldOf(code) : "";
    above = comment && code.find_first_not_of(' ') == std::string::npos;
  }
  return lines;
}

TEST(PaperScenes, TheCheckFindsWhatIsNotExplained) {
  std::istringstream text{
      "# why\n"
      "a_1: 2\n"
      "b: 3\n"
      "c: 4  # why\n"
      "c: 5\n"
      "d: \"6 # 7\"\n"
      "e_2 { x: -.5 }\n"};
  EXPECT_EQ(unexplained(text), (std::vector<int>{3, 7}));
}

TEST(PaperScenes, ExplainEveryNumber) {
  const auto files = paperScenes();
  ASSERT_GE(files.size(), 11u);
  for (const std::filesystem::path& file : files) {
    std::ifstream text{file};
    for (const int line : unexplained(text))
      ADD_FAILURE() << file.filename().string() << ':' << line << " has a number without a comment on the line or above it";
  }
}

TEST(PaperScenes, GiveTheRunsTheirLength) {
  PaperOptions options;
  options.scenes = PAPER_SCENE_DIR;
  for (const char* name : {"fig5", "fig5_literal", "fig6", "fig8"}) {
    const auto scene = loadPaperScene(options, name);
    ASSERT_TRUE(scene.ok()) << scene.status().message();
    const auto particles = particlesOf(*scene);
    ASSERT_TRUE(particles.ok()) << particles.status().message();
    EXPECT_EQ(*particles, 20000u) << name << ": the paper's number";
  }
  for (const char* name : {"fig2", "fig2_literal"}) {
    const auto scene = loadPaperScene(options, name);
    ASSERT_TRUE(scene.ok()) << scene.status().message();
    EXPECT_EQ(scene->horizon, 15.0) << name << ": the paper's time";
  }
}

TEST(PaperScenes, WithoutALengthAreRefusedByName) {
  scene::SceneDescription scene;
  scene.name = "endless";
  const auto particles = particlesOf(scene);
  ASSERT_FALSE(particles.ok());
  EXPECT_NE(particles.status().message().find("'endless' needs horizon_s"), std::string::npos) << particles.status().message();
}

TEST(KernelCubeOf, ReadsTheScene) {
  PaperOptions options;
  options.scenes = PAPER_SCENE_DIR;
  auto scene = loadPaperScene(options, "claims_kernels");
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  const auto cube = kernelCubeOf(*scene);
  ASSERT_TRUE(cube.ok()) << cube.status().message();
  EXPECT_EQ(cube->side, 6);
  EXPECT_EQ(cube->steps, 400);
  EXPECT_NEAR(cube->dt, 0.1, 1e-6);
  scene->world.domain.periodic[1] = false;
  EXPECT_FALSE(kernelCubeOf(*scene).ok());
}

}  // namespace
}  // namespace bleedsim::lab
