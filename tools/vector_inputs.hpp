// tools/vector_inputs.hpp
// Vector files that a site file names: read, and said which layer and how much of it was taken.
#pragma once

#include <string>

#include "io/vectors_gdal.hpp"
#include "tool.hpp"

namespace talus {

/// Reads shapes for the key `role` of a site file ("source", "ground.scree", "fence.upper"). Says
/// layer, number and area on the terminal and in the result. Throws InputError as read_vectors().
[[nodiscard]] VectorShapes read_layer(Tool& tool, const std::string& role, const VectorQuery& query,
                                      const std::string& crs_wkt);

}  // namespace talus
