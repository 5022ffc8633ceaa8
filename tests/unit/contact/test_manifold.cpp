// Contact points of two convex parts: faces, edges, nearly parallel ones.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>
#include <numbers>
#include <set>
#include <tuple>

#include "contact/manifold.hpp"
#include "convex_bodies.hpp"
#include "geometry/face_overlap.hpp"

namespace {

using namespace talus;
using namespace talus::test;

struct Manifold {
  AxisChoice choice;
  int incident = -1;
  std::vector<PairManifold> manifolds;
  std::vector<PairPoint> points;
};

Manifold contact_along(const Bodies& bodies, const PairAxis& axis, double margin) {
  Manifold m;
  m.choice.axis = axis;
  m.choice.normal = axis_normal(bodies.hulls, bodies.placed, 0, 1, axis);
  if (axis.kind == AxisKind::face_a)
    m.incident = incident_face(bodies.hulls, bodies.placed, 1, -m.choice.normal);
  if (axis.kind == AxisKind::face_b)
    m.incident = incident_face(bodies.hulls, bodies.placed, 0, m.choice.normal);
  ClipScratch clip;
  std::vector<HeldPoint> held;
  const double area =
      find_features(bodies.hulls, bodies.placed, 0, 1, axis, m.incident, true, clip, held);
  if (!held.empty())
    add_manifold(bodies.hulls, bodies.placed, 0, 1, axis, m.incident, m.choice.normal, area,
                 PointReach{margin}, held, m.manifolds, m.points);
  return m;
}

Manifold contact(const Bodies& bodies, double margin, const PairAxis& last = {}) {
  AxisScratch axis;
  ClipScratch clip;
  std::vector<HeldPoint> held;
  Manifold m;
  const ContactSearch found =
      search_contact(bodies.hulls, bodies.placed, 0, 1, margin, last, true, axis, clip, held);
  m.choice = found.choice;
  m.incident = found.incident;
  if (!held.empty())
    add_manifold(bodies.hulls, bodies.placed, 0, 1, m.choice.axis, m.incident, m.choice.normal,
                 found.area, PointReach{margin}, held, m.manifolds, m.points);
  return m;
}

using Key = std::tuple<int, int, int>;
std::map<Key, Vec3> places(const Manifold& m) {
  std::map<Key, Vec3> map;
  for (const PairPoint& p : m.points)
    map[{static_cast<int>(p.key.mode), p.key.feature_a, p.key.feature_b}] = p.point_b;
  return map;
}

Bodies cube_on_cube(double x, double y, double turn, double depth) {
  Bodies bodies;
  add(bodies, box(Vec3(-1, -1, -1), Vec3(1, 1, 1)), {});
  add(bodies, box(Vec3(-1, -1, -1), Vec3(1, 1, 1)),
      {Vec3(x, y, 2 - depth), Quat(Eigen::AngleAxisd(turn, Vec3::UnitZ()))});
  place(bodies);
  return bodies;
}

TEST(Manifold, ShiftedCubesShareTheRectangle) {
  const double depth = 1e-5;
  const Manifold m = contact(cube_on_cube(0.5, 0.3, 0, depth), 0);
  ASSERT_EQ(m.points.size(), 4u);
  EXPECT_NEAR(m.manifolds[0].area, 1.5 * 1.7, 1e-12);
  EXPECT_LT((m.manifolds[0].normal - Vec3(0, 0, -1)).norm(), 1e-15);
  std::map<int, int> modes;
  for (const PairPoint& p : m.points) {
    EXPECT_NEAR(p.gap, -depth, 1e-15);
    EXPECT_NEAR(p.point_b.z(), 1 - depth, 1e-15);
    EXPECT_NEAR(p.area, 1.5 * 1.7 / 4, 1e-12);
    ++modes[static_cast<int>(p.key.mode)];
  }
  EXPECT_EQ(modes[1], 1);  // a corner of the lower cube in the upper's face
  EXPECT_EQ(modes[2], 1);  // a corner of the upper cube in the lower's face
  EXPECT_EQ(modes[3], 2);  // two crossings of sides
}

// A face turned by 45 degrees on an equal one: a regular octagon, eight crossings.
TEST(Manifold, TurnedCubesShareTheOctagon) {
  const Manifold m = contact(cube_on_cube(0, 0, std::numbers::pi / 4, 1e-5), 0);
  ASSERT_EQ(m.points.size(), 8u);
  EXPECT_NEAR(m.manifolds[0].area, 8 * (std::sqrt(2.0) - 1), 1e-12);
  for (const PairPoint& p : m.points) EXPECT_EQ(p.key.mode, ContactMode::edge_edge);
}

TEST(Manifold, CrossedWedgesTouchAtOnePoint) {
  // two prisms with a ridge of 90 degrees, one along x, one along y, ridge on ridge
  const Polyhedron ridge = clip_convex(
      clip_convex(box(Vec3(-2, -1, -1), Vec3(2, 1, 1)), {Vec3(0, 1, 1).normalized(), 0}, 0, 1e-9),
      {Vec3(0, -1, 1).normalized(), 0}, 0, 1e-9);
  Bodies bodies;
  add(bodies, ridge, {});
  const Quat over = Quat(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitZ())) *
                    Quat(Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()));
  add(bodies, ridge, {Vec3(0.2, -0.3, -1e-4), over});
  place(bodies);
  const Manifold m = contact(bodies, 0);
  ASSERT_EQ(m.points.size(), 1u);
  EXPECT_EQ(m.choice.axis.kind, AxisKind::edges);
  EXPECT_EQ(m.points[0].key.mode, ContactMode::edge_edge);
  EXPECT_NEAR(m.points[0].gap, -1e-4, 1e-15);
  EXPECT_LT((m.points[0].point_b - Vec3(0.2, 0, -1e-4)).norm(), 1e-12);
  EXPECT_LT((m.manifolds[0].normal - Vec3(0, 0, -1)).norm(), 1e-12);
}

