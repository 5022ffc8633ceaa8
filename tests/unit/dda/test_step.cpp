#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <new>
#include <numbers>

#include "base/random.hpp"
#include "contact/search.hpp"
#include "dda/flight.hpp"
#include "dda/rotation.hpp"
#include "dda/step.hpp"
#include "dda/substep.hpp"
#include "unit/contact/depth_below_ground.hpp"
#include "unit/contact/ground_overlap.hpp"
#include "verify/cases.hpp"
#include "verify/closed_form.hpp"

namespace {

long n_allocations = 0;

}  // namespace

// Counts what the C++ library asks for; not inlined, or the compiler sees malloc meet delete.
__attribute__((noinline)) void* operator new(std::size_t size) {
  ++n_allocations;
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
__attribute__((noinline)) void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++n_allocations;
  return std::malloc(size);
}
__attribute__((noinline)) void operator delete(void* p) noexcept { std::free(p); }
__attribute__((noinline)) void operator delete(void* p, std::size_t) noexcept { std::free(p); }

namespace {

using namespace talus;
using namespace talus::cases;

double bumps(double x, double y) {
  return 2 * std::sin(0.35 * x) * std::cos(0.27 * y) +
         0.3 * std::sin(1.7 * x + 0.4) * std::sin(1.3 * y) - 0.4 * x;
}

// A tumbling block on rough ground.
Scene rough_scene(const Settings& settings) {
  GroundClass ground;
  ground.friction = 0.5;
  ground.restitution = 0.4;
  Polyhedron shape = box(Vec3(-0.8, -0.5, -0.3), Vec3(0.8, 0.5, 0.3));
  shape = moved(shape, Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix(),
                Vec3::Zero(), Vec3(-40, 3, bumps(-40, 3) + 6));
  return scene_of(make_trn(bumps, 1, 80), ground, {body_of(shape, Vec3(4, 1, 0), Vec3(1, 2, 0.5))},
                  settings);
}

// Shear strains and turning share an angular momentum where a block's moments differ. Counted with
// the turning alone, blocks that lay on three points went on turning by up to 0.2 mm/s.
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

// Kinetic, potential and what friction, impacts and contacts took add up to what there was.
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

// In between, a free body keeps its angular momentum to the bit and its parabola to rounding.
TEST(Step, FlightAndStepwiseMotionAgree) {
  const Scene a = rough_scene({});
  Scene b = a;
  b.base.time = {0, 1e9};  // ground that might move, and does not: followed step by step
  b.base.acceleration = {Vec3::Zero(), Vec3::Zero()};
  State sa = start(a), sb = start(b);
  Work wa = make_work(a), wb = make_work(b);
  for (int i = 0; i < 60; ++i) step(a, sa, wa), step(b, sb, wb);  // before the first hit
  const Motion ma = motion_at(a, sa, 0, sa.time), mb = motion_at(b, sb, 0, sb.time);
  EXPECT_EQ(sa.counters.impacts, 0);
  EXPECT_LT((ma.pose.position - mb.pose.position).norm(), 1e-12);
  EXPECT_LT(ma.pose.attitude.angularDistance(mb.pose.attitude), 1e-6);
  EXPECT_EQ(ma.angular_momentum, mb.angular_momentum);
}

// The deepest that a ball reaches below the ground, over points of its surface [m].
double ball_below(const Trn& trn, const Vec3& centre, double radius) {
  double below = -1e300;
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 24; ++j) {
      const double polar = i * std::numbers::pi / 24, around = j * std::numbers::pi / 12;
      const Vec3 at = centre + radius * Vec3(std::sin(polar) * std::cos(around),
                                             std::sin(polar) * std::sin(around), -std::cos(polar));
      if (contains(trn, at.x(), at.y()))
        below = std::max(below, elevation_at(trn, at.x(), at.y()) - at.z());
    }
  return below;
}

