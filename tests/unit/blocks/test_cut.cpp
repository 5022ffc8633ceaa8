// Cutting a mass by joints: exact filling, discs, walls, order of joints.
#include <gtest/gtest.h>

#include <numeric>

#include "blocks/cut.hpp"
#include "scenes.hpp"

namespace {

using namespace talus;
using namespace talus::test;

double sum_of_volumes(const CellComplex& complex) {
  double sum = 0;
  for (const Polyhedron& cell : cells_as_polyhedra(complex)) sum += moments(cell).volume;
  return sum;
}

int n_components(const CellComplex& complex, bool through_walls_only) {
  std::vector<int> parent(complex.cell_leaf.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (size_t d = 0; d < complex.dart_vertex.size(); ++d) {
    const int other = complex.dart_opposite[d];
    if (other < 0) continue;
    const int f = complex.dart_face[d];
    if (through_walls_only && complex.face_made_by[f] != cut_wall) continue;
    parent[root(complex.face_cell[f])] = root(complex.face_cell[complex.dart_face[other]]);
  }
  int n = 0;
  for (size_t i = 0; i < parent.size(); ++i) n += parent[i] == static_cast<int>(i);
  return n;
}

// The promises of the header's arrays.
void expect_sound(const CellComplex& complex) {
  EXPECT_EQ(complex.n_uncut, 0);
  for (size_t d = 0; d < complex.dart_vertex.size(); ++d) {
    const int next = complex.dart_next[d], twin = complex.dart_twin[d];
    const int opposite = complex.dart_opposite[d];
    ASSERT_EQ(complex.dart_twin[twin], static_cast<int>(d));
    ASSERT_EQ(complex.dart_vertex[twin], complex.dart_vertex[next]);
    ASSERT_EQ(complex.face_cell[complex.dart_face[twin]], complex.face_cell[complex.dart_face[d]]);
    if (opposite < 0) {
      ASSERT_LT(complex.face_made_by[complex.dart_face[d]], 0);
      ASSERT_NE(complex.face_made_by[complex.dart_face[d]], cut_wall);
      continue;
    }
    ASSERT_EQ(complex.dart_opposite[opposite], static_cast<int>(d));
    ASSERT_EQ(complex.dart_vertex[opposite], complex.dart_vertex[next]);
    ASSERT_EQ(complex.face_made_by[complex.dart_face[opposite]],
              complex.face_made_by[complex.dart_face[d]]);
  }
  for (const Polyhedron& cell : cells_as_polyhedra(complex)) {
    const SurfaceCheck check = check_surface(cell);
    ASSERT_TRUE(check.fault == SurfaceFault::none || check.fault == SurfaceFault::flat)
        << text(check.fault);
    ASSERT_EQ(check.euler, std::vector<int>{2});
  }
}

}  // namespace

// A slab of 10 m x 10 m x 5 m, its sides running out over one cell, cut by three orthogonal sets
// that coincide with the grid lines: as many cells of rock as the joints make.
TEST(CutMass, OrthogonalJointsOnGridLines) {
  const Trn ground = grid(11, 11, 1, [](double, double) { return 0.0; });
  Trn bed = ground;
  for (int r = 1; r < 10; ++r)
    for (int c = 1; c < 10; ++c) bed.elevation[node_index(bed, r, c)] = -4;
  const std::vector<JointSet> sets = {joint_set(0, 0, 2), joint_set(90, 0, 2),
                                      joint_set(90, 90, 2)};
  const auto joints = draw_all(sets, {5, 5, -2}, 9);
  const CellComplex complex = cut_mass(ground, bed, {}, joints);
  expect_sound(complex);
  EXPECT_NEAR(sum_of_volumes(complex), prism_volume(ground, bed), 1e-12 * 400);
  EXPECT_NEAR(prism_volume(ground, bed), 4 * 81, 1e-9);
  // Planes at x, y = 1, 3, 5, 7, 9 and z = -2: 6 x 6 columns of rock, of which those at the rim
  // (one cell wide) hold both layers; the corners of the square (0, 0), (10, 10) have rock too.
  EXPECT_EQ(n_components(complex, true), 72);
}

TEST(CutMass, FillsRandomMassesExactly) {
  Random random(11);
  for (int trial = 0; trial < 120; ++trial) {
    const double cell = random.uniform(0.5, 5);
    const Scene scene = random_scene(random, 9 + trial % 5, cell);
    const double volume = prism_volume(scene.ground, scene.bed);
    std::vector<JointSet> sets;
    for (int s = 0; s < 1 + trial % 4; ++s) {
      JointSet set =
          joint_set(random.uniform(0, 90), random.uniform(0, 360), random.uniform(1, 4) * cell);
      if (trial % 3 == 0) set.dip = 90 * degree, set.dip_direction = 45 * degree * random.below(8);
      if (trial % 5 == 0) set.fisher_k = 30;
      if (trial % 7 == 0) set.mean_spacing = cell, set.offset = 0;
      sets.push_back(set);
    }
    const double extent = scene.ground.cell_size * scene.ground.n_rows;
    const Vec3 centre(extent / 2, extent / 2, scene.ground.elevation[40]);
    const CellComplex complex =
        cut_mass(scene.ground, scene.bed, {}, draw_all(sets, centre, 2 * extent, trial));
    SCOPED_TRACE("trial " + std::to_string(trial));
    expect_sound(complex);
    if (volume > 0) {
      EXPECT_NEAR(sum_of_volumes(complex), volume, 1e-9 * volume);
    }
  }
}

// A disc parts the rock when it covers all of the section, and not when it ends inside; another
// joint that makes the section smaller comes to the disc's help, whatever the order of the two.
TEST(CutMass, DiscsPartOnlyWhatTheyCover) {
  const Trn ground = grid(9, 9, 1, [](double, double) { return 0.0; });
  Trn bed = ground;
  for (int r = 1; r < 8; ++r)
    for (int c = 1; c < 8; ++c) bed.elevation[node_index(bed, r, c)] = -2;
  const auto disc_joint = [](double radius) {
    Joint joint;
    joint.plane = {Vec3::UnitX(), 4};
    joint.is_through = false;
    joint.discs = {{Vec3(4, 2, -1), radius}};
    return joint;
  };
  Joint across;  // y = 4, through-going
  across.plane = {Vec3::UnitY(), 4};
  across.set = 1;
  const auto n_pieces = [&](const std::vector<Joint>& joints) {
    const CellComplex complex = cut_mass(ground, bed, {}, joints);
    EXPECT_NEAR(sum_of_volumes(complex), 98, 1e-10);
    return n_components(complex, true);
  };
  EXPECT_EQ(n_pieces({disc_joint(7)}), 2);  // reaches (4, 8, 0), the farthest corner
  EXPECT_EQ(n_pieces({disc_joint(5)}), 1);  // does not
  EXPECT_EQ(n_pieces({disc_joint(3)}), 1);
  EXPECT_EQ(n_pieces({disc_joint(3), across}), 3);  // covers the half with y < 4
  EXPECT_EQ(n_pieces({across, disc_joint(3)}), 3);
  EXPECT_EQ(n_pieces({across, disc_joint(1)}), 2);
}