// Pairs pressed together a little: every point lies on both surfaces, the deepest has the depth of
// the pair, keys differ, nothing is NaN.
TEST(Manifold, PointsLieOnBothSurfaces) {
  Draws random(21);
  int n_points = 0, n_faces_met = 0;
  for (int k = 0; k < 3000; ++k) {
    Bodies bodies;
    const bool needle = k % 5 == 0;
    for (int i = 0; i < 2; ++i) {
      const Pose pose{direction(random), attitude(random)};
      const Vec3 half =
          needle && i == 0 ? Vec3(2, 0.01, 0.01) : Vec3(1, uniform(random, 0.2, 1), 1);
      add(bodies, convex_body(random, half, k % 7), pose);
    }
    place(bodies);
    const double depth = 1e-5;
    press(bodies, 0, 1, -direction(random), 0);
    AxisScratch scratch;
    // part them along their own axis until they overlap by `depth`
    const AxisChoice choice = find_axis(bodies.hulls, bodies.placed, 0, 1, 10, {}, scratch);
    ASSERT_TRUE(choice.touches);
    bodies.poses[1].position += (choice.separation + depth) * choice.normal;
    place(bodies);
    const Manifold m = contact(bodies, 0.0);
    if (!m.choice.touches) continue;  // it was a vertex beyond an edge
    if (brute_separation(bodies.hulls, bodies.placed, 0, 1) < -1.5 * depth) continue;
    ASSERT_FALSE(m.points.empty()) << k;
    double deepest = 0;
    std::set<Key> keys;
    for (const PairPoint& p : m.points) {
      const Vec3 point_a = p.point_b + p.gap * m.manifolds[0].normal;
      EXPECT_LT(std::abs(outside_by(bodies.hulls, bodies.placed, 1, p.point_b)), 2 * depth) << k;
      EXPECT_LT(std::abs(outside_by(bodies.hulls, bodies.placed, 0, point_a)), 2 * depth) << k;
      EXPECT_TRUE(
          keys.insert({static_cast<int>(p.key.mode), p.key.feature_a, p.key.feature_b}).second)
          << k;
      deepest = std::min(deepest, p.gap);
    }
    EXPECT_NEAR(deepest, -depth, 0.2 * depth) << k;
    n_points += static_cast<int>(m.points.size());
    n_faces_met += m.choice.axis.kind == AxisKind::edges ? 0 : 1;
  }
  EXPECT_GT(n_points, 2000);
  EXPECT_GT(n_faces_met, 1000);
}

