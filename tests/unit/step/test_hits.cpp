// Hits of blocks of an island in order of time: the results are those of hit by hit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "step/flight.hpp"
#include "step/step.hpp"
#include "step/substep.hpp"
#include "verify/cases/block_cases.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

double kinetic(const Scene& scene, const State& state) {
  const Energies e = energies(scene, state);
  return e.translation + e.rotation;
}

void run(const Scene& scene, double until, State& state) {
  Work work = make_work(scene);
  while (state.time < until) step(scene, state, work);
}

// All contacts of one class.
Scene all_alike(Trn trn, const GroundClass& ground, const std::vector<Body>& bodies, double dt) {
  Settings settings;
  settings.dt = dt;
  Scene scene = scene_of(std::move(trn), ground, bodies, settings);
  scene.joint = ground;
  return scene;
}

// Speed of a cube of mass `m` after its hits with a slab that lies on the ground, one after the
// other in one dimension.
double speed_after(double m, double slab, double speed, double e) {
  double a = -speed, b = 0;
  for (int hits = 0; hits < 1000; ++hits) {
    if (a < b - 1e-9) {
      const double p = (1 + e) * (b - a) / (1 / m + 1 / slab);
      a += p / m;
      b -= p / slab;
    } else if (b < -1e-9) {
      b *= -e;
    } else {
      break;
    }
  }
  return a;
}

// A slab on the ground is not rigid rock: the cube that falls on it rebounds as from a slab that is
// hit by the ground in its turn.
TEST(Hits, ACubeReboundsFromABorneSlabAsHitByHit) {
  const double e = 0.7, height = 2;
  for (const double ratio : {1.8, 9.0, 36.0}) {
    const double thick = 0.5, half = std::sqrt(ratio / thick) / 2;
    const std::vector<Body> bodies = {
        body_of(box(Vec3(-half, -half, 0), Vec3(half, half, thick))),
        body_of(box(Vec3(-0.5, -0.5, thick + height), Vec3(0.5, 0.5, thick + height + 1)))};
    for (const double dt : {1e-3, 5e-3}) {
      const Scene scene =
          all_alike(plane_trn(slope_frame(0, 0), 1, 20), ground_of(30, e), bodies, dt);
      const double g = scene.gravity.norm(), fall = std::sqrt(2 * height / g), after = 0.1;
      State state = start(scene);
      run(scene, fall + after, state);
      const double speed =
          motion_at(scene, state, 1, state.time).velocity.z() + g * (state.time - fall);
      const double exact = speed_after(scene.blocks.mass[1], scene.blocks.mass[0], g * fall, e);
      EXPECT_NEAR(speed, exact, 0.01 * exact) << ratio << ' ' << dt;
    }
  }
}

// Unequal blocks in a row, a little apart: event by event in one dimension.
TEST(Hits, AnUnequalRowPassesItsHitsOnInOrder) {
  for (const double e : {0.6, 0.9}) EXPECT_LT(cases::unequal_row({}, e).error, 0.01) << e;
}

Body tumbling(const Vec3& place, const Vec3& velocity, double fastest_spin, Random& random) {
  const auto number = [&random](double low, double high) { return random.uniform(low, high); };
  const Vec3 half(number(0.3, 0.8), number(0.3, 0.8), number(0.3, 0.8));
  const Vec3 axis = Vec3(random.normal(), random.normal(), random.normal()).normalized();
  const Mat3 turn = Eigen::AngleAxisd(number(0, 3), axis).toRotationMatrix();
  const double w = fastest_spin / std::sqrt(3);
  const Vec3 spin(number(-w, w), number(-w, w), number(-w, w));
  return body_of(moved(box(-half, half), turn, Vec3::Zero(), place), velocity, spin);
}

// Boxes that spin fast and meet in free space without friction keep all their energy at e = 1,
// whatever the step.
TEST(Hits, FastTumblingPairsKeepTheirEnergy) {
  for (const double dt : {1e-3, 5e-3}) {
    Random random(7, "tumbling");
    for (int i = 0; i < 40; ++i) {
      const std::vector<Body> bodies = {tumbling(Vec3(0, 0, 50), Vec3::Zero(), 15, random),
                                        tumbling(Vec3(0.2, -0.1, 54), Vec3(0, 0, -6), 15, random)};
      Scene scene = all_alike(plane_trn(slope_frame(0, 0), 5, 50), ground_of(0, 1), bodies, dt);
      scene.gravity.setZero();
      State state = start(scene);
      const double before = kinetic(scene, state);
      run(scene, 1.5, state);
      EXPECT_NEAR(kinetic(scene, state), before, 1e-3 * before) << i << ' ' << dt;
    }
  }
}

