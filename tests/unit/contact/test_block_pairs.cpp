// Contacts between blocks: list of pairs, cached axes, grazing, ghost edges.
#include <gtest/gtest.h>

#include <map>
#include <tuple>

#include "bent_body.hpp"
#include "contact/block_pairs.hpp"
#include "convex_bodies.hpp"
#include "unit/count_allocations.hpp"

namespace {

using namespace talus;
using namespace talus::test;

// A heap of random bodies, close together.
Bodies heap(Draws& random, int n, double extent) {
  Bodies bodies;
  for (int k = 0; k < n; ++k)
    add(bodies,
        convex_body(random,
                    Vec3(uniform(random, 0.3, 1), uniform(random, 0.3, 1), uniform(random, 0.3, 1)),
                    k % 6),
        {Vec3(uniform(random, 0, extent), uniform(random, 0, extent), uniform(random, 0, extent)),
         attitude(random)});
  place(bodies);
  return bodies;
}

using Name = std::tuple<int, int, int, int, int>;
struct Where {
  Vec3 point_b, normal;
  double gap;
};
std::map<Name, Where> contacts(const PairWork& work) {
  std::map<Name, Where> map;
  for (const PairManifold& m : work.manifolds)
    for (int k = m.point_begin; k < m.point_end; ++k) {
      const PairPoint& p = work.points[k];
      map[{m.part_a, m.part_b, static_cast<int>(p.key.mode), p.key.feature_a, p.key.feature_b}] = {
          p.point_b, m.normal, p.gap};
    }
  return map;
}

// Random motion of each body, with a common drift.
struct Drift {
  std::vector<Vec3> velocity, spin;
  void move(Bodies& bodies, double dt) const {
    for (std::size_t b = 0; b < bodies.poses.size(); ++b) {
      bodies.poses[b].position += dt * velocity[b];
      bodies.poses[b].attitude =
          Quat(Eigen::AngleAxisd(dt * spin[b].norm(), spin[b].normalized())) *
          bodies.poses[b].attitude;
    }
  }
};
Drift drift(Draws& random, const Bodies& bodies, double speed) {
  Drift d;
  for (std::size_t b = 0; b < bodies.poses.size(); ++b) {
    d.velocity.push_back(Vec3(20, -3, 5) + speed * direction(random));
    d.spin.push_back(speed * uniform(random, 0, 1) * direction(random));
  }
  return d;
}

// Whatever is held from step to step, every pair that overlaps has a manifold, at the depth that
// brute force gives; and pairs without overlap beyond the margin have none.
TEST(BlockPairs, FindsEveryOverlapWhateverIsCached) {
  Draws random(31);
  Bodies bodies = heap(random, 40, 5);
  const Drift motion = drift(random, bodies, 1.0);
  PairState state;
  PairWork work;
  int n_relisted = 0, n_searched = 0, n_listed = 0;
  for (int step = 0; step < 150; ++step) {
    const PairReport report = find_pair_contacts(bodies.hulls, bodies.placed, {}, {}, state, work);
    n_relisted += report.relisted ? 1 : 0;
    n_searched += report.n_searched;
    n_listed += report.n_listed;
    std::map<std::pair<int, int>, double> deepest;
    for (const PairManifold& m : work.manifolds)
      for (int k = m.point_begin; k < m.point_end; ++k) {
        double& d = deepest.try_emplace({m.part_a, m.part_b}, 0.0).first->second;
        d = std::min(d, work.points[k].gap);
      }
    for (int a = 0; a < 40 && step % 10 == 0; ++a)
      for (int b = a + 1; b < 40; ++b) {
        const double brute = brute_separation(bodies.hulls, bodies.placed, a, b);
        if (brute > 0) {
          EXPECT_EQ(deepest.count({a, b}), 0u) << step;
        } else if (brute < -1e-3) {
          ASSERT_EQ(deepest.count({a, b}), 1u) << step << ": " << a << " " << b << " " << brute;
          EXPECT_LT((deepest[{a, b}]), 0.8 * brute) << step << ": " << a << " " << b;
        }
      }
    motion.move(bodies, 2e-3);
    place(bodies);
  }
  EXPECT_LT(n_relisted, 30);
  EXPECT_LT(n_searched, n_listed / 4);
}

// A bar that turns on the spot meets a block that does not move.
TEST(BlockPairs, FindsWhatOnlyTurningBringsTogether) {
  Bodies bodies;
  add(bodies, box(Vec3(-5, -0.1, -0.1), Vec3(5, 0.1, 0.1)), {});
  add(bodies, box(Vec3(-1, -1, -1), Vec3(1, 1, 1)), {Vec3(4, 2.5, 0), Quat::Identity()});
  PairState state;
  PairWork work;
  int n_meetings = 0;
  for (int step = 0; step < 500; ++step) {
    bodies.poses[0].attitude = Quat(Eigen::AngleAxisd(1e-3 * step, Vec3::UnitZ()));
    place(bodies);
    (void)find_pair_contacts(bodies.hulls, bodies.placed, {}, {}, state, work);
    double deepest = 0;
    for (const PairPoint& p : work.points) deepest = std::min(deepest, p.gap);
    const double brute = brute_separation(bodies.hulls, bodies.placed, 0, 1);
    n_meetings += brute < 0;
    ASSERT_LE(deepest, std::min(0.0, 0.5 * brute)) << "after " << step << " mrad";
  }
  EXPECT_GT(n_meetings, 20);
}

// A plate that rocks on a ridge: the axis is that of the ridge and now of one side of the plate,
// now of the other. Both sides are in contact.
TEST(BlockPairs, RockingOnTwoEdgesKeepsBoth) {
  const double tilt = 1e-3, depth = 2e-3;
  Polyhedron ridge = box(Vec3(-2, -5, -2), Vec3(2, 5, 1));
  for (const double side : {-1.0, 1.0})
    ridge = clip_convex(ridge, {Vec3(side, 0, 1).normalized(), 0}, 0, 1e-9);
  Bodies bodies;
  add(bodies, ridge, {});
  add(bodies, box(Vec3(-1, -0.5, 0), Vec3(1, 0.5, 0.1)), {});
  PairState state;
  PairWork work;
  for (const double side : {1.0, -1.0, 1.0}) {
    bodies.poses[1] = {Vec3(0.1, 0, -depth), Quat(Eigen::AngleAxisd(side * tilt, Vec3::UnitX()))};
    place(bodies);
    const bool first = state.pairs.empty();
    (void)find_pair_contacts(bodies.hulls, bodies.placed, {}, {}, state, work);
    ASSERT_EQ(work.points.size(), first ? 1u : 2u);
    if (first) continue;
    std::vector<double> gaps = {work.points[0].gap, work.points[1].gap};
    std::sort(gaps.begin(), gaps.end());
    EXPECT_NEAR(gaps[0], -depth - 0.5 * tilt, 1e-8);
    EXPECT_NEAR(gaps[1], -depth + 0.5 * tilt, 1e-8);
  }
}

// The caches may delay a change of features by a thousandth of a thickness of motion; apart from
// that the contacts are the same.
TEST(BlockPairs, CachesDoNotChangeTheContacts) {
  Draws random(32);
  Bodies bodies = heap(random, 30, 4);
  const Drift motion = drift(random, bodies, 0.5);
  PairState cached_state, fresh_state;
  PairWork cached, fresh;
  PairSettings settings, no_cache;
  no_cache.use_cache = false;
  int n_both = 0, n_one = 0;
  for (int step = 0; step < 300; ++step) {
    find_pair_contacts(bodies.hulls, bodies.placed, {}, settings, cached_state, cached);
    find_pair_contacts(bodies.hulls, bodies.placed, {}, no_cache, fresh_state, fresh);
    const auto one = contacts(cached), other = contacts(fresh);
    for (const auto& [name, where] : one) {
      const auto same = other.find(name);
      if (same == other.end() || where.normal.dot(same->second.normal) < same_axis_cos) {
        ++n_one;
        continue;
      }
      ++n_both;
      if ((where.normal - same->second.normal).norm() > 1e-12)
        continue;  // the other face carries it
      EXPECT_NEAR(where.gap, same->second.gap, 1e-12);
      EXPECT_LT((where.point_b - same->second.point_b).norm(), 1e-12);
    }
    for (const auto& entry : other) n_one += one.count(entry.first) == 0 ? 1 : 0;
    motion.move(bodies, 1e-3);
    place(bodies);
  }
  EXPECT_GT(n_both, 10000);
  EXPECT_LT(n_one, n_both / 100) << n_one << " of " << n_both;
}

// A mass that moves as a whole, however fast, keeps its list and its axes.
TEST(BlockPairs, CommonMotionUsesNoBudget) {
  Draws random(33);
  Bodies bodies = heap(random, 30, 4);
  PairState state;
  PairWork work;
  const std::vector<Vec3> step(30, Vec3(0.2, -0.1, 0.05));
  const std::vector<double> turn(30, 0.0);
  int n_relisted = 0, n_searched = 0, n_clipped = 0;
  for (int k = 0; k < 100; ++k) {
    const PairReport report =
        find_pair_contacts(bodies.hulls, bodies.placed, {step, turn, {}, {}}, {}, state, work);
    n_relisted += report.relisted ? 1 : 0;
    n_clipped += report.n_clipped;
    if (k > 0) n_searched += report.n_searched;
    for (Pose& pose : bodies.poses) pose.position += step[0];
    place(bodies);
  }
  EXPECT_EQ(n_relisted, 1);
  EXPECT_EQ(n_searched, 0);
  EXPECT_EQ(n_clipped, 0);
}

// Bodies that need closing points alone have exactly those of all points that come near, now or by
// the motion ahead.
TEST(BlockPairs, PointsThatStayOpenAreLeftOut) {
  Draws random(37);
  Bodies bodies = heap(random, 40, 5);
  const Drift motion = drift(random, bodies, 1.0);
  const double h = 5e-3;
  std::vector<Vec3> step, rotation;
  std::vector<double> turn;
  for (std::size_t b = 0; b < bodies.poses.size(); ++b) {
    step.push_back(h * motion.velocity[b]);
    rotation.push_back(h * motion.spin[b]);
    turn.push_back(bodies.hulls.radius[b] * rotation.back().norm());
  }
  PairMotion all;
  all.step = step;
  all.turn = turn;
  const std::vector<std::uint8_t> every(bodies.poses.size(), 1);
  PairMotion closing = all;
  closing.closing_only = every;
  closing.rotation = rotation;
  PairSettings settings;
  settings.margin = 0.15;
  settings.closing = 2e-3;
  PairState state_of_all, state_of_closing;
  PairWork work_of_all, work_of_closing;
  find_pair_contacts(bodies.hulls, bodies.placed, all, settings, state_of_all, work_of_all);
  find_pair_contacts(bodies.hulls, bodies.placed, closing, settings, state_of_closing,
                     work_of_closing);
  const auto kept = contacts(work_of_closing);
  int n_left_out = 0;
  for (const auto& [name, where] : contacts(work_of_all)) {
    const int a = std::get<0>(name), b = std::get<1>(name);  // of one part each
    const Vec3 on_a = where.point_b + where.gap * where.normal;
    const Vec3 opens = step[a] + rotation[a].cross(on_a - bodies.poses[a].position) - step[b] -
                       rotation[b].cross(where.point_b - bodies.poses[b].position);
    const double nearest = std::min(where.gap, where.gap + where.normal.dot(opens));
    EXPECT_TRUE(nearest > settings.closing || kept.contains(name)) << nearest;
    EXPECT_FALSE(nearest > 2e-2 && kept.contains(name)) << nearest;
    n_left_out += kept.contains(name) ? 0 : 1;
  }
  EXPECT_GT(n_left_out, 20);
  EXPECT_GT(kept.size(), 100u);
}

// To and fro twice: the second time nothing grows any more, whatever is listed or searched anew.
TEST(BlockPairs, StepsAllocateNothingOnceTheArraysHaveGrown) {
  if (!counts_allocations) GTEST_SKIP() << "the thread sanitizer counts nothing";
  Draws random(36);
  Bodies bodies = heap(random, 30, 4);
  const Drift motion = drift(random, bodies, 1.0);
  PairState state;
  PairWork work;
  long n_before = 0, n_in_steps = 0;
  int n_relisted = 0;
  for (int cycle = 0; cycle < 2; ++cycle)
    for (int k = 0; k < 200; ++k) {
      n_before = n_allocations;
      const PairReport report =
          find_pair_contacts(bodies.hulls, bodies.placed, {}, {}, state, work);
      if (cycle == 1) {
        n_in_steps += n_allocations - n_before;
        n_relisted += report.relisted ? 1 : 0;
      }
      motion.move(bodies, k < 100 ? 2e-3 : -2e-3);
      place(bodies);
    }
  EXPECT_GT(n_relisted, 0);
  EXPECT_EQ(n_in_steps, 0);
}

// A point that closes within the coming step is reported beforehand: fast relative motion widens
// the margin of that pair.
TEST(BlockPairs, MarginCoversTheComingStep) {
  Bodies bodies;
  add(bodies, box(Vec3(-1, -1, -1), Vec3(1, 1, 1)), {});
  add(bodies, box(Vec3(-1, -1, -1), Vec3(1, 1, 1)), {Vec3(0.1, 0, 2.3), Quat::Identity()});
  place(bodies);
  PairState state;
  PairWork work;
  find_pair_contacts(bodies.hulls, bodies.placed, {}, {}, state, work);
  EXPECT_TRUE(work.manifolds.empty());
  const std::vector<Vec3> falls = {Vec3::Zero(), Vec3(0, 0, -0.4)};
  find_pair_contacts(bodies.hulls, bodies.placed, {falls, {}, {}, {}}, {}, state, work);
  ASSERT_EQ(work.manifolds.size(), 1u);
  EXPECT_EQ(work.points.size(), 4u);
  EXPECT_NEAR(work.points[0].gap, 0.3, 1e-12);
  const std::vector<Vec3> together = {Vec3(0, 0, -0.4), Vec3(0, 0, -0.4)};
  find_pair_contacts(bodies.hulls, bodies.placed, {together, {}, {}, {}}, {}, state, work);
  EXPECT_TRUE(work.manifolds.empty());
}

// Cubes that pass each other diagonally may meet, though no features of them lie above each other.
TEST(BlockPairs, PartsWithinTheMarginAreNamedEvenWithoutPoints) {
  Bodies bodies;
  add(bodies, box(Vec3(-1, -1, -1), Vec3(1, 1, 1)), {});
  add(bodies, box(Vec3(-1, -1, -1), Vec3(1, 1, 1)), {Vec3(2.3, 0, 2.2), Quat::Identity()});
  place(bodies);
  PairState state;
  PairWork work;
  const std::vector<Vec3> near = {Vec3::Zero(), Vec3(-0.4, 0, 0)};
  find_pair_contacts(bodies.hulls, bodies.placed, {near, {}, {}, {}}, {}, state, work);
  ASSERT_EQ(work.manifolds.size(), 1u);
  EXPECT_FALSE(has_points(work.manifolds[0]));
  EXPECT_EQ(work.manifolds[0].block_b, 1);
  EXPECT_TRUE(work.points.empty());
  const std::vector<Vec3> far = {Vec3::Zero(), Vec3(-0.1, 0, 0)};
  find_pair_contacts(bodies.hulls, bodies.placed, {far, {}, {}, {}}, {}, state, work);
  EXPECT_TRUE(work.manifolds.empty());
}

BodyGrid grid_of_last(const Bodies& bodies, std::size_t n) {
  return make_body_grid(std::span(bodies.placed.position).last(n),
                        std::span(bodies.hulls.radius).last(n));
}

TEST(BlockPairs, FixedAndSleepingPairsAreLeftOut) {
  Bodies bodies;
  for (int k = 0; k < 4; ++k)
    add(bodies, box(Vec3(-0.5, -0.5, -0.5), Vec3(0.5, 0.5, 0.5)),
        {Vec3(0, 0, 0.99999 * k), Quat::Identity()});
  place(bodies);
  PairState state;
  PairWork work;
  const BodyGrid grid = grid_of_last(bodies, 2);
  find_pair_contacts(bodies.hulls, bodies.placed, {{}, {}, {}, 2, &grid}, {}, state, work);
  EXPECT_EQ(work.manifolds.size(), 2u);  // 0-1, 1-2
  PairState asleep_state;
  const std::vector<std::uint8_t> awake = {0, 0, 0, 1};
  find_pair_contacts(bodies.hulls, bodies.placed, {{}, {}, awake, {}}, {}, asleep_state, work);
  ASSERT_EQ(work.manifolds.size(), 1u);
  EXPECT_EQ(work.manifolds[0].block_b, 3);
}

// The floor of the tests on ghost contacts: 12 x 3 unit boxes, tops at z = 0.
template <class AddFloor>
void slide_over_floor(AddFloor&& add_floor, double turn, double penetration, const Vec3& step,
                      double first_x) {
  Bodies bodies;
  add(bodies, box(Vec3(-0.4, -0.4, -0.4), Vec3(0.4, 0.4, 0.4)),
      {Vec3(first_x, 1.47, 0.4 - penetration), Quat(Eigen::AngleAxisd(turn, Vec3::UnitZ()))});
  add_floor(bodies);
  place(bodies);
  const int cube = 0, n_fixed = n_bodies(bodies.hulls) - 1;
  const std::vector<Vec3> steps = {step};
  const BodyGrid grid = grid_of_last(bodies, static_cast<std::size_t>(n_fixed));
  PairState state;
  PairWork work;
  PairSettings settings;
  settings.margin = 1e-4;
  for (int k = 0; bodies.poses[cube].position.x() < 10.5; ++k) {
    find_pair_contacts(bodies.hulls, bodies.placed, {steps, {}, {}, n_fixed, &grid}, settings,
                       state, work);
    ASSERT_FALSE(work.manifolds.empty()) << k;
    for (const PairManifold& m : work.manifolds)
      if (has_points(m)) {
        ASSERT_GT(std::abs(m.normal.z()), 1 - 1e-9)
            << "step " << k << ", x " << bodies.poses[cube].position.x() << ": "
            << m.normal.transpose();
      }
    double deepest = 0, west = 1e9, east = -1e9;
    for (const PairPoint& p : work.points) {
      deepest = std::min(deepest, p.gap);
      west = std::min(west, p.point_b.x());
      east = std::max(east, p.point_b.x());
    }
    ASSERT_NEAR(deepest, -penetration, 1e-12);
    // the points support the whole cube: they reach to its ends, but for grazing ones
    const double half = 0.4 * (std::abs(std::cos(turn)) + std::abs(std::sin(turn)));
    ASSERT_LT(west - (bodies.poses[cube].position.x() - half), 0.02) << k;
    ASSERT_LT(bodies.poses[cube].position.x() + half - east, 0.02) << k;
    bodies.poses[cube].position += step;
    place(bodies);
  }
}

void separate_floor(Bodies& bodies) {
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 3; ++j)
      add(bodies, box(Vec3(0, 0, -1), Vec3(1, 1, 0)), {Vec3(i, j, 0), Quat::Identity()});
}
void union_floor(Bodies& bodies) {
  std::vector<Polyhedron> parts;
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 3; ++j) parts.push_back(box(Vec3(i, j, -1), Vec3(i + 1, j + 1, 0)));
  add(bodies, parts, {});
}

