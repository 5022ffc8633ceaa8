// Passages of cells against dense sampling.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>

#include "hand_made.hpp"
#include "record/motion.hpp"
#include "record/passages.hpp"
#include "terrain/trn_pyramid.hpp"

namespace {

using namespace talus_test;
using talus::Passage;
using talus::PassageRecorder;
using talus::PassageValues;

using Rows = std::map<int, Passage>;  // of one block, by cell

Rows rows_of(PassageRecorder& recorder, int block = 0) {
  talus::flush_passages(recorder);
  Rows rows;
  for (const Passage& row : talus::sorted(recorder.table))
    if (row.block == block) rows[row.cell] = row;
  return rows;
}

void record(PassageRecorder& recorder, const Scene& scene, const Segment& segment) {
  talus::SegmentMotion motion;
  motion.follow(segment, scene.blocks.inertia[static_cast<std::size_t>(segment.block)]);
  talus::record_passages(recorder, scene, motion);
}

// The path of one block, recorded.
PassageRecorder recorded(const Scene& scene, const std::vector<Segment>& path, bool by_centroid,
                         double cell_size = 0) {
  PassageRecorder recorder =
      talus::start_passages(scene, talus::passage_grid(scene.ground.trn, cell_size), by_centroid);
  talus::record_start(recorder, scene, path.front().block, path.front().start,
                      path.front().t_start);
  for (const Segment& segment : path) record(recorder, scene, segment);
  return recorder;
}

// --- brute force -------------------------------------------------------------------------------

std::vector<Vec2> hull_of(std::vector<Vec2> points) {
  const auto turn = [](const Vec2& o, const Vec2& a, const Vec2& b) {
    return (a - o).x() * (b - o).y() - (a - o).y() * (b - o).x();
  };
  std::sort(points.begin(), points.end(), [](const Vec2& a, const Vec2& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  std::vector<Vec2> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const Vec2& point : points) {
      while (hull.size() >= first + 2 && turn(hull[hull.size() - 2], hull.back(), point) <= 0)
        hull.pop_back();
      hull.push_back(point);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

// Overlap of a convex polygon with a square, by separating axes; < 0 by how much they overlap.
double separation(const std::vector<Vec2>& hull, const Vec2& centre, double cell) {
  double largest = -1e300;
  const auto try_axis = [&](Vec2 axis) {
    axis.normalize();
    double low = 1e300, high = -1e300;
    for (const Vec2& point : hull) {
      low = std::min(low, axis.dot(point - centre));
      high = std::max(high, axis.dot(point - centre));
    }
    const double half = 0.5 * cell * axis.cwiseAbs().sum();
    largest = std::max({largest, low - half, -half - high});
  };
  try_axis({1, 0});
  try_axis({0, 1});
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 edge = hull[(i + 1) % hull.size()] - hull[i];
    if (edge.norm() > 1e-9) try_axis({edge.y(), -edge.x()});
  }
  return largest;
}

PassageValues values_at(const Scene& scene, const Motion& motion) {
  PassageValues values;
  const Trn& trn = scene.ground.trn;
  const Vec3& at = motion.pose.position;
  values.speed = static_cast<float>(motion.velocity.norm());
  const double translation = 0.5 * scene.blocks.mass[0] * motion.velocity.squaredNorm();
  values.translational_energy = static_cast<float>(translation);
  values.total_energy =
      static_cast<float>(translation + talus::rotational_energy(motion, scene.blocks.inertia[0]));
  values.centroid_height = static_cast<float>(at.z() - talus::elevation_at(trn, at.x(), at.y()));
  double top = -1e300;
  for (const Vec3& vertex : scene.blocks.shapes.vertices)
    top = std::max(top, talus::place(motion.pose, vertex).z());
  values.top_height = static_cast<float>(top - talus::elevation_at(trn, at.x(), at.y()));
  return values;
}

// Largest values over dense samples, for every cell that the footprint comes nearer to than
// `reach` (negative: overlaps by more than that); reach of a centroid has no extent.
Rows sampled(const Scene& scene, const std::vector<Segment>& path, bool by_centroid, double reach,
             int n_samples) {
  const talus::PassageGrid grid = talus::passage_grid(scene.ground.trn, 0);
  talus::PassageTable table;
  for (const Segment& segment : path)
    for (int i = 0; i <= n_samples; ++i) {
      const double t =
          segment.t_start + (segment.t_end - segment.t_start) * i / static_cast<double>(n_samples);
      const Motion motion = talus::motion_at(segment, scene.blocks.inertia[0], t);
      std::vector<Vec2> points{motion.pose.position.head<2>()};
      if (!by_centroid)
        for (const Vec3& vertex : scene.blocks.shapes.vertices)
          points.push_back(talus::place(motion.pose, vertex).head<2>());
      const std::vector<Vec2> hull = by_centroid ? points : hull_of(points);
      const PassageValues values = values_at(scene, motion);
      for (int row = 0; row < grid.n_rows; ++row)
        for (int col = 0; col < grid.n_cols; ++col) {
          const Vec2 centre = grid.corner + grid.cell_size * Vec2(col + 0.5, -row - 0.5);
          if ((centre - points[0]).norm() > 3 * grid.cell_size + 5) continue;
          if (separation(hull, centre, grid.cell_size) < reach)
            table.raise({0, row * grid.n_cols + col, values, static_cast<float>(t)});
        }
    }
  Rows rows;
  for (const Passage& row : table.rows) rows[row.cell] = row;
  return rows;
}

struct Slack {
  double speed, energy, height, time;
};

// Every cell and value of `lower` is in `upper` and not below it by more than the slack.
void expect_within(const Rows& lower, const Rows& upper, const Slack& slack) {
  for (const auto& [cell, low] : lower) {
    const auto found = upper.find(cell);
    ASSERT_TRUE(found != upper.end())
        << "cell " << cell << " is missing, passed at " << low.first_time;
    const PassageValues &a = low.largest, &b = found->second.largest;
    EXPECT_LE(a.speed, b.speed + slack.speed) << cell;
    EXPECT_LE(a.translational_energy, b.translational_energy * (1 + slack.energy)) << cell;
    EXPECT_LE(a.total_energy, b.total_energy * (1 + slack.energy)) << cell;
    EXPECT_LE(a.centroid_height, b.centroid_height + slack.height) << cell;
    EXPECT_LE(a.top_height, b.top_height + slack.height) << cell;
    EXPECT_GE(low.first_time, found->second.first_time - slack.time) << cell;
  }
}

// --- scenes ------------------------------------------------------------------------------------

Scene rough_scene(talus::Random& random, const Vec3& box) {
  Scene scene;
  scene.gravity = {0, 0, -9.81};
  scene.ground.trn =
      trn_of(25, 25, 4, [&](double x, double) { return -0.5 * x + random.uniform(0, 1); });
  add_box(scene, box);
  return scene;
}

Motion thrown(const Scene& scene, talus::Random& random, double spin) {
  Motion motion;
  motion.pose.position = {random.uniform(8, 20), random.uniform(30, 66), 10};
  motion.pose.attitude = random_attitude(random);
  motion.velocity = {random.uniform(5, 20), random.uniform(-6, 6), random.uniform(0, 6)};
  motion.angular_momentum = spin * scene.blocks.inertia[0].minCoeff() * random_vector(random, 0.6);
  return motion;
}

// Flights that bounce and steps that slide and turn, one after the other.
std::vector<Segment> mixed_path(const Scene& scene, talus::Random& random, double spin) {
  std::vector<Segment> path;
  Motion motion = thrown(scene, random, spin);
  double t = 0;
  for (int i = 0; i < 3; ++i) {
    path.push_back(flight(scene, 0, motion, t, t + random.uniform(0.2, 1)));
    motion = path.back().end;
    t = path.back().t_end;
    motion.velocity.z() = std::abs(motion.velocity.z()) * 0.6;
    motion.angular_momentum *= 0.8;
    for (int step = 0; step < 10; ++step) {
      path.push_back(slide(0, motion, t, t + 0.02, random_vector(random, 3),
                           random_vector(random, 0.01 * spin)));
      motion = path.back().end;
      t = path.back().t_end;
    }
  }
  return path;
}

// The path cut into pieces at other times, as another choice of steps would.
std::vector<Segment> cut(const Scene& scene, const std::vector<Segment>& path, int n) {
  std::vector<Segment> pieces;
  for (const Segment& segment : path)
    for (int i = 0; i < n; ++i) {
      Segment piece = segment;
      const auto time = [&](int k) {
        return k == n ? segment.t_end : segment.t_start + k * (segment.t_end - segment.t_start) / n;
      };
      piece.t_start = time(i);
      piece.t_end = time(i + 1);
      piece.start = talus::motion_at(segment, scene.blocks.inertia[0], piece.t_start);
      piece.end = talus::motion_at(segment, scene.blocks.inertia[0], piece.t_end);
      pieces.push_back(piece);
    }
  return pieces;
}

// --- claims ------------------------------------------------------------------------------------

TEST(Passages, CentroidPassesTheCellsOfDenseSampling) {
  talus::Random random(3, "passages");
  for (int trial = 0; trial < 4; ++trial) {
    const Scene scene = rough_scene(random, {1, 1.4, 2});
    const std::vector<Segment> path = mixed_path(scene, random, 8);
    PassageRecorder recorder = recorded(scene, path, true);
    const Rows rows = rows_of(recorder);
    ASSERT_GT(rows.size(), 4u);
    // steps with contact are straight in plan: off by a h^2 / 8
    const Slack slack{1e-3, 1e-4, 0.02 * scene.blocks.shapes.radius[0], 1e-3};
    expect_within(sampled(scene, path, true, -1e-6, 1500), rows, slack);
    expect_within(rows, sampled(scene, path, true, 0.05, 1500), {0.01, 2e-3, 0.05, 2e-3});
  }
}

// Lower bound: cells of the true footprint. Upper bound: a footprint wider by a tenth of the
// longest side and the sagitta.
TEST(Passages, FootprintPassesTheCellsOfDenseSampling) {
  talus::Random random(4, "passages");
  for (int trial = 0; trial < 6; ++trial) {
    const Vec3 box = trial % 2 == 0 ? Vec3(1, 1.4, 2) : Vec3(6, 3, 5);
    const Scene scene = rough_scene(random, box);
    const double radius = scene.blocks.shapes.radius[0];
    const std::vector<Segment> path = mixed_path(scene, random, 6);
    PassageRecorder recorder = recorded(scene, path, false);
    const Rows rows = rows_of(recorder);
    ASSERT_GT(rows.size(), 6u);
    SCOPED_TRACE(trial);
    const double sagitta = 0.02 * radius, reach = 0.1 * box.maxCoeff() + 2 * sagitta;
    expect_within(sampled(scene, path, false, -1e-6, 400), rows, {1e-3, 1e-4, sagitta, 1e-3});
    expect_within(rows, sampled(scene, path, false, reach, 600), {0.1, 2e-2, sagitta + 0.1, 2e-2});
  }
}

TEST(Passages, DoNotDependOnHowAPathIsCutIntoSteps) {
  talus::Random random(5, "passages");
  for (int trial = 0; trial < 6; ++trial) {
    const Scene scene = rough_scene(random, {1, 1.4, 2});
    const std::vector<Segment> path = mixed_path(scene, random, 0);
    PassageRecorder coarse = recorded(scene, path, true);
    PassageRecorder fine = recorded(scene, cut(scene, path, 37), true);
    const Rows a = rows_of(coarse), b = rows_of(fine);
    ASSERT_EQ(a.size(), b.size());
    const Slack rounding{1e-3, 1e-4, 1e-3, 1e-4};
    expect_within(a, b, rounding);
    expect_within(b, a, rounding);
  }
}

TEST(Passages, CountABlockThatSlidesFarInOneStepInEveryCell) {
  Scene scene;
  scene.ground.trn = trn_of(3, 31, 5, [](double, double) { return 0.0; });
  add_box(scene, {1, 1, 1});
  Motion start;
  start.pose.position = {2.5, 7.5, 0.5};
  start.velocity = {50, 0, 0};
  for (const bool by_centroid : {true, false}) {
    PassageRecorder recorder =
        recorded(scene, {slide(0, start, 0, 2.9, Vec3::Zero(), Vec3::Zero())}, by_centroid);
    const Rows rows = rows_of(recorder);
    ASSERT_EQ(rows.size(), 30u);  // 145 m from the first cell's middle to the last one's
    for (int col = 0; col < 30; ++col) {
      const Passage& row = rows.at(col);
      EXPECT_FLOAT_EQ(row.largest.speed, 50);
      EXPECT_FLOAT_EQ(row.largest.translational_energy, 0.5f * 2600 * 2500);
      EXPECT_FLOAT_EQ(row.largest.total_energy, 0.5f * 2600 * 2500);
      EXPECT_FLOAT_EQ(row.largest.centroid_height, 0.5);
      EXPECT_FLOAT_EQ(row.largest.top_height, 1);
      const double front = by_centroid ? 2.5 : 3;
      EXPECT_NEAR(row.first_time, col == 0 ? 0 : (5 * col - front) / 50, 1e-6);
      EXPECT_EQ(row.heading, 0);
      EXPECT_EQ(std::isnan(row.travel_angle), col == 0);
    }
  }
}

// Straight down a 30 degree slope from rest: v^2 = 2 a x in every cell.
TEST(Passages, EqualTheClosedFormOfAStraightSlide) {
  const double slope = std::tan(std::numbers::pi / 6), a = 3.1;
  Scene scene;
  scene.ground.trn = trn_of(4, 60, 2, [&](double x, double) { return -slope * x; });
  add_box(scene, {0.5, 0.5, 0.5});
  Motion start;
  start.pose.position = {1, 3, -slope + 0.4};
  const Vec3 along(std::cos(std::numbers::pi / 6), 0, -std::sin(std::numbers::pi / 6));
  std::vector<Segment> path;
  Motion motion = start;
  for (int i = 0; i < 800; ++i) {
    path.push_back(slide(0, motion, 0.01 * i, 0.01 * (i + 1), a * along, Vec3::Zero()));
    motion = path.back().end;
  }
  PassageRecorder recorder = recorded(scene, path, true);
  const Rows rows = rows_of(recorder);
  const double end = motion.pose.position.x();
  ASSERT_EQ(rows.size(), static_cast<std::size_t>(end / 2) + 1);
  for (const auto& [cell, row] : rows) {
    const int col = cell - 59;
    const double exit = std::min(2.0 * (col + 1), end), run = (exit - 1) / along.x();
    EXPECT_NEAR(row.largest.speed, std::sqrt(2 * a * run), 1e-3) << col;
    EXPECT_NEAR(row.largest.centroid_height, 0.4, 1e-4) << col;
    const double entry = (std::max(2.0 * col, 1.0) - 1) / along.x();
    EXPECT_NEAR(row.first_time, std::sqrt(2 * entry / a), 1e-3) << col;
    if (col == 0) {  // where it started: no path yet, and it was at rest
      EXPECT_TRUE(std::isnan(row.travel_angle) && std::isnan(row.heading));
      continue;
    }
    // a h^2 / 8 = 4e-5 m: between two steps the displacement in plan is taken as even in time
    EXPECT_NEAR(row.travel_angle, std::numbers::pi / 6, 2e-5) << col;
    EXPECT_EQ(row.heading, 0) << col;
  }
}

TEST(Passages, OfABlockAtRestAreItsFootprint) {
  Scene scene;
  scene.ground.trn = trn_of(11, 11, 1, [](double, double) { return 0.0; });
  add_box(scene, {3, 2, 1});
  Motion start;
  start.pose.position = {5.5, 5.5, 0.5};
  PassageRecorder recorder =
      recorded(scene, {slide(0, start, 0, 1, Vec3::Zero(), Vec3::Zero())}, false);
  const Rows rows = rows_of(recorder);
  EXPECT_EQ(rows.size(), 9u);  // x 4..7, y 4.5..6.5
  for (const auto& [cell, row] : rows) {
    EXPECT_EQ(row.largest.speed, 0);
    EXPECT_EQ(row.first_time, 0);
  }
}

TEST(Passages, FollowTheirOwnGridOfCells) {
  Scene scene;
  scene.ground.trn = trn_of(11, 11, 10, [](double, double) { return 0.0; });
  add_box(scene, {1, 1, 1});
  Motion start;
  start.pose.position = {0.5, 50.1, 0.5};
  start.velocity = {99, 0, 0};
  PassageRecorder recorder =
      recorded(scene, {slide(0, start, 0, 1, Vec3::Zero(), Vec3::Zero())}, true, 3);
  const Rows rows = rows_of(recorder);
  EXPECT_EQ(recorder.grid.n_cols, 34);  // 100 m in cells of 3 m
  EXPECT_EQ(rows.size(), 34u);
  EXPECT_EQ(rows.begin()->first, 16 * 34);  // 49.9 m below the north side
}

TEST(Passages, OutsideTheGridAreLeftOut) {
  Scene scene;
  scene.ground.trn = trn_of(5, 5, 2, [](double, double) { return 0.0; });
  add_box(scene, {1, 1, 1});
  Motion start;
  start.pose.position = {-20, 3, 5};
  start.velocity = {50, 0, 0};
  for (const bool by_centroid : {true, false}) {
    PassageRecorder recorder =
        recorded(scene, {slide(0, start, 0, 1, Vec3::Zero(), Vec3::Zero())}, by_centroid);
    EXPECT_EQ(rows_of(recorder).size(), by_centroid ? 4u : 4u);
    EXPECT_TRUE(recorder.trackers[0].covered.empty());
  }
}

TEST(Passages, HaveNoHeightOverUnknownGround) {
  Scene scene;
  scene.ground.trn = trn_of(3, 12, 5, [](double x, double) {
    return x > 20 && x < 40 ? std::numeric_limits<double>::quiet_NaN() : 0.0;
  });
  add_box(scene, {1, 1, 1});
  Motion start;
  start.pose.position = {2.5, 7, 3};
  start.velocity = {50, 0, 0};
  PassageRecorder recorder =
      recorded(scene, {slide(0, start, 0, 1, Vec3::Zero(), Vec3::Zero())}, true);
  const Rows rows = rows_of(recorder);
  EXPECT_TRUE(std::isnan(rows.at(6).largest.centroid_height));
  EXPECT_TRUE(std::isnan(rows.at(6).largest.top_height));
  EXPECT_FLOAT_EQ(rows.at(6).largest.speed, 50);
  EXPECT_FLOAT_EQ(rows.at(2).largest.centroid_height, 3);
}

// The table grows with cells, not with steps, and a flush in between changes nothing.
TEST(Passages, FlushedEarlyAreTheSame) {
  talus::Random random(6, "passages");
  const Scene scene = rough_scene(random, {1, 1.4, 2});
  const std::vector<Segment> path = mixed_path(scene, random, 6);
  PassageRecorder once = recorded(scene, path, false);
  PassageRecorder often =
      talus::start_passages(scene, talus::passage_grid(scene.ground.trn, 0), false);
  talus::record_start(often, scene, 0, path.front().start, 0);
  for (const Segment& segment : path) {
    record(often, scene, segment);
    talus::flush_passages(often);
  }
  const Rows a = rows_of(once), b = rows_of(often);
  const Slack exact{0, 0, 0, 0};
  ASSERT_EQ(a.size(), b.size());
  expect_within(a, b, exact);
  expect_within(b, a, exact);
}

// Of a ballistic path over a plane the highest point lies at vz = slope * vx, inside the path.
TEST(LargestHeights, FindTheApexAboveSlopingGround) {
  const double slope = -0.6, vx = 8, vz = 3, g = 9.81, h = 1.2;
  const Trn trn = trn_of(4, 30, 1, [&](double x, double) { return slope * x; });
  const Vec3 from(2, 1.3, slope * 2 + 1);
  const Vec3 to = from + Vec3(vx * h, 0.2, vz * h - 0.5 * g * h * h);
  const double t = (vz - slope * vx) / g;
  const double apex = 1 + (vz - slope * vx) * t - 0.5 * g * t * t;
  const double sag = -0.5 * g * h * h;
  const talus::Heights all = talus::largest_heights(trn, {from, to, 0.5, 0.5, sag}, 0, 1);
  EXPECT_NEAR(all.centroid, apex, 1e-12);
  EXPECT_NEAR(all.top, apex + 0.5, 1e-12);
  const double s = 0.5 * t / h;  // cut off before the apex: the end is the highest
  const double at_end = 1 + (vz - slope * vx) * s * h - 0.5 * g * s * h * s * h;
  EXPECT_NEAR(talus::largest_heights(trn, {from, to, 0, 0, sag}, 0, s).centroid, at_end, 1e-12);
}

}  // namespace
