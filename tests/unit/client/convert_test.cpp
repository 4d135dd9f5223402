// Samples of the wire as values of the library.
#include "clients/lib/convert.h"

#include <cstring>
#include <gtest/gtest.h>

namespace bleedsim::client {
namespace {

TEST(FromWire, TextsEndWithTheirMembers) {
  bleed_v1_Status status{};
  std::memset(status.host, 'h', sizeof status.host);
  std::memset(status.text, 't', sizeof status.text);
  EXPECT_EQ(fromWire(status).host, std::string(sizeof status.host, 'h'));
  EXPECT_EQ(fromWire(status).text, std::string(sizeof status.text, 't'));
}

TEST(FromWire, NumbersOfALaterVersionAreNamedAsThat) {
  bleed_v1_Status status{};
  status.state = bleed_v1_STATE_STOPPED;
  EXPECT_STREQ(toString(fromWire(status).state), "stopped");
  status.state = bleed_v1_STATE_STOPPED + 1;
  EXPECT_STREQ(toString(fromWire(status).state), "unknown");
  status.state = 0xFFFFFFFF;
  EXPECT_STREQ(toString(fromWire(status).state), "unknown");
  bleed_v1_Reply reply{};
  reply.code = bleed_v1_REPLY_LEASED + 1;
  EXPECT_EQ(fromWire(reply).code, ReplyCode::failed);
}

TEST(FromWire, AListWithALengthAndNoDataIsEmpty) {
  bleed_v1_Scene scene{};
  scene.effects = {3, 3, nullptr, false};
  EXPECT_TRUE(fromWire(scene).effects.empty());
  EXPECT_EQ(fromWire(scene).text, "");
}

}  // namespace
}  // namespace bleedsim::client
