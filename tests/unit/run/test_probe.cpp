// The probe: whether blocks slide, stay or sag in the first seconds.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "run/probe.hpp"
#include "run/runner.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

// Two boxes of 1 and 8 m3 on an even slope of 30 degrees, far apart.
Scene two_boxes(double friction_deg) {
  const SlopeFrame frame = slope_frame(30, 0);
  std::vector<Body> bodies(2);
  bodies[0].parts.push_back(box_in(frame, Vec3(0, -10, 0), {0, 0, 0}, {1, 1, 1}));
  bodies[1].parts.push_back(box_in(frame, Vec3(0, 10, 0), {0, 0, 0}, {2, 2, 2}));
  Settings settings;
  settings.dt = probe_step_s;
  const double slope = std::tan(30 * std::numbers::pi / 180);
  return scene_of(make_trn([&](double x, double) { return -slope * x; }, 2, 80),
                  ground_of(friction_deg, 0.3), bodies, settings);
}

Runner begun(const Scene& scene, double duration) {
  RunOptions options;
  options.duration = duration;
  options.frame_interval = 0.1;
  return begin_run(scene, options, {}, {});
}

}  // namespace

TEST(Probe, SeesWhatSlides) {
  const Scene scene = two_boxes(20);
  const Probe result = probe(scene, 1);
  EXPECT_NEAR(result.time, 1, 1e-9);
  EXPECT_EQ(result.moved_share, 1);
  const double phi = 20 * std::numbers::pi / 180, dip = 30 * std::numbers::pi / 180;
  const double way = 9.81 * (std::sin(dip) - std::tan(phi) * std::cos(dip)) / 2;
  EXPECT_NEAR(result.displacement[1], way, 0.03 * way);
  EXPECT_EQ(result.fault, "");
}

TEST(Probe, SeesWhatStands) {
  const Probe result = probe(two_boxes(40), 1);
  EXPECT_EQ(result.moved_share, 0);
  EXPECT_LT(result.largest_speed, 1e-3);
}

// At 1 s a box on 30 degrees with a friction of 25 has gone 0.5 m and is at 0.9 m/s; one that drops
// 0.3 m onto a slope that holds it is at rest.
TEST(Probe, TellsWhatGoesFromWhatSags) {
  const Probe sliding = probe(two_boxes(25), 1);
  EXPECT_LT(sliding.displacement[1], probe_goes_m);
  EXPECT_EQ(sliding.moved_share, 1);
  Scene scene = two_boxes(60);
  for (Pose& rest : scene.blocks.rest) rest.position.z() += 0.3;
  const Probe sagging = probe(scene, 2);
  EXPECT_GT(sagging.displacement[1], 0.1);
  EXPECT_EQ(sagging.moved_share, 0);
  EXPECT_FALSE(sagging.goes[1]);
}

TEST(Probe, EndsWhenItIsStopped) {
  const Probe result = probe(two_boxes(20), 1, [](double share) { return share > 0.45; });
  EXPECT_LT(result.time, 0.7);
}

TEST(Stands, AfterThreeSecondsInWhichNothingMoved) {
  const Scene scene = two_boxes(40);
  Runner runner = begun(scene, 60);
  while (runner.state.time < 2.9) advance(runner);
  EXPECT_FALSE(stands(runner));
  while (runner.state.time < 3.05) advance(runner);
  EXPECT_TRUE(stands(runner));
}

TEST(Stands, NotWhereABlockGoesOrWhereTheGroundShakes) {
  const Scene sliding = two_boxes(29.5);
  Runner runner = begun(sliding, 60);
  while (runner.state.time < 4) advance(runner);
  EXPECT_FALSE(stands(runner));
  Scene shaken = two_boxes(40);
  shaken.base.harmonic = {Vec3(0.1, 0, 0), 6, 10, 20};
  Runner later = begun(shaken, 60);
  while (later.state.time < 4) advance(later);
  EXPECT_FALSE(stands(later));
}
