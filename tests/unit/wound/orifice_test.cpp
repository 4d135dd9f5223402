#include "service/sph/wound/orifice.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <string>

#include "service/status/quantity_limits.h"
#include "service/status/units.h"

namespace bleedsim::sph {
namespace {

constexpr double kDensity = 1060.0;

double flowMlPerS(double diameter, double mmhg, double coefficient) {
  const double area = 0.25 * std::numbers::pi * diameter * diameter;
  return 1e6 * driveFlow(PressureDriveSettings{pascalsFromMmHg(mmhg), coefficient}, area, kDensity);
}

TEST(Orifice, MatchesThePublishedFlows) {
  EXPECT_NEAR(flowMlPerS(0.002, 10.0, 0.61), 3.0, 0.05);
  EXPECT_NEAR(flowMlPerS(0.002, 10.0, 0.97), 4.8, 0.05);
  EXPECT_NEAR(flowMlPerS(0.002, 100.0, 0.61), 9.6, 0.05);
  EXPECT_NEAR(flowMlPerS(0.002, 100.0, 0.97), 15.3, 0.05);
}

TEST(Orifice, NoPressureNoFlow) {
  EXPECT_EQ(orificeSpeed(0.0, 0.61, kDensity), 0.0);
  EXPECT_EQ(orificeSpeed(-5.0, 0.61, kDensity), 0.0);
  EXPECT_EQ(driveFlow(FlowDrive{2e-6}, 1.0, kDensity), 2e-6);
}

TEST(Orifice, DrivesAreChecked) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(checkDrive(FlowDrive{0.0}).ok());
  EXPECT_TRUE(checkDrive(PressureDriveSettings{0.0, 1.0}).ok());
  for (const WoundDrive& bad : {WoundDrive{FlowDrive{-1e-9}}, WoundDrive{FlowDrive{nan}}, WoundDrive{FlowDrive{inf}},
                                WoundDrive{PressureDriveSettings{-1.0, 0.61}}, WoundDrive{PressureDriveSettings{nan, 0.61}},
                                WoundDrive{PressureDriveSettings{inf, 0.61}}, WoundDrive{PressureDriveSettings{100.0, 0.0}},
                                WoundDrive{PressureDriveSettings{100.0, 0.099}}, WoundDrive{PressureDriveSettings{100.0, 1.01}},
                                WoundDrive{PressureDriveSettings{100.0, nan}}}) {
    EXPECT_EQ(checkDrive(bad).code(), StatusCode::invalid_argument);
  }
}

TEST(Orifice, DrivesHaveTheRangesOfScenesAndRequests) {
  // As they are converted there, so that an end of a range is in it.
  const auto flow = [](double ml_per_s) { return checkDrive(FlowDrive{cubicMetresFromMl(ml_per_s)}); };
  const auto pressure = [](double mmhg, double coefficient) {
    return checkDrive(PressureDriveSettings{pascalsFromMmHg(mmhg), coefficient});
  };
  for (const double share : {0.0, 0.3, 0.7, 1.0}) {
    EXPECT_TRUE(flow(kFlow.lower + share * (kFlow.upper - kFlow.lower)).ok()) << share;
    EXPECT_TRUE(pressure(share * kInletPressure.upper, kDischargeCoefficient.lower).ok()) << share;
  }
  EXPECT_TRUE(pressure(10.0, kDischargeCoefficient.upper).ok());
  EXPECT_EQ(flow(1.001 * kFlow.upper).message(), "wound flow is 1001 mL/s; allowed are 0 to 1000 mL/s");
  EXPECT_EQ(pressure(1.5 * kInletPressure.upper, 0.61).message(),
            "wound inlet pressure is 1500 mmHg; allowed are 0 to 1000 mmHg");
  EXPECT_EQ(pressure(10.0, 0.05).message(), "wound discharge coefficient is 0.05; allowed are 0.1 to 1");
}

TEST(Orifice, SpeedRefusalNamesWhatWouldBeNeededAndAccepted) {
  EXPECT_TRUE(checkSpeed({.speed = 0.3, .limit = 0.3}, FlowDrive{1e-6}).ok());
  const Status flow = checkSpeed({.speed = 0.6, .limit = 0.3}, FlowDrive{4e-6});
  EXPECT_EQ(flow.code(), StatusCode::invalid_argument);
  EXPECT_LE(flow.message().size(), 127u) << "a reply would cut it";
  EXPECT_NE(flow.message().find("0.6 m/s"), std::string::npos) << flow.message();
  EXPECT_NE(flow.message().find("0.3 m/s"), std::string::npos) << flow.message();
  EXPECT_NE(flow.message().find("at most 2 mL/s"), std::string::npos) << flow.message();
  EXPECT_NE(flow.message().find("design_speed_m_per_s of at least 0.6"), std::string::npos) << flow.message();

  const Status pressure = checkSpeed({.speed = 1.23456, .limit = 0.61728}, PressureDriveSettings{pascalsFromMmHg(40.0), 0.61});
  EXPECT_NE(pressure.message().find("at most 10 mmHg"), std::string::npos) << pressure.message();
  EXPECT_NE(pressure.message().find("at least 1.24"), std::string::npos) << pressure.message();
}

}  // namespace
}  // namespace bleedsim::sph