class GhostEdges : public ::testing::TestWithParam<double> {};

TEST_P(GhostEdges, CubeOnAFloorOfBlocksSeesOnlyTheFloor) {
  for (const double penetration : {0.0, 1e-9, 1e-5, 1e-3})
    for (const Vec3& step : {Vec3(0.0137, 1e-4, 0), Vec3(0.0011, 0, 0), Vec3(0.21, 0.003, 0)})
      slide_over_floor(separate_floor, GetParam(), penetration, step, step.x() < 0.01 ? 7.9 : 0.9);
}
TEST_P(GhostEdges, CubeOnABodyOfManyPartsSeesOnlyTheFloor) {
  for (const double penetration : {0.0, 1e-9, 1e-5, 1e-3})
    for (const Vec3& step : {Vec3(0.0137, 1e-4, 0), Vec3(0.0011, 0, 0), Vec3(0.21, 0.003, 0)})
      slide_over_floor(union_floor, GetParam(), penetration, step, step.x() < 0.01 ? 7.9 : 0.9);
}
INSTANTIATE_TEST_SUITE_P(Turned, GhostEdges, ::testing::Values(0.0, 0.3, 0.785, 1e-7));

// A step of the floor that is higher than the graze height does stop the cube.
TEST(BlockPairs, LedgeIsAWall) {
  Bodies bodies;
  add(bodies, box(Vec3(0, 0, -1), Vec3(1, 1, 0)), {});
  add(bodies, box(Vec3(1, 0, -1), Vec3(2, 1, 0.05)), {});
  add(bodies, box(Vec3(-0.3, -0.3, -0.3), Vec3(0.3, 0.3, 0.3)),
      {Vec3(0.7001, 0.5, 0.3 - 1e-5), Quat::Identity()});
  place(bodies);
  PairState state;
  PairWork work;
  const PairReport report = find_pair_contacts(bodies.hulls, bodies.placed, {}, {}, state, work);
  EXPECT_EQ(report.n_grazing, 0);
  bool wall = false;
  for (const PairManifold& m : work.manifolds) wall |= m.block_a == 1 && m.normal.x() > 0.99;
  EXPECT_TRUE(wall);
}

