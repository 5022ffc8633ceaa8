// Doubts about heights and meetings of lines of a contour map.
#include "tools/tin/doubts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text.hpp"
#include "terrain/elevation.hpp"
#include "terrain/mend_meetings.hpp"

namespace talus {
namespace {

constexpr const char* way_out =
    "mend it in the map, or go on with --accept-doubts (make TIN_FLAGS=--accept-doubts)";
constexpr const char* way_out_of_meetings =
    "mend the lines there, take wrong ones out, or give the map's own accuracy in metres with "
    "--tolerance-m";

double height_of(const ContourMap& map, int line) {
  return map.contours.points[map.contours.begin[line]].z() + map.origin.z();
}

Doubt doubt_at(const ContourMap& map, int line, const Vec2& place) {
  Doubt doubt;
  doubt.where.file = map.source;
  doubt.feature = map.contours.feature[line];
  doubt.value = height_of(map, line);
  doubt.at = {Vec3(place.x() + map.origin.x(), place.y() + map.origin.y(), doubt.value)};
  return doubt;
}

// "moved apart by up to 1.3 m, tolerance 2.1 m"
std::string outcome_of(const Mending& mending, double tolerance, const std::string& from) {
  return "moved apart by up to " + text(mending.largest_move, 3) + " m, tolerance " +
         text(tolerance, 3) + " m, from " + from;
}

std::vector<Doubt> doubts_of(const ContourMap& map, const Mending& mending,
                             const std::string& outcome) {
  std::vector<Doubt> doubts;
  for (const Meeting& meeting : mending.meetings) {
    Doubt doubt = doubt_at(map, meeting.line_a, meeting.place);
    doubt.what = "meeting contour";
    doubt.low = doubt.high = height_of(map, meeting.line_b);
    doubt.found = "meets contour at " + text(doubt.low, 8) + " m";
    if (meeting.is_mended) doubt.found += "; " + outcome;
    doubt.expected = meeting.is_mended ? "" : "lines of different height to stay apart";
    doubt.hint = meeting.is_mended ? "" : way_out_of_meetings;
    doubt.state = meeting.is_mended ? DoubtState::mended : DoubtState::refused;
    doubts.push_back(std::move(doubt));
  }
  for (const MovedPoint& moved : mending.moved) {
    Doubt doubt = doubt_at(map, moved.line, moved.to);
    doubt.what = "moved point";
    doubt.value = (moved.to - moved.from).norm();
    doubt.found = "moved by " + text(doubt.value, 3) + " m";
    doubt.state = DoubtState::mended;
    doubts.push_back(std::move(doubt));
  }
  return doubts;
}

// Contours that meet are doubts of their mending.
std::vector<Doubt> doubts_of(const ContourMap& map, const std::vector<HeightConflict>& conflicts,
                             bool with_contours) {
  std::vector<Doubt> doubts;
  for (const HeightConflict& conflict : conflicts) {
    if (!with_contours && conflict.a == "contour" && conflict.b == "contour") continue;
    Doubt doubt;
    doubt.where.file = map.source;
    doubt.what = "meeting " + conflict.b;
    doubt.at = {conflict.place_b + map.origin};
    doubt.value = doubt.at[0].z();
    doubt.low = doubt.high = conflict.place_a.z() + map.origin.z();
    doubt.found = "meets " + conflict.a + " at " + text(doubt.low, 8) + " m";
    doubt.expected = "lines of different height to stay apart";
    doubt.hint = way_out_of_meetings;
    doubt.state = DoubtState::refused;
    doubts.push_back(std::move(doubt));
  }
  return doubts;
}

bool have_contours(const std::vector<HeightConflict>& conflicts) {
  return std::any_of(conflicts.begin(), conflicts.end(), [](const HeightConflict& conflict) {
    return conflict.a == "contour" && conflict.b == "contour";
  });
}

Json as_json(const Mending& mending, double tolerance, const std::string& from) {
  const auto n = std::count_if(mending.meetings.begin(), mending.meetings.end(),
                               [](const Meeting& meeting) { return meeting.is_mended; });
  return {{"tolerance_m", tolerance},
          {"tolerance_from", from},
          {"n_meetings", mending.meetings.size()},
          {"n_mended", n},
          {"n_points_moved", mending.moved.size()},
          {"largest_move_m", mending.largest_move}};
}

}  // namespace

CleanLines clean_or_mend(Tool& tool, const TinDoubtOptions& options, ContourMap& map,
                         Json& report) {
  std::vector<HeightConflict> conflicts;
  std::optional<CleanLines> clean = try_clean_lines(map, conflicts);
  if (clean) return std::move(*clean);
  std::vector<Doubt> doubts;
  std::string apart;
  if (have_contours(conflicts)) {
    const bool is_given = !std::isnan(options.tolerance_m);
    const double tolerance = is_given ? options.tolerance_m : accuracy_of_lines(map.contours);
    const std::string from = is_given ? "--tolerance-m" : "bends of the contours";
    const Mending mending = mend_meetings(tolerance, map);
    doubts = doubts_of(map, mending, outcome_of(mending, tolerance, from));
    report["meetings"] = as_json(mending, tolerance, from);
    conflicts.clear();
    clean = try_clean_lines(map, conflicts);
    if (tolerance > 0)
      apart = "moving points by " + text(tolerance, 3) + " m does not bring them apart; ";
  }
  const bool is_listed = refusal_of(doubts).state == DoubtState::refused;
  if (!clean)
    for (Doubt& doubt : doubts_of(map, conflicts, !is_listed)) doubts.push_back(std::move(doubt));
  for (Doubt& doubt : doubts)
    if (doubt.state == DoubtState::refused) doubt.hint = apart + doubt.hint;
  DoubtOptions nothing_accepted = options;
  nothing_accepted.accept = false;
  static_cast<void>(judge(tool, nothing_accepted, std::move(doubts)));
  return std::move(*clean);
}

Doubt height_doubt(const std::string& source, const char* what, const Vec3& place, double low,
                   double high, bool is_impossible) {
  Doubt doubt;
  doubt.where.file = source;
  doubt.what = what;
  doubt.at = {place};
  doubt.value = place.z();
  doubt.low = low, doubt.high = high;
  doubt.expected =
      (low == high ? text(low, 8) : text(low, 8) + " to " + text(high, 8)) + " m, as beside it";
  doubt.hint = way_out;
  doubt.state = is_impossible ? DoubtState::refused : DoubtState::in_doubt;
  return doubt;
}

std::vector<Doubt> doubts_below_land(const ContourMap& map, const LineFeatures& features,
                                     const char* of_points) {
  std::vector<Doubt> doubts;
  const auto add = [&](const std::string& file, const char* what, std::int64_t feature,
                       const Vec3& point) {
    if (point.z() + map.origin.z() >= lowest_land) return;
    Doubt doubt = height_doubt(file, what, point + map.origin, lowest_land, Doubt::none, true);
    doubt.feature = feature;
    doubt.expected = text(lowest_land) + " m or more: no land lies lower";
    doubts.push_back(std::move(doubt));
  };
  const auto add_lines = [&](const std::string& file, const char* what, const Polylines& lines) {
    for (std::size_t l = 0; l + 1 < lines.begin.size(); ++l) {
      const auto begin = lines.points.begin() + lines.begin[l];
      const auto end = lines.points.begin() + lines.begin[l + 1];
      add(file, what, lines.feature[l],
          *std::min_element(begin, end,
                            [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); }));
    }
  };
  add_lines(features.contour_file, "contour", map.contours);
  add_lines(features.breakline_file, "breakline", map.breaklines);
  for (const Vec3& spot : map.spots) add(features.spot_file, of_points, -1, spot);
  return doubts;
}

std::vector<Doubt> doubts_of(const std::vector<Outlier>& outliers, const LineFeatures& features,
                             const Vec3& origin) {
  std::vector<Doubt> doubts;
  const auto n_contours = static_cast<std::int64_t>(features.contours.size());
  for (const Outlier& outlier : outliers) {
    const Vec3 place = outlier.place + origin;
    if (place.z() < lowest_land) continue;
    const auto add = [&](const std::string& file, const char* what, std::int64_t feature) {
      doubts.push_back(height_doubt(file, what, place, outlier.low + origin.z(),
                                    outlier.high + origin.z(), outlier.is_impossible));
      doubts.back().feature = feature;
    };
    const std::int64_t line = outlier.line, breakline = line - n_contours;
    if (line < n_contours)
      add(features.contour_file, "contour", features.contours[line]);
    else if (breakline < std::ssize(features.breaklines))
      add(features.breakline_file, "breakline", features.breaklines[breakline]);
    else
      add(features.spot_file, "spot height", -1);
  }
  return doubts;
}

}  // namespace talus
