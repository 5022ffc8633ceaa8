// Drag of forests: closed forms in the air and in contact, alone and in an island, and where it
// does not act.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/error.hpp"
#include "step/soil.hpp"
#include "step/step.hpp"
#include "tests/unit/step/rough_scene.hpp"
#include "verify/cases/case_run.hpp"
#include "verify/cases/cases.hpp"
#include "verify/cases/closed_form_scenes.hpp"
#include "verify/cases/stem_case.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

constexpr double drag = 500, heavy_mass = 1000;        // [kg/s], [kg]
const double half = std::cbrt(heavy_mass / 2500) / 2;  // of a cube, density of Material{}

Canopy canopy_on(double x_low, double x_high, double height = 20) {
  return make_canopy({{{Vec2(x_low, -50), Vec2(x_high, -50), Vec2(x_high, 50), Vec2(x_low, 50)}}},
                     height, drag);
}

Body cube_at(const Vec3& centre, const Vec3& velocity, const Vec3& spin = Vec3::Zero()) {
  return body_of(box(centre - Vec3::Constant(half), centre + Vec3::Constant(half)), velocity, spin);
}

Scene in_forest(const Settings& settings, const std::vector<Body>& bodies, const Canopy& canopy,
                double gravity = 0) {
  Scene scene = scene_of(plane_trn(slope_frame(0, 0), 1, 60), {}, bodies, settings);
  scene.gravity = Vec3(0, 0, -gravity);
  scene.canopies = {canopy};
  return scene;
}

double kinetic(const Run& run) {
  const Energies e = energies(run.scene, run.state);
  return e.translation + e.rotation;
}

// Where a cube gets that starts at x = 0 with 15 m/s.
double way_of(Run& run, double time) {
  run.advance_to(time);
  return run.motion().pose.position.x();
}

class Canopies : public testing::TestWithParam<double> {
 protected:
  CaseSettings settings;
  void SetUp() override { settings.dt = GetParam(); }
};
INSTANTIATE_TEST_SUITE_P(Steps, Canopies,
                         testing::Values(Settings{}.dt, Settings{}.dt / 2, Settings{}.dt / 4));

// Test T6.
TEST_P(Canopies, StopABlockInTheAir) { EXPECT_LT(dragged_flight(settings).error, 1e-6); }

TEST_P(Canopies, LeaveTheSpinAndTakeWhatTheyBook) {
  cases::Run run(in_forest(settings, {cube_at(Vec3(0, 0, 5), Vec3(15, 0, 0), Vec3(1, -3, 2))},
                           canopy_on(-50, 50)),
                 {});
  const Vec3 spin = run.motion().angular_momentum;
  const double before = kinetic(run);
  run.advance_to(2);
  EXPECT_EQ(run.motion().angular_momentum, spin);
  EXPECT_NEAR(run.motion().velocity.x(), 15 * std::exp(-1), 1e-9);
  EXPECT_GT(run.state.ledger.drag, 0.8 * 0.5 * heavy_mass * 15 * 15);
  EXPECT_NEAR(kinetic(run) + run.state.ledger.drag, before, 1e-11 * before);
}

// A fall of 1 s from 15 m: v = g / nu (1 - exp(-nu t)).
TEST_P(Canopies, SlowAFall) {
  cases::Run run(
      in_forest(settings, {cube_at(Vec3(0, 0, 15), Vec3::Zero())}, canopy_on(-50, 50), g), {});
  run.advance_to(1);
  const double nu = drag / heavy_mass, v = g / nu * (1 - std::exp(-nu)),
               z = 15 - g / nu * (1 - (1 - std::exp(-nu)) / nu);
  EXPECT_NEAR(run.motion().velocity.z(), -v, 1e-5 * v);
  EXPECT_NEAR(run.motion().pose.position.z(), z, 1e-5 * z);
}

