// Clipping of terrain by areas, checked by closed-form volumes.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "blocks/area_clip.hpp"
#include "blocks/assemble.hpp"
#include "blocks/solid.hpp"
#include "blocks/source.hpp"
#include "scenes.hpp"

namespace {

using namespace talus;
using namespace talus::test;

using Ring = std::vector<Vec2>;

// Shapes of about 60 m x 50 m with the first corner at (0, 0).
struct Shape {
  const char* name;
  Area area;
};
std::vector<Shape> shapes() {
  const Ring rectangle = {{0, 0}, {60, 0}, {60, 50}, {0, 50}};
  return {
      {"rectangle", {{rectangle}}},
      {"clockwise triangle", {{{{0, 0}, {20, 50}, {60, 10}}}}},
      {"L", {{{{0, 0}, {60, 0}, {60, 20}, {30, 20}, {30, 50}, {0, 50}}}}},
      {"star", {{{{0, 0}, {30, 12}, {60, 0}, {45, 25}, {60, 50}, {30, 37}, {0, 50}, {14, 25}}}}},
      {"hole", {{rectangle, {{20, 20}, {40, 20}, {40, 30}, {20, 30}}}}},
      {"two", {{{{0, 0}, {20, 0}, {20, 50}, {0, 50}}, {{40, 0}, {60, 0}, {60, 50}, {40, 50}}}}},
      {"narrow neck",
       {{{{0, 0},
          {27, 0},
          {27, 24},
          {33, 24},
          {33, 0},
          {60, 0},
          {60, 50},
          {33, 50},
          {33, 26},
          {27, 26},
          {27, 50},
          {0, 50}}}}}};
}

Area placed(const Area& area, double turn_deg, const Vec2& first_corner) {
  Area out = area;
  const Eigen::Rotation2Dd turn(turn_deg * degree);
  for (Ring& ring : out.rings)
    for (Vec2& p : ring) p = (turn_deg == 0 ? p : Vec2(turn * p)) + first_corner;
  return out;
}

constexpr double extent = 200;

// 35 degrees down to the south, with bumps.
Trn rough_slope(double cell) {
  const int n = static_cast<int>(std::lround(extent / cell)) + 1;
  return grid(n, n, cell, [](double x, double y) {
    return 0.7 * y + 3 * std::sin(x / 11) * std::cos(y / 7) + 0.3 * std::sin(2.3 * x + 1.7 * y);
  });
}

SourceOptions vertical(double depth) {
  SourceOptions options;
  options.kind = FailureSurface::vertical_depth;
  options.depth = depth;
  return options;
}

double outside_by(const Area& area, const Vec2& p) {
  if (contains(area, p)) return 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (const AreaSide& side : sides_of(area)) {
    const double along = std::clamp(side.direction.dot(p - side.start), 0.0, side.length);
    nearest = std::min(nearest, (p - side.start - along * side.direction).norm());
  }
  return nearest;
}

double perimeter(const Area& area) {
  double sum = 0;
  for (const AreaSide& side : sides_of(area)) sum += side.length;
  return sum;
}

BlockSet new_set() {
  BlockSet set;
  set.material_names = {"rock"};
  set.joint_set_names = {"J1", "J2", "J3"};
  return set;
}

std::vector<Joint> three_sets() {
  return draw_all({joint_set(35, 170, 9), joint_set(80, 10, 14), joint_set(85, 95, 13)},
                  {100, 100, 70}, 90);
}

double sum_of_volumes(const CellComplex& complex) {
  double sum = 0;
  for (const Polyhedron& cell : cells_as_polyhedra(complex)) sum += moments(cell).volume;
  return sum;
}

// Farthest that a block reaches outside of the area: its corners, and points at random in its
// parts, since a part may span a re-entrant corner.
double farthest_outside(const BlockSet& set, const Area& area, Random& random) {
  double farthest = 0;
  for (const Vec3& v : set.vertices) farthest = std::max(farthest, outside_by(area, v.head<2>()));
  for (int p = 0; p < n_parts(set); ++p) {
    const Polyhedron part = convex_part(set, p);
    for (int sample = 0; sample < 30; ++sample) {
      const auto corner = [&]() -> const Vec3& {
        return part.vertices[random.below(part.vertices.size())];
      };
      const Vec3 one = corner(), other = corner();
      const Vec3 between = one + random.uniform(0, 1) * (other - one);
      farthest = std::max(farthest, outside_by(area, between.head<2>()));
    }
  }
  return farthest;
}

bool boxes_meet(const Polyhedron& one, const Polyhedron& other) {
  const auto extreme = [](const Polyhedron& body, bool high) {
    Vec3 e = body.vertices[0];
    for (const Vec3& v : body.vertices) e = high ? Vec3(e.cwiseMax(v)) : Vec3(e.cwiseMin(v));
    return e;
  };
  return !(extreme(one, true).array() < extreme(other, false).array()).any() &&
         !(extreme(other, true).array() < extreme(one, false).array()).any();
}

// No two blocks share more than 1e-9 of the larger.
void expect_apart(const BlockSet& set) {
  std::vector<Polyhedron> parts;
  std::vector<int> block;
  for (int b = 0; b < n_blocks(set); ++b)
    for (int p = set.convex_part_begin[b]; p < set.convex_part_begin[b + 1]; ++p)
      parts.push_back(convex_part(set, p)), block.push_back(b);
  for (size_t p = 0; p < parts.size(); ++p)
    for (size_t q = p + 1; q < parts.size(); ++q)
      if (block[p] != block[q] && boxes_meet(parts[p], parts[q])) {
        EXPECT_LE(common_volume(parts[p], parts[q]),
                  1e-9 * std::max(set.volume[block[p]], set.volume[block[q]]))
            << block[p] << " and " << block[q];
      }
}

}  // namespace

