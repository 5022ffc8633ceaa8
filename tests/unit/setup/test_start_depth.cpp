// Overlap of blocks with the ground at the start.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>

#include "base/random.hpp"
#include "setup/start_depth.hpp"

namespace {

using talus::BlockSet;
using talus::Polyhedron;
using talus::Trn;
using talus::Vec3;

Trn rough(talus::Random& random, double relief) {
  Trn trn;
  trn.n_rows = 12;
  trn.n_cols = 14;
  trn.cell_size = 1.5;
  trn.node0 = {0, 16.5};
  for (int i = 0; i < trn.n_rows * trn.n_cols; ++i)
    trn.elevation.push_back(random.uniform(0, relief));
  return trn;
}

// A box turned at random, centred at `at`.
Polyhedron random_box(talus::Random& random, const Vec3& at, const Vec3& size) {
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal())
          .normalized();
  Polyhedron body;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner((i & 4) ? 0.5 : -0.5, (i & 2) ? 0.5 : -0.5, (i & 1) ? 0.5 : -0.5);
    body.vertices.push_back(at + turn * corner.cwiseProduct(size));
  }
  for (const std::array<int, 4>& face : {std::array<int, 4>{0, 1, 3, 2},
                                         {4, 6, 7, 5},
                                         {0, 4, 5, 1},
                                         {2, 3, 7, 6},
                                         {0, 2, 6, 4},
                                         {1, 5, 7, 3}})
    talus::add_face(body, face, talus::face_terrain);
  return body;
}

BlockSet set_of(const Polyhedron& body) {
  BlockSet set;
  set.material_names = {"rock"};
  talus::Body made;
  made.parts = {body};
  talus::add_body(set, made);
  return set;
}

// Lowest point of a convex body above (x, y), by its planes; false beside it.
bool lowest_at(const Polyhedron& body, double x, double y, double& low) {
  double high = 1e300;
  low = -1e300;
  for (int f = 0; f < talus::n_faces(body); ++f) {
    const Vec3 n = talus::face_normal(body, f);
    const Vec3 p = body.vertices[static_cast<std::size_t>(talus::face(body, f)[0])];
    const double rest = n.dot(p) - n.x() * x - n.y() * y;
    if (n.z() > 0) high = std::min(high, rest / n.z());
    if (n.z() < 0) low = std::max(low, rest / n.z());
  }
  return low <= high;
}

TEST(StartDepth, IsTheLargestOverlapAlongTheVertical) {
  talus::Random random(5, "depth");
  for (int trial = 0; trial < 40; ++trial) {
    const Trn trn = rough(random, 1.2);
    const Vec3 at(random.uniform(6, 13), random.uniform(6, 11), random.uniform(0, 3));
    const Polyhedron body = random_box(random, at, {3, 2, 1.5});
    const double depth = talus::depths_below_ground(trn, set_of(body))[0];
    double sampled = -1e300;
    for (double x = at.x() - 2.2; x < at.x() + 2.2; x += 0.02)
      for (double y = at.y() - 2.2; y < at.y() + 2.2; y += 0.02) {
        double low = 0;
        if (lowest_at(body, x, y, low))
          sampled = std::max(sampled, talus::elevation_at(trn, x, y) - low);
      }
    EXPECT_GE(depth, sampled - 1e-9) << trial;
    EXPECT_LE(depth, sampled + 0.06) << trial;
  }
}

TEST(StartDepth, OfALiftedBlockIsZero) {
  talus::Random random(6, "depth");
  for (int trial = 0; trial < 40; ++trial) {
    const Trn trn = rough(random, 1.2);
    BlockSet set = set_of(random_box(random, {9, 8, 0.2}, {3, 2, 1.5}));
    const double depth = talus::depths_below_ground(trn, set)[0];
    ASSERT_GT(depth, 0);
    talus::move_block(set, 0, {0, 0, depth});
    EXPECT_NEAR(talus::depths_below_ground(trn, set)[0], 0, 1e-12);
    EXPECT_NEAR(set.centroid[0].z(), 0.2 + depth, 1e-12);
  }
}

}  // namespace

TEST(MoveToOrigin, KeepsThePlaceOnTheMap) {
  talus::BlockSet set;
  set.origin = {1000, 2000, 0};
  talus::Body body;
  body.parts = {talus::box(talus::Vec3(1, 2, 3), talus::Vec3(2, 4, 6))};
  talus::add_body(set, body);
  set.pair_point = {talus::Vec3(5, 6, 7)};
  const talus::Vec3 vertex = set.vertices[3] + set.origin, centroid = set.centroid[0] + set.origin;
  talus::move_to_origin(set, {1100, 1900, 50});
  EXPECT_EQ(set.origin, talus::Vec3(1100, 1900, 50));
  EXPECT_EQ(talus::Vec3(set.vertices[3] + set.origin), vertex);
  EXPECT_EQ(talus::Vec3(set.centroid[0] + set.origin), centroid);
  EXPECT_EQ(set.pair_point[0], talus::Vec3(-95, 106, -43));
}
