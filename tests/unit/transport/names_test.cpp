#include "service/transport/names.h"

#include <gtest/gtest.h>
#include <set>
#include <string>

#include "service/transport/uuid.h"

namespace bleedsim::transport {
namespace {

TEST(SessionName, AcceptsLettersDigitsUnderscoreAndDash) {
  EXPECT_TRUE(validSessionName("bleed"));
  EXPECT_TRUE(validSessionName("OR-2_left"));
  EXPECT_TRUE(validSessionName(std::string(64, 'x')));
}

TEST(SessionName, RefusesWildcardsSeparatorsAndLengths) {
  for (const char* name : {"", "*", "a*", "a?b", "a b", "a/b", "a.b", "a[b]", "\xc3\xa4", "a\n"}) {
    EXPECT_FALSE(validSessionName(name)) << name;
    EXPECT_EQ(checkSessionName(name).code(), StatusCode::invalid_argument);
  }
  EXPECT_FALSE(validSessionName(std::string(65, 'x')));
  EXPECT_FALSE(validSessionName(std::string_view{"a\0b", 3}));
}

TEST(TopicName, CarriesTheProtocolVersionAndOnlyAllowedCharacters) {
  std::set<std::string> seen;
  for (const Topic topic : kTopics) {
    const std::string name = topicName(topic);
    EXPECT_EQ(name.rfind("bleed/v1/", 0), 0U) << name;
    EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_/"), std::string::npos) << name;
    EXPECT_TRUE(seen.insert(name).second) << name;
  }
  EXPECT_EQ(seen.size(), 8U);
}

TEST(Uuid, IsRandomVersionFourAndPrintsInGroups) {
  const Uuid a = drawUuid();
  const Uuid b = drawUuid();
  EXPECT_NE(a, b);
  EXPECT_EQ(a[6] >> 4U, 4);
  EXPECT_EQ(a[8] >> 6U, 2);
  const Uuid fixed{0x01, 0x23, 0x45, 0x67, 0x89, 0xab, 0x4d, 0xef, 0x80, 1, 2, 3, 4, 5, 6, 7};
  EXPECT_EQ(toString(fixed), "01234567-89ab-4def-8001-020304050607");
  EXPECT_NE(drawRun(), drawRun());
}

}  // namespace
}  // namespace bleedsim::transport
