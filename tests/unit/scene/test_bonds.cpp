// Bonds and joint classes: limits in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <tuple>
#include <vector>

#include "base/units.hpp"
#include "scene/fence.hpp"
#include "step/step.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

// A cube on a slab that holds to the ground, their common faces made by joint set 0.
Scene cube_on_slab(double dip_deg, const GroundClass& set) {
  const SlopeFrame frame = slope_frame(dip_deg, 30);
  Body slab, cube;
  slab.parts = {box_in(frame, Vec3::Zero(), Vec3(-3, -3, 0), Vec3(3, 3, 0.5))};
  cube.parts = {box_in(frame, Vec3::Zero(), Vec3(-0.5, -0.5, 0.5), Vec3(0.5, 0.5, 1.5))};
  for (Body* body : {&slab, &cube}) body->parts[0].face_tag.assign(6, 0);
  const GroundClass rough = ground_of(85);
  Settings settings;
  settings.sleep = false;
  Scene scene = scene_of(plane_trn(frame, 1, 30), rough, {slab, cube}, settings);
  scene.joints.of_set = {set};
  return scene;
}

State run(const Scene& scene, double time) {
  State state = start(scene);
  Work work = make_work(scene);
  while (state.time < time - 1e-9) step(scene, state, work);
  return state;
}

double slid(const Scene& scene, const State& state) {
  const Vec3 way = state.motion[1].pose.position - state.motion[0].pose.position -
                   (scene.blocks.rest[1].position - scene.blocks.rest[0].position);
  return way.norm();
}

constexpr double area = 1, weight = 2500 * 10;

// Angle at which weight sin = weight cos tan(phi) + c A, by bisection.
double failure_angle_deg(double friction, double cohesion) {
  double low = 0, high = 90;
  for (int i = 0; i < 60; ++i) {
    const double angle = (low + high) / 2 * degree;
    const bool fails =
        weight * std::sin(angle) > weight * std::cos(angle) * friction + cohesion * area;
    (fails ? high : low) = (low + high) / 2;
  }
  return low;
}

struct Strength {
  double phi_deg, cohesion;
};
class Bond : public testing::TestWithParam<Strength> {};
INSTANTIATE_TEST_SUITE_P(Bonds, Bond,
                         testing::Values(Strength{20, 5000}, Strength{10, 8000},
                                         Strength{0, 10000}));

// Holds 0.05 degrees below the computed angle, and fails 0.05 degrees above it.
TEST_P(Bond, HoldsExactlyToItsLimit) {
  GroundClass set = ground_of(GetParam().phi_deg);
  set.cohesion = GetParam().cohesion;
  set.tension = GetParam().cohesion;
  const double angle = failure_angle_deg(set.friction, set.cohesion);
  const Scene below = cube_on_slab(angle - 0.05, set), above = cube_on_slab(angle + 0.05, set);
  const State held = run(below, 2), failed = run(above, 2);
  ASSERT_EQ(held.bonds.size(), 1u);
  EXPECT_NEAR(held.bonds[0].area, area, 1e-9);
  EXPECT_LT(slid(below, held), 1e-3);
  EXPECT_EQ(failed.bonds[0].area, 0);
  EXPECT_GT(slid(above, failed), 0.1);
}

// Brittle: a broken bond slides with the friction of the joint alone. An offset keeps the forces of
// a contact whose stiffness changes. On a bond it would stay, and pull when the load is gone: bonds
// have none.
TEST(Bonds, KeepTheirZeroWhateverTheirStiffness) {
  GroundClass set = ground_of(20);
  set.cohesion = set.tension = 5000;
  const State state = run(cube_on_slab(20, set), 0.1);
  int n_bonded = 0, n_free = 0;
  for (const std::vector<ContactMemory>& of_block : state.memory)
    for (const ContactMemory& memory : of_block) {
      const bool bonded = memory.key.body_b >= 0;
      (bonded ? n_bonded : n_free) += 1;
      EXPECT_EQ(memory.stiffness > 0, !bonded);
    }
  EXPECT_GE(n_bonded, 3);
  EXPECT_GE(n_free, 3);
}

