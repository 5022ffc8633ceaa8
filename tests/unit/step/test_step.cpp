// One step of all blocks: energy, rest, hits, domain, allocation.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/random.hpp"
#include "contact/search.hpp"
#include "motion/rotation.hpp"
#include "scene/joint_water.hpp"
#include "step/flight.hpp"
#include "step/step.hpp"
#include "step/substep.hpp"
#include "unit/contact/depth_below_ground.hpp"
#include "unit/contact/ground_overlap.hpp"
#include "unit/count_allocations.hpp"
#include "unit/step/rough_scene.hpp"
#include "verify/cases/case_run.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;
using test::counts_allocations, test::n_allocations;

// Shear strains and turning share an angular momentum where a block's moments differ. Counted with
// the turning alone, blocks that lay on three points continued to turn by up to 0.2 mm/s.
TEST(Step, BlocksWithStrainsComeToRest) {
  const auto waves = [](double x, double y) {
    return 0.4 * std::sin(0.9 * x + 0.3) * std::cos(0.7 * y);
  };
  for (int k = 0; k < 8; ++k) {
    const Mat3 turn = Eigen::AngleAxisd(0.5 + k, Vec3(1, 2 + k, 3).normalized()).toRotationMatrix();
    const Polyhedron shape = moved(box(Vec3(-0.5, -1, -2), Vec3(0.5, 1, 2)), turn, Vec3::Zero(),
                                   Vec3(0.3 * k, 0.2 * k, 2.6));
    Settings settings;
    settings.strains = true;
    settings.sleep = false;
    const Scene scene = scene_of(make_trn(waves, 1, 60), ground_of(30, 0.3),
                                 {body_of(shape, Vec3(0.5, 0, 0))}, settings, {2500, 1e9, 0.25});
    State state = start(scene);
    Work work = make_work(scene);
    double fastest = 0, turned = 0;
    while (state.time < 22) {
      step(scene, state, work);
      if (state.time < 20) continue;
      const Motion& m = state.motion[0];
      fastest = std::max(fastest, m.velocity.norm());
      turned = std::max(turned, (m.angular_momentum.cwiseQuotient(scene.blocks.inertia[0])).norm());
    }
    EXPECT_EQ(state.phase[0], Phase::near_ground) << k;
    EXPECT_FALSE(state.memory[0].empty()) << k;
    EXPECT_LT(fastest, 1e-9) << k;
    EXPECT_LT(turned, 1e-9) << k;
  }
}

TEST(Step, DoesNotAllocate) {
  if (!counts_allocations) GTEST_SKIP() << "the thread sanitizer counts nothing";
  for (const bool strains : {false, true}) {
    Settings settings;
    settings.strains = strains;
    const Scene scene = rough_scene(settings);
    State state = start(scene);
    Work work = make_work(scene);
    const long before = n_allocations;
    for (int i = 0; i < 2000; ++i) step(scene, state, work);
    EXPECT_EQ(n_allocations, before);
    EXPECT_GT(state.counters.impacts, 5);
  }
}

// Blocks that meet on rough ground: once the buffers have grown to the run, it asks for nothing.
TEST(Step, IslandsDoNotAllocateAfterWarmUp) {
  if (!counts_allocations) GTEST_SKIP() << "the thread sanitizer counts nothing";
  Scene scene = rough_scene({});
  std::vector<Body> bodies;
  for (int i = 0; i < 10; ++i)
    bodies.push_back(body_of(
        moved(box(Vec3(-0.6, -0.4, -0.3), Vec3(0.6, 0.4, 0.3)),
              Eigen::AngleAxisd(i, Vec3(1, i, 2).normalized()).toRotationMatrix(), Vec3::Zero(),
              Vec3(-40 + 1.7 * (i % 2), 3 + 1.7 * (i / 2 % 2), bumps(-40, 3) + 4 + 1.7 * (i / 4))),
        Vec3(2, 0, 0)));
  scene = scene_of(scene.ground.trn, scene.joint, bodies, {});
  const State first = start(scene);
  State state = first;
  Work work = make_work(scene);
  for (int warm_up = 0; warm_up < 6; ++warm_up, state = first)
    for (int i = 0; i < 800; ++i) step(scene, state, work);
  const long before = n_allocations;
  for (int i = 0; i < 800; ++i) step(scene, state, work);
  EXPECT_EQ(n_allocations, before);
  EXPECT_GT(state.counters.impacts, 50);
}

