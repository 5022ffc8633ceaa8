// Contacts of a block with the ground: peaks, crests, walls, lists of features.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bent_body.hpp"
#include "contact/search.hpp"
#include "convex_bodies.hpp"
#include "ground_overlap.hpp"
#include "unit/contact/depth_below_ground.hpp"

namespace {

using namespace talus;
using namespace talus::test;

// A peak of height `top` at (x, 0) above ground far below, on half-metre cells.
Ground peak(double x, double top) {
  Trn trn;
  trn.n_rows = trn.n_cols = 9;
  trn.cell_size = 0.5;
  trn.node0 = Vec2(x - 2, 2);
  trn.elevation.assign(81, -9.0);
  trn.elevation[4 * 9 + 4] = top;
  return make_ground(trn, {});
}

Shapes bent_shapes() {
  const BentBody body = bent_body(1);
  Shapes shapes;
  add_shape(shapes, body.parts, body.shell, Vec3::Zero(), Mat3::Identity(), face_internal);
  return shapes;
}

// A peak that touches the steep bed of one part lies in the other part's prolongation beyond the
// wall between them: it touches the body, and is not deep inside it.
TEST(FindContacts, APeakBeyondTheWallBetweenTwoPartsIsNotInsideThePart) {
  const Ground ground = peak(0.5, 0.5);
  const Shapes shapes = bent_shapes();
  std::vector<Vec3> vertices;
  std::vector<Contact> contacts;
  for (const double depth : {0.0, 1e-3}) {
    const Pose pose{Vec3(0, 0, -depth), Quat::Identity()};
    find_contacts(ground, shapes, 0, pose, Mat3::Identity(), 1e-2, vertices, contacts);
    ASSERT_EQ(contacts.size(), 1U);
    EXPECT_EQ(contacts[0].key.mode, ContactMode::face_vertex);
    EXPECT_NEAR(contacts[0].gap, -depth * std::sqrt(0.5), 1e-12);
    EXPECT_LT((contacts[0].normal - Vec3(-1, 0, 1).normalized()).norm(), 1e-12);
  }
}

// On the wall itself both parts see the peak, one or the other by rounding alone would not do.
TEST(FindContacts, APeakUnderTheWallTouchesTheBody) {
  const Pose pose{Vec3(0, 0, -1e-3), Quat::Identity()};
  EXPECT_NEAR(depth_below_ground(peak(0, 0), bent_shapes(), 0, pose), 1e-3, 1e-12);
}

// A crest of height 0 along y = 0 from x = -end to x = end, over ground far below.
Ground crest(double end) {
  Trn trn;
  trn.n_rows = trn.n_cols = 9;
  trn.cell_size = 0.5;
  trn.node0 = Vec2(-2, 2);
  trn.elevation.assign(81, -9.0);
  for (int col = 0; col < 9; ++col)
    if (std::abs(-2 + 0.5 * col) <= end) trn.elevation[4 * 9 + static_cast<std::size_t>(col)] = 0;
  return make_ground(trn, {});
}

// Places along x at which a box, pressed into the crest and tilted along it, is touched in `mode`.
std::vector<double> touched_at(const Ground& ground, double half_length, double tilt, double depth,
                               double margin, ContactMode mode) {
  const Polyhedron body = box(Vec3(-half_length, -1, 0), Vec3(half_length, 1, 1));
  Shapes shapes;
  add_shape(shapes, std::span(&body, 1), body, Vec3::Zero(), Mat3::Identity(), face_internal);
  const Pose pose{Vec3(0, 0, -depth), Quat(Eigen::AngleAxisd(tilt, Vec3::UnitY()))};
  std::vector<Vec3> vertices;
  std::vector<Contact> contacts;
  find_contacts(ground, shapes, 0, pose, Mat3::Identity(), margin, vertices, contacts);
  std::vector<double> places;
  for (const Contact& c : contacts)
    if (c.key.mode == mode) places.push_back(c.point_b.x());
  std::ranges::sort(places);
  return places;
}

// A corner that slides into a valley, pressed in by more than the margin on the side that it comes
// from, touches the other side before it is over it: sought without a margin, it is found there
// too.
TEST(FindContacts, AVertexPressedInBesideAValleyTouchesItsOtherSide) {
  Trn trn;
  trn.n_rows = trn.n_cols = 9;
  trn.cell_size = 0.5;
  trn.node0 = Vec2(-2, 2);
  for (int node = 0; node < 81; ++node) trn.elevation.push_back(std::abs(-1 + 0.25 * (node % 9)));
  const Ground valley = make_ground(trn, {});
  const Polyhedron body = box(Vec3(-0.5, -0.3, 0), Vec3(0.5, 0.3, 1));
  Shapes shapes;
  add_shape(shapes, std::span(&body, 1), body, Vec3::Zero(), Mat3::Identity(), face_internal);
  // on its edge along y, 1e-5 m below the left side and touching the plane of the right one
  const double pressed = 1e-5, beside = -pressed * std::sqrt(1.25);
  const Quat turned(Eigen::AngleAxisd(0.8, Vec3::UnitY()));
  const Vec3 corner = turned * Vec3(0.5, 0.3, 0);
  const Pose pose{Vec3(beside, 0.1, beside / 2) - Vec3(corner.x(), 0, corner.z()), turned};
  std::vector<Vec3> vertices;
  std::vector<Contact> contacts;
  find_contacts(valley, shapes, 0, pose, Mat3::Identity(), 1e-8, vertices, contacts);
  int n_left = 0, n_right = 0;
  for (const Contact& c : contacts) {
    const bool is_left = c.normal.x() > 0;
    (is_left ? n_left : n_right) += 1;
    EXPECT_NEAR(c.gap, is_left ? -pressed : 0, 1e-12);
  }
  EXPECT_EQ(n_left, 2);
  EXPECT_EQ(n_right, 2);
}

// A face on a crest is never parallel to it by rounding. It rests on both ends, whichever is the
// deeper one: else the two take turns from step to step and the body sinks in.
TEST(FindContacts, AFaceRestsOnBothEndsOfACrest) {
  const Ground ground = crest(1);
  for (const double tilt : {-4e-4, 0.0, 4e-4}) {
    const std::vector<double> places =
        touched_at(ground, 1.5, tilt, 2e-3, 1e-2, ContactMode::face_vertex);
    ASSERT_EQ(places.size(), 2U) << tilt;
    EXPECT_NEAR(places[0], -1, 1e-12);
    EXPECT_NEAR(places[1], 1, 1e-12);
  }
}

// A long crest supports a shorter face through two edges of the block, also when its overlap is
// larger at one of them: at large steps this tilts the face.
TEST(FindContacts, AFaceRestsOnALongCrestByItsEdges) {
  const Ground ground = crest(2);
  for (const double tilt : {-3e-3, 0.0, 3e-3}) {
    const std::vector<double> places =
        touched_at(ground, 0.8, tilt, 6e-3, 8e-3, ContactMode::edge_edge);
    ASSERT_EQ(places.size(), 2U) << tilt;
    EXPECT_NEAR(places[0], -0.8, 1e-3);
    EXPECT_NEAR(places[1], 0.8, 1e-3);
  }
}

// The lowest edge of a cube crosses a ridge of 90 degrees: they touch there, however small their
// angle is. Its ends are less deep in the sides, and no edge that ends before the ridge is deeper.
TEST(FindContacts, EdgesThatHardlyCrossARidgeTouchIt) {
  Trn trn;
  trn.n_rows = trn.n_cols = 9;
  trn.cell_size = 1;
  trn.node0 = Vec2(-4, 4);
  for (int node = 0; node < 81; ++node) trn.elevation.push_back(-std::abs(node % 9 - 4.0));
  const Ground ground = make_ground(trn, {});
  const Polyhedron body = box(Vec3(-0.5, -0.4, -0.5), Vec3(0.5, 0.4, 0.5));
  Shapes shapes;
  add_shape(shapes, std::span(&body, 1), body, Vec3::Zero(), Mat3::Identity(), face_internal);
  const Quat on_edge(Eigen::AngleAxisd(std::numbers::pi / 4, Vec3::UnitY()));
  std::vector<Vec3> vertices;
  std::vector<Contact> contacts;
  for (const double depth : {-1e-6, 1e-3, 0.015})
    for (const double degrees : {0.01, 0.1, 0.3, 0.9, 1.1, 5.0}) {
      const Quat turned(Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Vec3::UnitZ()));
      const Pose pose{Vec3(0, 0.45, std::sqrt(0.5) - depth), turned * on_edge};
      find_contacts(ground, shapes, 0, pose, Mat3::Identity(), 1e-5, vertices, contacts);
      const auto is_upright = [](const Contact& c) { return c.normal.z() > 0.9; };
      const auto edges = std::ranges::find_if(contacts, is_upright);
      ASSERT_NE(edges, contacts.end()) << degrees << " " << depth;
      EXPECT_EQ(edges->key.mode, ContactMode::edge_edge);
      EXPECT_LT((edges->normal - Vec3::UnitZ()).norm(), 1e-9);
      EXPECT_NEAR(edges->gap, -depth, 1e-12);
      EXPECT_NEAR(edges->point_b.y(), 0.45, 1e-7);  // rounding over the square of the sine
      for (const Contact& c : contacts)
        EXPECT_TRUE(is_upright(c) || c.gap > -std::sqrt(0.5) * std::max(0.0, depth)) << c.gap;
    }
}

