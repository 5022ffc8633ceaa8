// libcore/import/feature_tables_gdal.hpp: public
// Layers as tables of their attributes, and digests of their features.
// in:    a vector source
// out:   names and values as text
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace talus {

struct FeatureTable {
  struct Row {
    std::int64_t id = 0;
    std::vector<std::string> values;  ///< as text, numbers in full; empty: not set  (n_fields)
  };
  std::string layer;
  std::vector<std::string> fields;
  std::vector<Row> rows;
};

/// Names of all layers. Throws InputError when the source cannot be opened.
[[nodiscard]] std::vector<std::string> layers_of(const std::string& path);

/// Those of `layers` that the source has, in the order of `layers`. Throws InputError when it
/// cannot be opened or a layer has more than 100 000 features.
[[nodiscard]] std::vector<FeatureTable> read_feature_tables(const std::string& path,
                                                            const std::vector<std::string>& layers);

/// Digest of the coordinate system, the geometries and `attributes` of the features that `where`
/// lets through, in order; other attributes and the bytes of the file do not count. Throws
/// InputError.
[[nodiscard]] std::string digest_of_features(const std::string& path, const std::string& layer,
                                             const std::string& where,
                                             const std::vector<std::string>& attributes);

/// WKT of the system of a raster, or of the first layer of a vector source; empty where it says
/// none. Throws InputError when the source cannot be opened.
[[nodiscard]] std::string crs_of_source(const std::string& path);

}  // namespace talus