// A wedge that fills the room under a steep bed meets the part above it. The other part touches it
// along the wall between the parts only, and has no contact of its own with it, however deep the
// two reach along all other axes.
TEST(BlockPairs, APartThatMeetsABlockAcrossAWallOnlyStopsNothing) {
  const Vec2 wedge[] = {{0, 0}, {1, -3}, {1, 3}};
  const int tags[] = {1, 1, 1};
  for (const double depth : {0.0, 1e-6, 1e-3}) {
    Bodies bodies;
    add(bodies, bent_body(3).parts, {});
    const Vec3 inward = Vec3(-3, 0, 1).normalized();
    add(bodies, prism(wedge, tags), {depth * inward, Quat::Identity()});
    place(bodies);
    PairSettings settings;
    settings.margin = 1e-4;
    PairState state;
    PairWork work;
    find_pair_contacts(bodies.hulls, bodies.placed, {}, settings, state, work);
    ASSERT_FALSE(work.points.empty());
    for (const PairManifold& m : work.manifolds) {
      EXPECT_NEAR(std::abs(m.normal.dot(inward)), 1, 1e-9);
      for (int p = m.point_begin; p < m.point_end; ++p)
        EXPECT_NEAR(work.points[p].gap, -depth, 1e-9) << "overlap " << depth;
    }
  }
}