// Two bodies face to face in a general position: the area is that of the two faces' exact
// intersection; the shares add up to it and keep its centre.
TEST(Manifold, AreaAndItsCentreAreThoseOfTheFacesIntersection) {
  Draws random(22);
  int n = 0;
  for (int k = 0; k < 2000; ++k) {
    Bodies bodies;
    for (int i = 0; i < 2; ++i)
      add(bodies, convex_body(random, Vec3(1, 1, 1), 2 + k % 6), {Vec3::Zero(), attitude(random)});
    place(bodies);
    // lay a face of B against a face of A
    const int f_a = std::uniform_int_distribution<int>(0, bodies.hulls.n_faces[0] - 1)(random);
    const int f_b = bodies.hulls.face_begin[1] +
                    std::uniform_int_distribution<int>(0, bodies.hulls.n_faces[1] - 1)(random);
    const Vec3 n_a = normal_at(bodies.placed, f_a);
    bodies.poses[1].attitude =
        Quat::FromTwoVectors(normal_at(bodies.placed, f_b), -n_a) * bodies.poses[1].attitude;
    bodies.poses[1].position = uniform(random, 0, 0.7) * direction(random);
    place(bodies);
    press(bodies, 0, 1, -n_a, 1e-6);
    const auto corners = [&](int part, int slot) {
      std::vector<Vec3> c;
      for (int i = bodies.hulls.loop_begin[slot]; i < bodies.hulls.loop_begin[slot + 1]; ++i)
        c.push_back(bodies.placed
                        .vertices[bodies.hulls.vertex_begin[part] + bodies.hulls.loop_vertices[i]]);
      return c;
    };
    const FaceOverlap exact = face_overlap(corners(0, f_a), n_a, corners(1, f_b));
    const Manifold m = contact_along(bodies, {AxisKind::face_a, f_a, -1}, 1e-3);
    if (exact.area < 1e-3) continue;
    ++n;
    ASSERT_EQ(m.manifolds.size(), 1u);
    EXPECT_NEAR(m.manifolds[0].area, exact.area, 2e-5);
    double sum = 0;
    Vec3 centre = Vec3::Zero();
    for (const PairPoint& p : m.points) {
      EXPECT_GE(p.area, -1e-12);
      sum += p.area;
      centre += p.area * p.point_b;
    }
    EXPECT_NEAR(sum, m.manifolds[0].area, 1e-12);
    EXPECT_LT((centre / sum - exact.centre).norm(), 2e-5);
  }
  EXPECT_GT(n, 500);
}

// The reference may be either face: keys and places must not tell which.
TEST(Manifold, KeysSurviveAFlipOfTheReferenceFace) {
  Draws random(23);
  for (int k = 0; k < 200; ++k) {
    const Bodies bodies = cube_on_cube(uniform(random, -1.5, 1.5), uniform(random, -1.5, 1.5),
                                       uniform(random, 0, 3), 1e-5);
    const auto of_a = places(contact_along(bodies, {AxisKind::face_a, 5, -1}, 0));
    const auto of_b = places(contact_along(bodies, {AxisKind::face_b, -1, 4}, 0));
    ASSERT_EQ(of_a.size(), of_b.size());
    for (const auto& [key, point] : of_a) {
      ASSERT_EQ(of_b.count(key), 1u);
      EXPECT_LT((of_b.at(key) - point).norm(), 1e-12);
    }
  }
}

