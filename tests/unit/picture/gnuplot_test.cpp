// gnuplot there, missing, failing and hanging. Programs of a few lines stand in for it; the last cases run the real one.
#include "service/picture/gnuplot.h"

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "service/picture/plot.h"
#include "service/picture/png_file.h"
#include "tests/support/temporary_folder.h"

namespace bleedsim::picture::test {
namespace {

using bleedsim::test::contentOf;
using bleedsim::test::TemporaryFolder;

using testing::HasSubstr;

class Gnuplot : public testing::Test {
 protected:
  /// Puts a program with that body where the plots will look for gnuplot.
  void standIn(const std::string& body) {
    const std::filesystem::path program = programs_.path() / "gnuplot";
    std::ofstream{program} << "#!/bin/sh\n" << body << "\n";
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  }
  Result<PlotFiles> draw(const LinePlot& plot) {
    PlotOptions options;
    options.search_path = programs_.path().string();
    options.patience_s = patience_s_;
    return writePlot(folder_.path(), "speed", plot, options);
  }
  Result<PlotFiles> draw() { return draw(plot()); }
  static LinePlot plot() {
    LinePlot plot;
    plot.title = "Speed";
    plot.series = {{"a", SeriesStyle::line_with_points, {1, 2, 3}, {1, 4, 9}}};
    return plot;
  }

  TemporaryFolder folder_;
  TemporaryFolder programs_;
  double patience_s_ = 60.0;
};

TEST_F(Gnuplot, missingLeavesDataScriptAndAdvice) {
  std::ofstream{folder_.path() / "speed.png"} << "of older data";
  const Result<PlotFiles> files = draw();
  ASSERT_TRUE(files.ok()) << files.status().message();
  EXPECT_FALSE(files->drawn);
  EXPECT_THAT(files->advice, HasSubstr("apt-get install gnuplot-nox"));
  EXPECT_THAT(files->advice, HasSubstr(files->csv.string()));
  EXPECT_THAT(contentOf(files->csv), HasSubstr("\n2,4,a\n"));
  EXPECT_THAT(contentOf(files->script), HasSubstr("\"speed.csv\""));
  EXPECT_EQ(folder_.files(), 2U) << "a picture of older data beside the new data";
}

TEST_F(Gnuplot, runsInTheFolderWithDefaultSettings) {
  standIn("pwd > where; echo \"$@\" > words; echo picture > speed.png");
  const Result<PlotFiles> files = draw();
  ASSERT_TRUE(files.ok()) << files.status().message();
  EXPECT_TRUE(files->drawn);
  EXPECT_EQ(files->advice, "");
  EXPECT_EQ(files->png, folder_.path() / "speed.png");
  EXPECT_EQ(contentOf(folder_.path() / "words"), "-d speed.gnuplot\n");
  EXPECT_EQ(std::filesystem::canonical(folder_.path()).string() + "\n", contentOf(folder_.path() / "where"));
}

TEST_F(Gnuplot, failureCarriesItsWordsAndLeavesNoPicture) {
  standIn("echo half > speed.png; echo 'unknown terminal type' >&2; exit 3");
  const Result<PlotFiles> files = draw();
  EXPECT_EQ(files.status().code(), StatusCode::internal);
  EXPECT_THAT(files.status().message(), HasSubstr("unknown terminal type"));
  EXPECT_THAT(files.status().message(), HasSubstr("speed.gnuplot"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "speed.png"));
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "speed.csv"));
}

TEST_F(Gnuplot, manyWordsDoNotBlockIt) {
  // More than a pipe holds (64 KiB).
  standIn("head -c 300000 /dev/zero | tr '\\0' x; exit 1");
  const Result<PlotFiles> files = draw();
  EXPECT_EQ(files.status().code(), StatusCode::internal);
  EXPECT_LT(files.status().message().size(), 2000U);
}

TEST_F(Gnuplot, hangingIsEnded) {
  standIn("exec sleep 100");
  patience_s_ = 0.2;
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(draw().status().code(), StatusCode::timed_out);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds{50});
}

TEST_F(Gnuplot, silentSuccessWithoutPictureIsAFailure) {
  standIn("exit 0");
  EXPECT_THAT(draw().status().message(), HasSubstr("wrote no"));
}

TEST_F(Gnuplot, badPlotsWriteNothing) {
  standIn("touch ran");
  LinePlot empty;
  EXPECT_EQ(draw(empty).status().code(), StatusCode::invalid_argument);
  EXPECT_EQ(folder_.files(), 0U);
}

TEST_F(Gnuplot, missingFolderIsNamedWithARemedy) {
  const Result<PlotFiles> files = writePlot(folder_.path() / "missing", "speed", plot(), {});
  EXPECT_EQ(files.status().code(), StatusCode::io);
  EXPECT_THAT(files.status().message(), HasSubstr("missing/speed.csv'"));
  EXPECT_THAT(files.status().message(), HasSubstr("create its folder first"));
}