TEST(Step, MassesDoNotAllocateAfterWarmUp) {
  if (!counts_allocations) GTEST_SKIP() << "the thread sanitizer counts nothing";
  std::vector<Body> bodies;
  for (int i = 0; i < 64; ++i) {
    const Vec3 low(i % 4, i / 4 % 4, i / 16);
    bodies.push_back(body_of(box(low, low + Vec3::Ones()), Vec3(9, 0, 0)));
  }
  Settings settings;
  settings.masses = true;
  const Scene scene =
      scene_of(plane_trn(slope_frame(0, 0), 2, 60), ground_of(30, 0.3), bodies, settings);
  const State first = start(scene);
  State state = first;
  Work work = make_work(scene);
  for (int warm_up = 0; warm_up < 4; ++warm_up, state = first)
    while (state.time < 0.75) step(scene, state, work);
  for (int i = 0; i < 3; ++i) step(scene, state, work);
  const long before = n_allocations;
  while (state.time < 0.715) step(scene, state, work);
  EXPECT_EQ(n_allocations, before);
  EXPECT_TRUE(state.mass[0].is_in_mass);
}

// A block on a slope slides off water that its opening joints lose.
TEST(Step, WaterDoesNotAllocate) {
  if (!counts_allocations) GTEST_SKIP() << "the thread sanitizer counts nothing";
  const SlopeFrame frame = slope_frame(35, 0);
  std::vector<Body> bodies;
  for (const double x : {-1.0, 0.0, 1.0})
    bodies.push_back(body_of(box_in(frame, Vec3::Zero(), Vec3(x, -1, 0), Vec3(x + 1, 1, 1))));
  Scene scene = scene_of(plane_trn(frame, 1, 40), ground_of(30), bodies, {});
  JointWater water;
  water.unit_weight = 1e4;
  water.surface = scene.ground.trn.elevation;
  for (double& z : water.surface) z += 0.7;
  add_joint_water(water, scene);
  scene.drained_at = 0.01;
  ASSERT_EQ(scene.wet_faces.size(), 5u);
  const State first = start(scene);
  State state = first;
  Work work = make_work(scene);
  for (int warm_up = 0; warm_up < 2; ++warm_up, state = first)
    for (int i = 0; i < 200; ++i) step(scene, state, work);
  const long before = n_allocations;
  for (int i = 0; i < 200; ++i) step(scene, state, work);
  EXPECT_EQ(n_allocations, before);
  EXPECT_LT(state.pressure[0], 1);
}

TEST(Step, IsTheSameToTheBitWhenRepeated) {
  const Scene scene = rough_scene({});
  Motion last[2];
  for (Motion& m : last) {
    State state = start(scene);
    Work work = make_work(scene);
    for (int i = 0; i < 1500; ++i) {
      step(scene, state, work);
      if (&m == &last[0]) (void)motion_at(scene, state, 0, state.time);  // looking changes nothing
    }
    m = motion_at(scene, state, 0, state.time);
  }
  EXPECT_EQ(last[0].pose.position, last[1].pose.position);
  EXPECT_EQ(last[0].pose.attitude.coeffs(), last[1].pose.attitude.coeffs());
  EXPECT_EQ(last[0].velocity, last[1].velocity);
}

// Kinetic and potential energy and the losses by friction, impacts and contacts add up to the
// initial energy.
TEST(Step, EnergyBalanceCloses) {
  const Scene scene = rough_scene({});
  State state = start(scene);
  Work work = make_work(scene);
  const auto total = [&] {
    const Energies e = energies(scene, state);
    const EnergyLedger& l = state.ledger;
    return e.translation + e.rotation + e.potential + l.friction + l.impact + l.contact + l.removed;
  };
  const double before = total();
  const Energies e = energies(scene, state);
  for (int i = 0; i < 2000; ++i) step(scene, state, work);
  EXPECT_GT(state.ledger.impact, 0.01 * (e.translation + e.rotation));
  EXPECT_NEAR(total(), before, 1e-3 * (e.translation + e.rotation));
}

// The segments of a run follow one another without a gap, each a parabola, from start to now.
TEST(Step, SegmentsAreParabolasEndToEnd) {
  const Scene scene = rough_scene({});
  State state = start(scene);
  Work work = make_work(scene);
  Vec3 position = state.motion[0].pose.position;
  double time = 0;
  bool flew = false;
  for (int i = 0; i < 1000; ++i) {
    step(scene, state, work);
    for (const Segment& s : work.segments) {
      EXPECT_NEAR(s.t_start, time, 1e-9);
      EXPECT_LT((s.start.pose.position - position).norm(), 1e-12);
      const double h = s.t_end - s.t_start;
      const Vec3 end = s.start.pose.position + h * (s.start.velocity + h / 2 * s.acceleration);
      EXPECT_LT((end - s.end.pose.position).norm(), 0.05);
      position = s.end.pose.position;
      time = s.t_end;
      flew |= s.flight;
    }
  }
  EXPECT_TRUE(flew);
  EXPECT_NEAR(state.phase[0] == Phase::flight ? state.local_time[0] : state.time, time, 1e-9);
}