// The mass ends at the polygon: its volume is area times depth at any cell size, with corners on
// nodes, a hair beside them or anywhere, turned by any angle.
TEST(AreaClip, VolumeIsAreaTimesDepthWhateverTheGrid) {
  for (const double cell : {1.0, 2.5, 5.0, 10.0}) {
    const Trn ground = rough_slope(cell);
    for (const Shape& shape : shapes())
      for (const double turn : {0.0, 12.5, 45.0, 90.0, 201.7})
        for (const double offset : {0.0, 1e-9, -1e-9, 1e-7, 1e-5, 0.3712}) {
          SCOPED_TRACE(std::string(shape.name) + ", cell " + std::to_string(cell) + ", turned " +
                       std::to_string(turn) + ", beside nodes by " + std::to_string(offset));
          const Area area = placed(shape.area, turn, Vec2(100 + offset, 100 - 2 * offset));
          const SourceMass mass = find_source(ground, area, vertical(10), {});
          ASSERT_NEAR(mass.volume, 10 * area_of(area), 1e-6 * mass.volume);
          ASSERT_NEAR(mass.area, area_of(area), 1e-6 * mass.area);
          ASSERT_NEAR(mass.mean_depth, 10, 1e-9);
          ASSERT_NEAR(mass.max_depth, 10, 1e-9);
        }
  }
}

// Measured along the normal of a plane slope, 10 m are 10 m over the cosine.
TEST(AreaClip, NormalDepthOnASlopeIsAreaTimesVerticalDepth) {
  const double slope = 32 * degree;
  for (const double cell : {1.0, 2.5, 5.0, 10.0}) {
    const int n = static_cast<int>(std::lround(extent / cell)) + 1;
    const Trn ground =
        grid(n, n, cell, [&](double x, double y) { return std::tan(slope) * (0.6 * x + 0.8 * y); });
    SourceOptions options;
    options.depth = 10;
    for (const double turn : {0.0, 17.0}) {
      const Area area = placed(shapes()[0].area, turn, {100.3, 90.1});
      const SourceMass mass = find_source(ground, area, options, {});
      EXPECT_NEAR(mass.volume, 3000 * 10 / std::cos(slope), 1e-6 * mass.volume);
    }
  }
}

TEST(AreaClip, TheBedIsTheFailureSurfaceBelowAllOfThePolygon) {
  const Trn ground = rough_slope(10);
  Random random(3);
  for (const Shape& shape : shapes()) {
    const Area area = placed(shape.area, 23, {103.1, 88.7});
    const Trn bed = find_source(ground, area, vertical(10), {}).bed;
    for (int sample = 0; sample < 500; ++sample) {
      const Vec2 p(random.uniform(60, 180), random.uniform(60, 180));
      const double depth = elevation_at(ground, p.x(), p.y()) - elevation_at(bed, p.x(), p.y());
      if (contains(area, p)) {
        EXPECT_NEAR(depth, 10, 1e-9);
      }
      if (outside_by(area, p) > 2 * std::numbers::sqrt2 * 10) {
        EXPECT_EQ(depth, 0);
      }
    }
  }
}

