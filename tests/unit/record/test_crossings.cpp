// Crossings of lines against closed forms.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.hpp"
#include "hand_made.hpp"
#include "record/crossings.hpp"
#include "record/motion.hpp"

namespace {

using namespace talus_test;
using talus::Crossing;
using talus::CrossingRecorder;

Scene scene_with_box() {
  Scene scene;
  scene.gravity = {0, 0, -9.81};
  add_box(scene, {1, 1, 2});
  return scene;
}

CrossingRecorder recorded(const Scene& scene, const std::vector<std::vector<Vec3>>& lines,
                          const std::vector<Segment>& path) {
  std::vector<talus::RecordLine> record_lines;
  for (const auto& points : lines) record_lines.push_back(talus::record_line("line", points));
  CrossingRecorder recorder = talus::start_crossings(scene, record_lines);
  for (const Segment& segment : path) talus::record_crossings(recorder, scene, segment);
  return recorder;
}

Motion moving(const Vec3& position, const Vec3& velocity) {
  Motion motion;
  motion.pose.position = position;
  motion.velocity = velocity;
  return motion;
}

TEST(Crossings, OfAFlightAreTheClosedForm) {
  const Scene scene = scene_with_box();
  Motion start = moving({0, 2, 30}, {12, 1, 4});
  start.angular_momentum = scene.blocks.inertia[0].cwiseProduct(Vec3(0, 0, 3));
  const CrossingRecorder recorder =
      recorded(scene, {{{18, -10, 1}, {18, 10, 5}}}, {flight(scene, 0, start, 5, 8)});
  ASSERT_EQ(recorder.rows.size(), 1u);
  const Crossing& row = recorder.rows[0];
  const double t = 18.0 / 12;
  EXPECT_NEAR(row.time, 5 + t, 1e-12);
  EXPECT_NEAR(row.chainage, 10 + 2 + t, 1e-12);
  EXPECT_EQ(row.direction, -1);  // eastwards, to the right of a line that runs north
  EXPECT_EQ(row.n_crossings, 1);
  EXPECT_FALSE(row.beside);
  const Vec3 velocity(12, 1, 4 - 9.81 * t);
  EXPECT_NEAR((row.velocity - velocity).norm(), 0, 1e-12);
  EXPECT_NEAR((row.spin - Vec3(0, 0, 3)).norm(), 0, 1e-12);
  const double mass = scene.blocks.mass[0];
  EXPECT_NEAR(row.translational_energy, 0.5 * mass * velocity.squaredNorm(), 1e-7);
  EXPECT_NEAR(row.rotational_energy, 4.5 * scene.blocks.inertia[0].z(), 1e-7);
  const double base = 1 + 4 * (12 + t) / 20;
  const double z = 30 + 4 * t - 0.5 * 9.81 * t * t;
  EXPECT_NEAR(row.centroid_height, z - base, 1e-12);
  EXPECT_NEAR(row.top_height, z + 1 - base, 1e-12);
  EXPECT_NEAR(row.bottom_height, z - 1 - base, 1e-12);
}

TEST(Crossings, OfABrakedSlideAreTheClosedForm) {
  const Scene scene = scene_with_box();
  const Motion start = moving({0, 0, 0}, {10, 0, 0});
  const CrossingRecorder recorder = recorded(scene, {{{3, 5, 0}, {3, -5, 0}}},
                                             {slide(0, start, 0, 0.5, {-4, 0, 0}, Vec3::Zero())});
  ASSERT_EQ(recorder.rows.size(), 1u);
  const double t = (10 - std::sqrt(100 - 2 * 4 * 3)) / 4;  // 3 = 10 t - 2 t^2
  EXPECT_NEAR(recorder.rows[0].time, t, 1e-12);
  EXPECT_NEAR(recorder.rows[0].velocity.x(), 10 - 4 * t, 1e-12);
  EXPECT_EQ(recorder.rows[0].direction, 1);
}

// The first crossing stays; returns are counted.
TEST(Crossings, AreOneRowPerBlockAndLine) {
  const Scene scene = scene_with_box();
  const Motion out = moving({0, 0, 0}, {10, 0, 0}), back = moving({10, 0, 0}, {-10, 0, 0});
  const CrossingRecorder recorder =
      recorded(scene, {{{5, -5, 0}, {5, 5, 0}}, {{8, -5, 0}, {8, 5, 0}}},
               {slide(0, out, 0, 1, Vec3::Zero(), Vec3::Zero()),
                slide(0, back, 1, 2, Vec3::Zero(), Vec3::Zero())});
  ASSERT_EQ(recorder.rows.size(), 2u);
  const auto rows = talus::sorted(recorder);
  EXPECT_NEAR(rows[0].time, 0.5, 1e-12);
  EXPECT_NEAR(rows[1].time, 0.8, 1e-12);
  for (const Crossing& row : rows) EXPECT_EQ(row.n_crossings, 2);
}

// Of two segments that one step meets, the one that is met first is kept, wherever it is in the
// line.
TEST(Crossings, KeepTheFirstOfTwoInOneStep) {
  const Scene scene = scene_with_box();
  const std::vector<Segment> path{
      slide(0, moving({0, 0, 0}, {10, 0, 0}), 0, 1, Vec3::Zero(), Vec3::Zero())};
  std::vector<Vec3> line{{8, -5, 0}, {8, 5, 0}, {4, 5, 0}, {4, -5, 0}};  // met at 4 m, then at 8 m
  for (const int segment : {2, 0}) {
    const CrossingRecorder recorder = recorded(scene, {line}, path);
    ASSERT_EQ(recorder.rows.size(), 1u);
    EXPECT_EQ(recorder.rows[0].segment, segment);
    EXPECT_EQ(recorder.rows[0].n_crossings, 2);
    EXPECT_NEAR(recorder.rows[0].time, 0.4, 1e-12);
    EXPECT_NEAR(recorder.rows[0].position.x(), 4, 1e-12);
    std::reverse(line.begin(), line.end());
  }
}

// A step that ends on the line and continues from there crosses once, one that returns not at all.
TEST(Crossings, AtTheEndOfAStepAreCountedOnce) {
  const Scene scene = scene_with_box();
  const auto step = [](double x0, double x1, double t) {
    return slide(0, moving({x0, 0, 0}, {x1 - x0, 0, 0}), t, t + 1, Vec3::Zero(), Vec3::Zero());
  };
  const std::vector<std::vector<Vec3>> north{{{5, -5, 0}, {5, 5, 0}}};
  for (const double side : {-1.0, 1.0}) {
    const auto through = recorded(scene, north, {step(5 - side, 5, 0), step(5, 5 + side, 1)});
    ASSERT_EQ(through.rows.size(), 1u);
    EXPECT_EQ(through.rows[0].n_crossings, 1);
    EXPECT_NEAR(through.rows[0].time, 1, 1e-12);
  }
}

TEST(Crossings, BesideALineHaveAChainageBeyondIt) {
  const Scene scene = scene_with_box();
  const auto pass_at = [&](double y) {
    return recorded(scene, {{{5, 0, 0}, {5, 10, 0}, {7, 20, 0}}},
                    {slide(0, moving({0, y, 0}, {20, 0, 0}), 0, 1, Vec3::Zero(), Vec3::Zero())});
  };
  const auto before = pass_at(-3);
  ASSERT_EQ(before.rows.size(), 1u);
  EXPECT_TRUE(before.rows[0].beside);
  EXPECT_EQ(before.rows[0].n_crossings, 0);
  EXPECT_NEAR(before.rows[0].chainage, -3, 1e-12);
  const auto within = pass_at(15);
  ASSERT_EQ(within.rows.size(), 1u);
  EXPECT_FALSE(within.rows[0].beside);
  EXPECT_EQ(within.rows[0].segment, 1);
  EXPECT_NEAR(within.rows[0].chainage, 10 + 0.5 * std::sqrt(104), 1e-12);
  const auto beyond = pass_at(30);
  ASSERT_EQ(beyond.rows.size(), 1u);
  EXPECT_TRUE(beyond.rows[0].beside);
  EXPECT_NEAR(beyond.rows[0].chainage, 10 + 2 * std::sqrt(104), 1e-12);
}

// A corner of the line is crossed exactly once, wherever the path goes through it.
TEST(Crossings, NearACornerAreNeitherMissedNorDoubled) {
  talus::Random random(2, "crossings");
  const Scene scene = scene_with_box();
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3 corner = random_vector(random, 3);
    const std::vector<Vec3> line{corner + Vec3(random.uniform(-9, 3), -10, 0), corner,
                                 corner + Vec3(random.uniform(-9, 3), 10, 0)};
    const double off = trial % 3 == 0 ? 0 : random.uniform(-1e-9, 1e-9);
    const Motion start = moving({-30, corner.y() + off, 0}, {60, 0, 0});
    std::vector<Segment> path;
    for (int i = 0; i < 7; ++i)
      path.push_back(slide(0,
                           talus::motion_at(slide(0, start, 0, 1, Vec3::Zero(), Vec3::Zero()),
                                            scene.blocks.inertia[0], i / 7.0),
                           i / 7.0, (i + 1) / 7.0, Vec3::Zero(), Vec3::Zero()));
    const auto recorder = recorded(scene, {line}, path);
    ASSERT_EQ(recorder.rows.size(), 1u) << trial;
    EXPECT_EQ(recorder.rows[0].n_crossings, 1) << trial;
    EXPECT_NEAR(recorder.rows[0].time, (corner.x() + 30) / 60, 1e-9);
  }
}

