#include "service/sph/tissue/tissue_field.h"

#include <limits>

#include "tests/unit/tissue/tissue_fixture.h"

namespace bleedsim::sph {
namespace {

constexpr double kRatio = 2.5;
constexpr double kReach = kRatio * kSpacing;

const PlaneShape kFloor{};

PlaneShape wallAt(double degrees) {  // rises from the floor at x = 0, with that angle of blood between the two
  const double angle = degrees * std::numbers::pi / 180.0;
  return {.normal = {std::sin(angle), 0.0, -std::cos(angle)}};
}

const BowlShape kBowl{.sphere_radius = 12 * kSpacing, .depth = 5 * kSpacing};
const BoxShape kBlock{
    .lower = Vec3::Constant(-4 * kSpacing), .upper = {4 * kSpacing, 5 * kSpacing, 1.5 * kSpacing}, .obstacle = true};

TEST(TissueField, emptyTouchesNothing) {
  const auto field = fieldOf<float>({}, kRatio);
  WallSample<float> wall;
  EXPECT_TRUE(field.empty());
  EXPECT_FALSE(field.sample(0, 0, 0, wall));
  std::array<float, 3> position{0, 0, -1};
  std::array<float, 3> normal{};
  EXPECT_FALSE(field.project(position, normal));
}

TEST(TissueField, planeGivesItsTable) {
  const auto field = fieldOf<double>({tissueOf(PlaneShape{.normal = {0, 0, 3}})}, kRatio);
  const auto slippery = fieldOf<double>({tissueOf(kFloor, 0.75)}, kRatio);
  for (const double d : {0.1, 0.3, 0.5, 1.4}) {
    WallSample<double> wall;
    ASSERT_TRUE(field.sample(0.3, -0.2, d * kSpacing, wall));
    const Share<double> plane = planeShare(settingsFor(kRatio), d * kSpacing);
    EXPECT_NEAR(wall.distance, d * kSpacing, 1e-15);
    EXPECT_NEAR(wall.share, plane.share, 1e-5);
    EXPECT_NEAR(wall.gradient[2] * kSpacing, plane.slope * kSpacing, 1e-4);
    EXPECT_EQ(wall.gradient[0], 0.0);
    const double friction = plane.friction + plane.friction_depth / (std::max(d, 0.25) * kSpacing);
    EXPECT_NEAR(wall.friction / friction, 1.0, 1e-3);
    EXPECT_NEAR(wall.spring[2], std::max(0.0, 0.5 - d) / kSpacing, 1e-9);
    WallSample<double> eased;
    ASSERT_TRUE(slippery.sample(0.3, -0.2, d * kSpacing, eased));
    EXPECT_NEAR(eased.friction / wall.friction, 0.25, 1e-12);
    EXPECT_NEAR(eased.share, wall.share, 1e-15);
  }
  WallSample<double> wall;
  EXPECT_FALSE(field.sample(0, 0, kReach * 1.0001, wall));
  EXPECT_FALSE(field.sample(0, 0, std::numeric_limits<double>::quiet_NaN(), wall));
  EXPECT_TRUE(field.sample(0, 0, -10 * kReach, wall)) << "inside the tissue";
}

constexpr auto kNowhere = TissueField<float>::Nearness::none;
constexpr auto kAnything = TissueField<float>::Nearness::any;

// Whole boxes are passed over where nearby() has no wall: no point of such a box may touch. And it is of use: boxes as small as a
// cell that lie deep in the blood, or beyond a bowl's rim, are passed over.
TEST(TissueField, boxesThatAreOutOfReachHoldNoTouchingPoint) {
  PointStream stream;
  for (const TissueShape& shape : {TissueShape{wallAt(70.0)}, TissueShape{kBowl}, TissueShape{kBlock}}) {
    const auto field = fieldOf<float>({tissueOf(shape)}, kRatio);
    int out_of_reach = 0;
    for (int k = 0; k < 2000; ++k) {
      const Vec3 lower = stream.nextPoint(-14 * kSpacing, 14 * kSpacing);
      const Vec3 upper = lower + stream.nextPoint(0.0, 2 * kReach);
      const std::array<float, 3> from{float(lower.x()), float(lower.y()), float(lower.z())};
      const std::array<float, 3> to{float(upper.x()), float(upper.y()), float(upper.z())};
      if (field.nearby(from, to).nearness != kNowhere) continue;
      ++out_of_reach;
      WallSample<float> wall;
      for (int corner = 0; corner < 8; ++corner) {
        EXPECT_FALSE(field.sample((corner & 1 ? to : from)[0], (corner & 2 ? to : from)[1], (corner & 4 ? to : from)[2], wall));
      }
      for (int inner = 0; inner < 8; ++inner) {
        const auto within = [&](Eigen::Index a) { return float(stream.next(lower[a], upper[a])); };
        const float x = within(0);
        const float y = within(1);
        EXPECT_FALSE(field.sample(x, y, within(2), wall));
      }
    }
    EXPECT_GT(out_of_reach, 50);
  }
  const auto field = fieldOf<float>({tissueOf(kFloor)}, kRatio);
  const auto reach = static_cast<float>(kReach);
  EXPECT_NE(field.nearby({0, 0, 0.9f * reach}, {1, 1, 1}).nearness, kNowhere);
  EXPECT_EQ(field.nearby({0, 0, 1.01f * reach}, {1, 1, 1}).nearness, kNowhere);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(field.nearby({nan, 0, 1}, {nan, 1, 2}).nearness, kAnything) << "its particles are asked one by one";
}

struct LoneSample {
  bool touches = false;
  WallSample<float> wall;
};

template <TissueField<float>::Nearness kNearness>
LoneSample sampleLone(const TissueField<float>& field, const TissueField<float>::Nearby& near, const std::array<float, 3>& x,
                      float radius) {
  LoneSample result{field.touchesLone<kNearness>(near, x[0], x[1], x[2]), {}};
  if (result.touches) field.sampleLone<kNearness>(near, x[0], x[1], x[2], result.wall, radius);
  return result;
}

void expectSame(const WallSample<float>& lone, const WallSample<float>& full) {
  EXPECT_EQ(lone.distance, full.distance);
  EXPECT_EQ(lone.normal, full.normal);
  EXPECT_EQ(lone.share, full.share);
  EXPECT_EQ(lone.gradient, full.gradient);
  EXPECT_EQ(lone.friction, full.friction);
  EXPECT_EQ(lone.spring, full.spring);
  EXPECT_EQ(lone.grip, full.grip);
}

// Where one wall stands alone it is asked without the others, and must answer what all of them do, at every radius. Box: a bowl
// in a room with a ramp, so that both kinds of lone walls and their neighbours occur.
TEST(TissueField, aLoneWallAnswersAsAllOfThemDo) {
  ShareSettings settings = settingsFor(kRatio);
  settings.radii = {0.9, 1.3};
  const TissueShape ramp = PlaneShape{.point = {8 * kSpacing, 0, 0}, .normal = {-1, 0, 0.5}};
  const BowlShape bowl{.sphere_radius = 12 * kSpacing, .depth = 9 * kSpacing};
  const auto created = TissueField<float>::create({tissueOf(ramp, 0.25), tissueOf(bowl, 0.5)}, settings);
  ASSERT_TRUE(created.ok()) << created.status().message();
  const TissueField<float>& field = *created;
  using Nearness = TissueField<float>::Nearness;
  std::array<int, 4> boxes{};
  std::array<int, 4> touching{};
  PointStream stream;
  for (int k = 0; k < 4000; ++k) {
    const Vec3 lower = stream.nextPoint(-12 * kSpacing, 12 * kSpacing);
    const Vec3 upper = lower + stream.nextPoint(0.0, kReach);
    const std::array<float, 3> from{float(lower.x()), float(lower.y()), float(lower.z())};
    const std::array<float, 3> to{float(upper.x()), float(upper.y()), float(upper.z())};
    const auto near = field.nearby(from, to);
    const auto kind = static_cast<std::size_t>(near.nearness);
    ++boxes[kind];
    if (near.nearness != Nearness::plane && near.nearness != Nearness::hollow) continue;
    for (int inner = 0; inner < 8; ++inner) {
      std::array<float, 3> x{};
      for (std::size_t a = 0; a < 3; ++a) x[a] = std::clamp(float(stream.next(double(from[a]), double(to[a]))), from[a], to[a]);
      const float radius = float(stream.next(0.9, 1.3));
      WallSample<float> full;
      const bool touches = field.sample(x[0], x[1], x[2], full, radius);
      const LoneSample lone = near.nearness == Nearness::plane ? sampleLone<Nearness::plane>(field, near, x, radius)
                                                               : sampleLone<Nearness::hollow>(field, near, x, radius);
      ASSERT_EQ(lone.touches, touches);
      if (!touches) continue;
      ++touching[kind];
      expectSame(lone.wall, full);
    }
  }
  for (const int count : boxes) EXPECT_GT(count, 50);
  EXPECT_GT(touching[static_cast<std::size_t>(Nearness::plane)], 500);
  EXPECT_GT(touching[static_cast<std::size_t>(Nearness::hollow)], 500);
}

// grad L is the derivative of L, whatever meets: perpendicular faces, wedges, a bowl's hollow and rim, a block's edges.
TEST(TissueField, gradientIsTheDerivativeOfTheShare) {
  BoxShape box{.upper = Vec3::Constant(8 * kSpacing)};
  const std::vector<std::pair<const char*, std::vector<TissueDescription>>> scenes{
      {"container", {tissueOf(box)}},
      {"wedge 40", {tissueOf(kFloor), tissueOf(wallAt(40))}},
      {"wedge 60", {tissueOf(kFloor), tissueOf(wallAt(60))}},
      {"wedge 130", {tissueOf(kFloor), tissueOf(wallAt(130))}},
      {"three", {tissueOf(kFloor), tissueOf(wallAt(60)), tissueOf(PlaneShape{.normal = Vec3(0.2, 0.9, 0.1)})}},
      {"gap", {tissueOf(kFloor), tissueOf(PlaneShape{.point = {0, 0, 1.5 * kSpacing}, .normal = {0, 0, -1}})}},
      {"bowl", {tissueOf(kBowl)}},
      {"block", {tissueOf(kBlock)}}};
  const double step = 2.0 * kReach / (ShareTable<double>::kNodes - 1);  // below it the table's straight pieces show
  for (const auto& [name, tissue] : scenes) {
    const auto field = fieldOf<double>(tissue, kRatio);
    PointStream points;
    int compared = 0;
    double worst = 0.0;
    double squares = 0.0;
    for (int n = 0; n < 20000; ++n) {
      const Vec3 p = points.nextPoint(-14 * kSpacing, 14 * kSpacing);
      WallSample<double> wall;
      const double distance = field.distance(p.x(), p.y(), p.z());
      if (!(distance > 0.05 * kSpacing && distance < kReach)) continue;
      if (!field.sample(p.x(), p.y(), p.z(), wall)) continue;
      Vec3 slope;
      for (int axis = 0; axis < 3; ++axis) {
        WallSample<double> more;
        WallSample<double> less;
        const Vec3 a = p + step * Vec3::Unit(axis);
        const Vec3 b = p - step * Vec3::Unit(axis);
        const double upper = field.sample(a.x(), a.y(), a.z(), more) ? more.share : 0.0;
        const double lower = field.sample(b.x(), b.y(), b.z(), less) ? less.share : 0.0;
        slope[axis] = (upper - lower) / (2.0 * step);
      }
      const double error = kSpacing * (slope - Vec3(wall.gradient[0], wall.gradient[1], wall.gradient[2])).norm();
      ++compared;
      worst = std::max(worst, error);
      squares += error * error;
    }
    EXPECT_GT(compared, 50) << name;
    EXPECT_LT(std::sqrt(squares / compared), 5e-4) << name;
    EXPECT_LT(worst, 0.02) << name << ": differences across the kinks of min and max are larger";
  }
}

// A free-slip wall beside a no-slip one: each brings its own friction, with the weight of its share.
TEST(TissueField, cornersWeighTheFriction) {
  const auto field = fieldOf<double>({tissueOf(kFloor), tissueOf(PlaneShape{.normal = {1, 0, 0}}, 1.0)}, kRatio);
  const auto floor_only = fieldOf<double>({tissueOf(kFloor)}, kRatio);
  WallSample<double> corner;
  WallSample<double> floor;
  ASSERT_TRUE(field.sample(0.4 * kSpacing, 0, 0.5 * kSpacing, corner));
  ASSERT_TRUE(floor_only.sample(0.4 * kSpacing, 0, 0.5 * kSpacing, floor));
  const double side = planeShare(settingsFor(kRatio), 0.4 * kSpacing).share;
  EXPECT_NEAR(corner.friction / floor.friction, 1.0 - side, 1e-4);
  EXPECT_NEAR(corner.share, 1.0 - (1.0 - floor.share) * (1.0 - side), 1e-5);
  EXPECT_NEAR(corner.spring[0] * kSpacing, 0.1, 1e-9) << "each plane pushes on its own";
  EXPECT_NEAR(corner.spring[2], 0.0, 1e-9);
  EXPECT_NEAR(corner.distance, 0.4 * kSpacing, 1e-12);
  EXPECT_EQ(corner.normal[0], 1.0);
}

TEST(TissueField, theSameWallTwiceIsOneWall) {
  const auto once = fieldOf<double>({tissueOf(kFloor)}, kRatio);
  const auto twice = fieldOf<double>({tissueOf(kFloor), tissueOf(kFloor)}, kRatio);
  WallSample<double> a;
  WallSample<double> b;
  ASSERT_TRUE(once.sample(0, 0, 0.7 * kSpacing, a));
  ASSERT_TRUE(twice.sample(0, 0, 0.7 * kSpacing, b));
  EXPECT_NEAR(a.share, b.share, 1e-6);
  EXPECT_NEAR(a.gradient[2] / b.gradient[2], 1.0, 1e-6);
  EXPECT_NEAR(a.friction / b.friction, 1.0, 1e-6);
}

TEST(TissueField, bowlIsItsHollowDeepInsideAndAPlaneFarOutside) {
  const auto field = fieldOf<double>({tissueOf(kBowl)}, kRatio);
  const ShareTable<double> hollow{settingsFor(kRatio), 1.0 / kBowl.sphere_radius};
  const Share<double> plane = planeShare(settingsFor(kRatio), 0.5 * kSpacing);
  WallSample<double> wall;
  ASSERT_TRUE(field.sample(0, 0, -4.5 * kSpacing, wall));
  EXPECT_NEAR(wall.share, hollow.at(0.5 * kSpacing).share, 1e-9);
  EXPECT_GT(wall.share, plane.share);
  EXPECT_LT(wall.gradient[2], 0.0);
  const double hollow_friction = wall.friction;
  ASSERT_TRUE(field.sample(30 * kSpacing, 0, 0.5 * kSpacing, wall));
  EXPECT_NEAR(wall.share, plane.share, 1e-5);
  EXPECT_LT(hollow_friction, wall.friction) << "a hollow has more wall within reach";
  EXPECT_FALSE(field.sample(0, 0, 0, wall));
}

TEST(TissueField, floatFollowsDouble) {
  const std::vector<TissueDescription> tissue{tissueOf(kFloor, 0.3), tissueOf(wallAt(70)), tissueOf(kBlock), tissueOf(kBowl)};
  const auto single = fieldOf<float>(tissue, kRatio);
  const auto reference = fieldOf<double>(tissue, kRatio);
  PointStream points;
  int compared = 0;
  for (int n = 0; n < 3000; ++n) {
    const Vec3 p = points.nextPoint(-8 * kSpacing, 8 * kSpacing).cast<float>().cast<double>();
    const double distance = reference.distance(p.x(), p.y(), p.z());
    WallSample<double> exact;
    WallSample<float> wall;
    const Eigen::Vector3f q = p.cast<float>();
    const bool touched = single.sample(q.x(), q.y(), q.z(), wall);
    EXPECT_TRUE(std::isfinite(wall.share) && std::isfinite(wall.friction));
    if (!(distance > 0.01 * kSpacing && distance < 0.99 * kReach)) continue;
    if (!reference.sample(p.x(), p.y(), p.z(), exact)) continue;
    ASSERT_TRUE(touched || exact.share < 1e-6);
    ++compared;
    EXPECT_NEAR(static_cast<double>(wall.share), exact.share, 5e-6);
    EXPECT_NEAR(static_cast<double>(wall.distance), exact.distance, 1e-5 * kSpacing);
    if (exact.share < 1e-3) continue;
    EXPECT_NEAR(static_cast<double>(wall.friction) / exact.friction, 1.0, 1e-3);
  }
  EXPECT_GT(compared, 200);
}

TEST(TissueField, everyValueIsFiniteAndInRangeEverywhere) {
  const std::vector<TissueDescription> tissue{tissueOf(kFloor), tissueOf(wallAt(20)), tissueOf(wallAt(155)), tissueOf(kBlock),
                                              tissueOf(kBowl)};
  const auto field = fieldOf<float>(tissue, 2.0);
  PointStream points;
  for (int n = 0; n < 5000; ++n) {
    const Eigen::Vector3f p = points.nextPoint(-16 * kSpacing, 16 * kSpacing).cast<float>();
    WallSample<float> wall;
    if (!field.sample(p.x(), p.y(), p.z(), wall)) continue;
    EXPECT_GE(wall.share, 0.0f);
    EXPECT_LE(wall.share, 1.0f);
    EXPECT_LE(wall.friction, 0.0f);
    EXPECT_NEAR(vectorLength(wall.normal[0], wall.normal[1], wall.normal[2]), 1.0f, 1e-5f);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_TRUE(std::isfinite(wall.gradient[axis]));
      EXPECT_TRUE(std::isfinite(wall.spring[axis]));
    }
  }
}

}  // namespace
}  // namespace bleedsim::sph
