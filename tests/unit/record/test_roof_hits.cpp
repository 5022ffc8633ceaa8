// Hits of the roofs of galleries against closed forms.
#include <gtest/gtest.h>

#include "hand_made.hpp"
#include "record/roof_hits.hpp"
#include "scene/state.hpp"

namespace {

using namespace talus_test;
using talus::RecordLine;
using talus::RoofHit;
using talus::RoofRecorder;

constexpr double gravity = 9.81;

// A cube of 1 m above level ground at z = 6, which is a roof from x = 40 to 60; the second line has
// none.
struct Fall {
  Scene scene;
  talus::State state;
  RoofRecorder recorder;

  explicit Fall(const Vec3& normal = Vec3::UnitZ()) {
    scene.gravity = {0, 0, -gravity};
    scene.ground.trn = trn_of(21, 41, 5, [](double, double) { return 6.0; });
    add_box(scene, {1, 1, 1});
    RecordLine edge = talus::record_line("gallery.road", {{40, 40, 6}, {60, 40, 6}});
    edge.roof = {{{{40, 40}, {60, 40}, {60, 60}, {40, 60}}, normal}};
    for (int row = 0; row < scene.ground.trn.n_rows; ++row)
      for (int col = 0; col < scene.ground.trn.n_cols; ++col)
        if (const Vec3 at = node_point(scene.ground.trn, row, col);
            at.x() >= 40 && at.x() <= 60 && at.y() >= 40 && at.y() <= 60)
          edge.roof_nodes.push_back(static_cast<int>(node_index(scene.ground.trn, row, col)));
    RecordLine crest = talus::record_line("dam.other", {{40, 40, 6}, {60, 40, 6}});
    recorder = talus::start_roofs(scene, {crest, edge});
    state.motion.resize(1);
  }
  void step(const std::vector<Segment>& segments, const Vec3& after) {
    for (const Segment& segment : segments) record_roofs(recorder, scene, segment);
    state.motion[0] = segments.back().end;
    state.motion[0].velocity = after;
    close_step(recorder, scene, state);
  }
};

Motion moving(const Vec3& position, const Vec3& velocity) {
  Motion motion;
  motion.pose.position = position;
  motion.velocity = velocity;
  return motion;
}

}  // namespace

TEST(RoofHits, OfAFallHaveTheEnergyOfItsHeight) {
  Fall fall;
  const double h = 8, t = std::sqrt(2 * h / gravity);
  fall.step({flight(fall.scene, 0, moving({50, 50, 6.5 + h}, {3, 0, 0}), 0, t)}, {2, 0, 0});
  ASSERT_EQ(fall.recorder.rows.size(), 1U);
  const RoofHit& hit = fall.recorder.rows[0];
  EXPECT_EQ(hit.line, 1);
  EXPECT_EQ(hit.n_hits, 1);
  EXPECT_NEAR(hit.time, t, 1e-12);
  EXPECT_NEAR(hit.mass, 2600, 1e-9);
  EXPECT_NEAR(0.5 * hit.mass * hit.normal_speed * hit.normal_speed, 2600 * gravity * h, 1e-6);
  EXPECT_NEAR(hit.velocity.x(), 3, 1e-12);
}

TEST(RoofHits, OfARoofThatSlopesCountTheSpeedIntoIt) {
  Fall fall(Vec3(-0.6, 0, 0.8));
  fall.step({flight(fall.scene, 0, moving({50, 50, 6.5}, {4, 0, -3}), 0, 1e-9)}, {0, 0, 0});
  ASSERT_EQ(fall.recorder.rows.size(), 1U);
  EXPECT_NEAR(fall.recorder.rows[0].normal_speed, 0.6 * 4 + 0.8 * 3, 1e-7);
}

