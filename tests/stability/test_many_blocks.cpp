// Many blocks on each other: what stands, stands; what slides, topples or collides does so as rigid
// bodies do; whatever stiffness and step, the outcome is bounded. Long forms:
// unit/dda/test_many_blocks_long.cpp.
#include <gtest/gtest.h>

#include <thread>

#include "base/random.hpp"
#include "stability/block_scenes.hpp"

namespace {

using namespace talus;
using namespace talus::cases;
using namespace talus::stability;

// A pile of four cubes is 4 high and 1 wide: it topples where tan(dip) > 1/4, dip > 14.04 degrees.
TEST(ManyBlocks, PileTopplesWhereItsWeightLeavesItsBase) {
  for (const double dip : {12.5, 16.0}) {
    const SlopeFrame frame = slope_frame(dip, 30);
    const Scene scene = on_plane(frame, pile_of(4, frame), 40, 40);
    State state = start(scene);
    const std::vector<Vec3> before = places(scene, state);
    run(scene, 4, state);
    const double moved = farthest(before, places(scene, state));
    if (dip < 14)
      EXPECT_LT(moved, 0.05);
    else
      EXPECT_GT(frame.dip.dot(state.motion[3].pose.position - before[3]), 2);
  }
}

// A cube on a plate that sticks to a slope of 30 degrees; friction between the two of 20.
TEST(ManyBlocks, BlockSlidesOnABlock) {
  const SlopeFrame frame = slope_frame(30, 25);
  const std::vector<Body> bodies = {
      body_of(box_in(frame, Vec3::Zero(), Vec3(-2, -2, 0), Vec3(8, 2, 1))),
      body_of(box_in(frame, Vec3::Zero(), Vec3(-0.5, -0.5, 1), Vec3(0.5, 0.5, 2)))};
  const Scene scene = on_plane(frame, bodies, 20, 50);
  State state = start(scene);
  const std::vector<Vec3> before = places(scene, state);
  run(scene, 1.5, state);
  const double a = 10 * (std::sin(30 * degree) - std::tan(20 * degree) * std::cos(30 * degree));
  const Vec3 moved = state.motion[1].pose.position - before[1];
  EXPECT_NEAR(frame.dip.dot(moved), a * 1.5 * 1.5 / 2, 2e-3 * a * 1.5 * 1.5 / 2);
  EXPECT_LT(std::abs(frame.strike.dot(moved)), 1e-3);
  EXPECT_LT((state.motion[0].pose.position - before[0]).norm(), 2e-3);
}

// A keel of 90 degrees in the groove of two long blocks: each face bears N = W cos(dip) / sqrt(2),
// so it slides with a = g (sin(dip) - sqrt(2) tan(phi) cos(dip)) (symmetric wedge).
TEST(ManyBlocks, WedgeSlidesInAGrooveOfTwoBlocks) {
  const SlopeFrame frame = slope_frame(35, 25);
  const auto prism = [&](const std::vector<Vec2>& section, double low, double high) {
    std::vector<Vec3> v;
    for (const double x : {low, high})
      for (const Vec2& p : section)
        v.push_back(x * frame.dip + p.x() * frame.strike + p.y() * frame.normal);
    const int n = static_cast<int>(section.size());
    std::vector<std::vector<int>> faces(2);
    for (int k = 0; k < n; ++k) {  // section counter-clockwise about +dip
      faces[0].push_back(n - 1 - k);
      faces[1].push_back(n + k);
      faces.push_back({k, (k + 1) % n, n + (k + 1) % n, n + k});
    }
    return body_of(polyhedron(v, faces));
  };
  // strike x normal = dip: a section counter-clockwise in (strike, normal) turns about +dip
  const std::vector<Body> bodies = {
      prism({{0, 0}, {4, 0}, {4, 2.5}, {2, 2.5}, {0, 0.5}}, -2, 10),
      prism({{-4, 0}, {0, 0}, {0, 0.5}, {-2, 2.5}, {-4, 2.5}}, -2, 10),
      prism({{0.2, 0.7}, {1.5, 2}, {-1.5, 2}, {-0.2, 0.7}}, -1, 1)};
  const Scene scene = on_plane(frame, bodies, 20, 60);
  State state = start(scene);
  const std::vector<Vec3> before = places(scene, state);
  run(scene, 1.5, state);
  const double a =
      10 * (std::sin(35 * degree) - std::sqrt(2.0) * std::tan(20 * degree) * std::cos(35 * degree));
  const Vec3 moved = state.motion[2].pose.position - before[2];
  EXPECT_NEAR(frame.dip.dot(moved), a * 1.5 * 1.5 / 2, 5e-3 * a * 1.5 * 1.5 / 2);
  EXPECT_LT(std::abs(frame.strike.dot(moved)), 2e-3);
  for (const std::size_t b : {0U, 1U})
    EXPECT_LT((state.motion[b].pose.position - before[b]).norm(), 5e-3);
}

// Upright plates in a row, fixed about their leading edges, rigid, without rebound and friction
// among each other: angles alone, contacts by projected Gauss-Seidel at tiny steps.
struct DominoModel {
  double height, thickness, pitch, gravity;
  std::vector<double> angle, rate;