// Tumbling cubes without friction: every hit returns its e. The changes of momentum and angular
// momentum tell its normal and the lever arms, so the speeds of its point before and after.
TEST(Hits, EveryHitOfATumblingPairReturnsItsRestitution) {
  for (const double e : {0.5, 0.7, 0.95, 1.0}) {
    Random random(11, "cubes");
    int n_hits = 0;
    for (int i = 0; i < 30; ++i) {
      const auto cube = [&](const Vec3& place, const Vec3& velocity) {
        const Vec3 axis = Vec3(random.normal(), random.normal(), random.normal()).normalized();
        const Mat3 turn = Eigen::AngleAxisd(random.uniform(0, 3), axis).toRotationMatrix();
        const Vec3 half = Vec3::Constant(random.uniform(0.3, 0.8));
        Vec3 spin;
        for (double& w : spin) w = random.uniform(-15 / std::sqrt(3), 15 / std::sqrt(3));
        return body_of(moved(box(-half, half), turn, Vec3::Zero(), place), velocity, spin);
      };
      const std::vector<Body> bodies = {cube(Vec3(0, 0, 50), Vec3::Zero()),
                                        cube(Vec3(0.2, -0.1, 54), Vec3(0, 0, -6))};
      Scene scene = all_alike(plane_trn(slope_frame(0, 0), 5, 50), ground_of(0, e), bodies, 5e-3);
      scene.gravity.setZero();
      State state = start(scene);
      Work work = make_work(scene);
      while (state.time < 1.5) {
        const std::vector<Motion> before = state.motion;
        const auto hits_before = state.counters.impacts;
        step(scene, state, work);
        if (state.counters.impacts != hits_before + 1) continue;
        double speed_before = 0, speed_after = 0;
        const Vec3 p = scene.blocks.mass[0] * (state.motion[0].velocity - before[0].velocity);
        for (std::size_t k : {0, 1}) {
          const Vec3 n = (k == 0 ? 1 : -1) * p.normalized();
          const Vec3 turn =
              (state.motion[k].angular_momentum - before[k].angular_momentum) / p.norm();
          const auto speed = [&](const Motion& m) {
            return n.dot(m.velocity) + turn.dot(m.angular_momentum) / scene.blocks.inertia[k].x();
          };
          speed_before += speed(before[k]);
          speed_after += speed(state.motion[k]);
        }
        EXPECT_NEAR(-speed_after / speed_before, e, 0.01) << i << ' ' << state.time;
        ++n_hits;
      }
    }
    EXPECT_GT(n_hits, 20) << e;
  }
}

// Cubes in a row that hit and do not part: they move on together, at the speed given by momentum.
TEST(Hits, APlasticPileUpStaysTogether) {
  for (const double gap : {0.4, 0.0}) {
    constexpr int n = 6;
    std::vector<Body> bodies;
    for (int i = 0; i < n; ++i) {
      const double x = i * (1 + gap) + (i > 0 && gap == 0 ? 0.4 : 0);
      bodies.push_back(
          body_of(box(Vec3(x, 0, 50), Vec3(x + 1, 1, 51)), Vec3(i == 0 ? 10 : 0, 0, 0)));
    }
    Scene scene = all_alike(plane_trn(slope_frame(0, 0), 5, 100), ground_of(0, 0), bodies, 5e-3);
    scene.gravity.setZero();
    State state = start(scene);
    run(scene, 2, state);
    for (int i = 0; i < n; ++i) {
      const Motion m = motion_at(scene, state, i, state.time);
      EXPECT_NEAR(m.velocity.x(), 10.0 / n, 1e-3) << gap << ' ' << i;
      if (i == 0) continue;
      const Motion last = motion_at(scene, state, i - 1, state.time);
      EXPECT_NEAR(m.pose.position.x() - last.pose.position.x(), 1, 1e-3) << gap << ' ' << i;
    }
  }
}

