#include "service/scene/nearest_name.h"

#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace bleedsim::scene {
namespace {

const std::vector<std::string> kNames{"radius_m", "width_m", "points_m"};

TEST(NearestName, FindsTheSmallestEditDistance) {
  EXPECT_EQ(nearestName("radius_mm", kNames), "radius_m");
  EXPECT_EQ(nearestName("radius", kNames), "radius_m");
  EXPECT_EQ(nearestName("widht_m", kNames), "width_m");
  EXPECT_EQ(nearestName("point_m", kNames), "points_m");
  EXPECT_EQ(nearestName("radius_m", kNames), "radius_m");
}

TEST(NearestName, KnowsANameWithoutItsUnit) {
  const std::vector<std::string> names{"viscous", "viscosity_pa_s"};
  EXPECT_EQ(nearestName("viscosity", names), "viscosity_pa_s");
  EXPECT_EQ(nearestName("viscos", names), "viscous");
  EXPECT_EQ(nearestName("", names), "");
}

TEST(NearestName, IsSilentAboutNamesUnlikeAny) {
  EXPECT_EQ(nearestName("xyzzy_plugh", kNames), "");
  EXPECT_EQ(nearestName("", {}), "");
  EXPECT_EQ(nearestName(std::string(100'000, 'r'), kNames), "") << "absurd lengths are not compared";
}

}  // namespace
}  // namespace bleedsim::scene