  // Gap of the top corner of plate i to the back of the next, and its slopes by both angles.
  struct Gap {
    double value, by_this, by_next;
  };
  [[nodiscard]] Gap gap(std::size_t i) const {
    const double a = angle[i], b = angle[i + 1];
    const double x = height * std::sin(a) - pitch + thickness * std::cos(b);
    const double z = height * std::cos(a) - thickness * std::sin(b);
    return {-std::cos(b) * x + std::sin(b) * z,
            -std::cos(b) * height * std::cos(a) - std::sin(b) * height * std::sin(a),
            std::sin(b) * x + std::cos(b) * z};
  }

  void advance(double dt) {
    const double inertia = (height * height + thickness * thickness) / 3;  // over mass
    for (std::size_t i = 0; i < angle.size(); ++i) {
      const double torque =
          gravity * (height * std::sin(angle[i]) - thickness * std::cos(angle[i])) / 2;
      rate[i] += dt * torque / inertia;
      if (angle[i] <= 0) rate[i] = std::max(rate[i], 0.0);
    }
    std::vector<double> pushed(angle.size(), 0);
    for (int sweep = 0; sweep < 60; ++sweep)
      for (std::size_t i = 0; i + 1 < angle.size(); ++i) {
        const Gap g = gap(i);
        if (g.value > 0) continue;
        const double closing = g.by_this * rate[i] + g.by_next * rate[i + 1];
        const double mobility = g.by_this * g.by_this + g.by_next * g.by_next;
        const double impulse = std::max(-pushed[i], -closing / mobility);
        pushed[i] += impulse;
        rate[i] += impulse * g.by_this;
        rate[i + 1] += impulse * g.by_next;
        for (const std::size_t k : {i, i + 1})
          if (angle[k] <= 0) rate[k] = std::max(rate[k], 0.0);
      }
    for (std::size_t i = 0; i < angle.size(); ++i)
      angle[i] = std::max(0.0, angle[i] + dt * rate[i]);
  }
};

// The time at which each plate begins to fall: when it leans by 2 degrees.
template <class LeanOf, class Advance>
std::vector<double> falls(std::size_t n, double dt, double end, LeanOf&& lean, Advance&& advance) {
  std::vector<double> time(n, -1);
  for (int i = 1; i * dt < end; ++i) {
    advance();
    for (std::size_t k = 0; k < n; ++k)
      if (time[k] < 0 && lean(k) > 2 * degree) time[k] = i * dt;
  }
  return time;
}

TEST(ManyBlocks, DominoesFallAsARigidComputationSays) {
  constexpr int n = 14;
  constexpr double height = 1, thickness = 0.15, pitch = 0.5, push = 1.5;
  std::vector<Body> bodies;
  for (int i = 0; i < n; ++i)
    bodies.push_back(
        body_of(box(Vec3(pitch * i - thickness, -0.4, 0), Vec3(pitch * i, 0.4, height)),
                i == 0 ? push * Vec3(height / 2, 0, thickness / 2) : Vec3(Vec3::Zero()),
                i == 0 ? Vec3(0, push, 0) : Vec3(Vec3::Zero())));
  Settings settings;
  settings.dt = 1e-3;
  Scene scene = on_plane(slope_frame(0, 0), bodies, 0, 75, settings);
  State state = start(scene);
  Work work = make_work(scene);
  const auto lean = [&](std::size_t k) {
    const Vec3 up = motion_at(scene, state, static_cast<int>(k), state.time).pose.attitude *
                    (scene.blocks.rest[k].attitude.conjugate() * Vec3::UnitZ());
    return std::atan2(up.x(), up.z());
  };
  const std::vector<double> computed =
      falls(n, settings.dt, 4, lean, [&] { step(scene, state, work); });

  DominoModel model{
      height, thickness, pitch, 10, std::vector<double>(n, 0), std::vector<double>(n, 0)};
  model.rate[0] = push;
  const std::vector<double> expected = falls(
      n, 2e-5, 4, [&](std::size_t k) { return model.angle[k]; }, [&] { model.advance(2e-5); });
  RecordProperty("wave_error",
                 std::to_string((computed[11] - computed[3]) / (expected[11] - expected[3]) - 1));
  const double wave = (expected[11] - expected[3]) / 8;
  ASSERT_GT(expected[11], 0);
  EXPECT_NEAR((computed[11] - computed[3]) / 8, wave, 0.02 * wave);
}

// Eight tumbling boxes thrown at each other, far above the ground.
TEST(ManyBlocks, CollidingBlocksKeepMomentum) {
  for (const double restitution : {0.0, 0.5, 1.0}) {
    std::vector<Body> bodies;
    Random random(5);
    for (int i = 0; i < 8; ++i) {
      const Vec3 place = 2.5 * Vec3(i % 2 - 0.5, i / 2 % 2 - 0.5, (i < 4 ? 0 : 1) - 0.5);
      const Mat3 turn =
          Eigen::AngleAxisd(random.uniform(0, 3), Vec3(1, 2, 3).normalized()).toRotationMatrix();
      const Vec3 half(0.7, random.uniform(0.3, 0.7), random.uniform(0.3, 0.7));
      bodies.push_back(
          body_of(moved(box(-half, half), turn, Vec3::Zero(), place + Vec3(0, 0, 500)), -3 * place,
                  Vec3(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2))));
    }
    Scene scene = on_plane(slope_frame(0, 0), bodies, 25, 25, {}, 5, 100);
    scene.joint.restitution = restitution;
    State state = start(scene);
    const Vec6 before = momentum(scene, state);
    double exchanged = 0;
    for (int b = 0; b < 8; ++b)
      exchanged += scene.blocks.mass[static_cast<std::size_t>(b)] * bodies[0].velocity.norm();
    const double energy = mechanical_energy(scene, state);
    const Energies first = energies(scene, state);
    run(scene, 1.5, state);
    const Vec6 change = momentum(scene, state) - before;
    EXPECT_GE(state.counters.impacts, 8);
    EXPECT_LT(change.head<3>().norm(), 1e-10 * exchanged);
    EXPECT_LT(change.tail<3>().norm(), 1e-10 * exchanged);
    EXPECT_LT(mechanical_energy(scene, state), energy + 1e-6 * first.translation);
  }
}

