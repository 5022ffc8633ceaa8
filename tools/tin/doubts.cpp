#include "tools/tin/doubts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text.hpp"
#include "terrain/elevation.hpp"
#include "terrain/mend_meetings.hpp"

namespace talus {
namespace {

constexpr const char* mended = "mended";
constexpr const char* refused = "refused";
constexpr const char* in_doubt = "in doubt";

double height_of(const ContourMap& map, int line) {
  const auto first = map.contours.begin[line];
  return map.contours.points[first].z() + map.origin.z();
}

std::int64_t feature_of(const ContourMap& map, int line) { return map.contours.feature[line]; }

DoubtRow row_at(const ContourMap& map, int line, const Vec2& place) {
  DoubtRow row;
  row.feature = feature_of(map, line);
  row.place = Vec3(place.x() + map.origin.x(), place.y() + map.origin.y(), height_of(map, line));
  return row;
}

void add_rows(const ContourMap& map, const Mending& mending, std::vector<DoubtRow>& rows) {
  for (const Meeting& meeting : mending.meetings) {
    DoubtRow row = row_at(map, meeting.line_a, meeting.place);
    row.what = "contours meet";
    row.expected_low = row.expected_high = height_of(map, meeting.line_b);
    row.outcome = meeting.is_mended ? mended : "not mended";
    rows.push_back(std::move(row));
  }
  for (const MovedPoint& moved : mending.moved) {
    DoubtRow row = row_at(map, moved.line, moved.to);
    row.what = "contour moved";
    row.expected_low = row.expected_high = row.place.z();
    row.moved = (moved.to - moved.from).norm();
    row.outcome = mended;
    rows.push_back(std::move(row));
  }
}

void add_rows(const ContourMap& map, const std::vector<HeightConflict>& conflicts,
              std::vector<DoubtRow>& rows) {
  for (const HeightConflict& conflict : conflicts) {
    if (conflict.a == "contour" && conflict.b == "contour") continue;  // a row of the mending
    DoubtRow row;
    row.what = conflict.b + " meets " + conflict.a;
    row.place = conflict.place_b + map.origin;
    row.expected_low = row.expected_high = conflict.place_a.z() + map.origin.z();
    row.outcome = "not mended";
    rows.push_back(std::move(row));
  }
}

bool have_contours(const std::vector<HeightConflict>& conflicts) {
  return std::any_of(conflicts.begin(), conflicts.end(), [](const HeightConflict& conflict) {
    return conflict.a == "contour" && conflict.b == "contour";
  });
}

[[noreturn]] void refuse_meetings(const ContourMap& map, const HeightConflict& first,
                                  const DoubtOptions& options, double tolerance,
                                  const std::vector<DoubtRow>& rows) {
  const auto n = std::count_if(rows.begin(), rows.end(),
                               [](const DoubtRow& row) { return row.outcome == "not mended"; });
  const std::string more = n > 1 ? ", and so in " + std::to_string(n - 1) + " more places" : "";
  const std::string apart =
      tolerance > 0 ? "moving points by " + text(tolerance, 3) + " m does not bring them apart; "
                    : std::string();
  throw InputError(
      {map.source},
      describe(first, map.origin) + more + "; expected lines of different height to stay apart",
      apart +
          (options.layer.empty() ? std::string("--doubts places.gpkg writes all places")
                                 : "all places are in " + options.layer) +
          "; mend the lines there, take wrong ones out, or give the map's own "
          "accuracy in metres with --tolerance-m");
}

Json as_json(const Mending& mending, double tolerance, bool is_given) {
  const auto n = std::count_if(mending.meetings.begin(), mending.meetings.end(),
                               [](const Meeting& meeting) { return meeting.is_mended; });
  return {{"tolerance_m", tolerance},
          {"tolerance_from", is_given ? "--tolerance-m" : "bends of the contours"},
          {"n_meetings", mending.meetings.size()},
          {"n_mended", n},
          {"n_points_moved", mending.moved.size()},
          {"largest_move_m", mending.largest_move}};
}

Json as_json(const DoubtRow& row) {
  Json json = {{"kind", row.what}};
  if (row.feature >= 0) json["feature"] = row.feature;
  json["height_m"] = row.place.z();
  json["at"] = {row.place.x(), row.place.y()};
  if (!std::isnan(row.expected_low))
    json["contours_beside_m"] = {row.expected_low, row.expected_high};
  json["outcome"] = row.outcome;
  return json;
}

std::string sentence_on(const DoubtRow& row) {
  const std::string place =
      row.what + " at " + text(row.place.z(), 8) + " m" +
      (row.feature >= 0 ? ", feature " + std::to_string(row.feature) : std::string()) + ", x " +
      text(row.place.x(), 10) + ", y " + text(row.place.y(), 10);
  if (std::isnan(row.expected_low))
    return place + ": no land lies below " + text(lowest_land) + " m; is its height right?";
  const std::string beside = row.expected_low == row.expected_high
                                 ? text(row.expected_low, 8)
                                 : text(row.expected_low, 8) + " to " + text(row.expected_high, 8);
  return place + ": " + (row.what == "point" ? "the points" : "the contours") +
         " beside it stand at " + beside + " m; is its height right?";
}

bool is_doubt(const DoubtRow& row) { return row.outcome == in_doubt || row.outcome == refused; }

}  // namespace

CleanLines clean_or_mend(Tool& tool, const DoubtOptions& options, ContourMap& map,
                         std::vector<DoubtRow>& rows, Json& report) {
  std::vector<HeightConflict> conflicts;
  std::optional<CleanLines> clean = try_clean_lines(map, conflicts);
  if (clean) return std::move(*clean);
  const HeightConflict first = conflicts.front();
  const bool is_given = !std::isnan(options.tolerance_m);
  const double tolerance = is_given ? options.tolerance_m : accuracy_of_lines(map.contours);
  if (have_contours(conflicts)) {
    const Mending mending = mend_meetings(tolerance, map);
    add_rows(map, mending, rows);
    report["meetings"] = as_json(mending, tolerance, is_given);
    conflicts.clear();
    clean = try_clean_lines(map, conflicts);
    if (clean) {
      tool.warn("contours of different heights met in " +
                counted(static_cast<std::int64_t>(mending.meetings.size()), "place") + ": " +
                counted(static_cast<std::int64_t>(mending.moved.size()), "point") +
                " moved by at most " + text(mending.largest_move, 3) + " m, tolerance " +
                text(tolerance, 3) + " m (" +
                (is_given ? "--tolerance-m" : "nine in ten bends of the contours are larger") +
                ")" + (options.layer.empty() ? "; --doubts places.gpkg writes them" : ""));
      return std::move(*clean);
    }
  }
  add_rows(map, conflicts, rows);
  write_doubts(tool, options.layer, map.crs_wkt, rows);
  refuse_meetings(map, conflicts.empty() ? first : conflicts.front(), options, tolerance, rows);
}

std::vector<DoubtRow> rows_below_land(const ContourMap& map) {
  std::vector<DoubtRow> rows;
  const auto add = [&](const char* what, std::int64_t feature, const Vec3& point) {
    if (point.z() + map.origin.z() >= lowest_land) return;
    DoubtRow row;
    row.what = what, row.feature = feature, row.place = point + map.origin, row.outcome = refused;
    rows.push_back(std::move(row));
  };
  const auto add_lines = [&](const char* what, const Polylines& lines) {
    for (std::size_t l = 0; l + 1 < lines.begin.size(); ++l) {
      const auto begin = lines.points.begin() + lines.begin[l];
      const auto end = lines.points.begin() + lines.begin[l + 1];
      add(what, lines.feature[l], *std::min_element(begin, end, [](const Vec3& a, const Vec3& b) {
            return a.z() < b.z();
          }));
    }
  };
  add_lines("contour", map.contours);
  add_lines("breakline", map.breaklines);
  for (const Vec3& spot : map.spots) add("spot height", -1, spot);
  return rows;
}

std::vector<DoubtRow> rows_of(const std::vector<Outlier>& outliers, const LineFeatures& features,
                              const Vec3& origin) {
  std::vector<DoubtRow> rows;
  for (const Outlier& outlier : outliers) {
    const auto line = static_cast<std::size_t>(outlier.line);
    const std::size_t n_contours = features.contours.size();
    DoubtRow row;
    row.what = "spot height";
    if (line < n_contours) {
      row.what = "contour";
      row.feature = features.contours[line];
    } else if (line < n_contours + features.breaklines.size()) {
      row.what = "breakline";
      row.feature = features.breaklines[line - n_contours];
    }
    row.place = outlier.place + origin;
    row.expected_low = outlier.low + origin.z();
    row.expected_high = outlier.high + origin.z();
    row.outcome = outlier.is_impossible ? refused : in_doubt;
    rows.push_back(std::move(row));
  }
  return rows;
}

Json say_doubts(Tool& tool, const DoubtOptions& options, const std::string& source,
                const std::string& crs_wkt, std::vector<DoubtRow>& rows) {
  constexpr std::int64_t most_said = 10;
  Json json = Json::array();
  std::string first;
  std::int64_t n_refused = 0, n_doubts = 0;
  for (DoubtRow& row : rows) {
    if (!is_doubt(row)) continue;
    if (row.outcome == refused && n_refused++ == 0) first = sentence_on(row);
    if (row.outcome == refused && options.accept) row.outcome = "accepted";
    if (++n_doubts <= most_said) tool.warn(sentence_on(row));
    json.push_back(as_json(row));
  }
  if (n_doubts > most_said)
    tool.warn(std::to_string(n_doubts - most_said) +
              " more heights are in doubt; --report and --doubts list them all");
  write_doubts(tool, options.layer, crs_wkt, rows);
  if (n_refused == 0 || options.accept) return json;
  throw InputError({source}, counted(n_refused, "height") + " cannot be; the first: " + first,
                   std::string("mend it in the map, or go on with --accept-doubts (make "
                               "TIN_FLAGS=--accept-doubts); ") +
                       (options.layer.empty() ? "--doubts places.gpkg writes all places"
                                              : "all places are in " + options.layer));
}

}  // namespace talus
