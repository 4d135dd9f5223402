#include "service/daemon/inspect.h"

#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <sstream>

#include "service/sph/world.h"

namespace bleedsim::daemon {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// The lines of each row, by the effect's name; warnings and decisions are no rows.
std::map<std::string, std::string> rowsOf(const std::string& list) {
  std::map<std::string, std::string> rows;
  std::istringstream lines{list};
  std::string name;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("warning: ") || line.starts_with("auto: ")) continue;
    if (!line.starts_with(" ")) {
      std::istringstream words{line};
      std::string state;
      words >> state >> name;
    }
    rows[name] += line + "\n";
  }
  return rows;
}

scene::SceneDescription described(const std::string& effects, const std::string& more = {}) {
  Result<scene::SceneDescription> scene = scene::parseScene(
      "domain { lower_m {} upper_m { x: 0.1 y: 0.1 z: 0.1 } capacity: 2000 } resolution { spacing_m: 0.002 }"
      "compressibility { design_speed_m_per_s: 0.3 } effects { " +
      effects + " }" + more);
  EXPECT_TRUE(scene.ok()) << scene.status().message();
  return *scene;
}

TEST(ListEffects, EachRowHasStateEquationSourceAndDeviation) {
  const auto rows = rowsOf(listEffects(nullptr, false));
  EXPECT_EQ(rows.size(), sph::effectCatalog().size());
  const auto row = [&rows](const std::string& name) { return rows.contains(name) ? rows.at(name) : std::string{"no row"}; };
  const auto has = [](auto... parts) { return AllOf(StartsWith("available  "), HasSubstr("source: "), HasSubstr(parts)...); };
  EXPECT_THAT(row("gravity"), has("F of (9)", "closing_kick.h", "deviation: none"));
  EXPECT_THAT(row("pressure"),
              has("(18)", "Monaghan 1992", "p = k rho of (18)", "never negative", "mass of a particle is calibrated"));
  EXPECT_THAT(row("viscosity"), has("(25)", "Brookshaw", "Laplacian of (33)", "implicit"));
  EXPECT_THAT(row("platelets"), has("(26)(27)", "sinks by activation, tissue and air"));
  EXPECT_THAT(row("core_radius"), has("(34)", "Hernquist", "bounded"));
  EXPECT_THAT(row("repulsion"), has("(35)(36)", "damped"));
  EXPECT_THAT(row("surface_tension"),
              has("(21)-(23)", "Morris 2000", "1.56", "0.2 h sqrt(sigma/(rho0 h))", "|kappa| h <= 2", "ramp"));
  EXPECT_THAT(row("adhesion"), has("not in the paper as a formula"));
  EXPECT_THAT(row("applied_force"), has("not in the paper"));
  EXPECT_THAT(row("wetting"), has("Breinlinger 2013", "contact_angle_deg"));
  EXPECT_THAT(row("slip"), has("wall_combination.h", "tissue.slip"));
}

TEST(ListEffects, EachSourceNamesAFileThatExists) {
  for (const sph::EffectInfo& effect : sph::effectCatalog()) {
    const std::size_t at = effect.source.find("service/");
    ASSERT_NE(at, std::string_view::npos) << effect.name;
    const std::string path = std::string{BLEEDSIM_SOURCE_DIR} + "/" + std::string{effect.source.substr(at)};
    EXPECT_TRUE(std::ifstream{path}.good()) << path;
  }
}

TEST(ListEffects, WithASceneEachIsOnOrOff) {
  const std::string every =
      "gravity {} pressure {} viscosity {} applied_force {} surface_tension { contact_angle_deg: 60 } platelets {} core_radius "
      "{} "
      "repulsion {} adhesion {}";
  const scene::SceneDescription full = described(every, " tissue { plane { normal { z: 1 } } slip: 0.5 }");
  for (const auto& [name, row] : rowsOf(listEffects(&full, false))) { EXPECT_THAT(row, StartsWith("on ")) << name; }
  const scene::SceneDescription none = described("");
  for (const auto& [name, row] : rowsOf(listEffects(&none, false))) EXPECT_THAT(row, StartsWith("off ")) << name;
  EXPECT_THAT(listEffects(&full, true), Not(HasSubstr("\"state\": \"off\"")));
  EXPECT_THAT(listEffects(&none, true), Not(HasSubstr("\"state\": \"on\"")));
  EXPECT_THAT(listEffects(nullptr, true), HasSubstr("\"state\": \"available\""));
}

TEST(ListEffects, TellsDecisionsAndWarningsInBothForms) {
  const scene::SceneDescription scene =
      described("surface_tension {} viscosity {} auto: 'surface_tension' auto: 'implicit_viscosity'");
  for (const bool json : {false, true}) {
    const std::string list = listEffects(&scene, json);
    EXPECT_THAT(list, HasSubstr("auto: surface_tension on: without gravity"));
    EXPECT_THAT(list, HasSubstr("auto: implicit_viscosity off: the explicit limit"));
    EXPECT_THAT(list, HasSubstr("drops boil at support_ratio 2"));
  }
  EXPECT_THAT(listEffects(&scene, true), AllOf(StartsWith("{\"effects\": [{\"name\": \"gravity\""),
                                               HasSubstr("\"decisions\": [\"auto"), HasSubstr("\"warnings\": [\"warning")));
  EXPECT_THAT(listEffects(nullptr, true), HasSubstr("\"decisions\": [], \"warnings\": []}"));
}

TEST(DescribeWorld, TellsWarnings) {
  auto scene = std::make_shared<const scene::SceneDescription>(described("surface_tension {}"));
  const Result<LoadedScene> loaded = worldFactory({})({{}, scene});
  ASSERT_TRUE(loaded.ok()) << loaded.status().message();
  EXPECT_THAT(describeWorld(*loaded), AllOf(HasSubstr("is valid"), HasSubstr("warning: surface_tension")));
}

}  // namespace
}  // namespace bleedsim::daemon