// A 10 m cube on four cubes of 0.1 m: not pushed through the ground, nor squeezed out.
TEST(ManyBlocks, SmallBlocksBearALargeOne) {
  for (const double dt : {1e-3, 5e-3, 1e-2}) {
    std::vector<Body> bodies = {body_of(box(Vec3(-5, -5, 0.1), Vec3(5, 5, 10.1)))};
    for (const double x : {-4.0, 4.0})
      for (const double y : {-4.0, 4.0})
        bodies.push_back(body_of(box(Vec3(x - 0.05, y - 0.05, 0), Vec3(x + 0.05, y + 0.05, 0.1))));
    Settings settings;
    settings.dt = dt;
    const Scene scene = on_plane(slope_frame(0, 0), bodies, 30, 30, settings, 2, 40);
    State state = start(scene);
    const std::vector<Vec3> before = places(scene, state);
    run(scene, 2, state);
    EXPECT_LT(farthest(before, places(scene, state)), 1e-3) << dt;
    EXPECT_EQ(state.counters.unconverged, 0);
  }
}

// A plate of 10 x 10 x 0.1 m on a cube of 2 m: it rests on it, none goes through the other.
TEST(ManyBlocks, ThinPlateRestsOnABlock) {
  const std::vector<Body> bodies = {body_of(box(Vec3(-1, -1, 0), Vec3(1, 1, 2))),
                                    body_of(box(Vec3(-5, -5, 2), Vec3(5, 5, 2.1)))};
  Settings settings;
  settings.sleep = false;
  const Scene scene = on_plane(slope_frame(0, 0), bodies, 30, 30, settings);
  State state = start(scene);
  const std::vector<Vec3> start_places = places(scene, state);
  run(scene, 1, state);
  const std::vector<Vec3> before = places(scene, state);
  run(scene, 4, state);
  EXPECT_LT(farthest(start_places, before), 0.01);
  EXPECT_LT(farthest(before, places(scene, state)), 1e-6);
}

