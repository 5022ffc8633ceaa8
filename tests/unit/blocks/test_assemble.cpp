// Blocks from the cells of a cut mass: volume, overlap, convexity, slivers.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "blocks/assemble.hpp"
#include "scenes.hpp"

namespace {

using namespace talus;
using namespace talus::test;

struct Trial {
  Scene scene;
  std::vector<Joint> joints;
  CellComplex complex;
  double volume;
};

// A mass and a joint system; every few trials the joints coincide with grid lines, with the bed or
// with each other.
Trial random_trial(Random& random, int number) {
  const double cell = random.uniform(0.5, 5);
  Trial trial;
  trial.scene = random_scene(random, 9 + number % 5, cell);
  std::vector<JointSet> sets;
  for (int s = 0; s < 1 + number % 4; ++s) {
    JointSet set =
        joint_set(random.uniform(0, 90), random.uniform(0, 360), random.uniform(1.2, 4) * cell);
    if (number % 3 == 0) set.dip = 90 * degree, set.dip_direction = 45 * degree * random.below(8);
    if (number % 5 == 0) set.fisher_k = 30;
    if (number % 7 == 0) set.mean_spacing = 2 * cell;
    if (number % 4 == 0) set.spacing = Spacing::exponential;
    if (number % 6 == 5) set.persistence = 0.6, set.disc_diameter = 6 * cell;
    sets.push_back(set);
  }
  const double extent = cell * (trial.scene.ground.n_rows - 1);
  const int middle = trial.scene.ground.n_rows / 2;
  const Vec3 centre(middle * cell, middle * cell,
                    trial.scene.ground.elevation[middle * (middle + 1)]);
  trial.joints = draw_all(sets, centre, 2 * extent, number);
  if (number % 8 == 1) {  // a joint through a triangle of the bed
    const auto corners =
        triangle_corners(trial.scene.bed, 2 * (trial.scene.bed.n_cols - 1) * 4 + 8);
    Joint joint;
    joint.plane = plane_through(
        corners[0], (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized());
    trial.joints.push_back(joint);
  }
  trial.complex = cut_mass(trial.scene.ground, trial.scene.bed, {}, trial.joints);
  trial.volume = prism_volume(trial.scene.ground, trial.scene.bed);
  return trial;
}

BlockSet new_set() {
  BlockSet set;
  set.material_names = {"rock"};
  set.joint_set_names = {"J1", "J2", "J3", "J4"};
  return set;
}

bool is_inside(const Polyhedron& convex, const Vec3& point, double margin) {
  for (int f = 0; f < n_faces(convex); ++f)
    if (distance(plane_through(face_centroid(convex, f), face_normal(convex, f)), point) > -margin)
      return false;
  return true;
}

// Bodies that a point lies in, looked for in the convex parts without any help of the cutter.
int n_bodies_at(const std::vector<std::vector<Polyhedron>>& bodies, const Vec3& point,
                double margin) {
  int n = 0;
  for (const auto& parts : bodies)
    n += std::any_of(parts.begin(), parts.end(),
                     [&](const Polyhedron& part) { return is_inside(part, point, margin); });
  return n;
}

std::vector<std::vector<Polyhedron>> parts_by_block(const BlockSet& set) {
  std::vector<std::vector<Polyhedron>> bodies(n_blocks(set));
  for (int b = 0; b < n_blocks(set); ++b)
    for (int p = set.convex_part_begin[b]; p < set.convex_part_begin[b + 1]; ++p)
      bodies[b].push_back(convex_part(set, p));
  return bodies;
}

// Of convex parts of two blocks, cut by each other's planes.
double shared_volume(const std::vector<Polyhedron>& block, const std::vector<Polyhedron>& other) {
  double shared = 0;
  const auto apart = [](const Polyhedron& one, const Polyhedron& two) {
    const auto extreme = [](const Polyhedron& body, bool high) {
      Vec3 e = body.vertices[0];
      for (const Vec3& v : body.vertices) e = high ? Vec3(e.cwiseMax(v)) : Vec3(e.cwiseMin(v));
      return e;
    };
    return (extreme(one, true).array() < extreme(two, false).array()).any() ||
           (extreme(two, true).array() < extreme(one, false).array()).any();
  };
  for (const Polyhedron& one : block)
    for (const Polyhedron& two : other) {
      if (apart(one, two)) continue;
      Polyhedron common = one;
      for (int f = 0; f < n_faces(two) && n_faces(common) > 0; ++f)
        common =
            clip_convex(common, plane_through(face_centroid(two, f), face_normal(two, f)), 0, 0);
      if (n_faces(common) > 0) shared += std::abs(moments(common).volume);
    }
  return shared;
}

}  // namespace

// Exact blocks: all of the mass, each closed, outward and a sphere, no cubic metre lost.
TEST(AssembleBlocks, ExactBlocksFillRandomMasses) {
  Random random(21);
  for (int number = 0; number < 200; ++number) {
    SCOPED_TRACE("trial " + std::to_string(number));
    const Trial trial = random_trial(random, number);
    BlockSet set = new_set();
    AssembleOptions options;
    options.exact = true;
    const AssembleReport report =
        assemble_blocks(trial.complex, trial.joints, trial.scene.bed, options, set);
    ASSERT_EQ(trial.complex.n_uncut, 0);
    EXPECT_NEAR(report.block_volume + report.dropped_volume, trial.volume, 1e-9 * trial.volume);
    EXPECT_LE(report.dropped_volume, 1e-9 * trial.volume);
    EXPECT_EQ(broken_promise(set), "");
    for (int b = 0; b < n_blocks(set); ++b) {
      const SurfaceCheck check = check_surface(block_shell(set, b));
      for (const int euler : check.euler) EXPECT_EQ(euler, 2) << "block " << b;
      double parts = 0;
      for (int p = set.convex_part_begin[b]; p < set.convex_part_begin[b + 1]; ++p) {
        parts += moments(convex_part(set, p)).volume;
        EXPECT_TRUE(is_convex(convex_part(set, p), 1e-6)) << "block " << b;
      }
      EXPECT_NEAR(parts, set.volume[b], 1e-9 * trial.volume);
    }
  }
}

// Whatever a block is made of, no point of space belongs to two, and no block reaches below the
// bed.
TEST(AssembleBlocks, NoTwoBlocksOverlapAndNoneReachesBelowTheBed) {
  Random random(22);
  for (int number = 0; number < 30; ++number) {
    SCOPED_TRACE("trial " + std::to_string(number));
    const Trial trial = random_trial(random, number);
    for (const bool exact : {false, true}) {
      BlockSet set = new_set();
      AssembleOptions options;
      options.exact = exact;
      options.min_volume = 0.02 * trial.volume / std::max(1, number);
      static_cast<void>(
          assemble_blocks(trial.complex, trial.joints, trial.scene.bed, options, set));
      EXPECT_EQ(broken_promise(set), "");
      const auto bodies = parts_by_block(set);
      const double cell = trial.scene.bed.cell_size;
      for (int sample = 0; sample < 400 && !bodies.empty(); ++sample) {
        const auto& parts = bodies[random.below(bodies.size())];
        const Polyhedron& part = parts[random.below(parts.size())];
        // a point of a part: a random mean of its vertices
        Vec3 point = Vec3::Zero();
        double weight = 0;
        for (const Vec3& v : part.vertices) {
          const double w = random.exponential();
          point += w * v;
          weight += w;
        }
        point /= weight;
        EXPECT_LE(n_bodies_at(bodies, point, 1e-6 * cell), 1);
        EXPECT_GT(point.z() + 1e-6 * cell, elevation_at(trial.scene.bed, point.x(), point.y()));
      }
    }
  }
}

// The same by volume: every pair of convex parts of different blocks, cut by each other's planes.
TEST(AssembleBlocks, PairsOfBlocksShareNoVolume) {
  Random random(23);
  for (int number = 0; number < 30; ++number) {
    SCOPED_TRACE("trial " + std::to_string(number));
    const Trial trial = random_trial(random, number);
    BlockSet set = new_set();
    static_cast<void>(assemble_blocks(trial.complex, trial.joints, trial.scene.bed, {}, set));
    const auto bodies = parts_by_block(set);
    for (int a = 0; a < n_blocks(set); ++a)
      for (int b = a + 1; b < n_blocks(set); ++b) {
        const double shared = shared_volume(bodies[a], bodies[b]);
        ASSERT_LE(shared, 1e-9 * std::max(set.volume[a], set.volume[b])) << a << " and " << b;
      }
  }
}

// Nor do they where blocks that stay exact hold slivers from joint cells of convex ones: ground
// that rises and falls across gentle joints leaves several pieces in a joint cell.
TEST(AssembleBlocks, ConvexBlocksKeepClearOfThoseThatStayExact) {
  Random random(25);
  int n_exact = 0, n_convex = 0;
  for (int number = 0; number < 9; ++number) {
    SCOPED_TRACE("trial " + std::to_string(number));
    const double u = random.uniform(0.4, 1.5), v = random.uniform(0.4, 1.5);
    const Trn ground = grid(13, 13, 5, [&](double x, double y) {
      return 0.7 * y + 10 * std::sin(u * x / 5) * std::cos(v * y / 5) + 1.5 * random.normal();
    });
    Trn bed = ground;
    for (int r = 1; r < 12; ++r)
      for (int c = 1; c < 12; ++c) bed.elevation[node_index(bed, r, c)] -= 10;
    std::vector<JointSet> sets;
    for (int n = 0; n < 1 + number % 3; ++n)
      sets.push_back(
          joint_set(random.uniform(0, 60), random.uniform(0, 360), random.uniform(12, 30)));
    const auto joints = draw_all(sets, {30, 30, 20}, 60, number);
    AssembleOptions options;
    options.min_volume = 0.01 * prism_volume(ground, bed);
    options.max_convex_loss = 0.005;
    BlockSet set = new_set();
    const AssembleReport report =
        assemble_blocks(cut_mass(ground, bed, {}, joints), joints, bed, options, set);
    n_exact += report.n_kept_exact;
    n_convex += n_blocks(set) - report.n_kept_exact;
    const auto bodies = parts_by_block(set);
    const auto is_exact = [&](int b) { return bodies[b].size() > 4; };
    for (int a = 0; a < n_blocks(set); ++a)
      for (int b = a + 1; b < n_blocks(set); ++b) {
        if (is_exact(a) && is_exact(b)) continue;  // as they were cut
        EXPECT_LE(shared_volume(bodies[a], bodies[b]),
                  1e-9 * std::min(set.volume[a], set.volume[b]))
            << a << " and " << b;
      }
  }
  EXPECT_GT(n_exact, 8);
  EXPECT_GT(n_convex, 15);
}

// The limits hold for the blocks as they come out, or the report counts those for which they do
// not.
TEST(AssembleBlocks, BlocksBelowTheLimitsAreCounted) {
  Random random(24);
  int n_checked = 0;
  for (int number = 0; number < 40; ++number) {
    SCOPED_TRACE("trial " + std::to_string(number));
    const Trial trial = random_trial(random, number);
    BlockSet set = new_set();
    AssembleOptions options;
    options.min_volume = 1e-3 * trial.volume;
    options.min_thickness = 0.1 * trial.scene.bed.cell_size;
    options.max_aspect = 20;
    const AssembleReport report =
        assemble_blocks(trial.complex, trial.joints, trial.scene.bed, options, set);
    const auto bodies = parts_by_block(set);
    int n_below = 0, n_short = 0;
    for (int b = 0; b < n_blocks(set); ++b) {
      const Vec3 size = extents({set.volume[b], set.centroid[b], set.second_moment[b]});
      n_below += set.volume[b] < options.min_volume || size.z() < options.min_thickness ||
                 size.x() > options.max_aspect * size.z();
      double shortest = 1e9;
      for (const Polyhedron& part : bodies[b])
        for (const PolyhedronEdge& edge : edges(part))
          shortest = std::min(shortest, (part.vertices[edge.a] - part.vertices[edge.b]).norm());
      n_short += shortest < 1e-3 * std::cbrt(report.exact_volume[b]);
      ++n_checked;
    }
    EXPECT_EQ(report.n_below_limits, n_below);
    EXPECT_EQ(report.n_short_edged, n_short);
  }
  EXPECT_GT(n_checked, 200);
}

// A sliver that took in a smaller one before it was given away is counted without it.
TEST(AssembleBlocks, EachSliverIsCountedOnce) {
  const Trn ground = grid(9, 9, 1, [](double, double) { return 0.0; });
  Trn bed = ground;
  for (int r = 1; r < 8; ++r)
    for (int c = 1; c < 8; ++c) bed.elevation[node_index(bed, r, c)] = -2;
  // The rim thins out to zero at x = 0: the first piece has no neighbour but the second.
  std::vector<Joint> joints(2);
  joints[0].plane = {Vec3::UnitX(), 0.2};
  joints[1].plane = {Vec3::UnitX(), 0.5};
  AssembleOptions options;
  options.exact = true;
  BlockSet pieces = new_set(), blocks = new_set();
  const CellComplex complex = cut_mass(ground, bed, {}, joints);
  static_cast<void>(assemble_blocks(complex, joints, bed, options, pieces));
  ASSERT_EQ(n_blocks(pieces), 3);
  options.min_volume = 5;
  const AssembleReport report = assemble_blocks(complex, joints, bed, options, blocks);
  EXPECT_EQ(n_blocks(blocks), 1);
  EXPECT_EQ(report.n_merged, 2);
  std::sort(pieces.volume.begin(), pieces.volume.end());
  EXPECT_NEAR(report.merged_volume, pieces.volume[0] + pieces.volume[1], 1e-12);
}

// A block below flat ground on a flat bed is convex as it is cut.
TEST(AssembleBlocks, ConvexBlocksKeepTheirVolumeWhereTheyCan) {
  const Trn ground = grid(21, 21, 1, [](double x, double) { return 0.4 * x; });
  Trn bed = ground;
  for (int r = 1; r < 20; ++r)
    for (int c = 1; c < 20; ++c) bed.elevation[node_index(bed, r, c)] -= 3;
  const auto joints =
      draw_all({joint_set(0, 0, 2.5, "a"), joint_set(90, 0, 3, "b"), joint_set(90, 90, 3, "c")},
               {10, 10, 2}, 20);
  BlockSet set = new_set();
  const CellComplex complex = cut_mass(ground, bed, {}, joints);
  AssembleOptions options;
  options.min_volume = 0.5;
  const AssembleReport report = assemble_blocks(complex, joints, bed, options, set);
  EXPECT_EQ(broken_promise(set), "");
  EXPECT_NEAR(report.block_volume, report.cut_volume, 0.01 * report.cut_volume);
}

// Two joint cells side by side share the joint between them, and its area is known.
TEST(AssembleBlocks, PairsNameTheSharedJointAndItsArea) {
  const Trn ground = grid(5, 9, 1, [](double, double) { return 0.0; });
  Trn bed = ground;
  for (int r = 1; r < 4; ++r)
    for (int c = 1; c < 8; ++c) bed.elevation[node_index(bed, r, c)] = -2;
  JointSet vertical = joint_set(90, 90, 100);  // one plane, x = 4
  const auto joints = draw_all({vertical}, {4, 2, -1}, 9);
  BlockSet set = new_set();
  AssembleOptions options;
  options.exact = true;
  static_cast<void>(assemble_blocks(cut_mass(ground, bed, {}, joints), joints, bed, options, set));
  ASSERT_EQ(n_blocks(set), 2);
  ASSERT_EQ(set.pair_blocks.size(), 1u);
  EXPECT_NEAR(set.pair_area[0], 2 * 2 + 2 * 0.5 * 2, 1e-12);  // trapezoid: 2 wide below, 4 above
  EXPECT_NEAR(std::abs(set.pair_normal[0].x()), 1, 1e-12);
  const Vec3 apart = set.centroid[1] - set.centroid[0];
  EXPECT_GT(set.pair_normal[0].dot(apart), 0);
  EXPECT_EQ(set.pair_joint_set[0], 0);
}