TEST(Bonds, LeaveTheFrictionOfTheJointBehind) {
  GroundClass set = ground_of(15);
  set.cohesion = 1000;
  const double dip = failure_angle_deg(set.friction, set.cohesion) + 2;
  const Scene scene = cube_on_slab(dip, set);
  const auto speed = [&](double time) { return run(scene, time).motion[1].velocity.norm(); };
  const double a = 10 * (std::sin(dip * degree) - set.friction * std::cos(dip * degree));
  EXPECT_NEAR((speed(1) - speed(0.5)) / 0.5, a, 1e-3 * a);
}

// A cube that hangs below a fixed slab by its tensile strength: t A against its weight.
TEST(Bonds, HangByTheirTensileStrength) {
  for (const double share : {0.99, 1.01}) {
    GroundClass set;
    set.cohesion = 1e6;
    set.tension = weight / area / share;
    const SlopeFrame flat = slope_frame(0, 0);
    Body slab, cube;
    // the slab lies on two ridges of fixed blocks, the cube hangs between them
    slab.parts = {box(Vec3(-3, -3, 2), Vec3(3, 3, 3))};
    cube.parts = {box(Vec3(-0.5, -0.5, 1), Vec3(0.5, 0.5, 2))};
    for (Body* body : {&slab, &cube}) body->parts[0].face_tag.assign(6, 0);
    GroundClass rough;
    rough.friction = 1;
    Settings settings;
    settings.sleep = false;
    Scene scene = scene_of(plane_trn(flat, 1, 30), rough, {slab, cube}, settings);
    scene.joints.of_set = {set};
    scene.fixed.classes = {rough};
    add_fixed_body(scene, box(Vec3(-3, -3, 0), Vec3(-2, 3, 2)), 0);
    add_fixed_body(scene, box(Vec3(2, -3, 0), Vec3(3, 3, 2)), 0);
    const State state = run(scene, 1);
    EXPECT_EQ(state.bonds[0].area > 0, share < 1);
    EXPECT_EQ(slid(scene, state) < 0.01, share < 1);
  }
}

// --- one rule for both kinds of bonds ----------------------------------------------------------

/// Forces on the cube at the bonded face, and couples there.
struct FaceLoad {
  const char* name;
  Vec3 force = Vec3::Zero();   // [N]
  Vec3 couple = Vec3::Zero();  // [N m]
};

constexpr double c = 20000, t = 30000;  // of the bonds below; friction of 10 degrees
const double k = c + std::tan(10 * degree) * weight / area;
const double torsion = (std::sqrt(2) + std::log(1 + std::sqrt(2))) / 6;  // of a unit square

// Loads that a face of 1 m2 under the cube's weight just holds, in closed form.
const FaceLoad face_loads[] = {
    {"tension", Vec3(0, 0, weight + t), {}},
    {"shear", Vec3(0.6, -0.8, 0) * k, {}},
    {"bending", {}, Vec3(0, (weight + t) / 2, 0)},
    {"torsion", {}, Vec3(0, 0, torsion* k)},
    {"tension and bending", Vec3(0, 0, weight + t / 2), Vec3(t / 4, 0, 0)},
    {"tension and shear", Vec3(c, 0, weight + t / 2), {}},
    {"pull and torsion", Vec3(0, 0, weight), Vec3(0, 0, torsion* c)},
};

// A cube on a slab that holds to the ground, or on the ground itself, with `share` of the load
// besides its weight. The weight stays, so the share is of the load beyond it.
Scene loaded_cube(bool on_ground, const FaceLoad& load, double share) {
  GroundClass bonded = ground_of(10);
  bonded.cohesion = c;
  bonded.tension = t;
  const double low = on_ground ? 0 : 0.5;
  Body slab, cube;
  slab.parts = {box(Vec3(-3, -3, 0), Vec3(3, 3, 0.5))};
  cube.parts = {box(Vec3(-0.5, -0.5, low), Vec3(0.5, 0.5, low + 1))};
  for (Body* body : {&slab, &cube}) body->parts[0].face_tag.assign(6, 0);
  Settings settings;
  settings.sleep = false;
  std::vector<Body> bodies;
  if (!on_ground) bodies.push_back(slab);
  bodies.push_back(cube);
  Scene scene = scene_of(plane_trn(slope_frame(0, 0), 1, 10), on_ground ? bonded : ground_of(85),
                         bodies, settings);
  if (!on_ground) scene.joints.of_set = {bonded};
  const int b = on_ground ? 0 : 1;
  const auto add = [&](const Vec3& at, const Vec3& force) {
    const Quat& attitude = scene.blocks.rest[b].attitude;
    scene.loads.push_back({b, attitude.conjugate() * (at - Vec3(0, 0, 0.5)), force});
  };
  const Vec3 force = load.force.z() > 0 ? Vec3(share * load.force.x(), share * load.force.y(),
                                               weight + share * (load.force.z() - weight))
                                        : Vec3(share * load.force);
  add(Vec3::Zero(), force);
  for (int axis = 0; axis < 3; ++axis) {  // couples of an arm of 1 m
    const Vec3 arm = 0.5 * Vec3::Unit((axis + 1) % 3),
               pair = share * load.couple[axis] * Vec3::Unit((axis + 2) % 3);
    if (pair.isZero(0)) continue;
    add(arm, pair);
    add(-arm, -pair);
  }
  return scene;
}

