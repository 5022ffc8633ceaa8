// tools/frame/vector_inputs.hpp
// Vector files that a site file names: read, and said which layer and how much of it was taken.
#pragma once

#include <string>

#include "io/contours_gdal.hpp"
#include "io/vectors_gdal.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

/// The options LAYER and WHERE of a vector source whose options begin with `prefix` ("--spots-").
void add_layer_options(Tool& tool, const std::string& prefix, const std::string& of,
                       LayerChoice& choice);

/// Further files that a data set named to the tool is made of (data_files.hpp) become
/// inputs: other bytes in any of them make another run. Call it before the data set is read.
void read_members(Tool& tool, const std::string& role, const std::string& path);
/// Tool::read_also() of a data set and of these.
void read_data(Tool& tool, const std::string& role, const std::string& path);

/// A sentence and an entry for programs on what was taken from the source `role`.
[[nodiscard]] std::string sentence_on(const LayerReading& taken);
[[nodiscard]] Json entry_on(const LayerReading& taken, const std::string& role);

/// Reads shapes for the key `role` of a site file ("source", "ground.scree", "fence.upper"). Says
/// layer, number and area on the terminal and in the result. Throws InputError as read_vectors().
[[nodiscard]] VectorShapes read_layer(Tool& tool, const std::string& role, const VectorQuery& query,
                                      const std::string& crs_wkt);

}  // namespace talus