// And not much of the time until the ball touches is left out: what the planes of triangles reach
// beyond their sides.
TEST(FreeTime, NothingIsInTheBallBeforeIt) {
  const Ground ground = make_ground(make_trn(bumps, 1, 60), {});
  Random random(5, "free time");
  int flights = 0;
  double sum = 0, sum_until_touch = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const double x = random.uniform(-40, 40), y = random.uniform(-40, 40), radius = 0.5;
    const Vec3 from(x, y, bumps(x, y) + random.uniform(0.3, 20));
    const Vec3 v(random.uniform(-15, 15), random.uniform(-15, 15), random.uniform(-10, 10));
    const Vec3 a(0, 0, -10);
    const double T = free_time(ground, {from, v, radius}, a, 100);
    const auto centre = [&](double t) { return Vec3(from + t * v + t * t / 2 * a); };
    if (T == 0) continue;
    ++flights;
    for (int k = 0; k <= 100; ++k)
      EXPECT_LT(ball_below(ground.trn, centre(T * k / 100), radius), 1e-9) << trial << ", " << k;
    double touch = T;
    while (ball_below(ground.trn, centre(touch), radius) < 0 &&
           contains(ground.trn, centre(touch).x(), centre(touch).y()))
      touch += 0.01;
    sum += T;
    sum_until_touch += touch;
  }
  EXPECT_GT(flights, 200);
  EXPECT_GT(sum, 0.8 * sum_until_touch);
}

// Some motion of a block that may be anywhere over the bumps, low above them more often than not.
Motion thrown_over_bumps(double least_height, Random& random) {
  Motion m;
  const double x = random.uniform(-40, 40), y = random.uniform(-40, 40);
  m.pose.position = {x, y, bumps(x, y) + least_height + 3 * std::pow(random.uniform(0, 1), 3)};
  m.pose.attitude = Quat(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1),
                         random.uniform(-1, 1))
                        .normalized();
  m.velocity = {random.uniform(-15, 15), random.uniform(-15, 15), random.uniform(-5, 5)};
  return m;
}

// The deepest gap of a block's contacts with the ground, 0: above it [m].
double deepest(const Scene& scene, const Pose& pose) {
  std::vector<Vec3> vertices;
  std::vector<Contact> contacts;
  (void)find_contacts(scene.ground, scene.blocks.shapes, 0, pose, Mat3::Identity(), 0, vertices,
                      contacts);
  double gap = 0;
  for (const Contact& contact : contacts) gap = std::min(gap, contact.gap);
  return gap;
}

