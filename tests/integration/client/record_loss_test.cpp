// What is left of a recording whose process was killed or whose disk was full, and how `bleedctl recover` makes it whole.
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <gmock/gmock.h>
#include <sys/stat.h>

#include "tests/integration/client/bleedctl_fixture.h"
#include "tests/integration/client/json_value.h"
#include "tests/support/temporary_folder.h"

namespace bleedsim::client_test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class RecordLossTest : public BleedctlTest {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  static Json json(std::vector<std::string> arguments) {
    arguments.emplace_back("--json");
    const test::Finished finished = test::runProcess(command(std::move(arguments)), false);
    EXPECT_EQ(finished.code, 0) << finished.output;
    return parseJson(finished.output);
  }
  /// The recording was cut off: `info` says so and what to do, and doing it gives all frames that were there.
  void checkRecovery() const {
    const Json cut = json({"info", path("a.mcap")});
    EXPECT_TRUE(member(cut, "truncated").bool_value());
    EXPECT_EQ(text(cut, "remedy"), "'bleedctl recover " + path("a.mcap") + " -o OUT' makes a complete file of what it holds");
    EXPECT_THAT(bleedctl({"info", path("a.mcap")}).output,
                AllOf(HasSubstr("\ntruncated "), HasSubstr("'bleedctl recover " + path("a.mcap") + " -o OUT'")));
    EXPECT_GE(number(cut, "frames"), 1.0);
    const Json recovered = json({"recover", path("a.mcap"), "-o", path("b.mcap")});
    EXPECT_EQ(number(recovered, "frames"), number(cut, "frames"));
    const Json whole = json({"info", path("b.mcap")});
    EXPECT_FALSE(member(whole, "truncated").bool_value());
    EXPECT_EQ(text(whole, "remedy"), "");
    EXPECT_EQ(number(whole, "frames"), number(cut, "frames"));
    EXPECT_EQ(number(whole, "gaps"), number(cut, "gaps"));
    EXPECT_EQ(text(whole, "scene"), "round_wound");
    EXPECT_THAT(bleedctl({"info", path("b.mcap")}).output, Not(HasSubstr("truncated")));
  }

  const test::TemporaryFolder temporary_;
  const fs::path& folder_ = temporary_.path();
};

TEST_F(RecordLossTest, AKilledRecordingKeepsWhatCameASecondBefore) {
  const auto service = serve("one");
  test::ChildProcess recording{command({"record", "-o", path("a.mcap")}), true};
  ASSERT_TRUE(service->waitFrameReaders(1));
  ASSERT_TRUE(service->publishFrame(1).ok());
  ASSERT_TRUE(recording.readLine().has_value());
  // Nothing follows the frame: it is written because it is old.
  const auto deadline = std::chrono::steady_clock::now() + test::kPatience;
  while (number(json({"info", path("a.mcap")}), "frames") < 1.0) ASSERT_LT(std::chrono::steady_clock::now(), deadline);
  recording.signal(SIGKILL);
  ASSERT_EQ(recording.wait(), 128 + SIGKILL);
  checkRecovery();
}

