// The client library against a fake service over loopback.
#include "bleedsim/client.h"

#include <condition_variable>
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mutex>
#include <optional>
#include <unistd.h>

#include "tests/integration/client/client_fixture.h"

namespace bleedsim::client_test {
namespace {

using namespace std::chrono_literals;
using client::Delivery;
using client::Reply;
using client::ReplyCode;
using client::Session;

class ClientTest : public ClientFixture {
 protected:
  Session open(const std::string& name, const client::SessionOptions& options = {}) {
    auto session = client_->open(name, options, kLong);
    EXPECT_TRUE(session.ok()) << session.status().message();
    return std::move(*session);
  }
};

TEST_F(ClientTest, FindsASessionByNameOrTheFirst) {
  const auto one = serve("one");
  EXPECT_EQ(client_->find("", kLong)->name, "one");
  const auto two = serve("two");
  EXPECT_EQ(client_->find("two", kLong)->session, two->session);
  EXPECT_EQ(client_->find("", kLong)->name, "one");
  EXPECT_EQ(client_->sessions().size(), 2U);
}

TEST_F(ClientTest, SaysWhichSessionsThereAreWhenOneIsMissing) {
  const auto one = serve("one");
  const auto missing = client_->find("other", 300ms);
  EXPECT_EQ(missing.status().code(), StatusCode::timed_out);
  EXPECT_THAT(missing.status().message(), testing::AllOf(testing::HasSubstr("'other'"), testing::HasSubstr("one")));
  EXPECT_EQ(client_->find("bad name", kLong).status().code(), StatusCode::invalid_argument);
}

TEST_F(ClientTest, ForgetsSessionsThatStopOrVanish) {
  auto one = serve("one");
  const auto two = serve("two");
  ASSERT_TRUE(client_->find("two", kLong).ok());
  two->publishStatus(bleed_v1_STATE_STOPPED);
  one.reset();
  EXPECT_TRUE(client_->sessions().empty());
}

TEST_F(ClientTest, ALateClientGetsSceneAndStatusAtOnce) {
  const auto service = serve("late");
  service->publishScene("round_wound");
  Session session = open("late");
  const auto scene = session.waitScene(kLong);
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  EXPECT_EQ(scene->name, "round_wound");
  EXPECT_EQ(scene->text, "# round_wound");
  EXPECT_EQ(scene->spacing_m, 0.003);
  EXPECT_EQ(session.status()->state, client::SessionState::running);
}

TEST_F(ClientTest, AQueueKeepsEveryFrameInOrder) {
  const auto service = serve("queue");
  Session session = open("queue", {.delivery = Delivery::queue, .queue_length = 100});
  ASSERT_TRUE(service->waitFrameReaders(1));
  for (std::uint64_t seq = 1; seq <= 100; ++seq) ASSERT_TRUE(service->publishFrame(seq).ok());
  for (std::uint64_t seq = 1; seq <= 100; ++seq) {
    const auto frame = session.waitFrame(kLong);
    ASSERT_TRUE(frame.ok()) << frame.status().message();
    EXPECT_EQ((*frame)->header().seq, seq);
    ASSERT_EQ((*frame)->count(), 3U);
    EXPECT_EQ((*frame)->positions()[0], static_cast<float>(seq));
    EXPECT_EQ((*frame)->ids()[2], 2U);
  }
  EXPECT_EQ(session.tryTakeFrame(), nullptr);
  EXPECT_EQ(session.frameCounters().gaps, 0U);
  EXPECT_EQ(session.frameCounters().received, 100U);
}

TEST_F(ClientTest, NewestReplacesWhatNobodyTook) {
  const auto service = serve("newest");
  Session session = open("newest");
  ASSERT_TRUE(service->waitFrameReaders(1));
  for (std::uint64_t seq = 1; seq <= 50; ++seq) ASSERT_TRUE(service->publishFrame(seq).ok());
  std::uint64_t taken = 0;
  std::uint64_t last = 0;
  while (last < 50) {
    const auto frame = session.waitFrame(kLong);
    ASSERT_TRUE(frame.ok()) << frame.status().message();
    EXPECT_GT((*frame)->header().seq, last);
    last = (*frame)->header().seq;
    ++taken;
  }
  const client::FrameCounters counters = session.frameCounters();
  EXPECT_EQ(counters.received, taken + counters.dropped);
  EXPECT_LE(counters.received + counters.gaps, 50U);
}

TEST_F(ClientTest, CountsEveryGap) {
  const auto service = serve("gaps");
  Session session = open("gaps", {.delivery = Delivery::queue});
  ASSERT_TRUE(service->waitFrameReaders(1));
  for (const std::uint64_t seq : {5U, 6U, 9U, 10U, 20U}) ASSERT_TRUE(service->publishFrame(seq).ok());
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(session.waitFrame(kLong).ok());
  EXPECT_EQ(session.frameCounters().gaps, 11U);
}

TEST_F(ClientTest, CountsAndSkipsMalformedFrames) {
  const auto service = serve("malformed");
  Session session = open("malformed", {.delivery = Delivery::queue});
  ASSERT_TRUE(service->waitFrameReaders(1));
  ASSERT_TRUE(service->publishMalformedFrame(1).ok());
  ASSERT_TRUE(service->publishFrame(2).ok());
  EXPECT_EQ((*session.waitFrame(kLong))->header().seq, 2U);
  EXPECT_EQ(session.frameCounters().malformed, 1U);
  EXPECT_EQ(session.frameCounters().received, 1U);
}

TEST_F(ClientTest, CallsBackWithFramesAndStats) {
  const auto service = serve("callback");
  std::promise<client::FramePointer> frame;
  std::promise<client::FrameStats> stats;
  client::SessionOptions options;
  options.on_frame = [&](const client::FramePointer& f) { frame.set_value(f); };
  options.on_stats = [&](const client::FrameStats& s) { stats.set_value(s); };
  const Session session = open("callback", options);
  ASSERT_TRUE(service->waitFrameReaders(1));
  ASSERT_TRUE(service->publishFrame(8, 1000).ok());
  auto frame_future = frame.get_future();
  auto stats_future = stats.get_future();
  ASSERT_EQ(frame_future.wait_for(kLong), std::future_status::ready);
  ASSERT_EQ(stats_future.wait_for(kLong), std::future_status::ready);
  EXPECT_EQ(frame_future.get()->count(), 1000U);
  EXPECT_EQ(stats_future.get().emitted_ml, 4.0);
}

TEST_F(ClientTest, CommandsAreAnsweredWithCodeStepAndReason) {
  const auto service = serve("commands", [](const bleed_v1_Request& request, bleed_v1_Reply& reply) {
    reply.applied_step = 123;
    if (request.body._d == bleed_v1_REQUEST_WOUND_ADD) {
      EXPECT_EQ(request.body._u.wound_add.radius_m, 0.002);
      reply.object_id = 7;
    } else {
      reply.code = bleed_v1_REPLY_NOT_FOUND;
      std::string{"wound 99 is unknown"}.copy(reply.reason, sizeof reply.reason - 1);
    }
    return true;
  });
  Session session = open("commands");
  auto added = session.addWound({.radius_m = 0.002, .flow_ml_per_s = 1.0});
  auto removed = session.removeWound(99);
  const Reply first = added.get();
  EXPECT_TRUE(first.accepted()) << first.reason;
  EXPECT_EQ(first.object_id, 7U);
  EXPECT_EQ(first.applied_step, 123U);
  const Reply second = removed.get();
  EXPECT_EQ(second.code, ReplyCode::not_found);
  EXPECT_EQ(second.reason, "wound 99 is unknown");
}

TEST_F(ClientTest, SendsTheSameRequestAgainUntilItIsAnswered) {
  int seen = 0;
  const auto service = serve("deaf", [&seen](const bleed_v1_Request&, bleed_v1_Reply&) { return ++seen == 3; });
  Session session = open("deaf");
  const Reply reply = session.pause().get();
  EXPECT_TRUE(reply.accepted()) << reply.reason;
  EXPECT_EQ(service->requestSeqs(), (std::vector<std::uint64_t>{1, 1, 1}));
}

TEST_F(ClientTest, ACommandWithoutAnswerTimesOut) {
  const auto service = serve("silent", [](const bleed_v1_Request&, bleed_v1_Reply&) { return false; });
  Session session = open("silent", {.command_timeout = 400ms});
  const Reply reply = session.resume().get();
  EXPECT_EQ(reply.code, ReplyCode::no_answer);
  EXPECT_FALSE(reply.reason.empty());
}

TEST_F(ClientTest, ClosingASessionAnswersItsCommands) {
  const auto service = serve("closed", [](const bleed_v1_Request&, bleed_v1_Reply&) { return false; });
  std::future<Reply> open_command;
  {
    Session session = open("closed", {.command_timeout = 60s});
    open_command = session.reset();
    ASSERT_TRUE(service->waitRequests(1));
  }
  EXPECT_EQ(open_command.get().code, ReplyCode::no_answer);
}

TEST_F(ClientTest, TwoSessionsDoNotMix) {
  const auto one = serve("one");
  const auto two = serve("two");
  Session first = open("one", {.delivery = Delivery::queue});
  Session second = open("two", {.delivery = Delivery::queue});
  ASSERT_TRUE(one->waitFrameReaders(1));
  ASSERT_TRUE(two->waitFrameReaders(1));
  ASSERT_TRUE(one->publishFrame(1, 10).ok());
  ASSERT_TRUE(two->publishFrame(1, 20).ok());
  EXPECT_EQ((*first.waitFrame(kLong))->count(), 10U);
  EXPECT_EQ((*second.waitFrame(kLong))->count(), 20U);
  EXPECT_TRUE(first.pause().get().accepted());
  EXPECT_TRUE(second.pause().get().accepted());
  EXPECT_EQ(one->requestSeqs().size(), 1U);
  EXPECT_EQ(two->requestSeqs().size(), 1U);
  EXPECT_EQ(first.tryTakeFrame(), nullptr);
}

TEST_F(ClientTest, TwoHandlesOfOneSessionGetTheirOwnReplies) {
  const auto service = serve("shared");
  Session first = open("shared");
  Session second = open("shared");
  auto a = first.pause();
  auto b = second.resume();
  EXPECT_TRUE(a.get().accepted());
  EXPECT_TRUE(b.get().accepted());
}

TEST_F(ClientTest, StreamsInstrumentsInOrderAndNamesItself) {
  const auto service = serve("tool");
  Session session = open("tool");
  auto stream = session.instrument(3, "PSM1");
  ASSERT_TRUE(stream.ok()) << stream.status().message();
  for (int i = 0; i < 500; ++i) ASSERT_TRUE(stream->send({.position = {0.0, 0.0, i * 0.001}, .force = {0.0, 0.0, -0.5}}).ok());
  ASSERT_TRUE(service->waitInstruments(500));
  const auto samples = service->instruments();
  for (std::size_t i = 0; i < 500; ++i) ASSERT_EQ(samples[i].seq, i + 1);
  EXPECT_STREQ(samples.back().name, "PSM1");
  EXPECT_EQ(samples.back().tool, 3U);
  EXPECT_EQ(samples.back().force.z, -0.5);
  EXPECT_EQ(samples.back().orientation.w, 1.0);
  EXPECT_EQ(stream->lastSeq(), 500U);
  EXPECT_EQ(session.instrument(1, std::string(33, 'x')).status().code(), StatusCode::invalid_argument);
}

TEST_F(ClientTest, PingMeasuresTheClockOffset) {
  constexpr std::int64_t kAhead = 3'000'000'000;
  const auto service = serve("ping", [](const bleed_v1_Request&, bleed_v1_Reply& reply) {
    reply.receive_stamp_ns += kAhead;
    return true;
  });
  Session session = open("ping");
  EXPECT_FALSE(session.clockOffset().has_value());
  // Only the receive stamp is shifted: such stamps run backwards and are refused.
  ASSERT_TRUE(session.ping(kLong).ok());
  EXPECT_FALSE(session.clockOffset().has_value());

  const auto honest = serve("honest");
  Session other = open("honest");
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(other.ping(kLong).ok());
  ASSERT_TRUE(other.clockOffset().has_value());
  EXPECT_EQ(other.clockOffset()->samples, 20U);
  // One host has one monotonic clock: the offset is zero up to half the round trip.
  EXPECT_LE(std::abs(other.clockOffset()->offset_ns), other.clockOffset()->round_trip_ns / 2 + 1);
}

TEST_F(ClientTest, NoticesThatASessionEnds) {
  auto service = serve("ends");
  Session session = open("ends");
  EXPECT_TRUE(session.alive());
  service.reset();
  EXPECT_TRUE(session.waitGone(kLong));
  const auto next = serve("stops");
  Session stops = open("stops");
  next->publishStatus(bleed_v1_STATE_STOPPED);
  EXPECT_TRUE(stops.waitGone(kLong));
}

// What the callback is told, for a test to wait for.
class ConnectionLog {
 public:
  void note(const client::ConnectionState& state) {
    const std::lock_guard lock{mutex_};
    states_.push_back(state);
    changed_.notify_all();
  }
  client::ConnectionState wait(std::size_t count) {
    std::unique_lock lock{mutex_};
    EXPECT_TRUE(changed_.wait_for(lock, kLong, [&] { return states_.size() >= count; }));
    return states_.empty() ? client::ConnectionState{} : states_.back();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<client::ConnectionState> states_;
};

TEST_F(ClientTest, ReconnectsToAnotherDaemonOfTheName) {
  ConnectionLog log;
  auto service = serve("back");
  Session session = open("back", {.delivery = Delivery::queue, .on_connection = [&log](const auto& state) { log.note(state); }});
  ASSERT_TRUE(session.ping(kLong).ok());
  auto tool = session.instrument(1, "PSM1");
  ASSERT_TRUE(tool.ok());
  ASSERT_TRUE(service->waitFrameReaders(1));
  ASSERT_TRUE(service->publishFrame(7).ok());
  ASSERT_TRUE(session.waitFrame(kLong).ok());
  service.reset();
  const client::ConnectionState lost = log.wait(1);
  EXPECT_FALSE(lost.connected);
  EXPECT_EQ(lost.losses, 1U);
  EXPECT_FALSE(session.connection().connected);

  service = serve("back");
  ASSERT_TRUE(session.waitAlive(kLong));
  const client::ConnectionState back = log.wait(2);
  EXPECT_TRUE(back.connected);
  EXPECT_EQ(back.replacements, 1U);
  ASSERT_TRUE(service->waitFrameReaders(1));
  ASSERT_TRUE(service->publishFrame(100).ok());
  const auto frame = session.waitFrame(kLong);
  ASSERT_TRUE(frame.ok()) << frame.status().message();
  EXPECT_EQ((*frame)->header().seq, 100U);
  EXPECT_EQ(session.frameCounters().gaps, 0U) << "the numbers of another daemon";
  EXPECT_TRUE(session.pause().get().accepted());
  ASSERT_TRUE(service->waitRequests(2)) << "a ping by itself, and the pause";
  ASSERT_TRUE(session.clockOffset().has_value());
  EXPECT_EQ(session.clockOffset()->samples, 1U) << "the other daemon's clock";
  while (service->instruments().empty()) ASSERT_TRUE(tool->send({.tip_radius_m = 0.01}).ok());
}

TEST_F(ClientTest, NamesWoundsAndTakesALease) {
  std::vector<bleed_v1_Request> seen;
  std::mutex mutex;
  const auto service = serve("lease", [&](const bleed_v1_Request& request, bleed_v1_Reply& reply) {
    const std::lock_guard lock{mutex};
    seen.push_back(request);
    if (request.body._d == bleed_v1_REQUEST_RELEASE) reply.code = bleed_v1_REPLY_LEASED;
    return true;
  });
  Session session = open("lease");
  EXPECT_TRUE(session.acquireLease(2500ms).get().accepted());
  EXPECT_EQ(session.releaseLease().get().code, ReplyCode::leased);
  EXPECT_TRUE(session.updateWound("liver", {.flow_ml_per_s = 1.0}).get().accepted());
  EXPECT_TRUE(session.removeWound("liver").get().accepted());
  EXPECT_EQ(session.removeWound("").get().code, ReplyCode::not_sent);
  EXPECT_EQ(session.updateWound(std::string(65, 'x'), {.flow_ml_per_s = 1.0}).get().code, ReplyCode::not_sent);
  const std::lock_guard lock{mutex};
  ASSERT_EQ(seen.size(), 4U);
  EXPECT_EQ(transport::toUuid(seen[0].client), session.clientId());
  EXPECT_EQ(seen[0].body._u.acquire.seconds, 2.5);
  EXPECT_STREQ(seen[2].body._u.wound_update.wound_name, "liver");
  EXPECT_EQ(seen[2].body._u.wound_update.wound_id, 0U);
  EXPECT_STREQ(seen[3].body._u.wound_remove.wound_name, "liver");
}

TEST_F(ClientTest, RefusesOptionsOutOfRange) {
  const auto service = serve("options");
  EXPECT_EQ(client_->open("options", {.queue_length = 0}, kLong).status().code(), StatusCode::invalid_argument);
  EXPECT_EQ(client_->open("options", {.queue_length = 257}, kLong).status().code(), StatusCode::invalid_argument);
  EXPECT_EQ(client_->open("options", {.command_timeout = 0ms}, kLong).status().code(), StatusCode::invalid_argument);
}

}  // namespace
}  // namespace bleedsim::client_test