double weight_carried(const State& state) {
  double N = 0;
  for (const ContactMemory& memory : state.memory[0]) N += memory.normal_force * memory.normal.z();
  return N;
}

// A body laid onto ground of that shape stays, and contacts of one mode carry its whole weight.
void expect_rests_by(ContactMode mode, const Body& body, double (*ground_shape)(double, double)) {
  GroundClass ground;
  ground.friction = 0.5;
  Settings settings;
  settings.sleep = false;
  const Scene scene = scene_of(make_trn(ground_shape, 0.5, 6), ground, {body}, settings);
  State state = start(scene);
  Work work = make_work(scene);
  const Vec3 from = state.motion[0].pose.position;
  for (int i = 0; i < 1000; ++i) step(scene, state, work);
  EXPECT_LT((state.motion[0].pose.position - from).norm(), 1e-6);
  EXPECT_NEAR(weight_carried(state) / (scene.blocks.mass[0] * 10), 1, 1e-6);
  for (const ContactMemory& memory : state.memory[0]) EXPECT_EQ(memory.key.mode, mode);
}

// Mode 3: a beam across two ridges rests on them by its edges alone.
TEST(Step, BeamRestsOnRidgesByItsEdges) {
  expect_rests_by(ContactMode::edge_edge, body_of(box(Vec3(-1.8, -0.3, 0), Vec3(1.9, 0.35, 0.4))),
                  [](double x, double) { return -0.5 * std::abs(std::abs(x) - 1); });
}

// Mode 2: a plate on four peaks rests on them by its face alone.
TEST(Step, PlateRestsOnPeaksByItsFace) {
  expect_rests_by(ContactMode::face_vertex, body_of(box(Vec3(-1.7, -1.6, 0), Vec3(1.6, 1.7, 0.2))),
                  [](double x, double y) {
                    return -0.6 * std::max(std::abs(std::abs(x) - 1), std::abs(std::abs(y) - 1));
                  });
}

// The four corners of a cube that lands without a bounce close once and then keep their state.
TEST(Step, FlipsCountChangesOfState) {
  const Body cube = body_of(box(Vec3(-0.5, -0.5, 0.01), Vec3(0.5, 0.5, 1.01)));
  GroundClass ground;
  ground.friction = 0.5;
  Settings settings;
  settings.sleep = false;
  const Scene scene = scene_of(plane_trn(slope_frame(0, 0), 1, 5), ground, {cube}, settings);
  State state = start(scene);
  Work work = make_work(scene);
  int landing = 0, after = 0;
  for (int i = 0; i < 200; ++i) (i < 100 ? landing : after) += step(scene, state, work).n_flips;
  EXPECT_EQ(landing, 4);
  EXPECT_EQ(after, 0);
}

// --plan=full searches in every step, keeps sleepers awake and computes strains. The first two are
// no approximation where a block slides: the bits are the same. Strains are those of its weight.
TEST(Step, TheFullPlanAgrees) {
  const SlopeFrame frame = slope_frame(30, 37);
  const Body cube = body_of(box_in(frame, Vec3::Zero(), Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1)));
  const GroundClass ground = ground_of(20);
  const auto slide = [&](const Settings& settings) {
    const Scene scene = scene_of(plane_trn(frame, 0.5, 20), ground, {cube}, settings);
    State state = start(scene);
    Work work = make_work(scene);
    for (int i = 0; i < 200; ++i) step(scene, state, work);
    return state.motion[0];
  };
  Settings all_but_strains;
  all_but_strains.flight = all_but_strains.sleep = false;
  Settings all = all_but_strains;
  all.strains = true;
  const Motion planned = slide({}), searched = slide(all_but_strains), full = slide(all);
  EXPECT_EQ(planned.pose.position, searched.pose.position);
  EXPECT_EQ(planned.pose.attitude.coeffs(), searched.pose.attitude.coeffs());
  EXPECT_EQ(planned.velocity, searched.velocity);
  EXPECT_GT(planned.velocity.norm(), 1.5);
  EXPECT_LT((planned.pose.position - full.pose.position).norm(), 1e-5 * planned.velocity.norm());
}

