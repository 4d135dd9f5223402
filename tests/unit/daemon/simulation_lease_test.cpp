// The exclusive lease, and wounds that clients share by name.
#include <gmock/gmock.h>

#include "tests/unit/daemon/simulation_fixture.h"

namespace bleedsim::daemon {
namespace {

using testing::HasSubstr;
using namespace std::chrono_literals;

class LeaseTest : public SimulationTest {
 protected:
  void SetUp() override { start(); }
  dds::StatusReport shown() { return channels_.board.read().report; }
};

TEST_F(LeaseTest, TheOthersMayOnlyWatch) {
  EXPECT_EQ(askAs(1, dds::AcquireLease{10.0}).code, dds::ReplyCode::accepted);
  EXPECT_EQ(shown().lease_client, dds::Uuid{1});
  const dds::Reply refused = askAs(2, dds::PauseSession{});
  EXPECT_EQ(refused.code, dds::ReplyCode::leased);
  EXPECT_THAT(refused.reason, HasSubstr("client 01000000 has the lease for up to 10.0 s more"));
  EXPECT_EQ(askAs(2, dds::AcquireLease{10.0}).code, dds::ReplyCode::leased);
  EXPECT_EQ(askAs(2, dds::ReleaseLease{}).code, dds::ReplyCode::leased);
  EXPECT_EQ(askAs(2, dds::ShutdownSession{}).code, dds::ReplyCode::leased);
  EXPECT_EQ(askAs(1, dds::PauseSession{}).code, dds::ReplyCode::accepted);
  EXPECT_EQ(askAs(1, dds::ReleaseLease{}).code, dds::ReplyCode::accepted);
  EXPECT_EQ(shown().lease_client, dds::Uuid{});
  EXPECT_LE(shown().lease_until_ns, 0);
  EXPECT_EQ(askAs(2, dds::ResumeSession{}).code, dds::ReplyCode::accepted);
  EXPECT_EQ(askAs(1, dds::ReleaseLease{}).code, dds::ReplyCode::state);
}

TEST_F(LeaseTest, ExpiresUnlessItIsAcquiredAgain) {
  askAs(1, dds::AcquireLease{10.0});
  now_ += 8s;
  EXPECT_EQ(askAs(1, dds::AcquireLease{10.0}).code, dds::ReplyCode::accepted);
  now_ += 8s;
  EXPECT_EQ(askAs(2, dds::PauseSession{}).code, dds::ReplyCode::leased);
  now_ += 2s;
  EXPECT_EQ(askAs(2, dds::PauseSession{}).code, dds::ReplyCode::accepted);
  EXPECT_EQ(askAs(2, dds::AcquireLease{10.0}).code, dds::ReplyCode::accepted);
}

TEST_F(LeaseTest, EndsWithItsHolder) {
  askAs(1, dds::AcquireLease{300.0});
  ASSERT_TRUE(channels_.commands.tryPush(WriterLost{2}));
  tick();
  EXPECT_EQ(askAs(2, dds::PauseSession{}).code, dds::ReplyCode::leased);
  ASSERT_TRUE(channels_.commands.tryPush(WriterLost{1}));
  tick();
  EXPECT_EQ(askAs(2, dds::PauseSession{}).code, dds::ReplyCode::accepted);
}

TEST_F(LeaseTest, InstrumentsOfOthersLetGo) {
  InstrumentInput mine = sample(1);  // of client 9
  ASSERT_TRUE(channels_.commands.tryPush(mine));
  tick();
  ASSERT_EQ(log_->forces.size(), 1U);
  channels_.clients.heard(dds::Uuid{9}, dds::ClientCount::instrument_samples, 1, 5);
  askAs(1, dds::AcquireLease{10.0});
  EXPECT_TRUE(log_->forces.empty());
  mine = sample(2);
  ASSERT_TRUE(channels_.commands.tryPush(mine));
  tick();
  EXPECT_TRUE(log_->forces.empty());
  EXPECT_EQ(channels_.counters.value(ServiceCounter::instruments_refused), 1U);
  std::array<dds::ClientActivity, dds::kMaxClients> clients;
  ASSERT_EQ(channels_.clients.read(clients), 1U);
  EXPECT_EQ(clients[0].counts[static_cast<std::size_t>(dds::ClientCount::instruments_rejected)], 1U);
}

TEST_F(LeaseTest, WoundsAreSharedByName) {
  const auto named = [](const std::string& name) { return sph::AddWound{{.name = name, .shape = sph::DiscPatch{0.01}}}; };
  EXPECT_EQ(askAs(1, named("liver")).object_id, 1U);
  EXPECT_EQ(askAs(1, named("spleen")).object_id, 2U);
  pushAs(2, sph::RemoveWound{}, "liver");
  tick();
  const dds::Reply removed = reply();
  EXPECT_EQ(removed.code, dds::ReplyCode::accepted) << removed.reason;
  EXPECT_EQ(removed.object_id, 1U);
  pushAs(2, sph::RemoveWound{}, "liver");
  tick();
  const dds::Reply gone = reply();
  EXPECT_EQ(gone.code, dds::ReplyCode::not_found);
  EXPECT_EQ(gone.reason, "there is no wound named 'liver'");
  sph::UpdateWound change;
  change.name = "liver";
  pushAs(2, change, "spleen");
  tick();
  reply();
  EXPECT_EQ(std::get<sph::UpdateWound>(log_->applied.back().second).wound_id, 2U);
}

TEST_F(LeaseTest, AFloodDoesNotKeepOthersWaiting) {
  for (int i = 0; i < 512; ++i) pushAs(1, dds::SetOutput{.frame_rate = 20.0, .attributes = {}});
  pushAs(2, dds::PauseSession{});
  const std::uint64_t mine = seq_;
  EXPECT_EQ(tick().kind, Simulation::Next::Kind::again);
  EXPECT_EQ(simulation_->world().stepCount(), 0U) << "paused at once";
  bool answered = false;
  int replies = 0;
  for (dds::Reply out; channels_.replies.tryPop(out); ++replies) answered = answered || out.key.seq == mine;
  EXPECT_TRUE(answered);
  EXPECT_LT(replies, 512) << "one step takes a bounded number";
  while (tick().kind == Simulation::Next::Kind::again) {}
  for (dds::Reply out; channels_.replies.tryPop(out);) ++replies;
  EXPECT_EQ(replies, 513);
}

}  // namespace
}  // namespace bleedsim::daemon