TEST(BlockPairs, DegenerateShapesGiveFiniteContacts) {
  Draws random(34);
  Bodies bodies;
  const Polyhedron cube = box(Vec3(-0.05, -0.05, -0.05), Vec3(0.05, 0.05, 0.05));
  add(bodies, box(Vec3(-5, -5, -5), Vec3(5, 5, 5)), {Vec3(0, 0, 5), Quat::Identity()});
  for (const double x : {-4.0, 4.0})
    for (const double y : {-4.0, 4.0}) add(bodies, cube, {Vec3(x, y, -0.05), Quat::Identity()});
  for (int k = 0; k < 3; ++k)
    add(bodies, cube, {Vec3(4, 4, -0.05), Quat::Identity()});  // the same place
  for (int k = 0; k < 20; ++k)
    add(bodies, convex_body(random, k % 2 == 0 ? Vec3(2, 0.01, 0.01) : Vec3(1, 1, 0.01), k % 4),
        {Vec3(uniform(random, -5, 5), uniform(random, -5, 5), 0), attitude(random)});
  place(bodies);
  PairState state;
  PairWork work;
  PairSettings settings;
  settings.with_areas = true;
  const Drift motion = drift(random, bodies, 0.3);
  for (int step = 0; step < 200; ++step) {
    find_pair_contacts(bodies.hulls, bodies.placed, {}, settings, state, work);
    for (const PairManifold& m : work.manifolds) {
      ASSERT_NEAR(m.normal.norm(), 1, 1e-12);
      ASSERT_TRUE(std::isfinite(m.area));
      ASSERT_LE(m.point_begin, m.point_end);
    }
    for (const PairPoint& p : work.points) {
      ASSERT_TRUE(p.point_b.allFinite() && std::isfinite(p.gap) && std::isfinite(p.area));
      ASSERT_LT(p.point_b.norm(), 100);
    }
    motion.move(bodies, 1e-3);
    for (Pose& pose : bodies.poses) pose.position -= 1e-3 * Vec3(20, -3, 5);
    place(bodies);
  }
}

