// Free flight: safe times without contact.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.hpp"
#include "contact/search.hpp"
#include "motion/rotation.hpp"
#include "step/flight.hpp"
#include "step/step.hpp"
#include "unit/contact/depth_below_ground.hpp"
#include "unit/contact/ground_overlap.hpp"
#include "unit/step/rough_scene.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

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

// And not much of the time until the ball touches is left out: the planes of triangles reach beyond
// their sides.
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
  m.pose.attitude = Quat{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1),
                         random.uniform(-1, 1)}
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

// The vertices tell more than the ball, the more the less the block spins. Long flights are rare
// and weigh most: of 400, the sum scatters by 3 %. Braces: compilers draw in the same order.
TEST(FreeTime, NoPartOfABlockIsBelowTheGroundBeforeIt) {
  const Scene scene = scene_of(make_trn(bumps, 1, 60), {},
                               {body_of(box(Vec3(-0.5, -0.4, -0.2), Vec3(0.5, 0.4, 0.2)))}, {});
  const Vec3 a(0, 0, -10), &inertia = scene.blocks.inertia[0];
  const double radius = scene.blocks.shapes.radius[0];
  Random random(6, "free time of a block");
  for (const double fastest : {0.0, 1.0, 10.0}) {
    double sum = 0, sum_of_ball = 0;
    for (int trial = 0; trial < 10000; ++trial) {
      Motion m = thrown_over_bumps(0.2, random);
      const Vec3 spin{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
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

// Without spin it is known when the block lands on a plane: no search is needed before.
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

TEST(FreeTime, EndsAtUnknownGround) {
  Trn trn = make_trn([](double, double) { return 0.0; }, 1, 20);
  for (double x : {7.0, 8.0}) {
    const GridPoint at = locate(trn, x, 0.5);
    trn.elevation[node_index(trn, at.cell.row, at.cell.col)] = std::nan("");
  }
  const Ground ground = make_ground(std::move(trn), {});
  const double T = free_time(ground, {{0, 0.5, 3}, {10, 0, 10}, 0.5}, {0, 0, -10}, 100);
  EXPECT_GT(T, 0.4);  // on its path there
  EXPECT_LT(T, 0.75);
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

// Leaving out the search while nothing can be hit changes no bit of a bouncing block's path.
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

}  // namespace