// A block is stopped before it leans out over the edge, where nothing would support its corners:
// alone, beside another block, and with both laws.
TEST(Step, BlocksThatLeaveAreStoppedAndCounted) {
  const SlopeFrame frame = slope_frame(30, 0);
  const auto cube = [&](double y) {
    return body_of(box_in(frame, Vec3(0, y, 0), Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1)));
  };
  for (const bool is_paper : {false, true})
    for (const std::size_t n : {1u, 2u}) {
      Settings settings;
      RunLaw law;
      if (is_paper) law = PaperLaw{}, settings.normal_stiffness = 1e9;
      const Scene scene =
          scene_of(plane_trn(frame, 1, 10), {},
                   n == 1 ? std::vector{cube(0)} : std::vector{cube(0), cube(1)}, settings);
      Work work = make_work(scene);
      State state = start_by(law, scene, work);
      StepFlag flags = StepFlag::none;
      for (int i = 0; i < 2000; ++i) flags = flags | step_by(law, scene, state, work).flags;
      EXPECT_TRUE(has(flags, StepFlag::left_domain));
      EXPECT_FALSE(has(flags, StepFlag::fell_through));
      EXPECT_EQ(state.counters.left_domain, n);
      EXPECT_GT(state.ledger.removed, 0);
      for (std::size_t b = 0; b < n; ++b) {
        EXPECT_EQ(state.phase[b], Phase::left_domain);
        const Pose& pose = state.motion[b].pose;
        const double beyond = is_paper ? 0.1 : 0;  // by its last step
        for (const Vec3& X : vertices_of(scene.blocks.shapes, static_cast<int>(b)))
          EXPECT_LE((pose.position + pose.attitude * X).x(), 10 + beyond) << n << " " << b;
      }
    }
}

// A cube of 1 m on springs so soft that its weight presses them in by 0.02 m or by 0.2 m.
TEST(Step, DeepPenetrationIsFlagged) {
  const SlopeFrame frame = slope_frame(0, 0);
  const Body cube = body_of(box_in(frame, Vec3::Zero(), Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1)));
  for (const auto& [depth, is_deep] : {std::pair{0.02, false}, {0.2, true}}) {
    Settings settings;
    settings.dt = 1e-3;
    settings.normal_stiffness = 2500 * 10 / (4 * depth);
    cases::Run run(scene_of(plane_trn(frame, 1, 10), {}, {cube}, settings), PaperSettings{});
    run.advance_to(1);
    EXPECT_EQ(has(run.result.flags, StepFlag::deep), is_deep) << depth;
  }
}

// Block b of one part where it is now.
Polyhedron placed_shape(const Scene& scene, const State& state, const std::vector<Body>& bodies,
                        std::size_t b) {
  const Pose& pose = state.motion[b].pose;
  const auto corners = vertices_of(scene.blocks.shapes, static_cast<int>(b));
  Polyhedron shape = bodies[b].parts[0];
  for (std::size_t v = 0; v < corners.size(); ++v)
    shape.vertices[v] = pose.position + pose.attitude * corners[v];
  return shape;
}

// Slabs and rods that tumble down ground of ridges and valleys: within a step a corner or an edge
// may go through a ridge, or slide into a valley. None is deep in the ground, neither by the
// contacts nor by the overlap of the two surfaces.
TEST(Step, ThinBlocksThatTumbleOverRidgesAreNotDeepInThem) {
  Random random(7, "ridges");
  const auto rough = [](double x, double y) {
    return -x + 2.5 * std::sin(12.9898 * x) * std::cos(78.233 * y);
  };
  std::vector<Body> bodies;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 half = i % 2 ? Vec3(1, 0.75, 0.15) : Vec3(1.5, 0.2, 0.2);
    const double x = random.uniform(-140, -60), y = random.uniform(-60, 60);
    const auto number = [&] { return random.uniform(-1, 1); };
    const Quat attitude = Quat(number(), number(), number(), number()).normalized();
    Body body = body_of(
        moved(box(-half, half), attitude.toRotationMatrix(), Vec3::Zero(), Vec3(x, y, 8 - x)),
        Vec3(random.uniform(5, 25), random.uniform(-5, 5), random.uniform(-10, 0)));
    body.spin = random.uniform(0, 15) * Vec3(number(), number(), number()).normalized();
    bodies.push_back(body);
  }
  Settings settings;
  settings.block_contacts = false;
  const Scene scene = scene_of(make_trn(rough, 5, 150), ground_of(30, 0.5), bodies, settings);
  State state = start(scene);
  Work work = make_work(scene);
  int n_deep = 0, n_steps = 0;
  double deepest = 0;
  while (state.time < 4) {
    n_deep += has(step(scene, state, work).flags, StepFlag::deep);
    if (++n_steps % 10 != 0) continue;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      if (state.phase[b] == Phase::flight) continue;
      const Polyhedron shape = placed_shape(scene, state, bodies, b);
      deepest = std::max(deepest, test::vertical_overlap(scene.ground.trn, shape).height);
    }
  }
  EXPECT_EQ(n_deep, 0);
  EXPECT_LT(deepest, 0.01);
}

