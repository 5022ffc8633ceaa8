// The lines that runs watch at dams and galleries, on terrain in which these stand.
#include "setup/site_dams_gdal.hpp"
#include "setups.hpp"

namespace {

using namespace talus;
using namespace talus::test;

// Rises 1 : 20 to the north from 100 m at y = 0; nodes 1 m apart.
double gentle(double y) { return 100 + 0.05 * y; }

struct Dams : testing::Test {
  ScratchFolder folder;
  CollectedLog log;
  Trn trn;

  Dams() {
    trn.n_rows = 121, trn.n_cols = 141, trn.cell_size = 1;
    trn.node0 = {0, 120};
    trn.origin = map_origin;
    trn.crs_wkt = crs_from_user("EPSG:32632", "a test");
    for (int r = 0; r < trn.n_rows; ++r)
      for (int c = 0; c < trn.n_cols; ++c) trn.elevation.push_back(gentle(120 - r));
  }
  std::vector<DamLines> lines_of(const std::string& sections) {
    const Site site = site_of(folder, sections);
    static_cast<void>(build_dams(log, site, trn));
    const WatchedDams watched = watched_dams(log, site, trn);
    EXPECT_FALSE(watched.other_ground);
    return watched.dams;
  }
  // Why the ground is not that of these sections; empty: it is.
  std::string other_ground(const std::string& sections) {
    const auto found = watched_dams(log, site_of(folder, sections), trn).other_ground;
    return found ? found->what() : "";
  }
};

// 16 m south of the upper dam stands the lower one, 16 m north the ground is lower than its crest.
TEST_F(Dams, AreWatchedFromWhereTheGroundRoseBeforeThem) {
  const std::string keys = "height_m = 5\nslopes_deg = [60, 34]\n";
  const std::string both = "[dam.above]\nline = [[500030, 5000035], [500110, 5000035]]\n" + keys +
                           "[dam.below]\nline = [[500030, 5000018], [500110, 5000018]]\n" + keys;
  EXPECT_NE(other_ground(both).find("dam.above: is active, and the terrain was made without it"),
            std::string::npos);
  const std::vector<DamLines> lines = lines_of(both);
  ASSERT_EQ(lines.size(), 2U);
  const double before = 1 + 5 / std::tan(std::acos(-1) / 3) + 2.5;  // crest, face, half the height
  for (const Vec3& post : lines[0].before.points) EXPECT_NEAR(post.y(), 35 + before, 1e-9);
  for (const Vec3& post : lines[1].before.points) EXPECT_NEAR(post.y(), 18 + before, 1e-9);
  EXPECT_NE(
      other_ground("").find("dam.above: is in the ground of the terrain, and not active here"),
      std::string::npos);
}

// A line that is gone from a file of several leaves its dam in the ground.
TEST_F(Dams, OfAFileAreCheckedOneByOne) {
  const auto file_of = [&](int n) {
    std::vector<std::string> lines;
    for (int i = 0; i < n; ++i) {
      const std::string y = std::to_string(5000018 + 20 * i);
      lines.push_back("LineString|[[500030," + y + "],[500110," + y + "]]|");
    }
    folder.write("dams.geojson", geojson_of(lines));
  };
  const std::string section = "[dam.road]\nfile = 'dams.geojson'\nheight_m = 2\n";
  file_of(3);
  EXPECT_EQ(lines_of(section).size(), 3U);
  file_of(2);
  EXPECT_NE(other_ground(section).find("dam.road.3: is in the ground of the terrain"),
            std::string::npos);
}

// Both edges lie between two nodes, where the terrain falls from the roof.
TEST_F(Dams, HeightsAtAGalleryCountFromItsRoof) {
  const std::vector<DamLines> lines = lines_of(
      "[dam.shed]\nkind = 'gallery'\nline = [[500030, 5000035.3], [500110, 5000035.3]]\n"
      "height_m = 5\ncrest_width_m = 8\n");
  ASSERT_EQ(lines.size(), 1U);
  for (const RecordLine& edge : {lines[0].crest, lines[0].before})
    for (const Vec3& post : edge.points) EXPECT_NEAR(post.z(), gentle(35.3) + 5, 1e-9);
  EXPECT_NEAR(lines[0].crest.points[0].y(), 31.3, 1e-9);
  EXPECT_EQ(lines[0].crest.roof_nodes.size(), 81U * 8);  // x of 30 to 110, y of 32 to 39
}

}  // namespace