// The vertices tell more than the ball, the more the less the block spins.
TEST(FreeTime, NoPartOfABlockIsBelowTheGroundBeforeIt) {
  const Scene scene = scene_of(make_trn(bumps, 1, 60), {},
                               {body_of(box(Vec3(-0.5, -0.4, -0.2), Vec3(0.5, 0.4, 0.2)))}, {});
  const Vec3 a(0, 0, -10), &inertia = scene.blocks.inertia[0];
  const double radius = scene.blocks.shapes.radius[0];
  Random random(6, "free time of a block");
  for (const double fastest : {0.0, 1.0, 10.0}) {
    double sum = 0, sum_of_ball = 0;
    for (int trial = 0; trial < 400; ++trial) {
      Motion m = thrown_over_bumps(0.2, random);
      const Vec3 spin(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      m.angular_momentum = angular_momentum(m.pose.attitude, fastest * spin, inertia);
      if (deepest(scene, m.pose) < 0) continue;
      const double T = free_time(
          scene.ground, flying_body(m, inertia, radius, vertices_of(scene.blocks.shapes, 0)), a, 9);
      const double of_ball = free_time(scene.ground, flying_body(m, inertia, radius, {}), a, 9);
      EXPECT_GE(T, of_ball * (1 - 1e-9)) << trial;
      for (int k = 1; k <= 20; ++k) {
        const double t = T * k / 20;
        EXPECT_GT(deepest(scene, fly(m, inertia, a, t).pose), -1e-8) << trial << ", " << t;
      }
      sum += T;
      sum_of_ball += of_ball;
    }
    EXPECT_GT(sum, (fastest < 10 ? 1.05 : 1.02) * sum_of_ball) << fastest;
  }
}

// Without spin it is known when the block lands on a plane: no search is needed on the way.
TEST(FreeTime, IsExactWithoutSpinOnAPlane) {
  const auto plane = [](double x, double y) { return 0.3 * x - 0.2 * y; };
  const Scene scene = scene_of(make_trn(plane, 1, 60), {},
                               {body_of(box(Vec3(-0.5, -0.4, -0.2), Vec3(0.5, 0.4, 0.2)))}, {});
  Random random(7, "landing");
  for (int trial = 0; trial < 100; ++trial) {
    Motion m = thrown_over_bumps(0, random);
    m.pose.position /= 2;  // far enough from the grid's edge
    m.pose.position.z() = plane(m.pose.position.x(), m.pose.position.y()) + random.uniform(1, 3);
    const FlyingBody body = flying_body(m, scene.blocks.inertia[0], scene.blocks.shapes.radius[0],
                                        vertices_of(scene.blocks.shapes, 0));
    const double T = free_time(scene.ground, body, {0, 0, -10}, 100);
    Pose pose = m.pose;
    pose.position += T * m.velocity - Vec3(0, 0, 5 * T * T);
    EXPECT_GT(T, 0);
    double lowest = 1;
    for (const Vec3& X : body.vertices) {
      const Vec3 x = place(pose, X);
      lowest = std::min(lowest, x.z() - plane(x.x(), x.y()));
    }
    EXPECT_NEAR(lowest, 0, 1e-9) << trial;
  }
}

TEST(Step, BlockThatBouncesIsHitWithoutASearchOnTheWay) {
  GroundClass ground;
  ground.restitution = 0.7;
  const auto flat = [](double, double) { return 0.0; };
  const Scene scene = scene_of(make_trn(flat, 1, 20), ground,
                               {body_of(box(Vec3(-0.5, -0.5, 5), Vec3(0.5, 0.5, 6)))}, {});
  State state = start(scene);
  Work work = make_work(scene);
  while (state.time < 3.7) step(scene, state, work);  // three hits, the fourth is at 4.07 s
  EXPECT_EQ(state.counters.impacts, 3);
  EXPECT_EQ(state.counters.substeps, 0);
}

TEST(FreeTime, EndsAtUnknownGround) {
  Trn trn = make_trn([](double, double) { return 0.0; }, 1, 20);
  for (double x : {7.0, 8.0}) {
    const GridPoint at = locate(trn, x, 0.5);
    trn.elevation[node_index(trn, at.cell.row, at.cell.col)] = std::nan("");
  }
  const Ground ground = make_ground(std::move(trn), {});
  const double T = free_time(ground, {{0, 0.5, 3}, {10, 0, 10}, 0.5}, {0, 0, -10}, 100);
  EXPECT_GT(T, 0.4);  // on its way there
  EXPECT_LT(T, 0.75);
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

// Its vertices rest on the ground while its centroid sinks: they are not about to hit it.
TEST(Step, BlockThatSagsIsNotHitByTheGroundThatBearsIt) {
  Material soft;
  soft.young = 1e7;
  Settings settings;
  settings.strains = true;
  settings.static_start = false;  // which would begin it sagged
  const SlopeFrame frame = slope_frame(30, 37);
  const Body cube = body_of(box_in(frame, Vec3::Zero(), Vec3(-2, -2, 0), Vec3(2, 2, 4)));
  const Scene scene =
      scene_of(plane_trn(frame, 2, 100), ground_of(20, 0.3), {cube}, settings, soft);
  State state = start(scene);
  Work work = make_work(scene);
  double deepest = 0, strained = 0;
  for (int i = 0; i < 200; ++i) {
    deepest = std::max(deepest, step(scene, state, work).largest_penetration);
    strained = std::max(strained, state.strain[0].norm());
  }
  EXPECT_GT(strained, 5e-3);
  EXPECT_EQ(state.counters.substeps, 200);
  EXPECT_EQ(state.counters.impacts, 0);
  EXPECT_LT(deepest, 1e-5);
}

// At rest or sliding off, a block begins with the strains that its contacts and its weight give it:
// nothing of it swings, whatever its stiffness and the step. (Soft, and within a tenth of a degree
// of what would hold it, it does not find its equilibrium.)
TEST(Step, BlockThatStrainsBeginsInEquilibrium) {
  const SlopeFrame frame = slope_frame(30, 37);
  const Body cube = body_of(box_in(frame, Vec3::Zero(), Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1)));
  const std::pair<double, double> young_and_friction[] = {
      {1e7, 20}, {1e8, 29.9}, {5e10, 20}, {5e10, 29.9}, {5e10, 30.1}};
  for (const auto& [young, friction] : young_and_friction)
    for (const double dt : {1e-3, 5e-3, 2e-2}) {
      Material material;
      material.young = young;
      Settings settings;
      settings.strains = true;
      settings.sleep = false;
      settings.dt = dt;
      const Scene scene =
          scene_of(plane_trn(frame, 0.5, 10), ground_of(friction), {cube}, settings, material);
      State state = start(scene);
      Work work = make_work(scene);
      const Vec6 begin = state.strain[0];
      const double by_weight = 2500 * 10.0 / 2 / young;
      EXPECT_GT(begin.norm(), by_weight / 2);
      for (int i = 0; i < 40; ++i) (void)step(scene, state, work);
      EXPECT_LT((state.strain[0] - begin).norm(), 1e-4 * by_weight)
          << young << " Pa, " << friction << " degrees, " << dt << " s";
      const double tangent = std::tan(friction * std::numbers::pi / 180);
      const double speed = 10 * std::max(0.0, 0.5 - tangent * std::sqrt(0.75)) * state.time;
      EXPECT_NEAR(state.motion[0].velocity.norm(), speed, 1e-3 * speed + 1e-12)
          << young << " Pa, " << friction << " degrees, " << dt << " s";
    }
}

// Blocks that may touch others are computed rigid where they do, and have no strains until they are
// seen to be alone.
TEST(Step, BlocksThatMayMeetBeginWithoutStrains) {
  const SlopeFrame frame = slope_frame(0, 0);
  std::vector<Body> cubes;
  for (const double x : {-5.0, 5.0})
    cubes.push_back(
        body_of(box_in(frame, Vec3::Zero(), Vec3(x - 0.5, -0.5, 0), Vec3(x + 0.5, 0.5, 1))));
  Settings settings;
  settings.strains = true;
  for (const bool meet : {false, true}) {
    settings.block_contacts = meet;
    const State state = start(scene_of(plane_trn(frame, 0.5, 10), ground_of(30), cubes, settings));
    for (const Vec6& strain : state.strain) EXPECT_EQ(strain.isZero(0), meet);
  }
}

// Near its critical friction a block that strains slips at some corners for a moment. With the slip
// of its straining in the direction that friction has, one run in seven took thousands of passes.
TEST(Step, BlockThatStrainsAndAllButSticksSettlesInFewPasses) {
  Settings settings;
  settings.strains = true;
  settings.sleep = settings.static_start = false;
  const SlopeFrame frame = slope_frame(30, 37);
  const Body cube = body_of(box_in(frame, Vec3::Zero(), Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1)));
  for (double friction_deg = 29.8; friction_deg < 30.5; friction_deg += 0.02) {
    const Scene scene =
        scene_of(plane_trn(frame, 0.5, 20), ground_of(friction_deg), {cube}, settings);
    State state = start(scene);
    Work work = make_work(scene);
    for (int i = 0; i < 60; ++i) step(scene, state, work);
    EXPECT_LT(state.counters.passes, 60 * 8) << friction_deg;
    EXPECT_EQ(state.counters.cut_back, 0) << friction_deg;
  }
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

// Two planes that meet at x = 40: a cube slides down the first one in a few long substeps, and in
// short ones where it may meet the other.
TEST(Step, SlidesFarInASubstepOnlyWhileThereIsOnePlaneAhead) {
  const auto bend = [](double x, double) { return -0.4 * std::min(x, 40.0) - 0.1 * x; };
  const SlopeFrame frame = slope_frame(180 / std::numbers::pi * std::atan(0.5), 0);
  const auto slide = [&](double dt, const auto& each_step) {
    Settings settings;
    settings.dt = dt;
    const Body cube = body_of(box_in(frame, Vec3::Zero(), Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1)));
    const Scene scene = scene_of(make_trn(bend, 1, 100), ground_of(10, 0), {cube}, settings);
    State state = start(scene);
    Work work = make_work(scene);
    while (state.time < 6 - dt / 2) {
      const Vec3 from = motion_at(scene, state, 0, state.time).pose.position;
      const StepReport report = step(scene, state, work);
      each_step(from.x(), motion_at(scene, state, 0, state.time), report.substeps);
    }
    return motion_at(scene, state, 0, state.time);
  };
  int long_steps = 0, short_steps = 0;
  const Motion coarse = slide(0.2, [&](double from, const Motion& m, int substeps) {
    const double way = m.velocity.norm() * 0.2;
    if (way > 1 && m.pose.position.x() < 34) {
      ++long_steps;
      EXPECT_EQ(substeps, 1);
    } else if (from > 37 && from < 40) {
      ++short_steps;
      EXPECT_GE(substeps, way / 0.55);
    }
  });
  EXPECT_GT(long_steps, 5);
  EXPECT_GT(short_steps, 0);
  const Motion fine = slide(0.005, [](double, const Motion&, int) {});
  EXPECT_GT(fine.pose.position.x(), 43);
  EXPECT_LT((coarse.pose.position - fine.pose.position).norm(), 0.05);
}