// Rods that come to rest on steep ground, some of them with an edge on a node, over which the
// ridges that meet there take turns. None is pressed into it.
TEST(Step, BlocksThatLeanOnNodesDoNotSinkIntoThem) {
  Random random(11, "nodes");
  const auto rough = [](double x, double y) {
    return -0.6 * x + 3.5 * std::sin(12.9898 * x) * std::cos(78.233 * y);
  };
  std::vector<Body> bodies;
  for (int i = 0; i < 1000; ++i) {
    const auto number = [&] { return random.uniform(-1, 1); };
    const Vec3 half{random.uniform(1, 2), random.uniform(1, 2), random.uniform(2, 5)};
    const Quat attitude = Quat{number(), number(), number(), number()}.normalized();
    const double x = random.uniform(-120, 100), y = random.uniform(-130, 130);
    bodies.push_back(body_of(moved(box(-half, half), attitude.toRotationMatrix(), Vec3::Zero(),
                                   Vec3(x, y, 13 - 0.6 * x))));
  }
  Settings settings;
  settings.block_contacts = false;
  const Scene scene = scene_of(make_trn(rough, 5, 150), ground_of(32, 0.3), bodies, settings);
  State state = start(scene);
  Work work = make_work(scene);
  while (state.time < 10) step(scene, state, work);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (state.phase[b] == Phase::flight || state.phase[b] == Phase::left_domain) continue;
    EXPECT_LT(
        test::vertical_overlap(scene.ground.trn, placed_shape(scene, state, bodies, b)).height,
        0.005)
        << b;
  }
}

// Bonded face on a slope: fails where rho g h sin(th) = tan(phi) rho g h cos(th) + c.
TEST(Step, BondHoldsToItsStrengthAndBreaksForGood) { EXPECT_LT(bond_angle({}).error, 0.05); }

// Gravity makes 0.5 m/s in a step: a faster block rebounds and lifts off, a slower one is taken up
// by the springs and never leaves the ground.
TEST(Step, HitsFasterThanAStepOfGravityRebound) {
  Settings settings;
  settings.dt = 0.05;
  const auto highest_after_the_hit = [&](double speed) {
    const Scene scene =
        scene_of(make_trn([](double, double) { return 0.0; }, 1, 20), ground_of(30, 0.7),
                 {body_of(box(Vec3(-0.5, -0.5, 0.001), Vec3(0.5, 0.5, 1.001)), Vec3(0, 0, -speed))},
                 settings);
    State state = start(scene);
    Work work = make_work(scene);
    double highest = -1;
    while (state.time < 1) {
      step(scene, state, work);  // the first one hits
      const Motion now = motion_at(scene, state, 0, state.time);
      highest = std::max(highest, now.pose.position.z() - 0.5);
    }
    return highest;
  };
  EXPECT_GT(highest_after_the_hit(0.75), 0.01);
  EXPECT_LT(highest_after_the_hit(0.4), 0);
}

// A push on the centroid equal to the weight on a frictionless plane: a = F / m.
TEST(Step, PointLoadPushesAndTurns) {
  const SlopeFrame flat = slope_frame(0, 0);
  const Body cube = body_of(box_in(flat, Vec3::Zero(), Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 0.1)));
  Scene scene = scene_of(plane_trn(flat, 0.5, 10), {}, {cube}, {});
  const double mass = scene.blocks.mass[0];
  scene.loads = {{0, Vec3(0.5, 0, 0), Vec3(0, mass, 0)}};
  State state = start(scene);
  Work work = make_work(scene);
  for (int i = 0; i < 20; ++i) step(scene, state, work);
  EXPECT_NEAR(state.motion[0].velocity.y(), state.time, 1e-6);
  const double torque = 0.5 * mass;  // about z, while the block has hardly turned
  EXPECT_NEAR(state.motion[0].angular_momentum.z() / (torque * state.time), 1, 1e-2);
  const double angle = torque * state.time * state.time / 2 / (mass / 6);
  EXPECT_NEAR(state.motion[0].pose.attitude.angularDistance(scene.blocks.rest[0].attitude) / angle,
              1, 2e-3);
}

}  // namespace
