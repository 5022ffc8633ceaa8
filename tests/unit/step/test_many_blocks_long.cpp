// The long form of stability/test_many_blocks.cpp: minutes at rest.
#include <gtest/gtest.h>

#include "stability/block_scenes.hpp"
#include "verify/cases/block_cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;
using namespace talus::stability;

Settings awake() {
  Settings settings;
  settings.sleep = false;
  return settings;
}

// Beyond the overlap that its weight presses it into within the first 5 s, nothing moves for 60 s.
TEST(ManyBlocksLong, PileOfTenStandsForAMinute) {
  const Scene scene = tower(10, 0, 30, awake());
  State state = start(scene);
  Work work = make_work(scene);
  run(scene, 5, state, work);
  const std::vector<Vec3> before = places(scene, state);
  run(scene, 60, state, work);
  EXPECT_LT(farthest(before, places(scene, state)), 1e-6);
  EXPECT_EQ(state.counters.unconverged, 0);
}

// For 20 s it stays within a tenth of a metre of where it was cut, for the last 10 s it is at rest.
void expect_standing(const Scene& scene) {
  State state = start(scene);
  Work work = make_work(scene);
  const std::vector<Vec3> cut = places(scene, state);
  run(scene, 10, state, work);
  const std::vector<Vec3> before = places(scene, state);
  run(scene, 10, state, work);
  EXPECT_LT(farthest(cut, places(scene, state)), 0.1);
  EXPECT_LT(farthest(before, places(scene, state)), 5e-3);
  EXPECT_EQ(state.counters.unconverged, 0);
}

TEST(ManyBlocksLong, ArchStands) {
  for (const int n : {7, 15})
    expect_standing(on_plane(slope_frame(0, 0), arch_of(n, 4, 5.5, 2), 40, 50, awake()));
}

TEST(ManyBlocksLong, WallOf400Stands) {
  expect_standing(on_plane(slope_frame(0, 0), wall_of(20, 20, 1), 30, 40, awake(), 2, 60));
}

TEST(ManyBlocksLong, AnyStiffnessAndStepIsBounded) {
  for (const double stiffness : {0.0, 1e6, 1e8, 1e10, 1e12, 1e14})
    for (const double dt : {1e-5, 1e-4, 1e-3, 5e-3, 1e-2, 2e-2, 5e-2})
      expect_bounded(stiffness, dt, dt < 1e-3 ? 0.5 : 2, dt < 1e-3 ? 1 : 20);
}

}  // namespace
