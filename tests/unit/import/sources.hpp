// tests/unit/import/sources.hpp
// Small vector files, and requests for them.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "import/raw_inputs_gdal.hpp"
#include "io/crs_gdal.hpp"

namespace talus::test {

struct Feature {
  std::string type;         ///< "LineString"
  std::string coordinates;  ///< "[[0,0,1],[1,0,1]]"
  std::string properties;   ///< "\"elev\":100"
};

struct ImportTest : testing::Test {
  std::filesystem::path folder;
  InputsRequest request;

  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder = std::filesystem::temp_directory_path() /
             (std::string("talus_") + test->test_suite_name() + "_" + test->name());
    std::filesystem::create_directories(folder);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  /// A GeoJSON; `epsg` 0: it names no system, so that degrees are meant.
  std::string file(const std::string& name, int epsg, const std::vector<Feature>& features) {
    const std::string path = (folder / (name + ".geojson")).string();
    std::ofstream out(path);
    out << R"({"type":"FeatureCollection",)";
    if (epsg > 0)
      out << R"("crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::)" << epsg
          << R"("}},)";
    out << R"("features":[)";
    for (std::size_t i = 0; i < features.size(); ++i)
      out << (i == 0 ? "" : ",") << R"({"type":"Feature","properties":{)" << features[i].properties
          << R"(},"geometry":{"type":")" << features[i].type << R"(","coordinates":)"
          << features[i].coordinates << "}}";
    out << "]}";
    return path;
  }

  /// Two contours of a slope at 100 and 110 m.
  std::string contours(int epsg = 32632) {
    return file("contours", epsg,
                {{"LineString", "[[650000,5200000,100],[650100,5200000,100]]", ""},
                 {"LineString", "[[650000,5200050,110],[650100,5200050,110]]", ""}});
  }

  void ask(InputRole role, const std::string& path, const std::string& field = "") {
    request.layers.push_back({role, {path, field, 0}});
  }
};

/// The message of an error; empty: there was none.
template <class Function>
std::string error_of(const Function& function) {
  try {
    function();
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace talus::test
