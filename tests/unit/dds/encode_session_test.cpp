#include <cstring>
#include <gtest/gtest.h>
#include <memory>
#include <string>

#include "service/dds/command_limits.h"
#include "service/dds/session_encoder.h"
#include "service/transport/clock.h"
#include "tests/unit/dds/samples.h"

namespace bleedsim::dds {
namespace {

SessionIdentity identity() { return {Uuid{1, 2}, "theatre", "1.0.0", "1.0.0-abc", "host", 77, 1234}; }

TEST(CopyText, CutsAtACharacterOfUtf8) {
  char small[6];
  copyText("abcdefg", small);
  EXPECT_STREQ(small, "abcde");
  copyText("abcd\xC3\xA9", small);  // the two bytes of e acute do not fit together
  EXPECT_STREQ(small, "abcd");
  copyText("", small);
  EXPECT_STREQ(small, "");
}

TEST(ViewText, StopsAtTheEndOfAnUnterminatedArray) {
  char full[3] = {'a', 'b', 'c'};
  EXPECT_EQ(viewText(full), "abc");
}

TEST(Shortened, EndsAtAWordAndSaysThatMoreFollows) {
  EXPECT_EQ(shortened("use 1 to 20 N", 13), "use 1 to 20 N") << "what fits stays";
  EXPECT_EQ(shortened("use 1 to 20 N", 12), "use 1 to...") << "20 must not become 2";
  EXPECT_EQ(shortened("use 1 to 20 N", 11), "use 1 to...");
  EXPECT_EQ(shortened("first\nsecond line", 10), "first...");
  EXPECT_EQ(shortened("a longwordthatdoesnotend", 10), "a longw...") << "a word that is most of the text is cut";
  EXPECT_EQ(shortened("abcd\xC3\xA9\xC3\xA9\xC3\xA9", 8), "abcd...") << "no half of a character";
  EXPECT_EQ(shortened("   ", 3), "   ");
  EXPECT_EQ(shortened("abc", 2), "ab");
}

TEST(EncodeReply, CutsTheReasonAtAWord) {
  Reply reply;
  reply.code = ReplyCode::invalid;
  reply.reason =
      "output.attributes has bits 0x80000000, which this version does not publish: use velocity (0x4), viscosity (0x20), "
      "density (0x40)";
  ASSERT_GT(reply.reason.size(), kMaxReasonBytes);
  const bleed_v1_Reply sample = encodeReply(reply);
  EXPECT_STREQ(sample.reason,
               "output.attributes has bits 0x80000000, which this version does not publish: use velocity (0x4), viscosity "
               "(0x20), density...");
}

TEST(EncodeReply, CutsTheReason) {
  Reply reply;
  reply.key = {{Uuid{4}, 5}, 6};
  reply.code = ReplyCode::invalid;
  reply.reason = std::string(400, 'x');
  const bleed_v1_Reply sample = encodeReply(reply);
  EXPECT_EQ(sample.client[0], 4);
  EXPECT_EQ(sample.run, 5U);
  EXPECT_EQ(sample.seq, 6U);
  EXPECT_EQ(sample.code, static_cast<std::uint32_t>(bleed_v1_REPLY_INVALID));
  EXPECT_EQ(std::string{sample.reason}, std::string(kMaxReasonBytes - 3, 'x') + "...");
}

TEST(StatusEncoder, CountsHeartbeatsAndCutsText) {
  StatusEncoder encoder{identity()};
  StatusReport report;
  report.text = std::string(1000, 'y');
  report.pace = {PaceMode::factor, 0.5};
  report.faults[static_cast<std::size_t>(sph::Counter::speed_clamped)] = 5;
  const std::vector<NamedCount> counts(80, NamedCount{"many", 1});
  EXPECT_EQ(encoder.encode(report, counts, {}).heartbeat, 1U);
  const std::int64_t before = transport::monotonicNow();
  const bleed_v1_Status& status = encoder.encode(report, counts, {});
  EXPECT_EQ(status.heartbeat, 2U);
  EXPECT_STREQ(status.session_name, "theatre");
  EXPECT_EQ(status.pid, 77);
  EXPECT_EQ(status.start_stamp_ns, 1234);
  EXPECT_EQ(std::strlen(status.text), 256U);
  ASSERT_EQ(status.counters._length, 64U);
  EXPECT_STREQ(status.counters._buffer[0].name, "speed_clamped");
  EXPECT_EQ(status.counters._buffer[0].value, 5U);
  EXPECT_EQ(status.pace_mode, static_cast<std::uint32_t>(bleed_v1_PACE_FACTOR));
  EXPECT_GE(status.monotonic_stamp_ns, before);
  EXPECT_LE(status.monotonic_stamp_ns, transport::monotonicNow());
}

TEST(StatusEncoder, TellsOfClientsAndTheLease) {
  StatusEncoder encoder{identity()};
  StatusReport report;
  const std::int64_t now = transport::monotonicNow();
  std::vector<ClientActivity> clients(2);
  clients[1] = {Uuid{9}, {1, 2, 3, 4, 5, 6}, now - 2'000'000'000};
  EXPECT_EQ(encoder.encode(report, {}, clients).lease_left_s, 0.0);
  report.lease_client = Uuid{9};
  report.lease_until_ns = now + 60'000'000'000;
  const bleed_v1_Status& status = encoder.encode(report, {}, clients);
  ASSERT_EQ(status.clients._length, 2U);
  const bleed_v1_ClientActivity& client = status.clients._buffer[1];
  EXPECT_EQ(client.client[0], 9);
  EXPECT_EQ(client.requests, 1U);
  EXPECT_EQ(client.refused, 2U);
  EXPECT_EQ(client.busy, 3U);
  EXPECT_EQ(client.resent, 4U);
  EXPECT_EQ(client.instrument_samples, 5U);
  EXPECT_EQ(client.instruments_rejected, 6U);
  EXPECT_GE(client.silent_s, 2.0);
  EXPECT_EQ(status.lease_client[0], 9);
  EXPECT_GT(status.lease_left_s, 0.0);
  EXPECT_LE(status.lease_left_s, 60.0);

  report.lease_until_ns = now - 1;
  EXPECT_EQ(encoder.encode(report, {}, {}).lease_client[0], 0) << "expired";
  EXPECT_EQ(encoder.encode(report, {}, {}).clients._length, 0U);
}

TEST(SceneEncoder, TellsUnitsAndBounds) {
  SceneEncoder encoder{identity()};
  SceneReport report;
  report.epoch = 3;
  report.text = "name: 'round'";
  report.loaded_text = "name: 'before'";
  report.effects = {"gravity", "pressure"};
  report.known_effects = {"gravity", "pressure", "viscosity"};
  report.particle_volume = 1e-9;
  report.domain.upper = {0.1, 0.2, 0.3};
  const bleed_v1_Scene& scene = encoder.encode(report);
  EXPECT_EQ(scene.epoch, 3U);
  EXPECT_STREQ(scene.length_unit, "m");
  EXPECT_STREQ(scene.scene_text, "name: 'round'");
  ASSERT_EQ(scene.effects._length, 2U);
  EXPECT_STREQ(scene.effects._buffer[1], "pressure");
  EXPECT_STREQ(scene.loaded_text, "name: 'before'");
  ASSERT_EQ(scene.known_effects._length, 3U);
  EXPECT_STREQ(scene.known_effects._buffer[2], "viscosity");
  EXPECT_DOUBLE_EQ(scene.particle_volume_ml, 1e-3);
  EXPECT_DOUBLE_EQ(scene.upper_bound.z, 0.3);
}

TEST(EncodeJournal, HoldsEachKindOfInput) {
  const Uuid session{1};
  bleed_v1_Request request{};
  request.seq = 12;
  request.body._d = bleed_v1_REQUEST_PAUSE;
  JournalEntry entry{2, 3, 4, 0.5, RequestTaken{std::make_unique<RequestCopy>(request), 6}};
  bleed_v1_Journal sample = encodeJournal(session, entry);
  EXPECT_EQ(sample.epoch, 2U);
  EXPECT_EQ(sample.number, 3U);
  EXPECT_EQ(sample.step, 4U);
  EXPECT_EQ(sample.body._d, static_cast<std::uint32_t>(bleed_v1_JOURNAL_REQUEST));
  EXPECT_EQ(sample.body._u.request.request.seq, 12U);
  EXPECT_EQ(sample.body._u.request.object_id, 6U);

  entry.input = InstrumentTaken{instrumentSample()};
  EXPECT_EQ(encodeJournal(session, entry).body._u.instrument.seq, 41U);
  entry.input = InstrumentEnded{{Uuid{8}, 2}, InstrumentEndReason::lost};
  EXPECT_EQ(encodeJournal(session, entry).body._u.instrument_end.reason,
            static_cast<std::uint32_t>(bleed_v1_INSTRUMENT_END_LOST));
  entry.input = Decision{std::string(300, 'z')};
  sample = encodeJournal(session, entry);
  EXPECT_EQ(std::strlen(sample.body._u.decision), 256U);
}

}  // namespace
}  // namespace bleedsim::dds
