// libcore/import/vector_dataset_gdal.hpp
// Opens any vector source by the name that people give it: archives are looked into, tables of
// points are read as a layer.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/source_path.hpp"

class GDALDataset;

namespace talus {

struct VectorDataset {
  std::shared_ptr<GDALDataset> dataset;
  std::vector<std::string> remarks;  ///< sentences: the member of an archive, columns of a table
  bool is_y_first = false;           ///< a table whose columns are called y and x, in this order
};

/// Throws InputError when the source cannot be opened, is an archive with several, or has a table
/// with more or fewer rows than shapes (Shapefile, MapInfo).
[[nodiscard]] VectorDataset open_vectors(const SourcePath& path);

}  // namespace talus