// Random walks: the number of crossings is that of the brute-force test of every step and part.
TEST(Crossings, MissNothingByTheirClearance) {
  talus::Random random(3, "crossings");
  const Scene scene = scene_with_box();
  const std::vector<Vec3> line{{-5, -4, 0}, {1, 0, 0}, {-2, 5, 0}, {6, 6, 0}};
  const auto cross = [](const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); };
  for (int trial = 0; trial < 200; ++trial) {
    Motion motion = moving(random_vector(random, 4), Vec3::Zero());
    std::vector<Segment> path;
    int expected = 0;
    for (int i = 0; i < 60; ++i) {
      motion.velocity = random_vector(random, random.uniform(0, 6));
      path.push_back(slide(0, motion, i, i + 1, Vec3::Zero(), Vec3::Zero()));
      const Vec2 a = motion.pose.position.head<2>();
      motion = path.back().end;
      const Vec2 b = motion.pose.position.head<2>();
      for (int part = 0; part < 3; ++part) {
        const Vec2 p = line[part].head<2>(), q = line[part + 1].head<2>();
        expected += (cross(q - p, a - p) > 0) != (cross(q - p, b - p) > 0) &&
                    (cross(b - a, p - a) > 0) != (cross(b - a, q - a) > 0);
      }
    }
    const auto recorder = recorded(scene, {line}, path);
    ASSERT_EQ(recorder.rows.empty() ? 0 : recorder.rows[0].n_crossings, expected) << trial;
  }
}

