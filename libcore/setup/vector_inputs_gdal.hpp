// libcore/setup/vector_inputs_gdal.hpp: public
// Vector files that a site file names: read, and said which layer and how much of it was taken.
#pragma once

#include <string>

#include "base/input_log.hpp"
#include "import/vectors_gdal.hpp"

namespace talus {

/// Further files that a data set is made of (data_files_gdal.hpp) become inputs: other bytes in any
/// of them make another run. Call it before the data set is read.
void read_members(InputLog& log, const std::string& role, const std::string& path);
/// InputLog::read_also() of a data set and of these.
void read_data(InputLog& log, const std::string& role, const std::string& path);

/// "1 polygon of 140 m2 in all", and facts for programs on the shapes taken from the source `role`.
[[nodiscard]] std::string parts_of(const LayerReading& taken);
[[nodiscard]] LayerRead facts_on(const LayerReading& taken, const std::string& role);

/// Reports the shapes passed over; the digest of those taken counts as read.
void note_shapes(InputLog& log, const VectorShapes& found);

/// Reads shapes for the key `role` of a site file ("source", "ground.scree", "fence.upper"). Says
/// them to the log. Throws InputError as read_vectors().
[[nodiscard]] VectorShapes read_layer(InputLog& log, const std::string& role,
                                      const VectorQuery& query, const std::string& crs_wkt);

}  // namespace talus
