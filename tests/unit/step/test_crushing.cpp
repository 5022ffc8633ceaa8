// Crushing of small blocks: loads, debris, energy.
#include <gtest/gtest.h>

#include <cmath>

#include "base/numbers.hpp"
#include "solver/law_numbers.hpp"
#include "step/crushing.hpp"
#include "step/step.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

void press(const Vec3& normal, double force, BlockLoad& load) {
  load.press += force * normal * normal.transpose();
  load.push += force * normal;
}

// The load that enters on one side and leaves on the other; not the force that moves or supports
// the block.
TEST(LoadThrough, IsWhatIsPressedFromBothSides) {
  BlockLoad jammed, alone, corner, all_round;
  press(-Vec3::UnitZ(), 500, jammed);
  press(Vec3::UnitZ(), 510, jammed);
  EXPECT_NEAR(load_through(jammed), 500, 1e-9);
  press(Vec3::UnitZ(), 10, alone);
  EXPECT_EQ(load_through(alone), 0);
  press(Vec3::UnitX(), 300, corner);
  press(Vec3::UnitZ(), 400, corner);
  EXPECT_NEAR(load_through(corner), 0, 1e-9);
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) press(side * Vec3::Unit(axis), 700, all_round);
  EXPECT_NEAR(load_through(all_round), 700, 1e-9);
}

/// A cube of 2 m on a splinter of 0.5 m x 0.5 m x 0.1 m, which lies on flat ground.
struct Pinched {
  explicit Pinched(double dt, double strength_in_weights, const Vec3& velocity = Vec3::Zero())
      : scene(scene_of(plane_trn(slope_frame(0, 0), 1, 30), ground_of(30),
                       {body_of(box(Vec3(-0.25, -0.25, 0), Vec3(0.25, 0.25, 0.1))),
                        body_of(box(Vec3(-1, -1, 0.1), Vec3(1, 1, 2.1)), velocity)},
                       settings(dt))) {
    weight = scene.blocks.mass[1] * scene.gravity.norm();
    scene.crush_load = {strength_in_weights * weight, infinity};
    state = start(scene);
    work = make_work(scene);
  }
  static Settings settings(double dt) {
    Settings made;
    made.dt = dt;
    return made;
  }
  void run_to(double time) {
    while (state.time < time - scene.settings.dt / 2) step(scene, state, work);
  }
  [[nodiscard]] double energy() const {
    const Energies e = energies(scene, state);
    const EnergyLedger& l = state.ledger;
    return e.translation + e.rotation + e.potential + l.friction + l.impact + l.contact +
           l.breakage + l.removed - l.base;
  }
  Scene scene;
  double weight = 0;
  State state;
  Work work;
};

class PinchedSplinter : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(AtStep, PinchedSplinter, testing::Values(0.01, 0.005, 0.0025, 0.00125));

// The mean over load_time of a weight that was set down rises as 1 - exp(-t / load_time): it comes
// to 0.9 weights at 2.303 times that, at any step.
TEST_P(PinchedSplinter, IsCrushedWhenTheMeanLoadComesToItsStrengthAtAnyStep) {
  Pinched scene(GetParam(), 0.9);
  while (scene.state.crushed.empty() && scene.state.time < 1)
    step(scene.scene, scene.state, scene.work);
  ASSERT_EQ(scene.state.crushed.size(), 1u);
  const CrushedBlock& crushed = scene.state.crushed[0];
  EXPECT_EQ(crushed.block, 0);
  EXPECT_NEAR(crushed.time, -law::load_time * std::log(0.1), 0.02);
  EXPECT_NEAR(crushed.load, 0.9 * scene.weight, 0.02 * scene.weight);
  EXPECT_EQ(scene.state.phase[0], Phase::crushed);
}

TEST_P(PinchedSplinter, CarriesWhatIsBelowItsStrengthForGood) {
  Pinched scene(GetParam(), 1.05);
  scene.run_to(2);
  EXPECT_TRUE(scene.state.crushed.empty());
  EXPECT_EQ(scene.state.ledger.breakage, 0);
}

// A splinter that could be crushed and is not moves nothing by a bit.
TEST(CrushedSplinter, ThatCarriesItsLoadLeavesTheRunAsItWas) {
  Pinched strong(0.005, 1.05), plain(0.005, 1);
  plain.scene.crush_load.clear();
  plain.state = start(plain.scene);
  strong.run_to(1);
  plain.run_to(1);
  for (int b = 0; b < 2; ++b) {
    EXPECT_EQ(strong.state.motion[b].pose.position, plain.state.motion[b].pose.position);
    EXPECT_EQ(strong.state.motion[b].velocity, plain.state.motion[b].velocity);
  }
}

// The cube comes down through the debris to the ground, and not deeper; the debris stays, counts,
// and no energy is lost on the way down.
TEST_P(PinchedSplinter, LetsWhatItBoreDownToTheGroundAndStaysAsDebris) {
  Pinched scene(GetParam(), 0.9);
  const double before = scene.energy();
  scene.run_to(3);
  ASSERT_EQ(scene.state.crushed.size(), 1u);
  EXPECT_NEAR(scene.state.motion[1].pose.position.z(), 1, 2e-3);
  EXPECT_NEAR(scene.state.motion[0].pose.position.z(), 0.05, 2e-3);
  EXPECT_EQ(scene.state.motion[0].pose.position, scene.state.crushed[0].place);
  EXPECT_EQ(scene.state.crushed[0].mass, scene.scene.blocks.mass[0]);
  EXPECT_EQ(scene.state.crushed[0].volume, scene.scene.blocks.volume[0]);
  EXPECT_EQ(scene.state.deep[1].steps, 0);
  const double fell = scene.weight * 0.1;
  EXPECT_NEAR(scene.energy(), before, 1e-2 * fell);
}

// 2.5 t at 5 m/s on a splinter that can carry ten times their weight: a mean over load_time of
// 5 weights x seconds of impulse, five times that. It is hit from one side and held from the other.
TEST_P(PinchedSplinter, IsCrushedByABlowToo) {
  Pinched scene(GetParam(), 4, Vec3(0, 0, -5));
  scene.run_to(0.2);
  ASSERT_EQ(scene.state.crushed.size(), 1u);
  EXPECT_LT(scene.state.crushed[0].time, 0.05);
}

}  // namespace
