#include "service/daemon/client_ledger.h"

#include <gtest/gtest.h>

namespace bleedsim::daemon {
namespace {

using dds::ClientCount;
using dds::Uuid;

class ClientLedgerTest : public testing::Test {
 protected:
  std::span<const dds::ClientActivity> read() {
    const std::size_t count = ledger_.read(activities_);
    return std::span{activities_}.first(count);
  }
  static std::uint64_t of(const dds::ClientActivity& activity, ClientCount what) {
    return activity.counts[static_cast<std::size_t>(what)];
  }

  ClientLedger ledger_;
  std::array<dds::ClientActivity, dds::kMaxClients> activities_{};
};

TEST_F(ClientLedgerTest, CountsByClient) {
  ledger_.heard(Uuid{1}, ClientCount::requests, 10, 7);
  ledger_.heard(Uuid{2}, ClientCount::instrument_samples, 20, 7);
  ledger_.heard(Uuid{1}, ClientCount::requests, 30, 7);
  ledger_.note(Uuid{1}, ClientCount::busy);
  ledger_.note(Uuid{3}, ClientCount::busy);
  const auto clients = read();
  ASSERT_EQ(clients.size(), 2U);
  EXPECT_EQ(clients[0].client, Uuid{1});
  EXPECT_EQ(of(clients[0], ClientCount::requests), 2U);
  EXPECT_EQ(of(clients[0], ClientCount::busy), 1U);
  EXPECT_EQ(clients[0].last_heard_ns, 30);
  EXPECT_EQ(of(clients[1], ClientCount::instrument_samples), 1U);
}

TEST_F(ClientLedgerTest, ForgetsTheOneThatWasSilentLongest) {
  for (std::uint8_t i = 1; i <= dds::kMaxClients; ++i) ledger_.heard(Uuid{i}, ClientCount::requests, i, 7);
  ledger_.heard(Uuid{1}, ClientCount::requests, 100, 7);
  ledger_.heard(Uuid{200}, ClientCount::requests, 101, 7);
  const auto clients = read();
  ASSERT_EQ(clients.size(), dds::kMaxClients);
  EXPECT_EQ(clients[0].client, Uuid{1});
  EXPECT_EQ(clients[1].client, Uuid{3}) << "2 was silent longest";
  EXPECT_EQ(clients.back().client, Uuid{200});
}

TEST_F(ClientLedgerTest, WhoMakesUpClientsPushesOutHisOwn) {
  ledger_.heard(Uuid{1}, ClientCount::requests, 1, 1);
  ledger_.heard(Uuid{2}, ClientCount::requests, 2, 2);
  for (std::uint8_t i = 10; i < 200; ++i) ledger_.heard(Uuid{i}, ClientCount::requests, i, 9);
  const auto clients = read();
  ASSERT_EQ(clients.size(), dds::kMaxClients);
  EXPECT_EQ(clients[0].client, Uuid{1});
  EXPECT_EQ(clients[1].client, Uuid{2});
  EXPECT_EQ(clients.back().client, Uuid{199});
}

}  // namespace
}  // namespace bleedsim::daemon
