#include <gtest/gtest.h>

#include <numbers>

#include "bent_body.hpp"
#include "contact/search.hpp"

namespace {

using namespace talus;
using namespace talus::test;

// A peak of height `top` at (x, 0) that stands out of ground far below, on half-metre cells.
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

// A box leans with one face on the flank of a fin whose crest it overlaps by 5 cm. The edges of its
// next face cross the crest as well, where they read as a metre deep: that is not the way out.
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

}  // namespace