// Small steps of sliding and turning: a point keeps its name while it is there, moves no farther
// than the bodies do (a crossing by the angle of the sides), and names change only where a corner
// passes a side.
TEST(Manifold, KeysAreStableUnderSmallMotion) {
  Draws random(24);
  int n_kept = 0, n_changed = 0;
  for (int run = 0; run < 20; ++run) {
    const Vec2 along = 1e-3 * Vec2(uniform(random, -1, 1), uniform(random, -1, 1));
    const double spin = uniform(random, -1e-3, 1e-3);
    Vec2 at(uniform(random, -0.5, 0.5), uniform(random, -0.5, 0.5));
    double turn = uniform(random, 0.2, 1.2);
    std::map<Key, Vec3> before;
    PairAxis last;
    for (int k = 0; k < 500; ++k) {
      const Bodies bodies = cube_on_cube(at.x(), at.y(), turn, 1e-5);
      const Manifold m = contact(bodies, 0, last);
      last = m.choice.axis;
      const std::map<Key, Vec3> now = places(m);
      ASSERT_EQ(now.size(), m.points.size());
      for (const auto& [key, point] : now) {
        const auto old = before.find(key);
        if (k > 0) ++(old == before.end() ? n_changed : n_kept);
        if (old == before.end()) continue;
        EXPECT_LT((point - old->second).norm(), 0.05);
      }
      before = now;
      at += along;
      turn += spin;
    }
  }
  EXPECT_LT(n_changed, n_kept / 100) << n_changed << " of " << n_kept;
}

// Exactly aligned stacks: rounding of 1e-15 and shifts below a millionth of the size must not
// rename points.
TEST(Manifold, AlignedFacesKeepTheirKeysUnderRounding) {
  Draws random(25);
  const auto names = places(contact(cube_on_cube(0, 0, 0, 1e-5), 0));
  EXPECT_EQ(names.size(), 4u);
  for (int k = 0; k < 200; ++k) {
    const Manifold m =
        contact(cube_on_cube(uniform(random, -1e-7, 1e-7), uniform(random, -1e-7, 1e-7),
                             uniform(random, -1e-7, 1e-7), 1e-5),
                0);
    const auto now = places(m);
    ASSERT_EQ(now.size(), 4u);
    for (const auto& [key, point] : now) EXPECT_EQ(names.count(key), 1u);
  }
}

// A 10 m block on a 0.1 m cube: four points, all on the cube's face.
TEST(Manifold, LargeBlockOnSmallCubeTouchesTheWholeCube) {
  Bodies bodies;
  add(bodies, box(Vec3(-5, -5, -5), Vec3(5, 5, 5)), {});
  add(bodies, box(Vec3(-0.05, -0.05, -0.05), Vec3(0.05, 0.05, 0.05)),
      {Vec3(1, 2, -5.05 + 1e-6), Quat(Eigen::AngleAxisd(0.3, Vec3::UnitZ()))});
  place(bodies);
  const Manifold m = contact(bodies, 0);
  ASSERT_EQ(m.points.size(), 4u);
  EXPECT_NEAR(m.manifolds[0].area, 0.01, 1e-12);
  for (const PairPoint& p : m.points) {
    EXPECT_EQ(p.key.mode, ContactMode::face_vertex);
    EXPECT_NEAR(p.gap, -1e-6, 1e-12);
  }
}

// A rock behind a wide face has a contact at every vertex behind it, whichever of its faces it
// lies on and whichever of the two bodies comes first.
TEST(Manifold, EveryVertexBehindAWideFaceCarries) {
  Draws random(27);
  int n_beside = 0;  // not corners of the incident face
  for (int run = 0; run < 200; ++run) {
    const bool rock_first = run % 2;
    const Polyhedron rock = convex_body(random, Vec3(1.5, 0.2, 0.2), 12);
    const Polyhedron table = box(Vec3(-9, -9, -9), Vec3(9, 9, 0));
    const Pose pose{Vec3::Zero(), attitude(random)};
    Bodies bodies;
    add(bodies, rock_first ? rock : table, rock_first ? pose : Pose{});
    add(bodies, rock_first ? table : rock, rock_first ? Pose{} : pose);
    place(bodies);
    const int part = rock_first ? 0 : 1, first = bodies.hulls.vertex_begin[part];
    const auto height = [&](int v) { return bodies.placed.vertices[first + v].z(); };
    double lowest = height(0);
    for (int v = 1; v < n_vertices(bodies.hulls, part); ++v) lowest = std::min(lowest, height(v));
    bodies.poses[part].position.z() = -lowest - 0.03;
    place(bodies);
    const Manifold m = contact(bodies, 0);
    ASSERT_EQ(m.choice.axis.kind, rock_first ? AxisKind::face_b : AxisKind::face_a);
    const auto mode = rock_first ? ContactMode::vertex_face : ContactMode::face_vertex;
    std::map<int, double> gaps;
    for (const PairPoint& p : m.points) {
      EXPECT_EQ(p.key.mode, mode);
      EXPECT_TRUE(gaps.emplace(rock_first ? p.key.feature_a : p.key.feature_b, p.gap).second);
    }
    std::size_t n_behind = 0;
    for (int v = 0; v < n_vertices(bodies.hulls, part); ++v) {
      if (height(v) >= 0) continue;
      ++n_behind;
      ASSERT_EQ(gaps.count(v), 1u) << run;
      EXPECT_NEAR(gaps[v], height(v), 1e-12);
    }
    EXPECT_EQ(gaps.size(), n_behind);
    const int face = bodies.hulls.face_begin[part] + m.incident;
    for (const auto& [v, gap] : gaps)
      n_beside += std::count(bodies.hulls.loop_vertices.begin() + bodies.hulls.loop_begin[face],
                             bodies.hulls.loop_vertices.begin() + bodies.hulls.loop_begin[face + 1],
                             v) == 0;
  }
  EXPECT_GT(n_beside, 20);
}

