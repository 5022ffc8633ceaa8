// libcore/terrain/contours.hpp: public
// A contour map as plain data, and its cleaning: lines that meet at one height are joined and
// counted, lines that meet at two heights are refused with the place.
// in:    lines read by import/import_inputs_gdal
// out:   points and segments that a constrained triangulation can take as they are
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/types.hpp"

namespace talus {

/// Heights nearer than this are one height: no map states millimetres [m].
inline constexpr double same_height_m = 1e-3;

/// Polylines in one array: line l has the points begin[l] to begin[l + 1] - 1.
struct Polylines {
  std::vector<Vec3> points;           ///< relative to the map's origin [m]    (n_points)
  std::vector<int> begin = {0};       ///< first point of each line             (n_lines + 1)
  std::vector<std::int64_t> feature;  ///< id in the source, for messages       (n_lines)
  [[nodiscard]] int n_lines() const { return static_cast<int>(begin.size()) - 1; }
};

/// A ring of a boundary polygon, closed without repeating its first point. A point is inside a
/// polygon if an odd number of its rings encloses it: a ring in a ring is a hole.
struct BoundaryRing {
  int polygon = 0;           ///< rings of one polygon follow each other
  std::vector<Vec2> points;  ///< relative to the map's origin [m]
};

/// All that a map may hold.
struct ContourMap {
  std::string source;                  ///< file of the contours, for messages
  std::string crs_wkt;                 ///< projected, metres; empty when unknown
  Vec3 origin = Vec3::Zero();          ///< map coordinates of the local zero [m]
  Polylines contours;                  ///< each line at one height
  Polylines breaklines;                ///< height by point
  std::vector<Vec3> spots;             ///< spot heights, relative to `origin` [m]
  std::vector<BoundaryRing> boundary;  ///< polygons, which may overlap; none: no boundary
};

/// Faults that cleaning found and mended.
struct CleaningCounts {
  std::size_t duplicate_points = 0;    ///< points on another point at the same height
  std::size_t duplicate_segments = 0;  ///< segments digitised twice
  std::size_t touches = 0;             ///< points on another line at the same height
  std::size_t crossings = 0;           ///< crossings of two lines at the same height
  std::size_t single_points = 0;       ///< lines of one distinct point, kept as a point
  std::size_t breakline_meetings =
      0;  ///< breakline or spot height on a contour: the contour's height taken
  std::size_t measured_apart = 0;         ///< breaklines and spot heights that meet at two heights
  double measured_apart_m = 0;            ///< largest difference among them [m]
  Vec3 measured_apart_at = Vec3::Zero();  ///< and its place [m]
};

/// Lines that meet at their ends only. The points of contours come first.
struct CleanLines {
  std::vector<Vec3> points;                  ///< distinct in x, y, relative to the origin [m]
  std::vector<std::array<int, 2>> segments;  ///< indices into `points`, each pair once
  std::vector<int> line;     ///< of each point: contours, then breaklines, then spots (n_points)
  int n_contour_points = 0;  ///< points from here on are of breaklines and spots
  CleaningCounts counts;
};

/// Distinct heights of the contours, rising [m above the origin].
[[nodiscard]] std::vector<double> contour_levels(const ContourMap& map);

/// Vertical distance of neighbouring contours: median step between the distinct heights [m];
/// 0 when there are fewer than two heights.
[[nodiscard]] double contour_interval(const ContourMap& map);

/// Takes the contours at every `every`-th height (>= 2) out of the map and returns their points,
/// for comparison with the terrain made from the rest. The highest contours always stay.
[[nodiscard]] std::vector<Vec3> hold_back_contours(int every, ContourMap& map);

/// Throws InputError when the contours have fewer than two heights: they make no slope.
void check_heights(const ContourMap& map);

/// Joins and counts lines that meet at the same height (within same_height_m). A breakline or spot
/// height that meets a contour within half a contour interval takes the contour's height there.
/// Throws InputError, with the place in map coordinates and both heights, where lines meet or
/// points coincide at different heights.
[[nodiscard]] CleanLines clean_lines(const ContourMap& map);

/// Where lines meet, or points coincide, at different heights.
struct HeightConflict {
  std::string a, b;                                     ///< "contour", "breakline" or "spot height"
  Vec3 place_a = Vec3::Zero(), place_b = Vec3::Zero();  ///< of either; one place in plan [m]
};

/// The same; where heights differ, nothing, and the places that were found before lines could not
/// be split any further.
[[nodiscard]] std::optional<CleanLines> try_clean_lines(const ContourMap& map,
                                                        std::vector<HeightConflict>& conflicts);

/// "contour at 100 m meets spot height at 109 m at x 1, y 2", in map coordinates.
[[nodiscard]] std::string describe(const HeightConflict& conflict, const Vec3& origin);

/// Gives back the memory of the lines; origin, CRS and boundary stay.
void forget_lines(ContourMap& map);

}  // namespace talus
