// The closed forms that the cases casson and carreau compare with are those of the design, physics.md section 5 case 7.
#include "service/lab/validation/thinning.h"

#include <gtest/gtest.h>

namespace bleedsim::lab {
namespace {

TEST(PlaneFlowOfThinningBlood, ProfilesAreThoseOfTheDesign) {
  const PlaneFlow casson = cassonFlow();
  EXPECT_NEAR(casson.largest, 0.0126, 5e-5);
  EXPECT_NEAR(casson.largest / meanSpeed(casson), 1.356, 1e-3);
  const PlaneFlow carreau = carreauFlow();
  EXPECT_NEAR(carreau.largest, 0.02716, 2e-5);
  EXPECT_NEAR(meanSpeed(carreau), 0.020, 2e-5);
  EXPECT_NEAR(carreau.at(0.5 * kPlateHalf) / carreau.largest, 0.860, 1e-3);
  EXPECT_NEAR(carreau.at(0.9 * kPlateHalf) / carreau.largest, 0.249, 1e-3);
}

}  // namespace
}  // namespace bleedsim::lab