TEST(AreaClip, CellsFillThePrismAndStayInside) {
  const std::vector<Joint> joints = three_sets();
  for (const double cell : {2.5, 5.0, 10.0}) {
    const Trn ground = rough_slope(cell);
    for (const Shape& shape : shapes())
      for (const double turn : {0.0, 45.0, 201.7})
        for (const double offset : {0.0, 1e-9, 3e-7, 3e-6, 1e-5, 0.3712}) {
          if (cell < 5 && offset != 3e-6) continue;  // the cells are four times as many
          SCOPED_TRACE(std::string(shape.name) + ", cell " + std::to_string(cell) + ", turned " +
                       std::to_string(turn) + ", beside nodes by " + std::to_string(offset));
          const Area area = placed(shape.area, turn, Vec2(100 + offset, 100 - 2 * offset));
          const SourceMass mass = find_source(ground, area, vertical(10), {});
          const CellComplex complex = cut_mass(ground, mass.bed, area, joints);
          ASSERT_EQ(complex.n_uncut, 0);
          ASSERT_NEAR(sum_of_volumes(complex), mass.volume, 1e-9 * mass.volume);
          double farthest = 0;
          for (const Vec3& v : complex.vertices)
            farthest = std::max(farthest, outside_by(area, v.head<2>()));
          ASSERT_LT(farthest, 1e-5);
        }
  }
}

// Exact blocks: the same volume again, walls as high as the mass along all of the outline, and no
// point of a block outside.
TEST(AreaClip, ExactBlocksFillThePrism) {
  Random random(5);
  const std::vector<Joint> joints = three_sets();
  for (const double cell : {5.0, 10.0}) {
    const Trn ground = rough_slope(cell);
    for (const Shape& shape : shapes())
      for (const double turn : {0.0, 33.0}) {
        SCOPED_TRACE(std::string(shape.name) + ", cell " + std::to_string(cell) + ", turned " +
                     std::to_string(turn));
        const Area area = placed(shape.area, turn, {100, 100});
        const SourceMass mass = find_source(ground, area, vertical(10), {});
        AssembleOptions options;
        options.exact = true;
        BlockSet set = new_set();
        const AssembleReport report = assemble_blocks(cut_mass(ground, mass.bed, area, joints),
                                                      joints, mass.bed, options, set);
        EXPECT_NEAR(report.block_volume + report.dropped_volume, 10 * area_of(area), 1e-2);
        EXPECT_LE(report.dropped_volume, 1e-9 * mass.volume);
        EXPECT_EQ(broken_promise(set), "");
        EXPECT_LT(farthest_outside(set, area, random), 3e-6);
        double walls = 0;
        for (int b = 0; b < n_blocks(set); ++b) {
          const Polyhedron shell = block_shell(set, b);
          for (int f = 0; f < n_faces(shell); ++f)
            if (shell.face_tag[f] == face_source_side) walls += face_area(shell, f);
        }
        EXPECT_NEAR(walls, 10 * perimeter(area), 1e-6 * walls);
      }
  }
}

// The same with cells of 1 m, which are small against the blocks.
TEST(AreaClip, ExactBlocksFillThePrismOnFineCells) {
  const Trn ground = rough_slope(1);
  const std::vector<Joint> joints = three_sets();
  for (const double turn : {0.0, 33.0}) {
    const Area area = placed(shapes()[2].area, turn, {100, 100});
    const SourceMass mass = find_source(ground, area, vertical(10), {});
    AssembleOptions options;
    options.exact = true;
    BlockSet set = new_set();
    const AssembleReport report =
        assemble_blocks(cut_mass(ground, mass.bed, area, joints), joints, mass.bed, options, set);
    EXPECT_NEAR(report.block_volume + report.dropped_volume, 10 * area_of(area), 1e-2);
    EXPECT_EQ(broken_promise(set), "");
  }
}

namespace {

// A star-shaped outline, its corners on nodes in every second trial.
Area random_outline(Random& random, int number, double size, double cell) {
  const int n = 3 + static_cast<int>(random.below(12));
  Area area{{{}}};
  for (int k = 0; k < n; ++k) {
    const double angle = (k + random.uniform(0.1, 0.9)) * 2 * std::numbers::pi / n;
    const double radius = random.uniform(0.12, 0.32) * size;
    Vec2 p = Vec2(size / 2, size / 2) + radius * Vec2(std::cos(angle), std::sin(angle));
    if (number % 2 == 0) p = (p / cell).array().round().matrix() * cell;
    area.rings[0].push_back(p);
  }
  return without_repeated_corners(area);
}

bool is_sound(const Area& area) {
  try {
    check_area(area, Vec3::Zero(), {});
  } catch (const InputError&) {
    return false;
  }
  return true;
}

std::vector<Joint> random_joints(Random& random, int number, const Area& area, double size,
                                 double cell) {
  std::vector<JointSet> sets;
  for (int k = 0; k < 1 + number % 3; ++k) {
    JointSet set =
        joint_set(random.uniform(0, 90), random.uniform(0, 360), random.uniform(1.5, 4) * cell);
    if (number % 3 == 0) set.dip = 90 * degree, set.dip_direction = 45 * degree * random.below(8);
    if (number % 4 == 0) set.persistence = 0.6, set.disc_diameter = 6 * cell;
    sets.push_back(set);
  }
  std::vector<Joint> joints = draw_all(sets, {size / 2, size / 2, size / 3}, size, number);
  Joint along_a_side;
  along_a_side.plane = sides_of(area)[0].plane;
  if (number % 5 == 0) joints.push_back(along_a_side);
  return joints;
}

}  // namespace