// How far a load or a shaken base takes a block in the meantime is not bounded by gravity.
TEST(Step, SlidesFarInASubstepOnlyUnderGravityAlone) {
  const SlopeFrame frame = slope_frame(25, 0);
  const auto substeps = [&](double share_of_weight) {
    Settings settings;
    settings.dt = 0.2;
    const Body cube = body_of(box_in(frame, Vec3::Zero(), Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1)),
                              10 * frame.dip);
    Scene scene = scene_of(plane_trn(frame, 1, 120), ground_of(10, 0), {cube}, settings);
    if (share_of_weight > 0)
      scene.loads = {{0, Vec3::Zero(), share_of_weight * scene.blocks.mass[0] * 10 * frame.dip}};
    State state = start(scene);
    Work work = make_work(scene);
    step(scene, state, work);
    return step(scene, state, work).substeps;
  };
  EXPECT_EQ(substeps(0), 1);
  EXPECT_GE(substeps(1e-3), 4);
}

// The same on one plane that is rougher beyond x = 40: the block feels that where it comes there.
TEST(Step, SlidesFarInASubstepOnlyOverGroundOfOneKind) {
  const SlopeFrame frame = slope_frame(25, 0);
  const auto slide = [&](double dt) {
    Settings settings;
    settings.dt = dt;
    const Body cube = body_of(box_in(frame, Vec3::Zero(), Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1)));
    Scene scene = scene_of(plane_trn(frame, 1, 120), ground_of(10, 0), {cube}, settings);
    scene.ground.classes.push_back(ground_of(35, 0));
    const Trn& trn = scene.ground.trn;
    for (int row = 0; row < trn.n_rows - 1; ++row)
      for (int col = 0; col < trn.n_cols - 1; ++col)
        scene.ground.cell_class.push_back(trn.node0.x() + col * trn.cell_size >= 40);
    State state = start(scene);
    Work work = make_work(scene);
    while (state.time < 8 - dt / 2) step(scene, state, work);
    return motion_at(scene, state, 0, state.time);
  };
  const Motion coarse = slide(0.2), fine = slide(0.005);
  EXPECT_GT(fine.pose.position.x(), 60);
  EXPECT_NEAR(coarse.pose.position.x(), fine.pose.position.x(), 0.3);
  EXPECT_NEAR(coarse.velocity.norm(), fine.velocity.norm(), 0.15);
}

