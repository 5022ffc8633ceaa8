// Kinematic analysis: sliding, wedges and toppling against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "blocks/kinematics.hpp"
#include "blocks/removability.hpp"
#include "scenes.hpp"

namespace {

using namespace talus;
using namespace talus::test;

Attitude plane(double dip_deg, double direction_deg) {
  return {dip_deg * degree, direction_deg * degree};
}

const Vec3 steep_face = pole(60 * degree, 135 * degree);
constexpr double phi = 30 * degree;

KinematicSet scattered(double dip_deg, double direction_deg, double k, int n) {
  KinematicSet set;
  set.name = "J";
  set.mean = plane(dip_deg, direction_deg);
  set.friction = std::tan(phi);
  Random random(7, "test");
  const Vec3 mean = pole(set.mean.dip, set.mean.dip_direction);
  for (int i = 0; i < n; ++i) set.draws.push_back(attitude(draw_fisher(mean, k, random)));
  return set;
}

}  // namespace

TEST(Kinematics, PlaneSlidesWhereItDaylightsAndIsSteeperThanFriction) {
  EXPECT_TRUE(slides_on_plane(plane(45, 135), steep_face, phi));
  EXPECT_FALSE(slides_on_plane(plane(65, 135), steep_face, phi));
  EXPECT_FALSE(slides_on_plane(plane(28, 135), steep_face, phi));
  EXPECT_TRUE(slides_on_plane(plane(45, 160), steep_face, phi));
  const std::vector<FacePiece> piece = {{steep_face, 1}};
  const auto shares = [&](double direction) {
    return kinematics_of(piece, {{"J", plane(45, direction), {}, std::tan(phi)}}).sets[0];
  };
  EXPECT_EQ(shares(135).sliding_lateral.mean, 1);
  EXPECT_EQ(shares(160).sliding.mean, 1);
  EXPECT_EQ(shares(160).sliding_lateral.mean, 0);
}

// t . m > 0 is the same as a dip below the apparent slope.
TEST(Kinematics, DaylightIsADipBelowTheApparentSlope) {
  Random random(3, "apparent");
  for (int k = 0; k < 100000; ++k) {
    const double slope = random.uniform(1, 89) * degree, aspect = random.uniform(0, 360) * degree;
    const double dip = random.uniform(0, 90) * degree, azimuth = random.uniform(0, 360) * degree;
    const double apparent = std::atan(std::tan(slope) * std::cos(azimuth - aspect));
    ASSERT_EQ(slides_on_plane({dip, azimuth}, pole(slope, aspect), 0), dip > 0 && dip < apparent)
        << dip << " " << apparent;
  }
}

TEST(Kinematics, LayersToppleBeyondTheSlipLimitAndWithinThirtyDegrees) {
  EXPECT_TRUE(topples(plane(70, 315), steep_face, phi));
  EXPECT_TRUE(topples(plane(80, 315), steep_face, phi));
  EXPECT_TRUE(topples(plane(80, 340), steep_face, phi));
  EXPECT_FALSE(topples(plane(59, 315), steep_face, phi));
  EXPECT_TRUE(topples(plane(61, 315), steep_face, phi));
  EXPECT_FALSE(topples(plane(80, 350), steep_face, phi));
}

// The mean resultant of Fisher's distribution is coth K - 1 / K; medians by its closed form.
TEST(Kinematics, DrawsHaveFishersScatter) {
  const double expected[3][3] = {{20, 0.95, 15.13}, {50, 0.98, 9.55}, {200, 0.995, 4.77}};
  for (const auto& [k, resultant, median_deg] : expected) {
    constexpr int n = 40000;
    Random random(11, "fisher");
    Vec3 sum = Vec3::Zero();
    std::vector<double> angles;
    for (int i = 0; i < n; ++i) {
      const Vec3 drawn = draw_fisher(Vec3::UnitZ(), k, random);
      sum += drawn;
      angles.push_back(std::acos(drawn.z()));
    }
    std::nth_element(angles.begin(), angles.begin() + n / 2, angles.end());
    EXPECT_NEAR(sum.norm() / n, resultant, 0.001);
    EXPECT_NEAR(angles[n / 2] / degree, median_deg, 0.1);
  }
}