// A box leans with one face on the flank of a fin whose crest it overlaps by 5 cm. The edges of its
// next face cross the crest as well, where they read as a metre deep: the shortest displacement out
// is another one.
TEST(FindContacts, EdgesAreInContactOnlyAlongTheShortestWayOut) {
  Trn trn;
  trn.n_rows = trn.n_cols = 17;
  trn.cell_size = 0.5;
  trn.node0 = Vec2(-4, 4);
  trn.elevation.assign(17 * 17, -9.0);
  for (int col = 0; col < 17; ++col) {
    trn.elevation[7 * 17 + col] = -0.6;  // north of the crest, which is at y = 0
    trn.elevation[8 * 17 + col] = 0;
    trn.elevation[9 * 17 + col] = -0.5;
  }
  const Ground ground = make_ground(trn, {});
  const Polyhedron cube = box(Vec3::Constant(-1.7), Vec3::Constant(1.7));
  Shapes shapes;
  add_shape(shapes, std::span(&cube, 1), cube, Vec3::Zero(), Mat3::Identity(), face_internal);
  const Quat turned(Eigen::AngleAxisd(std::numbers::pi / 4, Vec3::UnitX()));
  const Pose pose{turned * Vec3(0.013, 0.7, 1.65), turned};  // the crest 5 cm inside of one face
  std::vector<Vec3> vertices;
  std::vector<Contact> contacts;
  find_contacts(ground, shapes, 0, pose, Mat3::Identity(), 1e-3, vertices, contacts);
  int n_crest = 0;
  for (const Contact& c : contacts) {
    EXPECT_NEAR(c.gap, -0.05, 1e-9);
    EXPECT_LT((c.normal - Vec3(0, -1, 1).normalized()).norm(), 1e-9);
    n_crest += c.key.mode == ContactMode::edge_edge && std::abs(c.point_b.y()) < 1e-9;
  }
  EXPECT_EQ(n_crest, 2);
}