// What is left out of a bouncing block's path, the search while nothing can be hit, changes no bit.
TEST(Step, SearchedFlightsAreTheSameToTheBit) {
  Settings planned, searched;
  planned.sleep = searched.sleep = searched.flight = false;
  const Scene a = rough_scene(planned), b = rough_scene(searched);
  State sa = start(a), sb = start(b);
  Work wa = make_work(a), wb = make_work(b);
  for (int i = 0; i < 2000; ++i) step(a, sa, wa), step(b, sb, wb);
  EXPECT_GT(sa.counters.flight_skips, 100);
  EXPECT_EQ(sb.counters.flight_skips, 0);
  EXPECT_GT(sa.counters.impacts, 5);
  EXPECT_EQ(sa.counters.impacts, sb.counters.impacts);
  const Motion ma = motion_at(a, sa, 0, sa.time), mb = motion_at(b, sb, 0, sb.time);
  EXPECT_EQ(ma.pose.position, mb.pose.position);
  EXPECT_EQ(ma.pose.attitude.coeffs(), mb.pose.attitude.coeffs());
  EXPECT_EQ(ma.velocity, mb.velocity);
}

// A flight that is believed to be free and is not: the search of the full plan finds the ground.
TEST(Step, SearchedFlightEndsAtTheGround) {
  Settings searched;
  searched.flight = false;
  const Scene scene = rough_scene(searched);
  State state = start(scene);
  Work work = make_work(scene);
  while (state.phase[0] != Phase::flight) step(scene, state, work);
  state.flight_end[0] = 1e3;
  for (int i = 0; i < 2000 && state.phase[0] == Phase::flight; ++i) step(scene, state, work);
  EXPECT_EQ(state.phase[0], Phase::near_ground);
  const double depth =
      depth_below_ground(scene.ground, scene.blocks.shapes, 0, state.motion[0].pose);
  EXPECT_LT(depth, 0.05);
}

