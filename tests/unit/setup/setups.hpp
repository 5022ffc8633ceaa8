// tests/unit/setup/setups.hpp
// A slope of 30 degrees that runs out on a flat beyond 100 m, three boxes on it, and a log that
// keeps its messages: for the tests of the set-up.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/input_log.hpp"
#include "blocks/block_set.hpp"
#include "io/blocks_hdf5.hpp"
#include "io/crs_gdal.hpp"
#include "io/trn_file_gdal.hpp"
#include "site/site.hpp"
#include "terrain/trn.hpp"

namespace talus::test {

struct CollectedLog : InputLog {
  std::vector<std::pair<std::string, std::string>> files, contents;  ///< role; path, digest
  std::vector<LayerRead> layers;
  std::vector<std::pair<Severity, std::string>> notes;
  std::vector<Doubt> found;

  void read_also(const std::string& role, const std::string& path) override {
    files.emplace_back(role, path);
  }
  void content_read(const std::string& role, const std::string& digest) override {
    contents.emplace_back(role, digest);
  }
  void layer_read(const LayerRead& layer) override { layers.push_back(layer); }
  void doubts(const std::vector<Doubt>& some) override {
    found.insert(found.end(), some.begin(), some.end());
  }
  void note(Severity severity, const std::string& words) override {
    notes.emplace_back(severity, words);
  }

  [[nodiscard]] bool has(Severity severity, const std::string& part) const {
    return std::any_of(notes.begin(), notes.end(), [&](const auto& note) {
      return note.first == severity && note.second.find(part) != std::string::npos;
    });
  }
  [[nodiscard]] bool has_warning(const std::string& part) const {
    return std::any_of(found.begin(), found.end(), [&](const Doubt& doubt) {
      return sentence_on(doubt).find(part) != std::string::npos;
    });
  }
  /// Of the content read for a role; "" where nothing was.
  [[nodiscard]] std::string digest_of(const std::string& role) const {
    for (const auto& [name, digest] : contents)
      if (name == role) return digest;
    return "";
  }
};

/// A folder of its own, removed at the end.
class ScratchFolder {
 public:
  ScratchFolder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(test->test_suite_name()) + "." + test->name();
    std::replace(name.begin(), name.end(), '/', '_');
    path_ = std::filesystem::path(testing::TempDir()) / ("talus_setup_" + name);
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~ScratchFolder() { std::filesystem::remove_all(path_); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name)) << text;
    return file(name);
  }

 private:
  std::filesystem::path path_;
};

inline const Vec3 map_origin(500000, 5000000, 0);

/// Height of the ground above `map_origin`.
inline double ground_height(double x) {
  return 1000 - std::min(x, 100.0) * std::tan(std::acos(-1) / 6);
}

inline Trn slope_trn() {
  Trn trn;
  trn.n_rows = 21, trn.n_cols = 31, trn.cell_size = 5;
  trn.node0 = {0, 100};
  trn.origin = map_origin;
  trn.crs_wkt = crs_from_user("EPSG:32632", "a test");
  for (int r = 0; r < trn.n_rows; ++r)
    for (int c = 0; c < trn.n_cols; ++c) trn.elevation.push_back(ground_height(5 * c));
  return trn;
}

/// Boxes of 2 x 1.5 x 1 m with their west bottom edges `above` the ground of a slope_trn().
inline BlockSet boxes_on(const Trn& trn, const std::vector<Vec2>& places, double above = 1.5) {
  BlockSet set;
  set.origin = trn.origin;
  set.crs_wkt = trn.crs_wkt;
  set.material_names = {"rock"};
  for (const Vec2& p : places) {
    const Vec3 low(p.x(), p.y(), ground_height(p.x()) + above);
    Body body;
    body.parts = {box(low, low + Vec3(2, 1.5, 1), face_terrain)};
    add_body(set, body);
  }
  return set;
}
inline BlockSet three_boxes() { return boxes_on(slope_trn(), {{20, 30}, {21, 50}, {22, 70}}); }

inline const std::string site_text =
    "[material.rock]\ndensity_kg_m3 = 2600\n[ground.ground]\nfriction_deg = 20\ncor = 0.4\n"
    "[solver]\nduration_s = 8\n";

/// The site of `site_text` with more sections; names of files are relative to `folder`.
inline Site site_of(const ScratchFolder& folder, const std::string& more = "") {
  return parse_site(site_text + more, folder.file("site.toml"));
}

/// A GeoJSON file of features "TYPE|COORDINATES|PROPERTIES" in EPSG:32632.
inline std::string geojson_of(const std::vector<std::string>& features) {
  std::string text =
      R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:32632"}},"features":[)";
  for (const std::string& feature : features) {
    const std::size_t first = feature.find('|'), last = feature.rfind('|');
    text += (&feature == &features.front() ? "" : ",") +
            std::string(R"({"type":"Feature","properties":{)") + feature.substr(last + 1) +
            R"(},"geometry":{"type":")" + feature.substr(0, first) + R"(","coordinates":)" +
            feature.substr(first + 1, last - first - 1) + "}}";
  }
  return text + "]}";
}

/// The message that `run` throws, with its hint; "accepted" where it does not.
template <class Run>
std::string refusal_of(const Run& run) {
  try {
    run();
  } catch (const InputError& error) {
    return std::string(error.what()) + " hint: " + error.hint();
  }
  return "accepted";
}

inline bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

#define EXPECT_HOLDS(text, part) EXPECT_PRED2(talus::test::holds, text, part)

}  // namespace talus::test