// Outlines and joints at random, joints along a side among them: cells fill the mass, blocks are
// sound, do not overlap and stay inside.
TEST(AreaClip, RandomOutlinesAndJoints) {
  Random random(17);
  int n_tried = 0;
  for (int number = 0; number < 120; ++number) {
    SCOPED_TRACE("trial " + std::to_string(number));
    const double cell = random.uniform(1, 5), size = 20 * cell;
    const Trn ground = grid(21, 21, cell, [&](double x, double y) {
      return 0.6 * y + 0.2 * x + 0.4 * cell * std::sin(x / cell) * std::cos(0.7 * y / cell);
    });
    const Area area = random_outline(random, number, size, cell);
    if (!is_sound(area)) continue;
    ++n_tried;
    const SourceMass mass = find_source(ground, area, vertical(random.uniform(0.5, 3) * cell), {});
    const std::vector<Joint> joints = random_joints(random, number, area, size, cell);
    const CellComplex complex = cut_mass(ground, mass.bed, area, joints);
    ASSERT_EQ(complex.n_uncut, 0);
    ASSERT_NEAR(sum_of_volumes(complex), mass.volume, 1e-9 * mass.volume);
    for (const bool exact : {true, false}) {
      AssembleOptions options;
      options.exact = exact;
      options.min_volume = exact ? 0 : 2e-3 * mass.volume;
      BlockSet set = new_set();
      const AssembleReport report = assemble_blocks(complex, joints, mass.bed, options, set);
      EXPECT_EQ(broken_promise(set), "");
      EXPECT_LT(farthest_outside(set, area, random), 1e-6 * size);
      if (exact) {
        EXPECT_NEAR(report.block_volume + report.dropped_volume, mass.volume, 1e-9 * mass.volume);
      }
      expect_apart(set);
    }
  }
  EXPECT_GT(n_tried, 80);
}

// Convex blocks keep out of the rock beside the source, also at re-entrant corners.
TEST(AreaClip, ConvexBlocksStayInside) {
  Random random(6);
  const std::vector<Joint> joints = three_sets();
  for (const double cell : {5.0, 10.0}) {
    const Trn ground = rough_slope(cell);
    for (const Shape& shape : shapes())
      for (const double turn : {0.0, 33.0}) {
        SCOPED_TRACE(std::string(shape.name) + ", cell " + std::to_string(cell) + ", turned " +
                     std::to_string(turn));
        const Area area = placed(shape.area, turn, {100, 100});
        const SourceMass mass = find_source(ground, area, vertical(10), {});
        BlockSet set = new_set();
        AssembleOptions options;
        options.min_volume = 1;
        const AssembleReport report = assemble_blocks(cut_mass(ground, mass.bed, area, joints),
                                                      joints, mass.bed, options, set);
        EXPECT_EQ(broken_promise(set), "");
        EXPECT_LT(farthest_outside(set, area, random), 3e-6);
        EXPECT_NEAR(report.block_volume, mass.volume, 0.05 * mass.volume);
      }
  }
}

// Without joints all rock that hangs together is one block, whatever corners the outline has: its
// sides part nothing.
TEST(AreaClip, ReEntrantCornersPartNoBlock) {
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    const Area area = placed(shape.area, 10, {100, 100});
    const Trn ground = grid(41, 41, 5, [](double, double y) { return 0.5 * y; });
    const SourceMass mass = find_source(ground, area, vertical(10), {});
    const CellComplex complex = cut_mass(ground, mass.bed, area, {});
    BlockSet set = new_set();
    const AssembleReport report = assemble_blocks(complex, {}, mass.bed, {}, set);
    const bool is_two = std::string(shape.name) == "two";
    EXPECT_EQ(report.n_pieces, is_two ? 2 : 1);
    EXPECT_EQ(n_blocks(set), is_two ? 2 : 1);
    EXPECT_EQ(report.n_kept_exact, 0);
    EXPECT_NEAR(report.block_volume, mass.volume, 1e-6 * mass.volume);
  }
}