// A block is stopped before it leans out over the edge, where nothing would bear its corners:
// alone, beside another block, and with both laws.
TEST(Step, BlocksThatLeaveAreStoppedAndCounted) {
  const SlopeFrame frame = slope_frame(30, 0);
  const auto cube = [&](double y) {
    return body_of(box_in(frame, Vec3(0, y, 0), Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1)));
  };
  for (const Law law : {Law::talus, Law::paper})
    for (const std::size_t n : {1u, 2u}) {
      Settings settings;
      settings.law = law;
      if (law == Law::paper) settings.normal_stiffness = 1e9;
      const Scene scene =
          scene_of(plane_trn(frame, 1, 10), {},
                   n == 1 ? std::vector{cube(0)} : std::vector{cube(0), cube(1)}, settings);
      State state = start(scene);
      Work work = make_work(scene);
      StepFlag flags = StepFlag::none;
      for (int i = 0; i < 2000; ++i) flags = flags | step(scene, state, work).flags;
      EXPECT_TRUE(has(flags, StepFlag::left_domain));
      EXPECT_FALSE(has(flags, StepFlag::fell_through));
      EXPECT_EQ(state.counters.left_domain, n);
      EXPECT_GT(state.ledger.removed, 0);
      for (std::size_t b = 0; b < n; ++b) {
        EXPECT_EQ(state.phase[b], Phase::left_domain);
        const Pose& pose = state.motion[b].pose;
        const double beyond = law == Law::paper ? 0.1 : 0;  // by its last step
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
    settings.law = Law::paper;
    settings.dt = 1e-3;
    settings.normal_stiffness = 2500 * 10 / (4 * depth);
    const Scene scene = scene_of(plane_trn(frame, 1, 10), {}, {cube}, settings);
    State state = start(scene);
    Work work = make_work(scene);
    StepFlag flags = StepFlag::none;
    for (int i = 0; i < 1000; ++i) flags = flags | step(scene, state, work).flags;
    EXPECT_EQ(has(flags, StepFlag::deep), is_deep) << depth;
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

TEST(Step, SleepingBlockStaysWhereItWouldStayAwake) {
  const SlopeFrame frame = slope_frame(20, 20);
  const GroundClass ground = ground_of(35);
  const Body cube = body_of(box_in(frame, Vec3::Zero(), Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1)));
  Vec3 end[2];
  for (const bool sleep : {false, true}) {
    Settings settings;
    settings.sleep = sleep;
    const Scene scene = scene_of(plane_trn(frame, 0.5, 10), ground, {cube}, settings);
    State state = start(scene);
    Work work = make_work(scene);
    for (int i = 0; i < 400; ++i) step(scene, state, work);
    EXPECT_EQ(state.phase[0] == Phase::asleep, sleep);
    end[sleep] = state.motion[0].pose.position;
  }
  EXPECT_LT((end[0] - end[1]).norm(), 1e-12);
}

Scene cube_at_rest(const Settings& settings) {
  const Body cube = body_of(box(Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1)));
  return scene_of(plane_trn(slope_frame(0, 0), 0.5, 10), ground_of(30), {cube}, settings);
}

