// Touches of endangered objects against closed forms.
#include <gtest/gtest.h>

#include <numbers>

#include "base/numbers.hpp"
#include "hand_made.hpp"
#include "record/object_hits.hpp"

namespace {

using namespace talus_test;
using talus::ObjectHit;
using talus::ObjectPart;
using talus::ObjectRecorder;
using talus::RecordObject;

RecordObject area(const std::string& name, double x0, double y0, double x1, double y1) {
  return {name, "house", {{{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, true}}, 0};
}

ObjectRecorder recorded(const Scene& scene, const std::vector<RecordObject>& objects,
                        const std::vector<Segment>& path) {
  ObjectRecorder recorder = talus::start_objects(scene, objects);
  talus::SegmentMotion motion;
  for (const Segment& segment : path) {
    motion.follow(segment, scene.blocks.inertia[static_cast<std::size_t>(segment.block)]);
    talus::record_objects(recorder, scene, motion);
  }
  return recorder;
}

Motion moving(const Vec3& position, const Vec3& velocity) {
  Motion motion;
  motion.pose.position = position;
  motion.velocity = velocity;
  return motion;
}

// Ground z = 0 under 200 m x 100 m.
Scene flat_scene(const Vec3& box) {
  Scene scene;
  scene.gravity = {0, 0, -9.81};
  scene.ground.trn = trn_of(21, 41, 5, [](double, double) { return 0.0; });
  add_box(scene, box);
  return scene;
}

}  // namespace

TEST(ObjectHits, OfAPlaneOf30DegreesHaveTheEnergyOfTheSlide) {
  // 2,600 kg slide from rest by phi = 20 degrees: 4.71171 kJ a metre of slope, 235.6 kJ at 50 m.
  const double alpha = 30 * std::numbers::pi / 180, phi = 20 * std::numbers::pi / 180;
  Scene scene = flat_scene({0.02, 0.02, 0.02});  // point-like, with the mass of a cubic metre
  scene.blocks.mass[0] = 2600;
  const double a = 9.80665 * (std::sin(alpha) - std::cos(alpha) * std::tan(phi));
  const Vec3 down(std::cos(alpha), 0, -std::sin(alpha));
  const double x_hit = 10 + 50 * std::cos(alpha);
  std::vector<Segment> path;
  Motion now = moving({10, 50, 100}, {0, 0, 0});
  for (int i = 0; i < 800; ++i) {
    path.push_back(slide(0, now, 0.01 * i, 0.01 * (i + 1), a * down, Vec3::Zero()));
    path.back().end.pose.position = now.pose.position + 0.01 * now.velocity + 0.5 * 1e-4 * a * down;
    path.back().end.velocity = now.velocity + 0.01 * a * down;
    now = path.back().end;
  }
  const ObjectRecorder recorder = recorded(scene, {area("house", x_hit, 40, x_hit + 10, 60)}, path);
  ASSERT_EQ(recorder.rows.size(), 1u);
  EXPECT_NEAR(recorder.rows[0].translational_energy / 1e3, 235.6, 235.6 * 5e-4);
  EXPECT_NEAR(recorder.rows[0].time, std::sqrt(2 * 50 / a), 3e-3);
}

TEST(ObjectHits, TakeTheFootprintNotTheCentroid) {
  const Scene scene = flat_scene({2, 2, 2});
  const auto hits = [&](double from_side) {  // the object's edge lies so far beside the path
    return recorded(scene, {area("house", 40, 50 + from_side, 60, 80)},
                    {flight(scene, 0, moving({10, 50, 30}, {20, 0, 0}), 0, 2.2)})
        .rows.size();
  };
  EXPECT_EQ(hits(0.5), 1u);
  EXPECT_EQ(hits(0.999), 1u);
  EXPECT_EQ(hits(1.01), 0u);
}

TEST(ObjectHits, OfTwoObjectsInLineAreBothAndCountedOnce) {
  const Scene scene = flat_scene({1, 1, 1});
  const Motion start = moving({10, 50, 60}, {20, 0, 0});
  const Segment whole = flight(scene, 0, start, 0, 3);
  const Motion turned = moving(whole.end.pose.position, {-20, 0, 0});
  const ObjectRecorder recorder = recorded(
      scene,
      {area("near", 30, 45, 35, 55), area("far", 50, 45, 55, 55), area("beside", 30, 60, 35, 70)},
      {whole, flight(scene, 0, turned, 3, 5)});
  const std::vector<ObjectHit> rows = sorted(recorder);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].object, 0);
  EXPECT_EQ(rows[1].object, 1);
  EXPECT_NEAR(rows[0].time, (30 - 10.5) / 20, 2e-4);
  EXPECT_NEAR(rows[1].time, (50 - 10.5) / 20, 2e-4);
  const double t = rows[0].time, z = 60 - 0.5 * 9.81 * t * t;
  EXPECT_NEAR(rows[0].top_height, z + 0.5, 1e-9);
  EXPECT_NEAR(rows[0].bottom_height, z - 0.5, 1e-9);
  EXPECT_NEAR(rows[0].speed, std::hypot(20, 9.81 * t), 1e-9);
  EXPECT_GT(rows[0].largest_speed, rows[0].speed);  // it was over it when it came back, faster
}

