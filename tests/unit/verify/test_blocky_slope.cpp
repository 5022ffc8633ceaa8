// The slope of polyhedral blocks against the TRN.
#include <gtest/gtest.h>

#include <cmath>

#include "base/units.hpp"
#include "step/step.hpp"
#include "verify/cases/blocky_slope.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

State run(const Scene& scene, double time) {
  State state = start(scene);
  Work work = make_work(scene);
  while (state.time < time - 1e-9) step(scene, state, work);
  return state;
}

Scene blocky(Scene scene) {
  add_blocky_slope(scene, blocky_depth(scene));
  return scene;
}

// Over some thirty triangles, turned against the grid, without a bump at any of their edges.
TEST(BlockySlope, SlidesAsOnTheTrn) {
  const SlopeFrame frame = slope_frame(30, 25);
  Body body;
  body.parts = {box_in(frame, Vec3::Zero(), Vec3(-0.7, -0.5, 0), Vec3(0.7, 0.5, 0.6))};
  const Scene trn = scene_of(plane_trn(frame, 1.5, 30), ground_of(20), {body}, {});
  const Scene blocks = blocky(trn);
  EXPECT_EQ(n_fixed(blocks), n_triangles(trn.ground.trn));
  const State on_trn = run(trn, 2.5), on_blocks = run(blocks, 2.5);
  const double a = 10 * (std::sin(30 * degree) - std::tan(20 * degree) * std::cos(30 * degree));
  const auto way = [&](const Scene& scene, const State& state) {
    return Vec3(state.motion[0].pose.position - scene.blocks.rest[0].position);
  };
  EXPECT_NEAR(frame.dip.dot(way(trn, on_trn)), a * 3.125, 1e-6 * a * 3.125);
  EXPECT_NEAR(frame.dip.dot(way(blocks, on_blocks)), a * 3.125, 1e-3 * a * 3.125);
  EXPECT_NEAR(frame.strike.dot(way(blocks, on_blocks)), 0, 1e-3);
  EXPECT_NEAR(frame.normal.dot(way(blocks, on_blocks)), 0, 1e-3);
}

// A cube that falls flat onto the plane rebounds by the restitution of the ground.
TEST(BlockySlope, ThrowsBackByTheRestitutionOfTheGround) {
  Body body;
  body.parts = {box(Vec3(-0.5, -0.4, 1), Vec3(0.5, 0.6, 2))};
  const SlopeFrame flat = slope_frame(0, 0);
  const Scene scene = blocky(scene_of(plane_trn(flat, 1.3, 20), ground_of(20, 0.5), {body}, {}));
  const State state = run(scene, 0.6);  // it hits after sqrt(0.2) s
  EXPECT_NEAR(state.motion[0].velocity.z(), 0.5 * std::sqrt(20) - 10 * (0.6 - std::sqrt(0.2)),
              1e-3);
}

// Blocks on a blocky slope see each other, too: the upper of two is pushed by none.
TEST(BlockySlope, CarriesAStack) {
  const SlopeFrame flat = slope_frame(0, 0);
  std::vector<Body> bodies(3);
  for (int i = 0; i < 3; ++i)
    bodies[static_cast<std::size_t>(i)].parts = {box(Vec3(0.1, 0.2, i), Vec3(1.1, 1.2, i + 1))};
  const Scene scene = blocky(scene_of(plane_trn(flat, 1, 10), ground_of(30), bodies, {}));
  const State state = run(scene, 3);
  for (std::size_t b = 0; b < 3; ++b)
    EXPECT_LT((state.motion[b].pose.position - scene.blocks.rest[b].position).norm(), 5e-3) << b;
  EXPECT_EQ(state.counters.unconverged, 0);
}

// Contacts that are far too soft let a cube through: it is seen.
TEST(BlockySlope, SaysThatABlockFellThrough) {
  Body body;
  body.parts = {box(Vec3(0.1, 0.2, 0), Vec3(1.1, 1.2, 1))};
  Settings soft;
  soft.normal_stiffness = 100;
  const Scene scene =
      blocky(scene_of(plane_trn(slope_frame(0, 0), 1, 10), ground_of(20), {body}, soft));
  State state = start(scene);
  Work work = make_work(scene);
  StepFlag flags = StepFlag::none;
  while (state.time < 2) flags = flags | step(scene, state, work).flags;
  EXPECT_LT(state.motion[0].pose.position.z(), -2);
  EXPECT_TRUE(has(flags, StepFlag::fell_through));
}

TEST(BlockySlope, LeavesOutUnknownGround) {
  Body body;
  body.parts = {box(Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1))};
  Scene scene = scene_of(plane_trn(slope_frame(0, 0), 1, 5), ground_of(30), {body}, {});
  scene.ground.trn.elevation[0] = std::nan("");
  const int n = n_triangles(scene.ground.trn);
  add_blocky_slope(scene, 5);
  EXPECT_EQ(n_fixed(scene), n - 2);
  EXPECT_FALSE(scene.settings.trn_contacts);
}

}  // namespace
