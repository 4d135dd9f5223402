#include "service/sph/quad.h"

#include <gtest/gtest.h>
#include <limits>

namespace bleedsim::sph {
namespace {

template <class Real>
class QuadOf : public testing::Test {};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(QuadOf, Reals);

TYPED_TEST(QuadOf, LoadsStoresAndTurnsRowsIntoColumns) {
  using Q = Quad<TypeParam>;
  std::array<TypeParam, 17> from{};
  for (std::size_t k = 0; k < from.size(); ++k) from[k] = static_cast<TypeParam>(k);
  typename Q::Vector rows[4];
  for (std::size_t k = 0; k < 4; ++k) rows[k] = Q::load(from.data() + 1 + 4 * k);  // not aligned
  Q::transpose(rows[0], rows[1], rows[2], rows[3]);
  std::array<TypeParam, 4> column{};
  for (std::size_t k = 0; k < 4; ++k) {
    Q::store(rows[k], column.data());
    for (std::size_t lane = 0; lane < 4; ++lane) EXPECT_EQ(column[lane], from[1 + 4 * lane + k]);
  }
}

TYPED_TEST(QuadOf, AllWantsEveryLane) {
  using Q = Quad<TypeParam>;
  const auto one = Q::set(TypeParam(1));
  EXPECT_TRUE(Q::all(one <= one));
  for (int lane = 0; lane < 4; ++lane) {
    auto larger = one;
    larger[lane] = TypeParam(2);
    EXPECT_FALSE(Q::all(larger <= one)) << lane;
    auto none = one;
    none[lane] = std::numeric_limits<TypeParam>::quiet_NaN();
    EXPECT_FALSE(Q::all(none <= one)) << lane;
    EXPECT_EQ(Q::largest(larger), TypeParam(2));
    EXPECT_EQ(Q::least(-larger), TypeParam(-2));
  }
}

TEST(FourZeros, SeesEveryEntry) {
  std::array<std::uint32_t, 6> entries{};
  EXPECT_TRUE(fourZeros(entries.data() + 1));
  for (std::size_t k = 0; k < entries.size(); ++k) {
    entries = {};
    entries[k] = 0x80000000U;
    EXPECT_EQ(fourZeros(entries.data() + 1), k == 0 || k == 5) << k;
  }
}

}  // namespace
}  // namespace bleedsim::sph