TEST(Crossings, RefuseALineWithoutLength) {
  EXPECT_THROW((void)talus::record_line("f", {{0, 0, 0}}), talus::InputError);
  EXPECT_THROW((void)talus::record_line("f", {{0, 0, 0}, {0, 0, 5}}), talus::InputError);
}

// Of any path the same crossings are found as the recorder finds: at corners, along the line, where
// a step ends on it. Whole numbers make all of these happen.
TEST(LineMeetings, AreThoseThatTheRecorderCounts) {
  talus::Random random(5, "meetings");
  const Scene scene = scene_with_box();
  const auto whole = [&] { return std::floor(random.uniform(0, 5)); };
  int n_met = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<Vec3> points{{whole(), whole(), 0}};
    while (points.size() < 4) {
      const Vec3 next(whole(), whole(), 0);
      if (next != points.back()) points.push_back(next);
    }
    Motion at = moving({whole(), whole(), 0}, {0, 0, 0});
    std::vector<Segment> path;
    for (int i = 0; i < 12; ++i) {
      at.velocity = Vec3(whole(), whole(), 0) - at.pose.position;
      path.push_back(slide(0, at, i, i + 1, Vec3::Zero(), Vec3::Zero()));
      at = path.back().end;
    }
    const CrossingRecorder recorder = recorded(scene, {points}, path);
    const talus::RecordLine line = talus::record_line("line", points);
    std::vector<std::pair<double, talus::LineMeeting>> met;
    for (const Segment& step : path)
      for (const talus::LineMeeting& meeting : line_meetings(
               line, step.start.pose.position.head<2>(), step.end.pose.position.head<2>()))
        met.emplace_back(step.t_start + meeting.share, meeting);
    const bool has_row = !recorder.rows.empty() && !recorder.rows[0].beside;
    ASSERT_EQ(met.size(), has_row ? recorder.rows[0].n_crossings : 0) << trial;
    if (!has_row) continue;
    ++n_met;
    EXPECT_NEAR(recorder.rows[0].time, met[0].first, 1e-9) << trial;
  }
  EXPECT_GT(n_met, 500);
}

}  // namespace