// A slab that slides on the flat stops as on ground of the same drag (case D2).
TEST_P(Canopies, StopASlide) {
  constexpr double mu = 0.3, speed = 10, nu = 0.5;
  GroundClass ground;
  ground.friction = mu;
  const Body slab =
      body_of(box(Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 0.05)), Vec3(speed, 0, 0));  // 125 kg
  Scene scene = scene_of(plane_trn(slope_frame(0, 0), 1, 40), ground, {slab}, settings);
  scene.canopies = {canopy_on(-50, 50)};
  scene.canopies[0].drag = nu * scene.blocks.mass[0];
  cases::Run run(std::move(scene), {});
  const double before = kinetic(run);
  run.advance_to(3);
  const double expected = speed / nu - mu * g / (nu * nu) * std::log(1 + nu * speed / (mu * g));
  EXPECT_NEAR(run.motion().pose.position.x(), expected, 1e-3 * expected);
  const EnergyLedger& l = run.state.ledger;
  EXPECT_GT(l.drag, 0.3 * before);
  EXPECT_NEAR(kinetic(run) + l.friction + l.contact + l.impact + l.drag, before, 1e-7 * before);
}

// One cube before another, in an island: both stop where one would, and press each other no more
// than before.
TEST_P(Canopies, StopAnIsland) {
  const Vec3 velocity(15, 0, 0);
  cases::Run run(
      in_forest(settings,
                {cube_at(Vec3(0, 0, 5), velocity), cube_at(Vec3(2 * half, 0, 5), velocity)},
                canopy_on(-50, 50)),
      {});
  const double before = kinetic(run);
  EXPECT_NEAR(way_of(run, 40), 30, 1e-3);
  EXPECT_NEAR(run.motion(1).pose.position.x() - run.motion(0).pose.position.x(), 2 * half, 1e-6);
  EXPECT_EQ(run.work.search.joined.size(), 1u);  // to the end
  EXPECT_NEAR(run.state.ledger.drag, before, 1e-9 * before);
}

// A flight ends before the forest, and the block is dragged from its edge on.
TEST_P(Canopies, AreNotFlownOver) {
  cases::Run run(in_forest(settings, {cube_at(Vec3(0, 0, 5), Vec3(15, 0, 0))}, canopy_on(10, 50)),
                 {});
  EXPECT_NEAR(way_of(run, 42), 40, 1e-3);
  EXPECT_GT(run.state.counters.flight_skips, 0);
}

// A block through an area loses d L / m, L its path in it: a strip entered at a slant, one that is
// narrower than a step, one of many sides; alone and as two that touch.
TEST_P(Canopies, TakeTheirDragOverTheWayInThem) {
  const Vec3 velocity(9, 2, 0);
  const double slant = velocity.norm() / velocity.x();
  const auto strip = [&](double low, double high) { return canopy_on(low, high); };
  Area disc{{{}}};
  for (int i = 0; i < 60; ++i) {
    const double angle = 2 * std::numbers::pi * i / 60;
    disc.rings[0].push_back(Vec2(4.003, 4.003 * 2 / 9) +
                            2.7 * Vec2(std::cos(angle), std::sin(angle)));
  }
  // of its sides that the path through its centre crosses, at 12.53 degrees: those from 12 to 18
  const double apothem = 2.7 * std::cos(std::numbers::pi / 60),
               off = 15 * std::numbers::pi / 180 - std::atan2(2, 9);
  const struct {
    Canopy canopy;
    double way;
  } areas[] = {{strip(2.0071, 5.013), 3.0059 * slant},
               {strip(3.0071, 3.0171), 0.01 * slant},
               {make_canopy(disc, 20, drag), 2 * apothem / std::cos(off)}};
  for (const auto& [canopy, way] : areas)
    for (const bool is_alone : {true, false}) {
      std::vector<Body> bodies{cube_at(Vec3(0, 0, 5), velocity)};
      if (!is_alone) bodies.push_back(cube_at(Vec3(0, 0, 5 + 2 * half), velocity));
      cases::Run run(in_forest(settings, bodies, canopy), {});
      run.advance_to(1.5);
      const Vec3 v = run.motion().velocity;
      EXPECT_NEAR(v.norm(), velocity.norm() - drag * way / heavy_mass, 1e-4 * way) << is_alone;
      EXPECT_NEAR(v.y() / v.x(), 2.0 / 9, 1e-9);
    }
}

// Up to the top of a canopy from below, and down through it.
TEST_P(Canopies, EndAtTheirTop) {
  for (const double up : {9.0, -9.0}) {
    const double from = up > 0 ? 1 : 12;
    cases::Run run(
        in_forest(settings, {cube_at(Vec3(0, 0, from), Vec3(1, 0, up))}, canopy_on(-50, 50, 6.013)),
        {});
    run.advance_to(0.9);
    const double z = run.motion().pose.position.z(), way = up > 0 ? 6.013 - from : 6.013 - z;
    EXPECT_NEAR(std::abs(run.motion().velocity.z()), 9 - drag * way / heavy_mass, 1e-4 * way);
  }
}

