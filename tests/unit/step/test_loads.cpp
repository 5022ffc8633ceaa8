// Base motion as a load.
#include <gtest/gtest.h>

#include <cmath>

#include "scene/scene.hpp"
#include "step/loads.hpp"

namespace {

using talus::Vec3;

talus::Scene shaken(const talus::HarmonicMotion& motion) {
  talus::Scene scene;
  scene.gravity = Vec3(0, 0, -9.80665);
  scene.base.harmonic = motion;
  return scene;
}

// Mean of the ground's acceleration over a time, by the midpoint rule.
Vec3 mean_of(const talus::HarmonicMotion& m, double from, double to) {
  constexpr int n = 20000;
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < n; ++i) {
    const double t = from + (to - from) * (i + 0.5) / n;
    if (t > m.start && t < m.end)
      sum += m.amplitude * std::sin(m.angular_frequency * (t - m.start)) / n;
  }
  return sum;
}

TEST(Loads, AHarmonicGroundGivesEachStepItsMeanAcceleration) {
  const talus::HarmonicMotion motion{Vec3(3, -2, 0.5), 7.5, 0.3, 2.7};
  const talus::Scene scene = shaken(motion);
  for (const auto& [from, to] : {std::pair(0.4, 0.405), std::pair(1.0, 1.5), std::pair(2.0, 2.3)})
    EXPECT_NEAR((scene.gravity - talus::free_acceleration(scene, 0, from, to, {}) -
                 mean_of(motion, from, to))
                    .norm(),
                0, 1e-7)
        << from;
}

TEST(Loads, AHarmonicGroundStandsStillBeforeItsStartAndAfterItsEnd) {
  const talus::HarmonicMotion motion{Vec3(4, 0, 0), 2, 1, 2};
  const talus::Scene scene = shaken(motion);
  EXPECT_EQ(talus::free_acceleration(scene, 0, 0.5, 1, {}), scene.gravity);
  EXPECT_EQ(talus::free_acceleration(scene, 0, 2, 2.005, {}), scene.gravity);
  // a step over the end takes the part before it alone
  const Vec3 a = scene.gravity - talus::free_acceleration(scene, 0, 1.9, 2.1, {});
  EXPECT_NEAR(a.x(), 4 * (std::cos(1.8) - std::cos(2.0)) / 2 / 0.2, 1e-12);
}

TEST(Loads, AHarmonicGroundIsRightToRoundingInTheShortestStep) {
  const talus::HarmonicMotion motion{Vec3(1, 0, 0), 5, 0, 1e9};
  const talus::Scene scene = shaken(motion);
  const double t = 1e-3, h = 1e-11;
  const Vec3 a = scene.gravity - talus::free_acceleration(scene, 0, t, t + h, {});
  EXPECT_NEAR(a.x() / std::sin(5 * (t + h / 2)), 1, 1e-6);  // h itself is known to 2e-8
}

}  // namespace
