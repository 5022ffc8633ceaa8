#include <gtest/gtest.h>

#include "base/error.hpp"
#include "post/maps/map_page.hpp"
#include "report/encode.hpp"
#include "report/plan_view.hpp"
#include "report/viewer_scene.hpp"
#include "unit/post/run_maker.hpp"
#include "unit/report/shipped_texts.hpp"

using namespace talus;

namespace {

// One box that goes from (50, 100) to (80, 100) in three frames on a plane of 201 x 101 nodes.
RunFile sliding_box() {
  RunFile run;
  talus::testing::add_box(run, {2, 4, 6}, {50, 100, 60});
  for (const double t : {0.0, 1.0, 2.0})
    talus::testing::add_frame(run, t, {talus::testing::standing({50 + 15 * t, 100, 60 - 7.5 * t})});
  return run;
}

}  // namespace

// Elevations are given from the lowest known one on, poses as x y z speed, then the quaternion.
TEST(ViewerScene, HoldsThePosesOfTheFrames) {
  const Trn trn = talus::testing::plane_trn(0.5, 2, 101, 101);  // 0 m at its eastern end
  const std::string json = viewer_scene(sliding_box(), trn, {});
  EXPECT_NE(json.find("\"time_s\":[0,1,2]"), std::string::npos);
  EXPECT_NE(json.find("\"z_origin_m\":0"), std::string::npos);
  const std::vector<float> pose = {50, 100, 60, 0, 0,  0,   0,  1, 65, 100, 52.5, 0,
                                   0,  0,   0,  1, 80, 100, 45, 0, 0,  0,   0,    1};
  EXPECT_NE(json.find(base64(pose)), std::string::npos);
}

// A box has 12 triangles, so 36 corners of block 0.
TEST(ViewerScene, FacesAreTriangles) {
  const Trn trn = talus::testing::plane_trn(0.5, 2, 101, 101);
  const std::string json = viewer_scene(sliding_box(), trn, {});
  EXPECT_NE(json.find("\"block\":\"" + base64(std::vector<std::uint32_t>(36, 0)) + "\""),
            std::string::npos);
}

TEST(ViewerScene, TrailsAreThoseOfAllRunsAndLeftOutEvenly) {
  const Trn trn = talus::testing::plane_trn(0.5, 2, 101, 101);
  ViewerPlaces places;
  for (int i = 0; i < 6; ++i) places.trails.push_back({{1.0 * i, 0, 5}, {1.0 * i, 2, 4}});
  const auto holds = [](const std::string& json, const std::string& part) {
    return json.find(part) != std::string::npos;
  };
  EXPECT_TRUE(holds(viewer_scene(sliding_box(), trn, places), "\"n\":6,\"n_all\":6"));
  ViewerLimits limits;
  limits.max_trail_points = 6;
  const std::string thinned = viewer_scene(sliding_box(), trn, places, limits);
  const std::vector<float> three = {0, 0, 5, 0, 2, 4, 2, 0, 5, 2, 2, 4, 4, 0, 5, 4, 2, 4};
  EXPECT_TRUE(holds(thinned, "\"n\":3,\"n_all\":6"));
  EXPECT_TRUE(holds(thinned, base64(three)));
}

TEST(ViewerScene, LongRunsAndLargeTerrainsAreThinned) {
  RunFile run = sliding_box();
  for (int k = 3; k < 1000; ++k)
    talus::testing::add_frame(run, k, {talus::testing::standing({80, 100, 45})});
  const Trn trn = talus::testing::plane_trn(0.5, 0.5, 801, 801);
  const std::string json = viewer_scene(run, trn, {}, {2000, 3200});
  EXPECT_NE(json.find("\"time_s\":[0,10,20,"), std::string::npos);
  EXPECT_NE(json.find(",990,999]"), std::string::npos) << "the last frame stays";
  EXPECT_LT(json.size(), 30000u);
  EXPECT_THROW(static_cast<void>(viewer_scene(RunFile{}, trn, {})), InputError);
}

TEST(PlanWindow, HoldsTheRunAndStaysOnTheTerrain) {
  const Trn trn = talus::testing::plane_trn(0.5, 2, 101, 101);
  const PlanWindow window = plan_window(sliding_box(), trn);
  EXPECT_DOUBLE_EQ(window.low.x(), 42);  // a margin of four cells, more than a quarter of 30 m
  EXPECT_DOUBLE_EQ(window.high.x(), 88);
  const PlanWindow all = plan_window(RunFile{}, trn);
  EXPECT_DOUBLE_EQ(all.low.x(), 0);
  EXPECT_DOUBLE_EQ(all.high.y(), 200);
}

TEST(PlanView, HoldsWhatTheRunDid) {
  const Trn trn = talus::testing::plane_trn(0.5, 2, 101, 101);
  MapSheet sheet;
  const PageLayout layout = layout_of(PageSize::a4);
  sheet.ground = map_ground(trn, layout, view_of(layout, {40, 80}, {90, 120}));
  const std::string svg = plan_view_svg(talus::testing::shipped_texts(), sliding_box(), sheet);
  for (const char* part : {"<path class=\"start\"", "<path class=\"way\"", "<path class=\"end\"",
                           "href=\"#map-ground\"", "href=\"#map-places\""})
    EXPECT_NE(svg.find(part), std::string::npos) << part;
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}
