// The energy budget of a mass with all laws at once (test E1): kinetic and potential energy and the
// losses by all laws add up to the initial energy.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "blocks/fragments.hpp"
#include "scene/stems.hpp"
#include "step/step.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

// Ground with all laws of yielding; its friction follows the slid distance, or the speed.
GroundClass yielding_ground(bool scars) {
  GroundClass ground;
  ground.friction = 0.5;
  ground.restitution = 0.9;
  ground.half_speed = 10;
  ground.rolling = 0.1;
  ground.spinning = 0.05;
  ground.drag_per_time = 0.2;
  ground.drag_per_distance = 0.01;
  if (scars) {
    ground.scar_friction = 1.2;
    ground.scar_rate = 1;
    ground.scar_decay = 50;
  } else {
    ground.weak_friction = 0.2;
    ground.weakening_speed = 4;
  }
  return ground;
}

// Stripes of both, four cells wide.
void lay_ground(Scene& scene) {
  scene.ground.classes = {yielding_ground(true), yielding_ground(false)};
  const Trn& trn = scene.ground.trn;
  for (int row = 0; row + 1 < trn.n_rows; ++row)
    for (int col = 0; col + 1 < trn.n_cols; ++col)
      scene.ground.cell_class.push_back(static_cast<std::uint8_t>(col / 4 % 2));
}

// A hundred blocks above the slope of `frame`, thrown down it.
BlockSet thrown(const SlopeFrame& frame, bool as_cubes) {
  Random random(11, "mass");
  BlockSet set;
  set.material_names = {"rock"};
  for (int i = 0; i < 100; ++i) {
    const double a = random.uniform(0.3, 0.5), b = random.uniform(0.3, 0.5),
                 c = random.uniform(0.3, 0.5);
    const Vec3 half = as_cubes ? Vec3::Constant(a) : Vec3(a, b, c);
    const Vec3 axis = Vec3(random.normal(), random.normal(), random.normal()).normalized();
    const Mat3 turn = Eigen::AngleAxisd(random.uniform(0, 3), axis).toRotationMatrix();
    const Vec3 at = (1.8 * (i % 5) - 25) * frame.dip + 1.8 * (i / 5 % 5) * frame.strike +
                    (1.8 * (i / 25) + 1) * frame.normal;
    add_body(set, body_of(moved(box(-half, half), turn, Vec3::Zero(), at),
                          6 * frame.dip - 2 * frame.normal,
                          Vec3(random.normal(), random.normal(), random.normal())));
  }
  return set;
}

void plant(const SlopeFrame& frame, Scene& scene) {
  std::vector<Stem> stems;
  for (int i = 0; i < 10; ++i)
    for (int j = -4; j < 12; ++j) {
      Stem stem;
      stem.foot = (3.1 * i - 12) * frame.dip + (1.7 * j + 0.4 * (i % 3)) * frame.strike;
      stem.height = 15;
      stem.radius = 0.1;
      stem.capacity = 2e4;
      stem.deflection = 0.5;
      stems.push_back(stem);
    }
  GroundClass bark;
  bark.friction = 0.3;
  add_forest(scene, stems, {bark});
  scene.canopies = {
      make_canopy({{{Vec2(-10, -60), Vec2(60, -60), Vec2(60, 60), Vec2(-10, 60)}}}, 5, 300)};
}

/// On 30 degrees, among stems and in a forest that drags. Blocks that break do so in boxes.
Scene mass(bool breaks) {
  const SlopeFrame frame = slope_frame(30, 20);
  Scene scene = scene_of(plane_trn(frame, 2, 80), {}, {}, {});
  lay_ground(scene);
  scene.joint.friction = 0.6;
  scene.joint.restitution = 0.3;
  BlockSet set = thrown(frame, !breaks);
  if (breaks) {
    SplitSettings split;
    split.min_volume = 0.05;
    split.max_generation = 2;
    scene.fragments = add_fragments(set, split);
    scene.fragmentation.energy = 1e4;
  }
  const Material rock;
  add_blocks(scene, set, std::span(&rock, 1));
  plant(frame, scene);
  return scene;
}

double total(const Scene& scene, const State& state) {
  const Energies e = energies(scene, state);
  const EnergyLedger& l = state.ledger;
  return e.translation + e.rotation + e.potential + l.friction + l.impact + l.contact + l.fence +
         l.rolling + l.drag + l.breakage + l.removed - l.base;
}

// Error of the budget after some seconds, over the energy of the fall.
double missed_by(const Scene& scene, State& state) {
  state = start(scene);
  Work work = make_work(scene);
  const double before = total(scene, state), high = energies(scene, state).potential;
  while (state.time < 2.5) step(scene, state, work);
  const double fall = high - energies(scene, state).potential;
  const double missed = (total(scene, state) - before) / fall;
  testing::Test::RecordProperty("missed", std::to_string(1e9 * missed) + "e-9");
  const EnergyLedger& l = state.ledger;
  for (const double law : {l.friction, l.impact, l.fence, l.rolling, l.drag})
    EXPECT_GT(law, 0.005 * fall);
  return missed;
}

// The rest is the energy that a step gives or takes where a pressed block turns: contacts turn it,
// and its angular momentum stays. It was measured on its own: all laws together miss 1e-9 (theory
// 1.13). Here it is 1.7e-6 of the fall; 2e-7 where pairs of bodies that were hit pressed for a
// shorter time and turned them less.
TEST(Budget, OfAMassWithAllLawsCloses) {
  State state;
  EXPECT_LT(std::abs(missed_by(mass(true), state)), 5e-6);
  EXPECT_GT(state.breaks.size(), 50u);
  EXPECT_GT(state.ledger.breakage, 0);
}

// Cubes have one moment of inertia, so that no turn changes their energy but for moments of
// contacts that press late in a substep, after hits: 1e-8.
TEST(Budget, OfCubesClosesToTheLawsAlone) {
  State state;
  EXPECT_LT(std::abs(missed_by(mass(false), state)), 5e-8);
}

}  // namespace