// Above a canopy and beside it a block moves as if there were none, over it step by step.
TEST(Canopy, DragsNothingOutsideIt) {
  for (const Canopy& canopy : {canopy_on(-50, -1), canopy_on(30, 50), canopy_on(-50, 50, 4)}) {
    cases::Run run(in_forest({}, {cube_at(Vec3(0, 0, 5), Vec3(15, 0, 0))}, canopy), {});
    EXPECT_NEAR(way_of(run, 1.5), 22.5, 1e-11);
    EXPECT_EQ(run.state.ledger.drag, 0);
  }
}

// Of two forests on one place both drag.
TEST(Canopy, DragsAddUp) {
  const std::vector<Canopy> both = {canopy_on(-50, 50), canopy_on(0, 50, 6)};
  const Trn trn = plane_trn(slope_frame(0, 0), 1, 60);
  EXPECT_EQ(drag_at(both, trn, Vec3(-1, 0, 5)), drag);
  EXPECT_EQ(drag_at(both, trn, Vec3(1, 0, 5)), 2 * drag);
  EXPECT_EQ(drag_at(both, trn, Vec3(1, 0, 7)), drag);
  EXPECT_EQ(drag_at(both, trn, Vec3(1, 0, 21)), 0);
  EXPECT_EQ(drag_at(both, trn, Vec3(51, 0, 5)), 0);
  EXPECT_EQ(drag_at(both, trn, Vec3(200, 0, 5)), 0);
}

TEST(Canopy, DragsNothingOverADam) {
  const std::vector<Canopy> forest = {canopy_on(-50, 50)};
  Trn trn = plane_trn(slope_frame(0, 0), 1, 60);
  const Cell cell = locate(trn, 20.5, 0.5).cell;
  trn.dams = {{"road", 1, {}, {static_cast<int>(node_index(trn, cell.row, cell.col))}, ""}};
  EXPECT_EQ(drag_at(forest, trn, Vec3(20.5, 0.5, 5)), 0);
  EXPECT_EQ(drag_at(forest, trn, Vec3(24.5, 0.5, 5)), drag);
}

// The path of a mass centre that turns back is wider than its ends.
TEST(Canopy, IsComeOverByWhatTurnsBackInIt) {
  const std::vector<Canopy> canopies = {canopy_on(10, 50)};
  const auto comes = [&](double x, double v, double a, double time) {
    return comes_over(canopies, Vec3(x, 0, 5), Vec3(v, 0, 0), Vec3(a, 0, -10), time);
  };
  EXPECT_FALSE(comes(0, 15, 0, 0.6));
  EXPECT_TRUE(comes(0, 15, 0, 0.7));
  EXPECT_TRUE(comes(0, 15, -10, 3));  // to 11.25 m and back
  EXPECT_FALSE(comes(0, 14, -10, 3));
  EXPECT_TRUE(comes(70, -15, 0, 10));
  EXPECT_FALSE(comes_over({}, Vec3::Zero(), Vec3::UnitX(), Vec3::Zero(), 1e3));
}

// A tumbling block that bounces through a forest: the plan with all searches has the same bits.
TEST(Canopy, IsMetAlikeInTheFullPlan) {
  Settings full;
  full.flight = false;
  const auto run_with = [](const Settings& settings) {
    Scene scene = rough_scene(settings);
    scene.canopies = {canopy_on(-38, -20, 3)};
    cases::Run run(std::move(scene), {});
    run.advance_to(6);
    return run;
  };
  const cases::Run one = run_with({}), other = run_with(full);
  EXPECT_EQ(one.motion().pose.position, other.motion().pose.position);
  EXPECT_EQ(one.motion().angular_momentum, other.motion().angular_momentum);
  EXPECT_GT(one.state.ledger.drag, 0);
  EXPECT_EQ(one.state.ledger.drag, other.state.ledger.drag);
}

TEST(Canopy, OfNegativeDragIsRefused) {
  Scene scene = in_forest({}, {cube_at(Vec3(0, 0, 5), Vec3::Zero())}, canopy_on(0, 1));
  scene.canopies[0].drag = -1;
  EXPECT_THROW(check_scene(scene), InputError);
}

}  // namespace