TEST_F(RecordLossTest, ARecordingKilledInTheMiddleOfItsFramesIsRecovered) {
  const auto service = serve("one");
  test::ChildProcess recording{command({"record", "-o", path("a.mcap")}), true};
  ASSERT_TRUE(service->waitFrameReaders(1));
  const std::uintmax_t empty = fs::file_size(path("a.mcap"));
  for (std::uint64_t seq = 1; fs::file_size(path("a.mcap")) < empty + 500'000; ++seq) {
    ASSERT_LT(seq, 100'000U) << "the recording does not grow";
    ASSERT_TRUE(service->publishFrame(seq, 5000).ok());
  }
  recording.signal(SIGKILL);
  ASSERT_EQ(recording.wait(), 128 + SIGKILL);
  checkRecovery();
}

TEST_F(RecordLossTest, AFullDiskEndsTheRecordingWithItsReasonAndIsRecovered) {
  const auto service = serve("one");
  std::vector<std::string> limited{"/bin/sh", "-c", "ulimit -f 800; exec \"$@\"", "sh"};
  for (std::string& argument : command({"record", "-o", path("a.mcap"), "--json"})) limited.push_back(std::move(argument));
  test::ChildProcess recording{limited, true};
  ASSERT_TRUE(service->waitFrameReaders(1));
  std::optional<int> code;
  for (std::uint64_t seq = 1; !code; ++seq) {
    ASSERT_LT(seq, 100'000U) << "the recording does not end";
    ASSERT_TRUE(service->publishFrame(seq, 5000).ok());
    code = recording.wait(std::chrono::milliseconds{1});
  }
  EXPECT_EQ(*code, 4) << recording.output();
  EXPECT_THAT(recording.output(),
              AllOf(HasSubstr("cannot write to '" + path("a.mcap") + "'"), HasSubstr("free space"),
                    HasSubstr(R"("ended_by": "file")"), HasSubstr("'bleedctl info " + path("a.mcap") + "' says what it holds")));
  checkRecovery();
}

/// A file that takes 64 KiB and then hangs for ever, as a network disk may.
class HangingFile {
 public:
  explicit HangingFile(const std::string& path) {
    EXPECT_EQ(::mkfifo(path.c_str(), 0600), 0);
    descriptor_ = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    EXPECT_GE(descriptor_, 0);
  }
  HangingFile(const HangingFile&) = delete;
  HangingFile& operator=(const HangingFile&) = delete;
  ~HangingFile() { ::close(descriptor_); }

 private:
  int descriptor_ = -1;
};

TEST_F(RecordLossTest, WhoInterruptsOnAHangingDiskCanGiveItUp) {
  const auto service = serve("one");
  const HangingFile hanging{path("a.mcap")};
  test::ChildProcess recording{command({"record", "-o", path("a.mcap"), "--compress", "none"}), true};
  ASSERT_TRUE(service->waitFrameReaders(1));
  for (std::uint64_t seq = 1; seq <= 4; ++seq) ASSERT_TRUE(service->publishFrame(seq, 5000).ok());
  ASSERT_TRUE(recording.waitForOutput("recording session 'one'"));
  recording.signal(SIGINT);
  ASSERT_TRUE(recording.waitForOutput("the disk takes its time for '" + path("a.mcap") +
                                      "': writing what is left; Ctrl-C gives it up\n"));
  recording.signal(SIGINT);
  EXPECT_EQ(recording.wait(), 130) << recording.output();
}

TEST_F(RecordLossTest, ADiskThatHangsEndsTheRecordingWhichSaysSoAndCanBeGivenUp) {
  const auto service = serve("one");
  const HangingFile hanging{path("a.mcap")};
  test::ChildProcess recording{command({"record", "-o", path("a.mcap"), "--compress", "none"}), true};
  ASSERT_TRUE(service->waitFrameReaders(1));
  const auto said = [&](const char* text) { return recording.output().find(text) != std::string::npos; };
  for (std::uint64_t seq = 1; !said("gives it up"); ++seq) {
    ASSERT_LT(seq, 100'000U) << "the recording does not end";
    ASSERT_TRUE(service->publishFrame(seq, 20'000).ok());
    ASSERT_FALSE(recording.wait(std::chrono::milliseconds{1}).has_value()) << recording.output();
  }
  EXPECT_THAT(recording.output(),
              AllOf(HasSubstr("the disk is too slow for '" + path("a.mcap") + "'"), HasSubstr(": writing what is left;")));
  recording.signal(SIGINT);
  EXPECT_EQ(recording.wait(), 130) << recording.output();
}

TEST_F(RecordLossTest, WhatCannotBeRecoveredIsNamed) {
  EXPECT_EQ(bleedctl({"recover", path("none.mcap"), "-o", path("b.mcap")}).code, 4);
  EXPECT_EQ(bleedctl({"recover", path("none.mcap")}).code, 2);
  const auto service = serve("one");
  test::ChildProcess recording{command({"record", "-o", path("a.mcap"), "--frames", "1"}), true};
  ASSERT_TRUE(service->waitFrameReaders(1));
  ASSERT_TRUE(service->publishFrame(1).ok());
  ASSERT_EQ(recording.wait(), 0) << recording.output();
  const test::Finished same = bleedctl({"recover", path("a.mcap"), "-o", path("a.mcap")});
  EXPECT_EQ(same.code, 2);
  EXPECT_THAT(same.output, HasSubstr("is the recording itself"));
  EXPECT_EQ(number(json({"info", path("a.mcap")}), "frames"), 1.0);
}

}  // namespace
}  // namespace bleedsim::client_test
