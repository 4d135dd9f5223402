// The direction of the architecture: every include of service/ and clients/ against the layers' table.
#include "tests/unit/architecture/include_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/architecture/source_tree.h"

namespace bleedsim::tests {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

LayerTable tableOfTheBuild() {
  std::string text;
  for (const SourceFile& file : readFiles(sourceRoot(), {"config/cmake"})) {
    if (file.path != "config/cmake/Layers.cmake") continue;
    for (const std::string& line : file.lines) text += line + "\n";
  }
  return parseLayerTable(text);
}

std::string problem(const std::string& path, const std::string& line) {
  const std::optional<Include> include = parseInclude(line);
  return include ? problemOf(path, *include, tableOfTheBuild()) : "not an include";
}

TEST(IncludeRules, readsBothFormsOfInclude) {
  const auto quoted = parseInclude("  #  include \"service/sph/world.h\"  // why");
  ASSERT_TRUE(quoted);
  EXPECT_EQ(quoted->target, "service/sph/world.h");
  EXPECT_TRUE(quoted->quoted);
  const auto angled = parseInclude("#include <dds/dds.h>");
  ASSERT_TRUE(angled);
  EXPECT_EQ(angled->target, "dds/dds.h");
  EXPECT_FALSE(angled->quoted);
  for (const char* line : {"", "// #include <vector>", "#if 1", "#include HWY_TARGET_INCLUDE", "#include <vector"}) {
    EXPECT_FALSE(parseInclude(line)) << line;
  }
}

TEST(IncludeRules, readsTheTable) {
  const LayerTable table = parseLayerTable("set(BLEEDSIM_MAY_a)\nset(other b)\nset(BLEEDSIM_MAY_b a\n    c)\n");
  ASSERT_EQ(table.size(), 2U);
  EXPECT_THAT(table.at("a"), IsEmpty());
  EXPECT_THAT(table.at("b"), UnorderedElementsAre("a", "c"));
}

// Says the borders a second time, so that the table cannot be widened in passing.
TEST(IncludeRules, theTableKeepsTheBorders) {
  const LayerTable table = tableOfTheBuild();
  ASSERT_TRUE(table.contains("sph") && table.contains("client") && table.contains("daemon"));
  EXPECT_THAT(table.at("status"), IsEmpty());
  EXPECT_THAT(table.at("idl"), IsEmpty());
  EXPECT_THAT(table.at("sph"), UnorderedElementsAre("status"));
  for (const char* hidden : {"sph", "scene", "dds", "daemon"}) EXPECT_FALSE(table.at("client").contains(hidden)) << hidden;
  for (const char* layer : {"transport", "recording"}) {
    for (const char* hidden : {"sph", "scene", "dds", "daemon", "client"}) {
      EXPECT_FALSE(table.at(layer).contains(hidden)) << layer << " -> " << hidden;
    }
  }
  for (const auto& [layer, others] : table) {
    EXPECT_FALSE(others.contains("client")) << layer;
    EXPECT_FALSE(others.contains("daemon")) << layer;
  }
}

TEST(IncludeRules, refuseWhatIsForbidden) {
  EXPECT_THAT(problem("service/sph/world.cpp", "#include \"idl/bleed.h\""), HasSubstr("must not use layer 'idl'"));
  EXPECT_THAT(problem("service/sph/world.cpp", "#include <dds/dds.h>"), HasSubstr("must not use dds/"));
  EXPECT_THAT(problem("service/sph/wound/throat.cpp", "#include <google/protobuf/message.h>"), HasSubstr("must not use"));
  EXPECT_THAT(problem("service/sph/world.cpp", "#include <fmt/core.h>"), HasSubstr("must not use fmt/"));
  EXPECT_THAT(problem("service/scene/scene.h", "#include \"service/transport/qos.h\""), HasSubstr("layer 'transport'"));
  EXPECT_THAT(problem("service/picture/splat.cpp", "#include \"service/sph/world.h\""), HasSubstr("layer 'sph'"));
  EXPECT_THAT(problem("service/picture/splat.cpp", "#include <google/protobuf/message.h>"), HasSubstr("must not use"));
  EXPECT_THAT(problem("service/daemon/program.cpp", "#include <png.h>"), HasSubstr("must not use png"));
  EXPECT_THAT(problem("clients/lib/client.cpp", "#include \"service/sph/world.h\""), HasSubstr("layer 'sph'"));
  EXPECT_THAT(problem("clients/bleedctl/app.cpp", "#include \"service/daemon/options.h\""), HasSubstr("layer 'daemon'"));
  EXPECT_THAT(problem("clients/lib/include/bleedsim/frame.h", "#include \"idl/bleed.h\""), HasSubstr("public header"));
  EXPECT_THAT(problem("clients/examples/front_end.cpp", "#include \"service/status/status.h\""), HasSubstr("installed"));
  EXPECT_THAT(problem("service/daemon/main.cpp", "#include \"tests/support/scenes.h\""), HasSubstr("tests/"));
  EXPECT_THAT(problem("service/daemon/main.cpp", "#include \"../sph/world.h\""), HasSubstr("'..'"));
  EXPECT_THAT(problem("service/daemon/main.cpp", "#include \"options.h\""), HasSubstr("root of the repository"));
  EXPECT_THAT(problem("service/daemon/main.cpp", "#include <service/sph/world.h>"), HasSubstr("quotes"));
  EXPECT_THAT(problem("service/daemon/main.cpp", "#include <boost/any.hpp>"), HasSubstr("no rule"));
  EXPECT_THAT(problem("service/gui/window.cpp", "#include <vector>"), HasSubstr("no row"));
}

TEST(IncludeRules, acceptWhatIsAllowed) {
  EXPECT_EQ(problem("service/sph/world.cpp", "#include <hwy/highway.h>"), "");
  EXPECT_EQ(problem("service/sph/world.cpp", "#include <vector>"), "");
  EXPECT_EQ(problem("service/sph/world.cpp", "#include \"service/status/status.h\""), "");
  EXPECT_EQ(problem("service/daemon/program.cpp", "#include \"service/sph/world.h\""), "");
  EXPECT_EQ(problem("clients/lib/client.cpp", "#include \"idl/bleed.h\""), "");
  EXPECT_EQ(problem("clients/bleedctl/app.cpp", "#include \"bleedsim/client.h\""), "");
  EXPECT_EQ(problem("clients/examples/front_end.cpp", "#include <bleedsim/client.h>"), "");
}

// The simulation's thread waits for nobody: it neither writes the log nor calls the middleware nor the service manager.
TEST(IncludeRules, theSimulationSeesNoLogAndNoMiddleware) {
  std::size_t files = 0;
  for (const SourceFile& file : readFiles(sourceRoot(), {"service/daemon"})) {
    if (!file.path.starts_with("service/daemon/simulation")) continue;
    ++files;
    for (const std::string& line : file.lines) {
      const std::optional<Include> include = parseInclude(line);
      if (!include) continue;
      for (const char* hidden : {"spdlog/", "dds/", "systemd/", "service/transport/writer.h", "service/transport/reader.h"}) {
        EXPECT_FALSE(include->target.starts_with(hidden)) << file.path << ": " << include->target;
      }
    }
  }
  EXPECT_GE(files, 6U);
}

TEST(IncludeRules, holdInTheWholeTree) {
  const LayerTable table = tableOfTheBuild();
  std::size_t includes = 0;
  for (const SourceFile& file : readFiles(sourceRoot(), {"service", "clients"})) {
    if (!isCode(file.path)) continue;
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      const std::optional<Include> include = parseInclude(file.lines[i]);
      if (!include) continue;
      ++includes;
      const std::string found = problemOf(file.path, *include, table);
      EXPECT_TRUE(found.empty()) << file.path << ":" << i + 1 << ": " << include->target << ": " << found;
    }
  }
  EXPECT_GT(includes, 500U) << "the walk found suspiciously little";
}

}  // namespace
}  // namespace bleedsim::tests
