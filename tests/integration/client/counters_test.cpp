// That watch, status and info show what went wrong: counters of faults, of malformed input, and how far behind the session is.
#include <csignal>
#include <filesystem>
#include <gmock/gmock.h>
#include <sstream>

#include "tests/integration/client/bleedctl_fixture.h"
#include "tests/integration/client/json_value.h"

namespace bleedsim::client_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class CountersTest : public BleedctlTest {
 protected:
  void SetUp() override {
    BleedctlTest::SetUp();
    service_ = serve("one");
    service_->figures = {
        .real_time_factor = 0.75,
        .behind_s = 1.25,
        .counters = {{"speed_clamped", 3}, {"requests", 5}, {"instruments_malformed", 2}, {"write_failures", 0}}};
    service_->publishStatus();
  }

  static test::Finished output(std::vector<std::string> arguments) {
    return test::runProcess(command(std::move(arguments)), false);
  }
  /// The counters above, each with its value, zeros included.
  static void expectCounters(const Json& counters) {
    EXPECT_EQ(number(counters, "speed_clamped"), 3.0);
    EXPECT_EQ(number(counters, "requests"), 5.0);
    EXPECT_EQ(number(counters, "instruments_malformed"), 2.0);
    EXPECT_EQ(number(counters, "write_failures"), 0.0);
    EXPECT_EQ(counters.struct_value().fields_size(), 4);
  }

  std::unique_ptr<FakeService> service_;
};

TEST_F(CountersTest, StatusShowsThem) {
  const test::Finished json = output({"status", "--json"});
  ASSERT_EQ(json.code, 0);
  const Json status = parseJson(json.output);
  EXPECT_EQ(number(status, "real_time_factor"), 0.75);
  EXPECT_EQ(number(status, "behind_s"), 1.25);
  expectCounters(member(status, "counters"));

  const test::Finished shown = output({"status"});
  ASSERT_EQ(shown.code, 0);
  EXPECT_THAT(shown.output, AllOf(HasSubstr("real-time factor 0.75, 1.250 s behind\n"), HasSubstr("\nspeed_clamped     3\n"),
                                  HasSubstr("\ninstruments_malformed 2\n"), HasSubstr("\nrequests          5\n"),
                                  Not(HasSubstr("write_failures"))));
}

TEST_F(CountersTest, ListShowsThemAsJson) {
  const Json sessions = parseJson(output({"list", "--json"}).output);
  ASSERT_EQ(sessions.list_value().values_size(), 1);
  EXPECT_EQ(number(sessions.list_value().values(0), "behind_s"), 1.25);
  expectCounters(member(sessions.list_value().values(0), "counters"));
}

TEST_F(CountersTest, WatchShowsThem) {
  test::ChildProcess json{command({"watch", "--json"}), false};
  ASSERT_TRUE(service_->waitFrameReaders(1));
  ASSERT_TRUE(service_->publishMalformedFrame(1).ok());
  Json figures;
  // The line of a frame's statistics may come before the frame itself is looked at.
  for (std::uint64_t seq = 2; seq < 100 && (seq == 2 || number(figures, "malformed") == 0.0); ++seq) {
    ASSERT_TRUE(service_->publishFrame(seq).ok());
    auto line = json.readLine();
    while (line && line->find("\"seq\"") == std::string::npos) line = json.readLine();
    ASSERT_TRUE(line.has_value());
    figures = parseJson(*line);
  }
  EXPECT_EQ(number(figures, "malformed"), 1.0);
  EXPECT_EQ(number(figures, "real_time_factor"), 0.75);
  EXPECT_EQ(number(figures, "behind_s"), 1.25);
  expectCounters(member(figures, "fault_counters"));
  json.signal(SIGINT);
  ASSERT_EQ(json.wait(), 0);
  ASSERT_TRUE(service_->waitNoFrameReaders());

  test::ChildProcess shown{command({"watch"}), false};
  ASSERT_TRUE(service_->waitFrameReaders(1));
  ASSERT_TRUE(service_->publishMalformedFrame(100).ok());
  std::string line;
  for (std::uint64_t seq = 101; seq < 200 && line.find("1 malformed ") == std::string::npos; ++seq) {
    ASSERT_TRUE(service_->publishFrame(seq).ok());
    auto next = shown.readLine();
    while (next && next->find("real time") == std::string::npos) next = shown.readLine();
    ASSERT_TRUE(next.has_value());
    line = *next;
  }
  EXPECT_THAT(line, AllOf(HasSubstr("0.75 x real time, 1.250 s behind"), HasSubstr(" gaps, 1 malformed  "),
                          HasSubstr("speed_clamped 3, instruments_malformed 2"), Not(HasSubstr("requests")),
                          Not(HasSubstr("write_failures"))));
  shown.signal(SIGINT);
  ASSERT_EQ(shown.wait(), 0);
}

