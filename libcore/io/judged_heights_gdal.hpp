// libcore/io/judged_heights_gdal.hpp: public
// Heights that a tool has judged: the terrain file names them by a digest, so that no later tool
// judges them again. Heights that were changed since have another digest, and are judged.
// in:    an elevation raster
// out:   whether its heights were judged; the doubts that the user accepted
#pragma once

#include <cstddef>
#include <string>

#include "base/sha256.hpp"
#include "terrain/grid_frame.hpp"

namespace talus {

/// Nodata of every terrain file.
inline constexpr double terrain_nodata = -9999;

/// Tags of a terrain file.
inline constexpr const char* judged_tag = "HEIGHTS_JUDGED";     ///< digest of the heights
inline constexpr const char* accepted_tag = "DOUBTS_ACCEPTED";  ///< places, in words

/// SHA-256 of the lattice and of the numbers in the file. The place on the map does not
/// count: a raster that is moved keeps its heights.
class HeightsDigest {
 public:
  HeightsDigest(int n_rows, int n_cols, double cell_size);
  void add(const double* stored, std::size_t n);  ///< row by row
  [[nodiscard]] std::string hex();

 private:
  Sha256 hash_;
};

/// Whether the raster has the digest of its own heights. Reads all of it where it has a digest.
/// Throws InputError when it cannot be opened.
[[nodiscard]] bool were_heights_judged(const std::string& path);

/// A tag of the raster; empty: none, or other heights than those that were judged. Throws
/// InputError when it cannot be opened.
[[nodiscard]] std::string tag_of_judged(const std::string& path, const char* name);

/// Places whose heights the user accepted, in words; empty: none, or other heights than those.
/// Throws InputError when it cannot be opened.
[[nodiscard]] std::string accepted_doubts(const std::string& path);

}  // namespace talus
