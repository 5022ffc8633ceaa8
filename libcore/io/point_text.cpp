#include "io/point_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "base/column_text.hpp"
#include "base/error.hpp"
#include "base/text.hpp"

namespace talus {
namespace {

constexpr const char* names_hint =
    "a first line names the columns: x, y, z, or east, north, height";

std::array<int, 3> find_columns(const ColumnText& text) {
  return {find_column(text, {"x", "east", "easting", "e", "rechtswert", "xcoord", "pointx"}),
          find_column(text, {"y", "north", "northing", "n", "hochwert", "ycoord", "pointy"}),
          find_column(text, {"z", "height", "elevation", "elev", "h", "hoehe", "alt", "altitude",
                             "zcoord", "pointz"})};
}

// 1, 2, 3 ...: numbers of points, not coordinates.
bool is_running(const ColumnText& text) {
  if (text.rows.size() < 3) return false;
  double first = 0;
  for (std::size_t row = 0; row < text.rows.size(); ++row) {
    double value = 0;
    if (!parse_number(text, text.rows[row].front(), value)) return false;
    if (row == 0) first = value;
    if (value != first + static_cast<double>(row)) return false;
  }
  return true;
}

std::array<int, 3> choose_columns(const ColumnText& text) {
  const std::array<int, 3> named = find_columns(text);
  if (std::all_of(named.begin(), named.end(), [](int c) { return c >= 0; })) return named;
  if (!text.names.empty() && !text.names_in_remark)
    throw InputError({text.file}, "no columns of coordinates are among: " + list_of_names(text),
                     names_hint);
  if (text.rows.front().size() < 3)
    throw InputError({text.file, text.line.front()},
                     counted(static_cast<std::int64_t>(text.rows.front().size()), "column") +
                         ", expected x, y and z",
                     names_hint);
  if (text.rows.front().size() > 3 && is_running(text))
    throw InputError({text.file, text.line.front()},
                     "the first column holds running numbers, expected x, y, z", names_hint);
  return {0, 1, 2};
}

std::string taken_from(const ColumnText& text, const std::array<int, 3>& columns) {
  std::string words = "the first three columns as x, y, z";
  if (!text.names.empty()) {
    words = "columns";
    for (const int c : columns)
      words += (c == columns[0] ? " " : ", ") + text.names[static_cast<std::size_t>(c)];
  }
  const auto n_others = static_cast<std::int64_t>(text.rows.front().size()) - 3;
  return n_others > 0 ? words + "; " + counted(n_others, "other column") + " passed over" : words;
}

}  // namespace

bool is_point_text(const std::string& path) {
  const std::string extension = lower(std::filesystem::path(path).extension().string());
  for (const char* one : {".csv", ".xyz", ".txt", ".pts", ".dat", ".tsv"})
    if (extension == one) return true;
  return false;
}

PointText parse_points(const std::string& text, const std::string& file) {
  const ColumnText columns = parse_columns(text, file);
  const std::array<int, 3> chosen = choose_columns(columns);
  PointText found;
  found.taken_from = taken_from(columns, chosen);
  found.points.reserve(columns.rows.size());
  for (std::size_t row = 0; row < columns.rows.size(); ++row) {
    const std::vector<std::string>& words = columns.rows[row];
    Vec3 point = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto c = static_cast<std::size_t>(chosen[k]);
      const std::string word = c < words.size() ? words[c] : std::string();
      if (!parse_number(columns, word, point[static_cast<Eigen::Index>(k)]))
        throw InputError({file, columns.line[row]}, "\"" + word + "\" is no coordinate",
                         "each line is a point: x, y, z");
    }
    found.points.push_back(point);
  }
  return found;
}

}  // namespace talus