// Random ground about a plane of random dip: 33 nodes a side, (0, 0) in the middle.
Trn rough_ground(Draws& random, double cell, double roughness) {
  std::normal_distribution<double> normal(0, roughness);
  const double east = uniform(random, -1, 1), north = uniform(random, -1, 1);
  Trn trn;
  trn.n_rows = trn.n_cols = 33;
  trn.cell_size = cell;
  trn.node0 = Vec2(-16 * cell, 16 * cell);
  for (int row = 0; row < trn.n_rows; ++row)
    for (int col = 0; col < trn.n_cols; ++col)
      trn.elevation.push_back(cell * (east * (col - 16) + north * (16 - row)) + normal(random));
  return trn;
}

// A block that is lowered onto rough ground until it overlaps by `wanted` is in contact about as
// deep there, whichever features meet: corners, nodes, edges with ridges. How often it is not.
double share_unseen(std::initializer_list<double> wanted) {
  constexpr int n_trials = 3000;
  Draws random(5);
  std::vector<Vec3> vertices;
  std::vector<Contact> contacts;
  int n_unseen = 0;
  for (int trial = 0; trial < n_trials; ++trial) {
    const Trn trn = rough_ground(random, 2, 1);
    Polyhedron body = convex_body(random, Vec3::Constant(5), 5);
    const Quat turned = attitude(random);
    for (Vec3& v : body.vertices) v = turned * v;
    const double overlap = vertical_overlap(trn, body).height;
    const Ground ground = make_ground(trn, {});
    Shapes shapes;
    add_shape(shapes, std::span(&body, 1), body, Vec3::Zero(), Mat3::Identity(), face_internal);
    for (const double w : wanted) {
      const Pose pose{Vec3(0, 0, overlap - w), Quat::Identity()};
      find_contacts(ground, shapes, 0, pose, Mat3::Identity(), 1e-3, vertices, contacts);
      double seen = 0;
      for (const Contact& c : contacts)
        seen = std::max(seen, -c.gap / std::max(0.05, std::abs(c.normal.z())));
      n_unseen += seen < 0.2 * w;
    }
  }
  return n_unseen / (n_trials * static_cast<double>(wanted.size()));
}

