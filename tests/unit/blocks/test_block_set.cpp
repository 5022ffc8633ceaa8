// Block sets: adding bodies, reading them back, naming broken promises.
#include <gtest/gtest.h>

#include "blocks/block_set.hpp"
#include "geometry/polyhedron.hpp"

namespace {

using talus::BlockSet;
using talus::Body;
using talus::Vec3;

BlockSet two_bodies() {
  BlockSet set;
  set.material_names = {"rock"};
  talus::add_body(
      set,
      {{talus::box({0, 0, 0}, {1, 1, 1}, talus::face_terrain)}, {}, 0, Vec3::Zero(), Vec3::Zero()});
  // an L of two boxes, without a shell of its own
  talus::add_body(set, {{talus::box({5, 0, 0}, {7, 1, 1}, talus::face_terrain),
                         talus::box({5, 1, 0}, {6, 2, 1}, talus::face_terrain)},
                        {},
                        0,
                        Vec3(1, 0, 0),
                        Vec3::Zero()});
  return set;
}

}  // namespace

TEST(BlockSet, GivesBackTheBodiesThatWereAdded) {
  const BlockSet set = two_bodies();
  EXPECT_EQ(talus::broken_promise(set), "");
  ASSERT_EQ(talus::n_blocks(set), 2);
  EXPECT_EQ(talus::n_parts(set), 3);
  EXPECT_DOUBLE_EQ(set.volume[1], 3);
  EXPECT_LT((set.centroid[1] - Vec3(5 + 2.5 / 3, 2.5 / 3, 0.5)).norm(), 1e-15);
  const talus::Polyhedron shell = talus::block_shell(set, 0);
  EXPECT_EQ(talus::n_faces(shell), 6);
  EXPECT_DOUBLE_EQ(talus::moments(shell).volume, 1);
  EXPECT_EQ(talus::n_faces(talus::block_shell(set, 1)), 12);
  EXPECT_DOUBLE_EQ(talus::moments(talus::convex_part(set, 2)).volume, 1);
}

TEST(BlockSet, BrokenPromisesAreNamed) {
  BlockSet set = two_bodies();
  set.velocity.pop_back();
  EXPECT_NE(talus::broken_promise(set).find("velocity"), std::string::npos);
  set = two_bodies();
  set.part_face_vertices[0] = 12;  // of the other block
  EXPECT_NE(talus::broken_promise(set).find("block 0"), std::string::npos);
  set = two_bodies();
  set.vertices[3].x() = std::nan("");
  EXPECT_NE(talus::broken_promise(set).find("not finite"), std::string::npos);
  set = two_bodies();
  set.face_vertices[1] = set.face_vertices[0];
  EXPECT_NE(talus::broken_promise(set).find("block 0"), std::string::npos);
  set = two_bodies();
  set.pair_blocks.push_back({1, 0});
  EXPECT_NE(talus::broken_promise(set).find("pair"), std::string::npos);
}
