#include <gtest/gtest.h>

#include "bent_body.hpp"
#include "contact/search.hpp"

namespace {

using namespace talus;
using namespace talus::test;

// A peak that touches the steep bed of one part lies in the other part's prolongation beyond the
// wall between them: it touches the body, and is not deep inside it.
TEST(FindContacts, APeakBeyondTheWallBetweenTwoPartsIsNotInsideThePart) {
  Trn trn;
  trn.n_rows = trn.n_cols = 9;
  trn.cell_size = 0.5;
  trn.node0 = Vec2(-1.5, 2);
  trn.elevation.assign(81, -9.0);
  trn.elevation[4 * 9 + 4] = 0.5;  // at x = 0.5, y = 0
  const Ground ground = make_ground(trn, {});

  const BentBody body = bent_body(1);
  Shapes shapes;
  add_shape(shapes, body.parts, body.shell, Vec3::Zero(), Mat3::Identity(), face_internal);
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
  Trn trn;
  trn.n_rows = trn.n_cols = 9;
  trn.cell_size = 0.5;
  trn.node0 = Vec2(-2, 2);
  trn.elevation.assign(81, -9.0);
  trn.elevation[4 * 9 + 4] = 0;  // at x = 0, y = 0
  const Ground ground = make_ground(trn, {});
  const BentBody body = bent_body(1);
  Shapes shapes;
  add_shape(shapes, body.parts, body.shell, Vec3::Zero(), Mat3::Identity(), face_internal);
  EXPECT_NEAR(depth_below_ground(ground, shapes, 0, {Vec3(0, 0, -1e-3), Quat::Identity()}), 1e-3,
              1e-12);
}

}  // namespace
