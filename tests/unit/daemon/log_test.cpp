// Levels of the log, and its file.
#include "service/daemon/log.h"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <spdlog/spdlog.h>
#include <sys/resource.h>
#include <unistd.h>

#include "tests/support/temporary_folder.h"

namespace bleedsim::daemon {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class LogTest : public testing::Test {
 protected:
  void TearDown() override { spdlog::set_default_logger(before_); }

  std::string path(const std::string& name = "bleedd.log") const { return (folder_ / name).string(); }
  static std::string textOf(const std::string& file) {
    std::ifstream stream{file};
    return {std::istreambuf_iterator<char>{stream}, {}};
  }

  const test::TemporaryFolder temporary_;
  const fs::path& folder_ = temporary_.path();
  std::shared_ptr<spdlog::logger> before_ = spdlog::default_logger();
};

TEST_F(LogTest, KnowsItsLevels) {
  for (const char* level : {"trace", "debug", "info", "warning", "error", "off"}) EXPECT_TRUE(checkLogLevel(level)) << level;
  for (const char* level : {"", "loud", "INFO", "warn"}) {
    const Status refused = checkLogLevel(level);
    EXPECT_EQ(refused.code(), StatusCode::invalid_argument) << level;
    EXPECT_THAT(refused.message(), HasSubstr("use trace, debug, info, warning, error, off"));
  }
}

TEST_F(LogTest, ALevelKeepsWhatIsLessAway) {
  ASSERT_TRUE(setUpLog({"warning", path()}));
  spdlog::info("quiet");
  spdlog::warn("loud");
  EXPECT_THAT(textOf(path()), AllOf(HasSubstr("loud"), Not(HasSubstr("quiet"))));
  ASSERT_TRUE(setUpLog({"off", path("off.log")}));
  spdlog::critical("nobody hears");
  EXPECT_EQ(textOf(path("off.log")), "");
  ASSERT_TRUE(setUpLog({"trace", path("trace.log")}));
  spdlog::trace("finest");
  EXPECT_THAT(textOf(path("trace.log")), HasSubstr("finest"));
}

TEST_F(LogTest, StandardErrorShowsWhatNeedsAttentionBesideAFile) {
  testing::internal::CaptureStderr();
  ASSERT_TRUE(setUpLog({"info", path()}));
  spdlog::info("all is well");
  spdlog::error("all is lost");
  EXPECT_THAT(testing::internal::GetCapturedStderr(), AllOf(HasSubstr("all is lost"), Not(HasSubstr("all is well"))));
  EXPECT_THAT(textOf(path()), AllOf(HasSubstr("all is lost"), HasSubstr("all is well")));
}

TEST_F(LogTest, AppendsToWhatIsThere) {
  std::ofstream{path()} << "yesterday\n";
  ASSERT_TRUE(setUpLog({"info", path()}));
  spdlog::info("today");
  EXPECT_THAT(textOf(path()), AllOf(HasSubstr("yesterday\n"), HasSubstr("today\n")));
}

TEST_F(LogTest, GoesOnInANewFileWhenTheOldOneWasMovedAway) {
  const auto file = setUpLog({"info", path()});
  ASSERT_TRUE(file);
  spdlog::info("one");
  fs::rename(path(), path("moved.log"));
  spdlog::info("two");
  EXPECT_THAT(textOf(path("moved.log")), HasSubstr("two")) << "until it is reopened";
  ASSERT_TRUE((*file)->reopen());
  spdlog::info("three");
  EXPECT_THAT(textOf(path()), AllOf(HasSubstr("three"), Not(HasSubstr("two"))));
  EXPECT_THAT(textOf(path("moved.log")), Not(HasSubstr("three")));
}

TEST_F(LogTest, AFileThatCannotBeOpenedIsAnError) {
  const auto folder = setUpLog({"info", folder_.string()});
  EXPECT_EQ(folder.status().code(), StatusCode::io);
  EXPECT_THAT(folder.status().message(), AllOf(HasSubstr(folder_.string()), HasSubstr("directory")));
  EXPECT_FALSE(setUpLog({"info", path("missing/bleedd.log")}));
}

TEST_F(LogTest, SaysWhatToDoAboutAFileThatCannotBeOpened) {
  EXPECT_THAT(LogFile::open(path("none/bleedd.log")).status().message(),
              AllOf(HasSubstr("none/bleedd.log' cannot be opened: "), HasSubstr("; create its folder first")));
  EXPECT_THAT(LogFile::open(folder_.string()).status().message(), HasSubstr("; it is a folder: give the name of a file"));
}

TEST_F(LogTest, WhenItCannotBeReopenedTheOldFileGoesOn) {
  const auto file = setUpLog({"info", path()});
  ASSERT_TRUE(file);
  fs::rename(path(), path("moved.log"));
  fs::create_directory(path());
  EXPECT_EQ((*file)->reopen().code(), StatusCode::io);
  spdlog::info("still here");
  EXPECT_THAT(textOf(path("moved.log")), HasSubstr("still here"));
}

// A limit of the file's size stands for a full disk: writes fail until there is room again.
TEST_F(LogTest, TellsHowManyLinesAFullDiskRefused) {
  const auto file = LogFile::open(path());
  ASSERT_TRUE(file);
  spdlog::logger logger{"full", *file};
  logger.info("before");
  signal(SIGXFSZ, SIG_IGN);
  rlimit unlimited{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &unlimited), 0);
  rlimit full = unlimited;
  full.rlim_cur = fs::file_size(path()) + 3;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &full), 0);
  logger.info("refused but for three bytes");
  logger.info("refused");
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &unlimited), 0);
  logger.info("after");
  logger.info("last");
  const std::string text = textOf(path());
  EXPECT_THAT(text, AllOf(HasSubstr("before\n"), HasSubstr("\n(2 lines could not be written here)\n"), HasSubstr("after\n")));
  EXPECT_THAT(text.substr(text.find("after")), Not(HasSubstr("could not be written")));
}

}  // namespace
}  // namespace bleedsim::daemon