TEST(ObjectHits, OfLinesAndPointsReachAsFarAsTheirRadius) {
  const Scene scene = flat_scene({0.02, 0.02, 0.02});
  RecordObject road{"road", "road", {{{{30, 0}, {30, 100}}, false}}, 3};
  RecordObject mast{"mast", "mast", {{{{60, 52}}, false}}, 2.5};
  RecordObject away{"away", "mast", {{{{60, 55}}, false}}, 2.5};
  const ObjectRecorder recorder = recorded(
      scene, {road, mast, away}, {flight(scene, 0, moving({10, 50, 50}, {20, 0, 0}), 0, 3)});
  const std::vector<ObjectHit> rows = sorted(recorder);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_NEAR(rows[0].time, (27 - 10.01) / 20, 1e-3);
  EXPECT_NEAR(rows[1].time, (60 - std::sqrt(2.5 * 2.5 - 4) - 10) / 20, 2e-3);
}

TEST(ObjectHits, OfASpinningBlockAreNotMissedHoweverLongTheFlight) {
  const Scene scene = flat_scene({0.2, 0.2, 4});  // a stick that turns end over end
  Motion start = moving({10, 50, 90}, {15, 0, 0});
  start.angular_momentum = scene.blocks.inertia[0].cwiseProduct(Vec3(0.3, 9, 0.2));
  const RecordObject object = area("house", 45, 49, 60, 51);
  const ObjectRecorder at_once = recorded(scene, {object}, {flight(scene, 0, start, 0, 4)});
  std::vector<Segment> pieces;  // the same flight in many segments
  Motion now = start;
  for (int i = 0; i < 400; ++i) {
    pieces.push_back(flight(scene, 0, now, 0.01 * i, 0.01 * (i + 1)));
    now = pieces.back().end;
  }
  const ObjectRecorder in_pieces = recorded(scene, {object}, pieces);
  ASSERT_EQ(at_once.rows.size(), 1u);
  ASSERT_EQ(in_pieces.rows.size(), 1u);
  EXPECT_NEAR(at_once.rows[0].time, in_pieces.rows[0].time, 1e-3);
  EXPECT_NEAR(at_once.rows[0].largest_total_energy, in_pieces.rows[0].largest_total_energy,
              1e-3 * in_pieces.rows[0].largest_total_energy);
}

// A road from x = 40 to 60 whose first three quarters lie under a roof of two pieces.
RecordObject road_under_roof(double roof_end) {
  RecordObject road = area("road", 40, 40, 60, 60);
  road.roofs = {{{30, 30}, {48, 30}, {48, 70}, {30, 70}},
                {{48, 30}, {roof_end, 30}, {roof_end, 70}, {48, 70}}};
  return road;
}

TEST(ObjectHits, UnderARoofAreOfWhatLiesBesideItAlone) {
  const Scene scene = flat_scene({1, 1, 1});
  const std::vector<Segment> path = {flight(scene, 0, moving({10, 50, 60}, {20, 0, 0}), 0, 3)};
  const ObjectRecorder part = recorded(scene, {road_under_roof(55)}, path);
  ASSERT_EQ(part.rows.size(), 1u);
  EXPECT_NEAR(part.rows[0].time, (55 - 10.5) / 20, 1e-4);
  EXPECT_EQ(recorded(scene, {road_under_roof(62)}, path).rows.size(), 0u);
}

TEST(ObjectHits, BesideARoofAreThoseOfAnOpenRoad) {
  const Scene scene = flat_scene({1, 1, 1});
  // from the far side, where no roof is
  const std::vector<Segment> path = {flight(scene, 0, moving({75, 50, 60}, {-20, 0, 0}), 0, 3)};
  const ObjectHit open = recorded(scene, {area("road", 40, 40, 60, 60)}, path).rows.at(0);
  const ObjectHit hit = recorded(scene, {road_under_roof(55)}, path).rows.at(0);
  EXPECT_EQ(hit.time, open.time);
  EXPECT_LT(hit.largest_speed, open.largest_speed);  // it was over the roof when it was faster
}

TEST(ObjectHits, GapsCountWhatLiesBesideTheRoof) {
  const RecordObject road = road_under_roof(55);
  const auto gap = [&road](double x0, double x1) {
    return gap_to(road, std::vector<Vec2>{{x0, 45}, {x1, 45}, {x1, 46}, {x0, 46}});
  };
  EXPECT_EQ(gap(42, 54), talus::infinity);
  EXPECT_EQ(gap(42, 56), 0);
  EXPECT_NEAR(gap(63, 65), 3, 1e-12);
  EXPECT_NEAR(gap(25, 28), 12, 1e-12);
  EXPECT_EQ(gap_to(road, Vec2(50, 50)), talus::infinity);
  EXPECT_EQ(gap_to(road, Vec2(57, 50)), 0);
}