double strayed(const Scene& scene, const State& state) {
  const auto b = scene.blocks.rest.size() - 1;
  const Pose &now = state.motion[b].pose, &then = scene.blocks.rest[b];
  return (now.position - then.position).norm() + now.attitude.angularDistance(then.attitude);
}

// The loads set in when the cube rests under its weight.
State run_from_rest(const Scene& scene, double time) {
  Scene unloaded = scene;
  unloaded.loads.clear();
  State state = start(unloaded);
  Work work = make_work(scene);
  while (state.time < time - 1e-9) step(scene, state, work);
  return state;
}

class LoadedFace : public testing::TestWithParam<std::tuple<bool, int>> {};
INSTANTIATE_TEST_SUITE_P(
    Bonds, LoadedFace,
    testing::Combine(testing::Bool(), testing::Range(0, static_cast<int>(std::size(face_loads)))));

TEST_P(LoadedFace, HoldsUpToItsClosedForm) {
  const auto [on_ground, i] = GetParam();
  const FaceLoad& load = face_loads[i];
  const Scene below = loaded_cube(on_ground, load, 0.98),
              above = loaded_cube(on_ground, load, 1.02);
  EXPECT_LT(strayed(below, run_from_rest(below, 0.5)), 1e-3) << load.name;
  EXPECT_GT(strayed(above, run_from_rest(above, 0.5)), 0.01) << load.name;
}

// A bond without tensile strength that is lifted off and lands again is gone, on the ground as
// between blocks; before that it holds the cube on a slope steeper than its friction.
class OpenedBond : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Bonds, OpenedBond, testing::Bool());

TEST_P(OpenedBond, IsGone) {
  const bool on_ground = GetParam();
  GroundClass bonded = ground_of(10);
  bonded.cohesion = 1e6;
  Scene scene = cube_on_slab(15, bonded);
  if (on_ground) {
    const SlopeFrame frame = slope_frame(15, 30);
    const Body cube = body_of(box_in(frame, Vec3::Zero(), Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1)));
    Settings settings;
    settings.sleep = false;
    scene = scene_of(plane_trn(frame, 1, 30), bonded, {cube}, settings);
  } else {
    scene.ground.classes[0].cohesion = scene.ground.classes[0].tension = 1e9;
  }
  const auto slid_by = [&](double time) { return strayed(scene, run(scene, time)); };
  EXPECT_LT(slid_by(1), 1e-3);
  // the ground drops away at 12 m/s2, stops, and the cube lands a few centimetres lower
  scene.base.time = {0, 0.5, 0.5001, 0.6, 0.6001, 0.7, 0.7001, 9};
  const Vec3 down(0, 0, -12);
  scene.base.acceleration = {Vec3::Zero(), Vec3::Zero(), down,         down,
                             -down,        -down,        Vec3::Zero(), Vec3::Zero()};
  EXPECT_GT(slid_by(3), 0.3);
}