TEST_F(Gnuplot, searchTakesTheFirstExecutableFile) {
  const TemporaryFolder first;
  std::ofstream{first.path() / "gnuplot"} << "not executable";
  std::filesystem::permissions(first.path() / "gnuplot", std::filesystem::perms::owner_read);
  standIn("exit 0");
  const std::string path = "::/nowhere:" + first.path().string() + ":" + programs_.path().string();
  EXPECT_EQ(findProgram("gnuplot", path), programs_.path() / "gnuplot");
  EXPECT_FALSE(findProgram("gnuplot", first.path().string()));
  EXPECT_FALSE(findProgram("gnuplot", ""));
}

/// The installed one; it is an optional package, so its cases are skipped without it.
class RealGnuplot : public testing::Test {
 protected:
  void SetUp() override {
    const char* path = std::getenv("PATH");
    if (path == nullptr || !findProgram("gnuplot", path)) GTEST_SKIP() << "gnuplot is not installed (package gnuplot-nox)";
  }
  TemporaryFolder folder_;
};

/// Pixels that are not nearly white.
std::size_t inkOf(const Image& image) {
  std::size_t count = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const Color c = image.at(x, y);
      count += c.r + c.g + c.b < 600 ? 1 : 0;
    }
  }
  return count;
}

TEST_F(RealGnuplot, drawsLinesAndBars) {
  LinePlot lines;
  lines.title = "Speed";
  lines.x = {"particles", true, {}, {}};
  lines.y = {"steps/s", true, {}, {}};
  lines.series = {{"a", SeriesStyle::line_with_points, {1, 10, 100}, {1, 4, 9}},
                  {"b", SeriesStyle::points, {1, 10}, {2, std::nan("")}}};
  lines.lines = {{ReferenceLine::Direction::horizontal, 20, "enough"}, {ReferenceLine::Direction::vertical, 50, "here"}};
  BarPlot bars;
  bars.categories = {"one", "two"};
  bars.series = {{"a", {1, 2}}, {"b", {2, std::nan("")}}};
  bars.lines = {{ReferenceLine::Direction::horizontal, 3, "budget"}};
  const Result<PlotFiles> first = writePlot(folder_.path(), "lines", lines, {.width = 900, .height = 600});
  const Result<PlotFiles> second = writePlot(folder_.path(), "bars", bars, {.width = 900, .height = 600});
  for (const auto& files : {first, second}) {
    ASSERT_TRUE(files.ok()) << files.status().message();
    ASSERT_TRUE(files->drawn);
    const Result<Image> image = readPng(files->png);
    ASSERT_TRUE(image.ok()) << image.status().message();
    EXPECT_EQ(image->width(), 900);
    EXPECT_EQ(image->height(), 600);
    EXPECT_GT(inkOf(*image), 1500U);
  }
}

TEST_F(RealGnuplot, hostileTextsAreJustText) {
  // Each tries to end its string, or to run a command from within, in another way.
  for (const std::string hostile :
       {"'; system('touch pwned'); '", "\"; system(\"touch pwned\"); \"", "`touch pwned`", "\\\"; system(\"touch pwned\") #",
        "\\", "''", "'\"'\"", "@x $(touch pwned) {/:Bold b} a_b^c ~a{.8-}", "%s %d %g %", "#", "\\140touch pwned\\140",
        "; exit 1"}) {
    LinePlot lines;
    lines.title = lines.x.label = lines.y.label = hostile;
    lines.series = {{hostile, SeriesStyle::line, {1, 2}, {1, 2}}, {hostile, SeriesStyle::points, {1, 2}, {2, 1}}};
    lines.lines = {{ReferenceLine::Direction::horizontal, 1.5, hostile}, {ReferenceLine::Direction::vertical, 1.5, hostile}};
    BarPlot bars;
    bars.title = bars.category_label = bars.y.label = hostile;
    bars.categories = {hostile, "plain"};
    bars.series = {{hostile, {1, 2}}};
    const PlotOptions small{.width = 300, .height = 200};
    const Result<PlotFiles> first = writePlot(folder_.path(), "lines", lines, small);
    ASSERT_TRUE(first.ok()) << first.status().message();
    const Result<PlotFiles> second = writePlot(folder_.path(), "bars", bars, small);
    ASSERT_TRUE(second.ok()) << second.status().message();
    EXPECT_TRUE(first->drawn && second->drawn);
    EXPECT_EQ(folder_.files(), 6U) << hostile << " was run";
  }
}

}  // namespace
}  // namespace bleedsim::picture::test
