// The closed forms that the cases casson and carreau compare with are those of the design, physics.md section 5 case 7.
#include "service/lab/validation/thinning.h"

#include <cmath>
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

// What a disturbance does in time, against what does not depend on how it is computed: it ends at the profile, in the steady
// profile's own place it does not move, and mu_c, the thinnest that blood gets, bounds how fast: exp(-pi^2 nu t/(2 a)^2).
// Casson's profile is that of blood with a true yield stress; the solver's, and this one's, is regularised, which moves it by 0.4
// %.
TEST(PlaneFlowOfThinningBlood, ComesToItsProfileInTime) {
  for (const PlaneFlow& flow : {cassonFlow(), carreauFlow()}) {
    const auto off = [&](double part, double seconds) {
      const PlaneFlow then = flowAfter(flow, part, seconds);
      return then.at(0.0) / flow.largest - 1.0;
    };
    EXPECT_NEAR(off(1.0, 2.0), 0.0, 0.005);
    EXPECT_NEAR(off(0.9, 0.0), -0.1, 0.001);
    EXPECT_NEAR(off(0.9, 30.0), off(1.0, 30.0), 1e-4);
    const double least = 0.1 * std::exp(-9.87 * 0.07 / 1060.0 * 2.0 / 1e-4);  // of blood at rest, 0.07 Pa s
    const double most = 0.1 * std::exp(-9.87 * 0.00345 / 1060.0 * 2.0 / 1e-4);
    EXPECT_LT(off(0.9, 2.0), -least);
    EXPECT_GT(off(0.9, 2.0), -most - 0.005);
    EXPECT_DOUBLE_EQ(flowAfter(flow, 0.9, 2.0).at(kPlateHalf), 0.0);
  }
}

}  // namespace
}  // namespace bleedsim::lab
