// Damaged scenes: whatever the text, parseScene answers; what it accepts round-trips.
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <string_view>

#include "scene_text.h"
#include "service/scene/scene.h"

namespace bleedsim::scene {
namespace {

constexpr int kMutations = 2000;

void expectAnswer(const std::string& text) {
  const Result<SceneDescription> scene = parseScene(text);
  if (!scene.ok()) {
    EXPECT_EQ(scene.status().code(), StatusCode::invalid_argument);
    EXPECT_NE(scene.status().message().find(" problem"), std::string::npos) << scene.status().message();
    return;
  }
  const Result<SceneDescription> again = parseScene(scene->normalized_text);
  ASSERT_TRUE(again.ok()) << again.status().message() << "\n" << text;
  EXPECT_EQ(again->normalized_text, scene->normalized_text);
}

/// std::uniform_int_distribution differs between libraries; the bias of a remainder does not matter here.
std::size_t below(std::mt19937_64& random, std::size_t bound) { return static_cast<std::size_t>(random() % bound); }

TEST(DamagedScene, FlippedBytesAreAnswered) {
  std::mt19937_64 random{20'240'611};
  for (int i = 0; i < kMutations; ++i) {
    std::string text{kFullScene};
    const std::size_t flips = 1 + below(random, 4);
    for (std::size_t k = 0; k < flips; ++k) text[below(random, text.size())] ^= static_cast<char>(1u << below(random, 8));
    expectAnswer(text);
  }
}

TEST(DamagedScene, TruncatedAndSplicedTextsAreAnswered) {
  std::mt19937_64 random{7};
  for (int i = 0; i < kMutations; ++i) {
    const std::size_t cut = below(random, kFullScene.size());
    const std::size_t from = below(random, kFullScene.size());
    std::string text{kFullScene.substr(0, cut)};
    if (i % 2 == 0) text += kFullScene.substr(from);
    expectAnswer(text);
  }
}

TEST(DamagedScene, ForeignNumbersAreAnswered) {
  constexpr std::string_view kNumbers[] = {"nan",
                                           "-nan",
                                           "inf",
                                           "-inf",
                                           "1e308",
                                           "-1e308",
                                           "4.9e-324",
                                           "1e999",
                                           "-0",
                                           "0",
                                           "18446744073709551615",
                                           "-9223372036854775808",
                                           "0x7fffffff",
                                           "4294967296"};
  std::mt19937_64 random{11};
  for (int i = 0; i < kMutations; ++i) {
    std::string text{kFullScene};
    std::size_t start = text.find_first_of("0123456789", below(random, text.size()));
    if (start == std::string::npos) continue;
    const std::size_t end = text.find_first_not_of("0123456789.e-", start);
    const std::size_t number = below(random, std::size(kNumbers));
    text.replace(start, end - start, kNumbers[number]);
    expectAnswer(text);
  }
}

}  // namespace
}  // namespace bleedsim::scene
