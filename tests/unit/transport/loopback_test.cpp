// Both ends in this process: matching, partitions, lent samples and every way a wait set wakes.
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <thread>
#include <unistd.h>

#include "service/transport/clock.h"
#include "service/transport/reader.h"
#include "service/transport/wait_set.h"
#include "service/transport/writer.h"

namespace bleedsim::transport {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

class Loopback : public testing::Test {
 protected:
  void SetUp() override {
    auto made = join();
    ASSERT_TRUE(made.ok()) << made.status().message();
    participant_.emplace(*made);
  }
  static Result<Participant> join() { return Participant::create({.domain = 63, .tag = fmt::format("t{}", getpid())}); }
  const Participant& participant() const { return *participant_; }

 private:
  std::optional<Participant> participant_;
};

bleed_v1_Instrument instrument(std::uint64_t seq) {
  bleed_v1_Instrument sample{};
  sample.seq = seq;
  sample.position.z = 0.25;
  return sample;
}

TEST_F(Loopback, DeliversInOrderAndWakesTheWaitSet) {
  auto reader = Reader<bleed_v1_Instrument>::create(participant(), "one");
  auto writer = Writer<bleed_v1_Instrument>::create(participant(), "one");
  ASSERT_TRUE(reader.ok());
  ASSERT_TRUE(writer.ok());
  EXPECT_EQ(writer->matchedCount(), 1U);
  auto waits = WaitSet::create(participant());
  ASSERT_TRUE(waits.ok());
  ASSERT_TRUE(waits->attach(*reader, 5).ok());
  EXPECT_TRUE(waits->wait(milliseconds{0})->timedOut());
  for (std::uint64_t seq = 1; seq <= 100; ++seq) ASSERT_TRUE(writer->write(instrument(seq)).ok());
  std::uint64_t last = 0;
  PublicationHandle publication = 0;
  while (last < 100) {
    const auto woken = waits->wait(seconds{10});
    ASSERT_TRUE(woken.ok() && woken->has(5));
    const auto taken = reader->take([&](const Sample<bleed_v1_Instrument>& sample) {
      ASSERT_NE(sample.data, nullptr);
      EXPECT_EQ(sample.data->seq, last + 1);
      EXPECT_EQ(sample.data->position.z, 0.25);
      last = sample.data->seq;
      publication = sample.publication;
    });
    ASSERT_TRUE(taken.ok());
    EXPECT_LE(*taken, Reader<bleed_v1_Instrument>::kMaxBatch);
  }
  EXPECT_EQ(reader->matchedPublications(), std::vector<PublicationHandle>{publication});
}

TEST_F(Loopback, SessionsDoNotMixAndDiscoverySeesAll) {
  auto one = Reader<bleed_v1_Status>::create(participant(), "one");
  auto all = Reader<bleed_v1_Status>::create(participant(), kAnySession, readerQos(Topic::status, Reading::discovery));
  auto writer_one = Writer<bleed_v1_Status>::create(participant(), "one");
  auto writer_two = Writer<bleed_v1_Status>::create(participant(), "two");
  ASSERT_TRUE(one.ok() && all.ok() && writer_one.ok() && writer_two.ok());
  bleed_v1_Status status{};
  status.step = 1;
  ASSERT_TRUE(writer_one->write(status).ok());
  status.step = 2;
  ASSERT_TRUE(writer_two->write(status).ok());
  std::vector<std::uint64_t> seen_one;
  std::vector<std::uint64_t> seen_all;
  const auto note = [](std::vector<std::uint64_t>& into) {
    return [&into](const Sample<bleed_v1_Status>& sample) {
      if (sample.data != nullptr) into.push_back(sample.data->step);
    };
  };
  ASSERT_TRUE(one->take(note(seen_one)).ok());
  ASSERT_TRUE(all->take(note(seen_all)).ok());
  EXPECT_EQ(seen_one, (std::vector<std::uint64_t>{1}));
  EXPECT_EQ(seen_all, (std::vector<std::uint64_t>{1, 2}));
}

TEST_F(Loopback, ALateReaderGetsStatusSceneAndTheWholeJournal) {
  auto writer = Writer<bleed_v1_Journal>::create(participant(), "late");
  ASSERT_TRUE(writer.ok());
  bleed_v1_Journal entry{};
  entry.body._d = bleed_v1_JOURNAL_DECISION;
  std::string text = "decision";
  entry.body._u.decision[0] = '\0';
  text.copy(entry.body._u.decision, text.size());
  for (std::uint64_t number = 1; number <= 500; ++number) {
    entry.number = number;
    ASSERT_TRUE(writer->write(entry).ok());
  }
  auto reader = Reader<bleed_v1_Journal>::create(participant(), "late");
  ASSERT_TRUE(reader.ok());
  std::uint64_t last = 0;
  for (;;) {
    const auto taken = reader->take([&](const Sample<bleed_v1_Journal>& sample) {
      if (sample.data == nullptr) return;
      EXPECT_EQ(sample.data->number, last + 1);
      last = sample.data->number;
    });
    ASSERT_TRUE(taken.ok());
    if (*taken == 0) break;
  }
  EXPECT_EQ(last, 500U);
}

TEST_F(Loopback, ALostWriterWakesAndItsPublicationIsGone) {
  auto reader = Reader<bleed_v1_Instrument>::create(participant(), "lost");
  auto waits = WaitSet::create(participant());
  ASSERT_TRUE(reader.ok() && waits.ok());
  ASSERT_TRUE(waits->attachMatches(*reader, 1).ok());
  {
    auto writer = Writer<bleed_v1_Instrument>::create(participant(), "lost");
    ASSERT_TRUE(writer.ok());
    EXPECT_TRUE(waits->wait(seconds{10})->has(1));
    EXPECT_EQ(reader->matchedPublications().size(), 1U);
    EXPECT_TRUE(waits->wait(milliseconds{0})->timedOut());
  }
  EXPECT_TRUE(waits->wait(seconds{10})->has(1));
  EXPECT_TRUE(reader->matchedPublications().empty());
}

TEST_F(Loopback, WritersTellWhoseTheyAre) {
  const auto other = join();
  ASSERT_TRUE(other.ok());
  auto reader = Reader<bleed_v1_Instrument>::create(participant(), "whose");
  auto one = Writer<bleed_v1_Instrument>::create(*other, "whose");
  auto two = Writer<bleed_v1_Instrument>::create(*other, "whose");
  auto own = Writer<bleed_v1_Instrument>::create(participant(), "whose");
  auto waits = WaitSet::create(participant());
  ASSERT_TRUE(reader.ok() && one.ok() && two.ok() && own.ok() && waits.ok());
  ASSERT_TRUE(waits->attachMatches(*reader, 1).ok());
  while (reader->matchedCount() < 3) ASSERT_TRUE(waits->wait(seconds{10})->has(1));
  std::map<std::uint64_t, int> writers;
  for (const PublicationHandle writer : reader->matchedPublications()) ++writers[reader->participantOf(writer)];
  ASSERT_EQ(writers.size(), 2U);
  EXPECT_EQ(writers.count(0), 0U);
  EXPECT_EQ(writers.begin()->second + writers.rbegin()->second, 3);
  EXPECT_EQ(reader->participantOf(12345), 0U) << "there is no such writer";
}

TEST_F(Loopback, AGuardWakesFromAnotherThread) {
  auto guard = GuardCondition::create(participant());
  auto waits = WaitSet::create(participant());
  ASSERT_TRUE(guard.ok() && waits.ok());
  ASSERT_TRUE(waits->attach(*guard, 0).ok());
  std::thread other{[&] { guard->raise(); }};
  EXPECT_TRUE(waits->wait(seconds{10})->has(0));
  other.join();
  guard->lower();
  EXPECT_TRUE(waits->wait(milliseconds{0})->timedOut());
}

TEST_F(Loopback, RefusesPartitionsThatWouldJoinOtherSessions) {
  EXPECT_EQ(Writer<bleed_v1_Status>::create(participant(), "*").status().code(), StatusCode::invalid_argument);
  EXPECT_EQ(Reader<bleed_v1_Status>::create(participant(), "a*").status().code(), StatusCode::invalid_argument);
}

TEST(Clock, IsMonotonicAndAgreesWithTheCalendar) {
  const std::int64_t first = monotonicNow();
  EXPECT_LE(first, monotonicNow());
  EXPECT_GT(realtimeNow(), 1'700'000'000'000'000'000);
}

}  // namespace
}  // namespace bleedsim::transport