TEST(FindContacts, SeesEveryOverlapOfAFewPerCentWithRoughGround) {
  EXPECT_EQ(share_unseen({0.1, 0.3}), 0);
}

// Deeper, other features than the deepest in height may lead out sooner.
TEST(FindContacts, SeesNearlyEveryDeepOverlapWithRoughGround) {
  const double share = share_unseen({0.5, 1, 2});
  RecordProperty("share_unseen", std::to_string(share));
  EXPECT_LT(share, 4e-3);
}

bool same_contacts(const std::vector<Contact>& a, const std::vector<Contact>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Contact& x, const Contact& y) {
    return x.key == y.key && x.ground_class == y.ground_class && x.normal == y.normal &&
           x.gap == y.gap && x.point_a == y.point_a && x.point_b == y.point_b;
  });
}

// A block that wanders and turns over rough ground, now slowly, now fast, strained a little, with
// margins that come and go: the lists of earlier searches change no contact and no bit, and the
// slow ones do use them.
TEST(FindContacts, AreTheSameToTheBitWithAListOfFeatures) {
  Draws random(11);
  std::vector<Vec3> vertices;
  std::vector<Contact> whole, listed;
  int n_contacts = 0, n_edge_contacts = 0, n_large = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Ground ground = make_ground(rough_ground(random, 2, 1), {});
    // many of every third have more edges than fit into 64 bits
    Polyhedron body = convex_body(random, Vec3::Constant(5), trial % 3 == 0 ? 60 : 5);
    Shapes shapes;
    add_shape(shapes, std::span(&body, 1), body, Vec3::Zero(), Mat3::Identity(), face_internal);
    n_large += edges_of(shapes, 0).size() > 64;
    Pose pose{Vec3(0, 0, vertical_overlap(ground.trn, body).height - 0.2), Quat::Identity()};
    NearFeatures near;
    int n_lists = 0;
    for (int k = 0; k < 60; ++k) {
      const double fast = k % 20 == 19 ? 0.5 : std::pow(10, uniform(random, -5, -2));
      pose.position +=
          fast * Vec3(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -0.5, 0.5));
      const Vec3 axis(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
      pose.attitude =
          (Quat(Eigen::AngleAxisd(0.2 * fast, axis.normalized())) * pose.attitude).normalized();
      Mat3 stretch = Mat3::Identity();
      if (trial % 2 != 0) stretch(0, 0) += uniform(random, 0, 1e-4);
      const double margin = std::pow(10, uniform(random, -4, -1.5));
      const Vec3 was = near.listed.position;
      find_contacts(ground, shapes, 0, pose, stretch, margin, vertices, whole);
      find_contacts(ground, shapes, 0, pose, stretch, margin, vertices, listed, &near);
      ASSERT_TRUE(same_contacts(whole, listed)) << "trial " << trial << ", search " << k;
      n_lists += near.listed.position != was;
      n_contacts += static_cast<int>(whole.size());
      n_edge_contacts +=
          static_cast<int>(std::count_if(whole.begin(), whole.end(), [](const Contact& c) {
            return c.key.mode == ContactMode::edge_edge;
          }));
    }
    EXPECT_LT(n_lists, 30);
  }
  EXPECT_GT(n_large, 30);
  EXPECT_GT(n_edge_contacts, 10000);
  EXPECT_GT(n_contacts, n_edge_contacts);
}

}  // namespace