// A block on a bench whose top is bent by 0.2 degrees, moved over from the other side of the bend:
// the face that it pressed on before is in nearly the same direction, but no longer below it.
TEST(Manifold, FaceOnTheOtherSideOfASlightBendTakesOver) {
  const double slope = std::tan(0.2 * std::numbers::pi / 180), depth = 1e-3;
  Polyhedron bench = box(Vec3(-4, -2, -2), Vec3(4, 2, 1));
  for (const double side : {-1.0, 1.0})
    bench = clip_convex(bench, {Vec3(side * slope, 0, 1).normalized(), 0}, 0, 1e-9);
  Bodies bodies;
  add(bodies, bench, {});
  add(bodies, box(Vec3(-0.5, -0.5, -0.5), Vec3(0.5, 0.5, 0.5)),
      {Vec3(1, 0, 0.5 - 0.5 * slope - depth), Quat::Identity()});
  place(bodies);
  PairAxis last;
  for (int f = 0; f < bodies.hulls.n_faces[0]; ++f) {
    const Vec3 normal = normal_at(bodies.placed, bodies.hulls.face_begin[0] + f);
    if (normal.z() > 0.9 && normal.x() < 0) last = {AxisKind::face_a, f, -1};
  }
  ASSERT_EQ(last.kind, AxisKind::face_a);
  const Manifold m = contact(bodies, 0, last);
  ASSERT_FALSE(m.points.empty());
  double deepest = 0;
  for (const PairPoint& p : m.points) deepest = std::min(deepest, p.gap);
  EXPECT_NEAR(deepest, -depth, 1e-5);
}

// An upright edge leans by half a degree over the upper edge of a cube. The edges overlap least,
// and meet at one point; where the edge ends half a metre below, it is in the cube's side as well.
TEST(Manifold, EdgesNearlyAlongAFaceBearWhereTheyEndToo) {
  const double lean = 0.5 * std::numbers::pi / 180, depth = 5e-3;
  Bodies bodies;
  add(bodies, box(Vec3(-1, -0.5, -1), Vec3(0, 0.5, 0)), {});
  const Quat turned(Eigen::AngleAxisd(-std::numbers::pi / 4, Vec3::UnitZ()));  // an edge faces -x
  add(bodies, box(Vec3(0, 0, -0.5), Vec3(0.6, 0.6, 0.5)),
      {Vec3(-depth, 0, 0), Quat(Eigen::AngleAxisd(-lean, Vec3::UnitY())) * turned});
  place(bodies);
  const Manifold m = contact(bodies, 0);
  std::map<ContactMode, double> gaps;
  for (const PairPoint& p : m.points) gaps[p.key.mode] = p.gap;
  ASSERT_EQ(gaps.size(), 2u);
  EXPECT_NEAR(gaps[ContactMode::edge_edge], -depth, 1e-6);
  EXPECT_NEAR(gaps[ContactMode::face_vertex], -depth + 0.5 * std::sin(lean), 1e-9);
}

