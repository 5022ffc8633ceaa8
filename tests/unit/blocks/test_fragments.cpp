// Fragments: exact filling, sizes, determinism.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "blocks/fragments.hpp"

namespace {

using namespace talus;

Body body_of(const Polyhedron& shape) { return {{shape}, {}, 0, Vec3::Zero(), Vec3::Zero()}; }

BlockSet set_of(const std::vector<Polyhedron>& shapes) {
  BlockSet set;
  set.material_names = {"rock"};
  for (Polyhedron shape : shapes) {
    std::fill(shape.face_tag.begin(), shape.face_tag.end(), face_terrain);
    add_body(set, body_of(shape));
  }
  return set;
}

Moments moments_of(const BlockSet& set, int b) {
  const auto i = static_cast<std::size_t>(b);
  return {set.volume[i], set.centroid[i], set.second_moment[i]};
}

// Volume, centroid and second moments of a block are those of its pieces taken together.
TEST(Fragments, FillTheirParentToRounding) {
  BlockSet set = set_of({box(Vec3(0, 0, 0), Vec3(3, 2, 1)), box(Vec3(9, 0, 0), Vec3(10, 1, 1))});
  const std::vector<Fragment> fragments = add_fragments(set, {});
  ASSERT_EQ(fragments.size(), static_cast<std::size_t>(n_blocks(set)));
  EXPECT_EQ(broken_promise(set), "");
  int n_cut = 0;
  for (int b = 0; b < n_blocks(set); ++b) {
    const int first = fragments[static_cast<std::size_t>(b)].first_piece;
    if (first < 0) continue;
    ++n_cut;
    const Moments whole = moments_of(set, b),
                  both = joined(moments_of(set, first), moments_of(set, first + 1));
    EXPECT_NEAR(both.volume, whole.volume, 1e-12 * whole.volume);
    EXPECT_LT((both.centroid - whole.centroid).norm(), 1e-12);
    EXPECT_LT((both.second - whole.second).norm(), 1e-12 * whole.second.norm());
  }
  EXPECT_GT(n_cut, 50);
}

// A plane passes the centroid by up to a fifth of the width, so pieces are not halves: limits.md
// has these numbers.
TEST(Fragments, AreNoHalves) {
  struct Case {
    Vec3 size;
    double mean;
  };
  for (const Case& of : {Case{{1, 1, 1}, 0.67}, Case{{3, 2, 1}, 0.66}, Case{{6, 1, 1}, 0.64}}) {
    std::vector<Polyhedron> shapes;
    for (int i = 0; i < 4000; ++i) {
      const Vec3 corner(10.0 * i, 0, 0);
      shapes.push_back(box(corner, corner + of.size));
    }
    BlockSet set = set_of(shapes);
    SplitSettings settings;
    settings.max_generation = 1;
    const std::vector<Fragment> fragments = add_fragments(set, settings);
    double sum = 0, most = 0;
    for (std::size_t b = 0; b < shapes.size(); ++b) {
      const double share =
          fragments[static_cast<std::size_t>(fragments[b].first_piece)].volume_share;
      sum += std::max(share, 1 - share);
      most = std::max({most, share, 1 - share});
    }
    EXPECT_NEAR(sum / 4000, of.mean, 0.005) << of.size.transpose();
    EXPECT_NEAR(most, 0.875, 0.005) << of.size.transpose();
  }
}

TEST(Fragments, NoneIsSmallerThanAskedForAndNoneCutMoreOften) {
  BlockSet set = set_of({box(Vec3(0, 0, 0), Vec3(3, 2, 1))});
  SplitSettings settings;
  settings.min_volume = 0.2;
  settings.max_generation = 3;
  const std::vector<Fragment> fragments = add_fragments(set, settings);
  double shares = 0;
  for (int b = 0; b < n_blocks(set); ++b) {
    const Fragment& piece = fragments[static_cast<std::size_t>(b)];
    EXPECT_LE(piece.generation, 3);
    if (piece.parent >= 0) {
      EXPECT_GE(set.volume[static_cast<std::size_t>(b)], 0.2);
    }
    EXPECT_NEAR(piece.volume_share, set.volume[static_cast<std::size_t>(b)] / 6, 1e-12);
    if (piece.first_piece < 0) shares += piece.volume_share;
  }
  EXPECT_NEAR(shares, 1, 1e-12);
}

// The pieces of a block are the same whatever is beside it.
TEST(Fragments, DependOnSeedAndBlockAlone) {
  const Polyhedron one = box(Vec3(0, 0, 0), Vec3(3, 2, 1));
  BlockSet alone = set_of({one}), together = set_of({one, box(Vec3(9, 0, 0), Vec3(12, 1, 1))}),
           other = set_of({one});
  SplitSettings once;
  once.max_generation = 1;
  const auto cut = [&](BlockSet& set) { return add_fragments(set, once).front().cut_normal; };
  const Vec3 normal = cut(alone);
  EXPECT_EQ(cut(together), normal);
  once.seed = 2;
  EXPECT_NE(cut(other), normal);
}

// Binary cuts give pieces with 6 to 7 faces and about 9 vertices, as natural fragments have
// (Domokos et al. 2020: 6.6 and 8.9), not the 15 and 27 of Voronoi cells.
TEST(Fragments, HaveTheFacesAndVerticesOfNaturalOnes) {
  BlockSet set = set_of({box(Vec3(0, 0, 0), Vec3(10, 8, 6))});
  const std::vector<Fragment> fragments = add_fragments(set, {});
  double faces = 0, vertices = 0, n = 0;
  for (int b = 0; b < n_blocks(set); ++b) {
    if (fragments[static_cast<std::size_t>(b)].first_piece >= 0) continue;
    const Polyhedron shell = block_shell(set, b);
    faces += n_faces(shell);
    vertices += static_cast<double>(shell.vertices.size());
    ++n;
  }
  EXPECT_EQ(n, 64);
  EXPECT_NEAR(faces / n, 6.6, 0.6);
  EXPECT_NEAR(vertices / n, 8.9, 1);
}

TEST(Fragments, AlongJointsAreParallelToTheJointSets) {
  BlockSet set = set_of({});
  set.joint_set_names = {"J1", "J2"};
  Polyhedron shape = box(Vec3(0, 0, 0), Vec3(3, 2, 1), face_terrain);
  shape.face_tag[0] = shape.face_tag[1] = 0;  // -x, +x
  shape.face_tag[4] = 1;                      // -z
  add_body(set, body_of(shape));
  SplitSettings settings;
  settings.splitting = Splitting::joints;
  settings.bonded = {0.25, 1};
  const std::vector<Fragment> fragments = add_fragments(set, settings);
  for (const Fragment& piece : fragments) {
    if (piece.first_piece < 0) continue;
    const bool along_x = std::abs(piece.cut_normal.x()) > 1 - 1e-12,
               along_z = std::abs(piece.cut_normal.z()) > 1 - 1e-12;
    EXPECT_TRUE(along_x || along_z);
    EXPECT_EQ(piece.bonded, along_x ? 0.25 : 1);
  }
  BlockSet bare = set_of({box(Vec3(0, 0, 0), Vec3(1, 1, 1))});
  EXPECT_THROW((void)add_fragments(bare, settings), InputError);
}

}  // namespace