// A saved and restored state continues bit for bit.
TEST(BlockPairs, ResumesBitForBit) {
  Draws random(35);
  Bodies bodies = heap(random, 20, 3.5);
  const Drift motion = drift(random, bodies, 0.5);
  PairState state;
  PairWork work;
  for (int step = 0; step < 40; ++step) {
    find_pair_contacts(bodies.hulls, bodies.placed, {}, {}, state, work);
    motion.move(bodies, 1e-3);
    place(bodies);
  }
  Bodies resumed{bodies.hulls, bodies.poses, {}};
  place(resumed);
  resumed.placed.turned = bodies.placed.turned;
  PairState resumed_state = state;
  PairWork resumed_work;
  for (int step = 0; step < 40; ++step) {
    find_pair_contacts(bodies.hulls, bodies.placed, {}, {}, state, work);
    find_pair_contacts(resumed.hulls, resumed.placed, {}, {}, resumed_state, resumed_work);
    ASSERT_EQ(work.points.size(), resumed_work.points.size());
    for (std::size_t k = 0; k < work.points.size(); ++k) {
      ASSERT_EQ(work.points[k].key, resumed_work.points[k].key);
      ASSERT_EQ(work.points[k].gap, resumed_work.points[k].gap);
      ASSERT_EQ(work.points[k].point_b, resumed_work.points[k].point_b);
    }
    motion.move(bodies, 1e-3);
    motion.move(resumed, 1e-3);
    place(bodies);
    place(resumed);
  }
}

}  // namespace