// 1 m thick, 5 ms: it stays while no point goes farther than g dt^2 = 0.25 mm.
TEST(WatchRest, CountsStepsWithinWhatContactsResolve) {
  const Scene scene = cube_at_rest({});
  State state = start(scene);
  Pose& pose = state.motion[0].pose;
  const Pose from = pose;
  for (int i = 0; i < 10; ++i) {
    pose.position.x() = from.position.x() + (i % 2 == 0 ? 2.4e-4 : -2.4e-4);
    watch_rest(scene, 0, state);
  }
  EXPECT_EQ(state.rest_steps[0], 10);
  for (int i = 0; i < 10; ++i) {  // what creeps on in one direction does not stay
    pose.position.x() = from.position.x() + 1e-4 * i;
    watch_rest(scene, 0, state);
    EXPECT_LT(state.rest_steps[0], 14);
  }
  state.rest_steps[0] = 5;
  pose.attitude = rotation_by(Vec3(0, 0, 4e-4)) * pose.attitude;  // corners are 0.87 m off
  watch_rest(scene, 0, state);
  EXPECT_EQ(state.rest_steps[0], 0);
}

// A block that something shakes by micrometres for good is at rest; what it still moves by is lost,
// and said to be.
TEST(Step, BlockThatIsShakenByMicrometresFallsAsleep) {
  const Scene scene = cube_at_rest({});
  State state = start(scene);
  Work work = make_work(scene);
  for (int i = 0; i <= steps_before_sleep && state.phase[0] != Phase::asleep; ++i) {
    state.motion[0].velocity.x() += i % 2 == 0 ? 1e-3 : -1e-3;
    step(scene, state, work);
  }
  EXPECT_EQ(state.phase[0], Phase::asleep);
  EXPECT_EQ(state.motion[0].velocity.norm(), 0);
  State moving = start(scene);
  moving.motion[0].velocity = Vec3(0, 2, 0);
  fall_asleep(scene, 0, moving);
  EXPECT_NEAR(moving.ledger.contact, 2 * scene.blocks.mass[0], 1e-9 * scene.blocks.mass[0]);
}

// Gravity makes 0.5 m/s in a step: what comes faster rebounds and lifts off, what comes slower is
// taken up by the springs and never leaves the ground.
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
}

}  // namespace