// A bond that the pull of a hanging chain breaks: the one that carries most, and no other.
TEST(Bonds, OfAChainTheOneThatCarriesMostBreaks) {
  GroundClass set = ground_of(10);
  set.cohesion = 1e6;
  set.tension = 2.5 * weight / area;
  Body slab, cube[3];
  slab.parts = {box(Vec3(-3, -3, 4), Vec3(3, 3, 5))};
  slab.parts[0].face_tag.assign(6, 0);
  std::vector<Body> bodies{slab};
  for (int i = 0; i < 3; ++i) {
    cube[i].parts = {box(Vec3(-0.5, -0.5, 3 - i), Vec3(0.5, 0.5, 4 - i))};
    cube[i].parts[0].face_tag.assign(6, 0);
    bodies.push_back(cube[i]);
  }
  Settings settings;
  settings.sleep = false;
  Scene scene = scene_of(make_trn([](double, double) { return -20.0; }, 1, 30), ground_of(45),
                         bodies, settings);
  scene.joints.of_set = {set};
  scene.fixed.classes = {ground_of(60)};
  add_fixed_body(scene, box(Vec3(-3, -3, 0), Vec3(-2, 3, 4)), 0);
  add_fixed_body(scene, box(Vec3(2, -3, 0), Vec3(3, 3, 4)), 0);
  const State state = run(scene, 0.5);
  ASSERT_EQ(state.bonds.size(), 3u);
  EXPECT_EQ(state.bonds[0].area, 0);
  EXPECT_NEAR(state.bonds[1].area, 1, 1e-9);
  EXPECT_NEAR(state.bonds[2].area, 1, 1e-9);
}

// Faces of two sets: each pair of faces has its own friction.
TEST(JointClasses, FrictionIsThatOfTheFacesThatTouch) {
  const GroundClass smooth = ground_of(10), rough = ground_of(40);
  for (const bool slides : {false, true}) {
    Scene scene = cube_on_slab(25, slides ? smooth : rough);
    scene.joints.of_set.push_back(slides ? rough : smooth);  // of no face
    const State state = run(scene, 1);
    EXPECT_EQ(slid(scene, state) > 0.5, slides);
  }
}

// A block whose face is bonded to the ground is shaken beside a steep rise, hardly a millimetre
// off, by one acceleration in the first part of a step and another one after that. The bond fails
// where it does not hold one of them, whatever their mean is; an attempt at a longer step breaks
// nothing.
struct Shaking {
  double peak, gap, rise, height, strength;  // strength: of the peak
  double before, until;                      // share of the peak, up to this share of a step
  double up;                                 // of the peak
};
class LoneBond : public testing::TestWithParam<Shaking> {};
INSTANTIATE_TEST_SUITE_P(Bonds, LoneBond,
                         testing::Values(Shaking{189.519, 9.0356e-4, 1.8065, 1.64157, 0.964664, 0,
                                                 0.911034, -0.458496},
                                         Shaking{43.2762, 1.1135e-5, 6.1898, 1.79661, 0.703021,
                                                 -0.977732, 0.458969, 0.571632}));

TEST_P(LoneBond, FailsByWhatItCarriesInAnAcceptedSubstep) {
  const Shaking& p = GetParam();
  Settings settings;
  settings.dt = 0.02;
  const Body block = body_of(box(Vec3(-1 - p.gap, 0.2, 0), Vec3(-p.gap, 1.2, p.height)));
  const auto wall = [&](double x, double) { return x > 0 ? p.rise * x : 0.0; };
  Scene scene = scene_of(make_trn(wall, 1, 20), ground_of(10, 0), {block}, settings);
  GroundClass& ground = scene.ground.classes[0];
  ground.cohesion = p.strength * scene.blocks.mass[0] * p.peak;
  ground.tension = 1e9;
  const Vec3 shaken = p.peak * Vec3(-1, 0, -p.up);
  scene.base.time = {0, p.until * settings.dt, p.until * settings.dt + 1e-6, 1};
  scene.base.acceleration = {p.before * shaken, p.before * shaken, shaken, shaken};
  State state = start(scene);
  Work work = make_work(scene);
  const auto bonded = [&] {
    double sum = 0;
    for (const ContactMemory& memory : state.memory[0]) sum += memory.bond_area;
    return sum;
  };
  ASSERT_NEAR(bonded(), 1, 1e-9);
  bool holds = true;
  for (const double share : {p.before, 1.0}) {
    const Vec3 pull = scene.gravity - share * shaken;
    const double pressed = std::max(0.0, -pull.z());
    holds &= std::abs(pull.x()) < p.strength * p.peak + ground.friction * pressed;
  }
  for (int k = 0; k < 2; ++k) step(scene, state, work);
  EXPECT_NEAR(bonded(), holds ? 1 : 0, 1e-9);
  const double moved = (state.motion[0].pose.position - scene.blocks.rest[0].position).norm();
  if (holds) {
    EXPECT_LT(moved, 2e-3);
  }
}

}  // namespace