// Shares found elsewhere from 400,000 draws, to 0.001; 40,000 draws are good to 0.0075 (3 sigma).
TEST(Kinematics, ScatterMakesAShareOfAProbability) {
  const double expected[3][3] = {{20, 0.737, 0.542}, {50, 0.931, 0.852}, {200, 1, 0.999}};
  for (const auto& [k, free, lateral] : expected) {
    const SetKinematics share =
        kinematics_of({{steep_face, 1}}, {scattered(45, 135, k, 40000)}).sets[0];
    EXPECT_NEAR(share.sliding.mean, free, 0.0085);
    EXPECT_NEAR(share.sliding_lateral.mean, lateral, 0.0085);
  }
}

TEST(Kinematics, AttitudesOfASetAreDrawnTheSameEachTime) {
  JointSet set = joint_set(45, 135, 4);
  EXPECT_TRUE(drawn_attitudes(set).empty());
  set.fisher_k = 50;
  const auto one = drawn_attitudes(set), other = drawn_attitudes(set);
  ASSERT_EQ(one.size(), static_cast<size_t>(n_kinematic_draws));
  EXPECT_EQ(one[17].dip, other[17].dip);
}

TEST(Kinematics, WedgeThatSlidesOnOnePlaneIsNoWedge) {
  const double tangent = std::tan(phi);
  const Wedge both = wedge_of(plane(60, 130), plane(60, 230), tangent, tangent);
  EXPECT_TRUE(both.on_both);
  EXPECT_NEAR(both.plunge / degree, 48.070, 5e-4);
  EXPECT_NEAR(both.trend / degree, 180, 1e-9);
  EXPECT_NEAR(both.factor, 0.6930475, 5e-8);
  EXPECT_TRUE(slides(both, pole(60 * degree, 180 * degree)));
  EXPECT_FALSE(slides(both, pole(40 * degree, 180 * degree)));
  const Wedge one = wedge_of(plane(40, 180), plane(70, 150), tangent, tangent);
  EXPECT_FALSE(one.on_both);
  EXPECT_FALSE(slides(one, pole(60 * degree, 180 * degree)));
  EXPECT_TRUE(wedge_of(plane(40, 180), plane(40, 180), 1, 1).line.isZero());
}

TEST(Kinematics, ColumnsToppleOverABaseThatDipsOutOfTheSlope) {
  // The line of 85/045 and 85/225+90 is vertical; 80/315 and 85/045 dip into the slope.
  const KinematicSet rear{"rear", plane(75, 315), {}, std::tan(phi)};
  const KinematicSet side{"side", plane(89, 45), {}, std::tan(phi)};
  const KinematicSet base{"base", plane(15, 135), {}, std::tan(phi)};
  const std::vector<FacePiece> piece = {{steep_face, 2}};
  EXPECT_EQ(kinematics_of(piece, {rear, side}).pairs[0].toppling.mean, 0);
  EXPECT_EQ(kinematics_of(piece, {rear, side, base}).pairs[0].toppling.mean, 1);
}

// Weights are sloping areas inside the outline, whatever the cells.
TEST(Kinematics, FaceIsTheSlopingAreaOfThePolygon) {
  const Trn ground = grid(30, 30, 2, [](double, double y) { return y; });
  const Area area{{{{11, 13}, {41.3, 13}, {41.3, 37.7}, {11, 37.7}}}};
  double sum = 0;
  for (const FacePiece& piece : face_in(ground, area)) {
    EXPECT_NEAR(piece.normal.z(), std::sqrt(0.5), 1e-12);
    sum += piece.area;
  }
  EXPECT_NEAR(sum, 30.3 * 24.7 * std::sqrt(2), 1e-6);
}
