// Places of a site: fences, lines, members, facts of layers.
#include <variant>

#include "setup/site_places_gdal.hpp"
#include "setup/vector_inputs_gdal.hpp"
#include "setups.hpp"

namespace {

using namespace talus;
using namespace talus::test;

const std::string line = "[[500060, 5000010], [500060, 5000090]]";

struct SitePlaces : testing::Test {
  ScratchFolder folder;
  CollectedLog log;
  Trn trn = slope_trn();

  std::vector<FenceLine> lines_of(const Site& site) {
    std::vector<FenceLine> lines;
    for (const FenceSettings& fence : site.fences)
      for (RecordLine& one : fence_lines(log, site, trn, fence)) lines.push_back({&fence, one});
    return lines;
  }
  std::string fences(const std::string& more) {
    return refusal_of([&] {
      const Site site = site_of(folder, more);
      check_fences_apart(log, site, trn, lines_of(site));
    });
  }
  std::string objects(const std::string& keys) {
    return refusal_of(
        [&] { static_cast<void>(site_objects(log, site_of(folder, "[object.a]\n" + keys), trn)); });
  }
};

TEST_F(SitePlaces, AFenceHasOneSourceOfItsLine) {
  EXPECT_HOLDS(fences("[fence.low]\nline = " + line + "\nfile = 'a.geojson'\n"),
               "has both line and file");
}

TEST_F(SitePlaces, ALineFromAFileIsThatOfTheSiteFile) {
  folder.write("lines.geojson", geojson_of({"LineString|[[500060,5000010],[500060,5000090]]|"}));
  const Site written = site_of(folder, "[fence.low]\nline = " + line + "\n");
  const Site named = site_of(folder, "[fence.low]\nfile = 'lines.geojson'\n");
  const auto here = lines_of(written), there = lines_of(named);
  ASSERT_EQ(there.size(), 1u);
  EXPECT_EQ(there[0].line.points, here[0].line.points);
  ASSERT_EQ(log.layers.size(), 1u);
  EXPECT_EQ(log.layers[0].role, "fence.low");
  EXPECT_EQ(log.layers[0].facts[0].first, "layer");
  EXPECT_EQ(std::get<std::string>(log.layers[0].facts[0].second), "lines");
  EXPECT_EQ(log.layers[0].facts[1].first, "n_lines");
  EXPECT_EQ(std::get<std::int64_t>(log.layers[0].facts[1].second), 1);
  EXPECT_TRUE(log.has(Severity::info, "lines.geojson: layer lines, 1 line"));
  EXPECT_FALSE(log.digest_of("fence.low").empty());
  EXPECT_EQ(log.files.front().first, "fence.low");
}

TEST_F(SitePlaces, FencesThatStandTwiceAreRefused) {
  const std::string low = "[fence.low]\nline = " + line + "\ncapacity_kj = 2000\n";
  const auto again = [](const std::string& points, const std::string& more = "") {
    return "[fence.again]\nline = " + points + "\n" + more;
  };
  EXPECT_HOLDS(fences(low + again(line)),
               "fence.again: lies on fence low all along, from 500060, 5000010 on");
  EXPECT_HOLDS(fences(low + again("[[500060, 5000090], [500060, 5000010]]")),
               "lies on fence low all along, from 500060, 5000090 on");
  EXPECT_HOLDS(fences(low + again("[[500060, 5000050], [500060, 5000098]]")),
               "lies on fence low along 40 m, from 500060, 5000050 on");
  EXPECT_EQ(fences(low + again("[[500060, 5000050], [500060, 5000098]]", "active = false\n")),
            "accepted");
  EXPECT_TRUE(log.has_warning("fence again lies on fence low along 40 m"));
}

TEST_F(SitePlaces, FencesThatCrossMeetOrStandBesideShareNoGround) {
  const std::string low = "[fence.low]\nline = " + line + "\n";
  for (const char* other :
       {"[[500060, 5000090], [500060, 5000098]]", "[[500055, 5000040], [500065, 5000045]]",
        "[[500062, 5000010], [500062, 5000090]]"})
    EXPECT_EQ(fences(low + "[fence.other]\nline = " + other + "\n"), "accepted") << other;
  EXPECT_TRUE(log.notes.empty());
}

TEST_F(SitePlaces, AnObjectHasOnePlaceAndItsWidth) {
  const std::string position = "position_m = [[500060, 5000010]]\n";
  EXPECT_HOLDS(objects(""), "object.a: has no place");
  EXPECT_HOLDS(objects(position + "line = " + line + "\n"), "has more than one place");
  EXPECT_HOLDS(objects("line = " + line + "\n"), "is a line without a width");
  EXPECT_HOLDS(objects(position), "is a point without a radius");
  EXPECT_HOLDS(objects("polygon = [[500060, 5000010], [500070, 5000010], [500070, 5000020]]\n"
                       "radius_m = 3\n"),
               "is an area with width_m or radius_m");
  EXPECT_HOLDS(objects("polygon = [[500060, 5000010], [500070, 5000020], [500070, 5000010], "
                       "[500060, 5000020]]\n"),
               "Self-intersection");
  EXPECT_HOLDS(objects("position_m = [[500260, 5000010]]\nradius_m = 3\n"),
               "lies outside of the known terrain");
  EXPECT_EQ(objects("line = [[500060, 5000010], [500260, 5000010]]\nwidth_m = 3\n"), "accepted");
  EXPECT_TRUE(log.has_warning("object.a: 1 of its 2 points lie outside of the known terrain"));
}

TEST_F(SitePlaces, PolygonsOfALineAreAsWideAsIt) {
  const auto found =
      site_objects(log, site_of(folder, "[object.road]\nline = " + line + "\nwidth_m = 6\n"), trn);
  const auto polygons = polygons_of(found[0]);
  ASSERT_EQ(polygons.size(), 1u);
  for (const Vec2& p : polygons[0][0]) EXPECT_NEAR(gap_to(found[0], p), 0, 0.01);
}

TEST(LayerFacts, SayWhatWasTakenAndPassedOver) {
  LayerReading taken;
  taken.file = "a.gpkg", taken.layer = "heights", taken.where = "z > 3", taken.noun = "line";
  taken.n_parts = 2, taken.n_passed_over = 1;
  taken.passed_over = "1 point";
  taken.decisions = {{"unit of heights", "0.3048 m", "--unit-m"}};
  const LayerRead layer = facts_on(taken, "spots");
  EXPECT_EQ(layer.role, "spots");
  std::vector<std::string> names;
  for (const auto& [name, value] : layer.facts) names.push_back(name);
  EXPECT_EQ(names, (std::vector<std::string>{"layer", "where", "n_lines", "n_passed_over",
                                             "passed_over", "decisions"}));
  EXPECT_EQ(std::get<std::vector<std::string>>(layer.facts.back().second).front(),
            "unit of heights: 0.3048 m (--unit-m)");
}

TEST(ReadMembers, FilesBesideTheNamedOneBecomeInputs) {
  const ScratchFolder folder;
  CollectedLog log;
  folder.write("a.asc", "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n3 4\n");
  folder.write(
      "a.vrt",
      "<VRTDataset rasterXSize=\"2\" rasterYSize=\"2\"><VRTRasterBand dataType=\"Float32\" "
      "band=\"1\"><SimpleSource><SourceFilename relativeToVRT=\"1\">a.asc</SourceFilename>"
      "<SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>");
  read_data(log, "raster", folder.file("a.vrt"));
  ASSERT_EQ(log.files.size(), 2u);
  EXPECT_EQ(log.files[0].second, folder.file("a.vrt"));
  EXPECT_HOLDS(log.files[1].second, "a.asc");
}

}  // namespace