// A beam that falls flat on two cubes is hit by both at one time: nothing prefers a side.
TEST(Hits, ABeamThatFallsOnTwoCubesStaysLevel) {
  std::vector<Body> bodies = {body_of(box(Vec3(-2, -0.5, 51), Vec3(2, 0.5, 51.5)), Vec3(0, 0, -5)),
                              body_of(box(Vec3(-1.5, -0.5, 49), Vec3(-0.5, 0.5, 50))),
                              body_of(box(Vec3(0.5, -0.5, 49), Vec3(1.5, 0.5, 50)))};
  Scene scene = all_alike(plane_trn(slope_frame(0, 0), 5, 50), ground_of(30, 0.7), bodies, 5e-3);
  scene.gravity.setZero();
  State state = start(scene);
  run(scene, 0.5, state);
  EXPECT_LT(state.motion[1].velocity.z(), -1);
  EXPECT_NEAR(state.motion[1].velocity.z(), state.motion[2].velocity.z(), 1e-9);
  EXPECT_LT(state.motion[0].angular_momentum.norm(), 1e-8 * scene.blocks.mass[0]);
}

/// A rhombic prism about the y axis, its edges at x -+ `tip`, its sides at an angle of
/// 2 atan(steep) there, turned about the x axis.
struct Prism {
  double tip, steep, length;
};

Body prism_at(const Prism& prism, double x, double turn, const Vec3& velocity) {
  const double h = prism.tip / std::sqrt(2);
  Polyhedron p = box(Vec3(-h, -prism.length / 2, -h), Vec3(h, prism.length / 2, h));
  const Mat3 on_edge = Eigen::AngleAxisd(std::numbers::pi / 4, Vec3::UnitY()).toRotationMatrix(),
             about_x = Eigen::AngleAxisd(turn, Vec3::UnitX()).toRotationMatrix();
  for (Vec3& v : p.vertices) {
    v = on_edge * v;
    v.z() *= prism.steep;
    v = about_x * v + Vec3(x, 0, 30);
  }
  return body_of(p, velocity);
}

// Two prisms meet edge on edge, their edges crossing in the middle at a small angle: the direction
// across both is that of the hit, whatever the faces beside them.
class EdgesThatHardlyCross : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Hits, EdgesThatHardlyCross,
                         testing::Values(0.01, 0.03, 0.1, 0.3, 0.5, 0.9, 1.1, 2.0, 5.0));

TEST_P(EdgesThatHardlyCross, AreHitAcrossBoth) {
  const double turn = GetParam() * std::numbers::pi / 180, e = 0.5;
  const std::pair<Prism, Prism> pairs[] = {{{0.707, 1, 1}, {0.707, 1, 1.2}},
                                           {{0.5, 0.5, 1}, {1.1, 2, 3}},
                                           {{0.3, 1, 0.4}, {0.9, 0.6, 1}}};
  for (const auto& [a, b] : pairs)
    for (const double dt : {1e-3, 5e-3}) {
      const std::vector<Body> bodies = {prism_at(a, -1.5, turn / 3, Vec3(4, 0, 0)),
                                        prism_at(b, 0.5, turn / 3 - turn, Vec3::Zero())};
      Scene scene = all_alike(plane_trn(slope_frame(0, 0), 5, 50), ground_of(0, e), bodies, dt);
      scene.gravity.setZero();
      State state = start(scene);
      run(scene, 1, state);
      const double ma = scene.blocks.mass[0], mb = scene.blocks.mass[1];
      const Vec3 va(4 * (ma - e * mb) / (ma + mb), 0, 0), vb(4 * (1 + e) * ma / (ma + mb), 0, 0);
      EXPECT_LT((motion_at(scene, state, 0, 1).velocity - va).norm(), 0.01)
          << a.length << ' ' << dt;
      EXPECT_LT((motion_at(scene, state, 1, 1).velocity - vb).norm(), 0.01)
          << a.length << ' ' << dt;
    }
}

TEST(Hits, ElasticBoxesInABowlKeepTheirEnergy) {
  Random random(3, "bowl");
  std::vector<Body> bodies;
  for (int i = 0; i < 12; ++i)
    bodies.push_back(tumbling(Vec3(2.4 * (i % 2) - 1.2, 2.4 * (i / 2 % 2) - 1.2, 4 + 2.5 * (i / 4)),
                              Vec3::Zero(), 1, random));
  const Scene scene =
      all_alike(make_trn([](double x, double y) { return (x * x + y * y) / 12; }, 1, 30),
                ground_of(0, 1), bodies, 5e-3);
  State state = start(scene);
  const auto total = [&] { return kinetic(scene, state) + energies(scene, state).potential; };
  const double before = total(), spare = before;
  run(scene, 20, state);
  EXPECT_GT(state.counters.impacts, 400);
  EXPECT_NEAR(total(), before, 0.01 * spare);
}

}  // namespace
