// The revision that a build carries: of a checkout, a worktree, an archive, and whether the sources differ from it.
#include <cstdlib>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <unistd.h>

#include "tests/support/child_process.h"
#include "tests/support/temporary_folder.h"

namespace bleedsim::config_test {
namespace {

namespace fs = std::filesystem;
using testing::MatchesRegex;

constexpr const char* kHash = "[0-9a-f]{12}";
constexpr const char* kDirtyHash = "[0-9a-f]{12}-dirty";
constexpr uid_t kNobody = 65534;

class RevisionTest : public testing::Test {
 protected:
  void SetUp() override {
    setenv("GIT_CONFIG_GLOBAL", "/dev/null", 1);
    setenv("GIT_CONFIG_NOSYSTEM", "1", 1);
  }

  static bool hasGit() { return test::runProcess({"/usr/bin/env", "git", "--version"}).code == 0; }
  static void git(const fs::path& folder, const std::vector<std::string>& arguments) {
    std::vector<std::string> command{"/usr/bin/env", "git", "-c", "user.name=n", "-c", "user.email=e@x", "-C", folder.string()};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const test::Finished finished = test::runProcess(command);
    ASSERT_EQ(finished.code, 0) << finished.output;
  }
  static void write(const fs::path& file, const std::string& text) { std::ofstream{file} << text; }
  /// A repository with one committed file.
  fs::path makeCheckout() const {
    const fs::path folder = root_ / "checkout";
    fs::create_directories(folder);
    git(folder, {"init", "-q"});
    write(folder / "source.txt", "one\n");
    git(folder, {"add", "source.txt"});
    git(folder, {"commit", "-q", "-m", "one"});
    return folder;
  }

  fs::path header() const { return root_ / "out" / "revision.h"; }
  /// What the header says after a look at `sources`; `environment` as "NAME=value".
  std::string revisionOf(const fs::path& sources, const std::string& environment = "BLEEDSIM_NONE=") const {
    const test::Finished finished = test::runProcess({"/usr/bin/env", environment, CMAKE_PATH, "-DSOURCE_DIR=" + sources.string(),
                                                      "-DHEADER=" + header().string(), "-P", REVISION_SCRIPT});
    EXPECT_EQ(finished.code, 0) << finished.output;
    std::ifstream file{header()};
    const std::string text{std::istreambuf_iterator<char>{file}, {}};
    const std::string start = "kRevision = \"";
    const std::size_t at = text.find(start);
    if (at == std::string::npos) return "no revision in: " + text;
    return text.substr(at + start.size(), text.find('"', at + start.size()) - at - start.size());
  }

  const test::TemporaryFolder temporary_;
  const fs::path& root_ = temporary_.path();
};

TEST_F(RevisionTest, OfACheckoutIsItsCommitAndSaysWhenTrackedFilesDiffer) {
  if (!hasGit()) GTEST_SKIP() << "needs git";
  const fs::path sources = makeCheckout();
  const std::string clean = revisionOf(sources);
  EXPECT_THAT(clean, MatchesRegex(kHash));
  write(sources / "notes.txt", "not tracked\n");
  EXPECT_EQ(revisionOf(sources), clean);
  write(sources / "source.txt", "two\n");
  EXPECT_EQ(revisionOf(sources), clean + "-dirty");
  git(sources, {"commit", "-q", "-a", "-m", "two"});
  EXPECT_THAT(revisionOf(sources), MatchesRegex(kHash));
  EXPECT_NE(revisionOf(sources), clean);
  git(sources, {"tag", "-a", "-m", "a tag changes nothing", "v9"});
  EXPECT_THAT(revisionOf(sources), MatchesRegex(kHash));
}

TEST_F(RevisionTest, AnUnchangedHeaderIsLeftAlone) {
  if (!hasGit()) GTEST_SKIP() << "needs git";
  const fs::path sources = makeCheckout();
  revisionOf(sources);
  const auto old = fs::last_write_time(header()) - std::chrono::hours{1};
  fs::last_write_time(header(), old);
  revisionOf(sources);
  EXPECT_EQ(fs::last_write_time(header()), old);
  write(sources / "source.txt", "two\n");
  revisionOf(sources);
  EXPECT_GT(fs::last_write_time(header()), old);
}

TEST_F(RevisionTest, IsFoundInAWorktree) {
  if (!hasGit()) GTEST_SKIP() << "needs git";
  const fs::path worktree = root_ / "worktree";
  git(makeCheckout(), {"worktree", "add", "-q", worktree.string()});
  EXPECT_THAT(revisionOf(worktree), MatchesRegex(kHash));
  write(worktree / "source.txt", "two\n");
  EXPECT_THAT(revisionOf(worktree), MatchesRegex(kDirtyHash));
}

TEST_F(RevisionTest, IsFoundInACheckoutOfSomebodyElse) {
  if (!hasGit()) GTEST_SKIP() << "needs git";
  if (geteuid() != 0) GTEST_SKIP() << "only root can give files away";
  const fs::path sources = makeCheckout();
  ASSERT_EQ(chown(sources.c_str(), kNobody, kNobody), 0);
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator{sources}) {
    ASSERT_EQ(lchown(entry.path().c_str(), kNobody, kNobody), 0);
  }
  ASSERT_NE(test::runProcess({"/usr/bin/env", "git", "-C", sources.string(), "status"}).code, 0) << "git does not mind here";
  EXPECT_THAT(revisionOf(sources), MatchesRegex(kHash));
}

TEST_F(RevisionTest, IsUnknownWithoutARepositoryOfItsOwnACommitOrGit) {
  const fs::path archive = root_ / "checkout" / "archive";
  fs::create_directories(archive);
  EXPECT_EQ(revisionOf(archive), "unknown");
  if (!hasGit()) return;
  makeCheckout();
  EXPECT_EQ(revisionOf(archive), "unknown") << "the repository around it is another project's";
  EXPECT_THAT(revisionOf(root_ / "checkout"), MatchesRegex(kHash));
  EXPECT_EQ(revisionOf(root_ / "checkout", "PATH=/nonexistent"), "unknown");
  const fs::path empty = root_ / "empty";
  fs::create_directories(empty);
  git(empty, {"init", "-q"});
  EXPECT_EQ(revisionOf(empty), "unknown");
}

TEST_F(RevisionTest, IsWhatBleeddPrints) {
  const test::Finished version = test::runProcess({BLEEDD_PATH, "--version"});
  EXPECT_EQ(version.code, 0);
  EXPECT_THAT(version.output,
              MatchesRegex(PROJECT_VERSION_TEXT "-([0-9a-f]{12}(-dirty)?|unknown) [A-Za-z]+-[0-9.]+ [A-Za-z]*\n"));
}

}  // namespace
}  // namespace bleedsim::config_test