// Bounces are hits of one block, of which the hardest is kept, whatever their order.
TEST(RoofHits, KeepTheHardestAndCountAll) {
  Fall fall;
  const auto bounce = [&](double down, double up, double time) {
    fall.step({flight(fall.scene, 0, moving({50, 50, 6.5 + 1e-9 * down}, {0, 0, -down}), time,
                      time + 1e-9),
               flight(fall.scene, 0, moving({50, 50, 6.5}, {0, 0, up}), time + 1e-9, time + 0.1)},
              {0, 0, up - 0.1 * gravity});
  };
  bounce(4, 2, 0);
  bounce(9, 3, 1);
  bounce(1, 0.8, 2);
  ASSERT_EQ(fall.recorder.rows.size(), 1U);
  EXPECT_EQ(fall.recorder.rows[0].n_hits, 3);
  EXPECT_NEAR(fall.recorder.rows[0].normal_speed, 9, 1e-7);
  EXPECT_NEAR(fall.recorder.rows[0].time, 1, 1e-6);
  // and again, as a resumed run does
  RoofRecorder again = talus::start_roofs(fall.scene, fall.recorder.lines);
  restore(again, fall.recorder.rows);
  EXPECT_EQ(sorted(again)[0].n_hits, 3);
}

// A block that was crushed hits faster, with less energy: 5 m/s with all of it, 6 m/s with half.
TEST(RoofHits, AreTheHardestByTheirEnergy) {
  Fall fall;
  fall.step({flight(fall.scene, 0, moving({50, 50, 6.5}, {0, 0, -5}), 0, 1e-9)}, {0, 0, 0});
  fall.scene.blocks.mass[0] /= 2;
  fall.step({flight(fall.scene, 0, moving({50, 50, 6.5}, {0, 0, -6}), 1, 1 + 1e-9)}, {0, 0, 0});
  EXPECT_EQ(fall.recorder.rows[0].n_hits, 2);
  EXPECT_NEAR(fall.recorder.rows[0].normal_speed, 5, 1e-7);
}

TEST(RoofHits, AreNeitherBesideTheRoofNorAboveItNorOfWhatSlides) {
  const auto hits = [](const Vec3& position, const Vec3& velocity, const Vec3& after) {
    Fall fall;
    fall.step({flight(fall.scene, 0, moving(position, velocity), 0, 1e-9)}, after);
    return fall.recorder.rows.size();
  };
  EXPECT_EQ(hits({50, 50, 6.5}, {0, 0, -5}, {0, 0, 0}), 1U);
  EXPECT_EQ(hits({65, 50, 6.5}, {0, 0, -5}, {0, 0, 0}), 0U);    // beside it
  EXPECT_EQ(hits({50, 50, 8}, {0, 0, -5}, {0, 0, 0}), 0U);      // by something above it
  EXPECT_EQ(hits({50, 50, 6.5}, {5, 0, 0}, {2, 0, 0}), 0U);     // stopped along it
  EXPECT_EQ(hits({50, 50, 6.5}, {0, 0, -0.4}, {0, 0, 0}), 0U);  // too slow
}

// The roof's ring reaches into the cell over which the terrain rises to the slope behind it.
TEST(RoofHits, AreNotOnTheStepsBesideTheRoof) {
  const auto hits = [](double y) {
    Fall fall;
    fall.recorder.lines[1].roof[0].ring = {{40, 40}, {60, 40}, {60, 63}, {40, 63}};
    fall.step({flight(fall.scene, 0, moving({50, y, 6.5}, {0, 0, -5}), 0, 1e-9)}, {0, 0, 0});
    return fall.recorder.rows.size();
  };
  EXPECT_EQ(hits(58), 1U);
  EXPECT_EQ(hits(61), 0U);
}

// In a mass the contacts act over the segment itself, not between two.
TEST(RoofHits, WithinASegmentAreFoundToo) {
  Fall fall;
  const Vec3 start(0, 0, -5);
  fall.step({slide(0, moving({50, 50, 6.5}, start), 0, 0.01, Vec3(0, 0, 500), Vec3::Zero())},
            Vec3(0, 0, 0));
  ASSERT_EQ(fall.recorder.rows.size(), 1U);
  EXPECT_NEAR(fall.recorder.rows[0].normal_speed, 5, 1e-9);
}