// Bars that cross on edges, of which one is cut off by a sliver of a face: they meet where they
// would without it.
TEST(Manifold, EdgesBesideASliverFaceMeet) {
  const double deep = 5e-3, up = std::sqrt(0.5), lean = 0.4;
  const Quat on_edge_x(Eigen::AngleAxisd(lean - std::numbers::pi / 4, Vec3::UnitX()));
  const Quat on_edge_y(Eigen::AngleAxisd(std::numbers::pi / 4, Vec3::UnitY()));
  Bodies bodies;
  add(bodies, box_with_sliver(Vec3(3, 0.5, 0.5)),
      {Vec3(0, 0, up * std::cos(lean) + up - deep), on_edge_x});
  add(bodies, box(Vec3(-0.5, -3, -0.5), Vec3(0.5, 3, 0.5)), {Vec3::Zero(), on_edge_y});
  place(bodies);
  const Manifold m = contact(bodies, 0.02);
  ASSERT_TRUE(m.choice.touches);
  ASSERT_FALSE(m.points.empty());
  EXPECT_NEAR(m.choice.normal.z(), 1, 1e-3);
  for (const PairPoint& point : m.points) EXPECT_NEAR(point.gap, -deep, 1e-4);
}

// Whatever the shapes and poses: where parts overlap along all axes by more than a fiftieth of the
// thickness, there is a contact that is in.
TEST(Manifold, PartsThatOverlapHaveAContact) {
  Draws random(5);
  int n_overlapping = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto half = [&] {
      return Vec3(uniform(random, 0.1, 1), uniform(random, 0.1, 1), uniform(random, 0.1, 1));
    };
    Bodies bodies;
    add(bodies, convex_body(random, half(), 5), {Vec3::Zero(), attitude(random)});
    add(bodies, convex_body(random, half(), 5),
        {uniform(random, 0.3, 1.5) * direction(random), attitude(random)});
    place(bodies);
    const Manifold m = contact(bodies, 0.02);
    const double thickness = std::min(bodies.hulls.thickness[0], bodies.hulls.thickness[1]);
    if (!m.choice.touches || m.choice.separation > -0.02 * thickness) continue;
    ++n_overlapping;
    const bool is_in = std::any_of(m.points.begin(), m.points.end(),
                                   [](const PairPoint& point) { return point.gap < 0; });
    EXPECT_TRUE(is_in) << i << " separation " << m.choice.separation;
  }
  EXPECT_GT(n_overlapping, 3000);
}

// The gap and the place of held features stay exact while the bodies move.
RC_GTEST_PROP(Manifold, HeldFeaturesFollowTheBodiesExactly, ()) {
  Draws random(*rc::gen::arbitrary<std::uint64_t>());
  Bodies bodies =
      cube_on_cube(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, 0.1, 1), 1e-4);
  const PairAxis axis{AxisKind::face_a, 5, -1};
  const Manifold first = contact_along(bodies, axis, 1);
  std::vector<HeldPoint> held;
  for (const PairPoint& p : first.points) held.push_back({p.key, p.area});
  bodies.poses[1].position += 1e-4 * direction(random);
  bodies.poses[1].attitude =
      Quat(Eigen::AngleAxisd(1e-4, direction(random))) * bodies.poses[1].attitude;
  place(bodies);
  const Manifold fresh = contact_along(bodies, axis, 1);
  std::vector<PairManifold> manifolds;
  std::vector<PairPoint> points;
  add_manifold(bodies.hulls, bodies.placed, 0, 1, axis, first.incident, fresh.choice.normal, 0,
               PointReach{1}, held, manifolds, points);
  const auto expected = places(fresh);
  RC_PRE(expected.size() == points.size());
  for (const PairPoint& p : points) {
    const Key key{static_cast<int>(p.key.mode), p.key.feature_a, p.key.feature_b};
    RC_PRE(expected.count(key) == 1u);
    RC_ASSERT((expected.at(key) - p.point_b).norm() < 1e-12);
  }
}

}  // namespace