// Long form: the whole range of stiffness and step.
TEST(ManyBlocks, AnyStiffnessAndStepIsBounded) {
  for (const double stiffness : {0.0, 1e6, 1e14})
    for (const double dt : {1e-3, 1e-2, 5e-2}) expect_bounded(stiffness, dt, 2);
}

void expect_same_bits(const State& a, const State& b) {
  ASSERT_EQ(a.motion.size(), b.motion.size());
  for (std::size_t i = 0; i < a.motion.size(); ++i) {
    const Motion &p = a.motion[i], &q = b.motion[i];
    EXPECT_EQ(p.pose.position, q.pose.position) << i;
    EXPECT_EQ(p.pose.attitude.coeffs(), q.pose.attitude.coeffs()) << i;
    EXPECT_EQ(p.velocity, q.velocity) << i;
    EXPECT_EQ(p.angular_momentum, q.angular_momentum) << i;
  }
}

// A run that goes on from a copy of its state, with new scratch, gives the same bits.
TEST(ManyBlocks, ResumedRunHasTheSameBits) {
  const Scene scene = heap({});
  State whole = start(scene);
  run(scene, 1, whole);
  State resumed = whole;
  Work used = make_work(scene);
  State other = start(scene);
  run(scene, 0.7, other, used);
  run(scene, 1, whole);
  Work fresh = make_work(scene);
  for (int i = 0; i < 200; ++i) step(scene, resumed, i < 100 ? used : fresh);
  EXPECT_GT(whole.counters.impacts, 20);
  expect_same_bits(whole, resumed);
}

// Runs side by side are those one after the other, to the bit.
TEST(ManyBlocks, RunsInTwoThreadsHaveTheSameBits) {
  const Scene scene = heap({});
  State alone = start(scene), beside[2] = {start(scene), start(scene)};
  run(scene, 1, alone);
  std::thread first([&] { run(scene, 1, beside[0]); });
  run(scene, 1, beside[1]);
  first.join();
  EXPECT_GT(alone.counters.impacts, 20);
  for (const State& state : beside) expect_same_bits(alone, state);
}

}  // namespace