TEST_F(CountersTest, WatchTellsOfFramesThatDoNotCome) {
  // The next lines until one holds the text; a session without news gives one every 2 s.
  const auto shows = [](test::ChildProcess& watch, const std::string& expected) {
    for (int i = 0; i < 20; ++i) {
      const auto line = watch.readLine();
      if (!line) return false;
      if (line->find(expected) != std::string::npos) return true;
    }
    return false;
  };
  for (const bool json : {true, false}) {
    test::ChildProcess watch{json ? command({"watch", "--json"}) : command({"watch"}), false};
    ASSERT_TRUE(service_->waitFrameReaders(1));
    ASSERT_TRUE(service_->publishFrame(1).ok());
    for (std::uint64_t seq = 2; seq <= 6; ++seq) ASSERT_TRUE(service_->publishStats(seq).ok());
    EXPECT_TRUE(shows(watch, json ? R"("gaps": 0, "overdue": 5)" : "1 frames, 0 gaps, 5 overdue"));
    ASSERT_TRUE(service_->publishFrame(7).ok());
    EXPECT_TRUE(shows(watch, json ? R"("gaps": 5, "overdue": 0)" : "2 frames, 5 gaps  "));
    watch.signal(SIGINT);
    ASSERT_EQ(watch.wait(), 0);
    ASSERT_TRUE(service_->waitNoFrameReaders());
  }
}

TEST_F(CountersTest, InfoShowsThemOfARecording) {
  const std::string file = fmt::format("{}/bleedsim_counters_{}.mcap", testing::TempDir(), getpid());
  test::ChildProcess recording{command({"record", "-o", file, "--frames", "3"}), true};
  ASSERT_TRUE(service_->waitFrameReaders(1));
  ASSERT_TRUE(service_->publishFrame(1).ok());
  service_->figures.behind_s = 0.5;
  service_->figures.real_time_factor = 0.25;
  ASSERT_TRUE(service_->publishFrame(2).ok());
  ASSERT_TRUE(service_->publishFrame(4).ok());
  ASSERT_EQ(recording.wait(), 0) << recording.output();

  const test::Finished json = output({"info", file, "--json"});
  ASSERT_EQ(json.code, 0);
  const Json figures = parseJson(json.output);
  EXPECT_EQ(number(figures, "gaps"), 1.0);
  EXPECT_NEAR(number(figures, "mean_real_time_factor"), (0.75 + 0.25 + 0.25) / 3.0, 1e-12);
  EXPECT_EQ(number(figures, "max_behind_s"), 1.25);
  expectCounters(member(figures, "fault_counters"));

  const test::Finished shown = output({"info", file});
  ASSERT_EQ(shown.code, 0);
  EXPECT_THAT(
      shown.output,
      AllOf(HasSubstr("3, 1 missing, 0 left out\n"), HasSubstr("real-time factor  0.42, at most 1.250 s behind\n"),
            HasSubstr("\nspeed_clamped     3\n"), HasSubstr("\ninstruments_malformed 2\n"), Not(HasSubstr("write_failures"))));
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace bleedsim::client_test
