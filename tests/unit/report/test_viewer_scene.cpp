// The scene of the 3D viewer, and the plan view of a run.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

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

// The inverse of base64 of words.
std::vector<int> words_of(const std::string& base64_text) {
  static const std::string letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int n_bits = 0;
  for (const char c : base64_text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned>(letters.find(c));
    n_bits += 6;
    if (n_bits >= 8) bytes += static_cast<char>(bits >> (n_bits -= 8) & 255u);
  }
  std::vector<int> words;
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2)
    words.push_back(static_cast<unsigned char>(bytes[i]) +
                    256 * static_cast<unsigned char>(bytes[i + 1]));
  return words;
}

std::vector<int> counts_of(const nlohmann::json& counts) {
  EXPECT_EQ(counts.at("bytes"), 2);
  return words_of(counts.at("all"));
}

}  // namespace

// Elevations are given from the lowest known one on, poses as x y z speed, then the quaternion;
// they may differ by half a step of the packing.
TEST(ViewerScene, HoldsThePosesOfTheFrames) {
  const Trn trn = talus::testing::plane_trn(0.5, 2, 101, 101);  // 0 m at its eastern end
  const nlohmann::json scene = nlohmann::json::parse(viewer_scene(sliding_box(), trn, {}));
  EXPECT_EQ(scene.at("terrain").at("z_origin_m"), 0);
  const nlohmann::json& frames = scene.at("frames");
  EXPECT_EQ(frames.at("time_s"), nlohmann::json({0, 1, 2}));
  const std::vector<double> pose = {50, 100, 60, 0, 0,  0,   0,  1, 65, 100, 52.5, 0,
                                    0,  0,   0,  1, 80, 100, 45, 0, 0,  0,   0,    1};
  const std::vector<int> words = words_of(frames.at("pose"));
  ASSERT_EQ(words.size(), pose.size());
  for (std::size_t i = 0; i < words.size(); ++i) {
    const nlohmann::json& packing = frames.at("packing").at(std::min<std::size_t>(i % 8, 4));
    const double low = packing.at(0), step = packing.at(1);
    EXPECT_NEAR(low + step * words[i], pose[i], 0.51 * step) << i;
    EXPECT_TRUE(step == 1 || step < 5e-4) << "at most 30 m in 65,534 steps";
  }
}

TEST(ViewerScene, ABlockThatRestsStandsInTheFirstFrameAlone) {
  RunFile run;
  for (const double x : {50.0, 20.0, 80.0}) talus::testing::add_box(run, {2, 4, 6}, {x, 100, 60});
  for (const double t : {0.0, 1.0, 2.0})
    talus::testing::add_frame(run, t,
                              {talus::testing::standing({50, 100, 60}),
                               talus::testing::standing({20 + 15 * t, 100, 60 - 7.5 * t}),
                               talus::testing::standing({80, 100, 60})});
  const Trn trn = talus::testing::plane_trn(0.5, 2, 101, 101);
  const nlohmann::json frames = nlohmann::json::parse(viewer_scene(run, trn, {})).at("frames");
  EXPECT_EQ(counts_of(frames.at("moved")), std::vector<int>{1});
  EXPECT_EQ(words_of(frames.at("pose")).size(), 8u * (3 + 2));
}

TEST(ViewerScene, BlocksAreTheirFaces) {
  const Trn trn = talus::testing::plane_trn(0.5, 2, 101, 101);
  const nlohmann::json blocks =
      nlohmann::json::parse(viewer_scene(sliding_box(), trn, {})).at("blocks");
  EXPECT_EQ(counts_of(blocks.at("n_vertices")), std::vector<int>{8});
  EXPECT_EQ(counts_of(blocks.at("n_faces")), std::vector<int>{6});
  EXPECT_EQ(counts_of(blocks.at("face_sizes")), std::vector<int>(6, 4));
  const std::vector<int> corners = counts_of(blocks.at("corners"));
  const std::vector<int> vertices = words_of(blocks.at("vertices"));
  ASSERT_EQ(corners.size(), 24u);
  ASSERT_EQ(vertices.size(), 24u);
  const double low = blocks.at("vertex_m").at(0), step = blocks.at("vertex_m").at(1);
  const auto vertex = [&](int corner) {
    Vec3 at;
    for (int axis = 0; axis < 3; ++axis)
      at[axis] = low + step * vertices[static_cast<std::size_t>(3 * corner + axis)];
    return at;
  };
  double volume = 0;
  for (std::size_t f = 0; f < 24; f += 4)
    for (std::size_t k = 1; k < 3; ++k)
      volume +=
          vertex(corners[f]).dot(vertex(corners[f + k]).cross(vertex(corners[f + k + 1]))) / 6;
  EXPECT_NEAR(volume, 48, 0.02) << "counter-clockwise from outside";
}

TEST(ViewerScene, UnknownGroundIsSaid) {
  Trn trn = talus::testing::plane_trn(0.5, 2, 101, 101);
  trn.elevation[0] = std::numeric_limits<double>::quiet_NaN();
  ViewerLimits limits;
  const nlohmann::json terrain =
      nlohmann::json::parse(viewer_scene(sliding_box(), trn, {}, limits)).at("terrain");
  const std::vector<int> words = words_of(terrain.at("z"));
  ASSERT_EQ(words.size(),
            terrain.at("n_rows").get<std::size_t>() * terrain.at("n_cols").get<std::size_t>());
  const bool has_corner = terrain.at("n_rows") == 101 && terrain.at("n_cols") == 101;
  EXPECT_EQ(words[0] == 65535, has_corner);
  const double low = terrain.at("z_m").at(0), step = terrain.at("z_m").at(1);
  const auto n_cols = terrain.at("n_cols").get<std::size_t>();
  EXPECT_NEAR(step * (words[n_cols + 1] - words[n_cols + 2]),
              0.5 * terrain.at("cell_size_m").get<double>(), 2 * step);
  EXPECT_GE(low, 0);
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
  EXPECT_NE(json.find("\"time_s\":[0,5,10,"), std::string::npos);
  EXPECT_NE(json.find(",995,999]"), std::string::npos) << "the last frame stays";
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
  std::string dense = svg;  // Cairo sets blanks or not
  std::erase(dense, ' ');
  for (const char* part :
       {"class=\"blocks\"", "<title>block0", "rgb(94.117647%,50.980392%,7.843137%)",
        "href=\"#map-ground\"", "href=\"#map-places\""})
    EXPECT_NE(dense.find(part), std::string::npos) << part;
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}
