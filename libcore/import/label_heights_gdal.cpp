// The part of import/raw_inputs_gdal.hpp that takes the heights of contours from labels beside
// them.
#include <gdal_priv.h>

#include <algorithm>

#include "base/column_text.hpp"
#include "base/source_path.hpp"
#include "base/text.hpp"
#include "base/thousands.hpp"
#include "import/drawing_unit_gdal.hpp"
#include "import/raw_inputs_gdal.hpp"
#include "io/crs_gdal.hpp"
#include "terrain/contour_labels.hpp"

namespace talus {
namespace {

// "1050" of "1050 m".
std::string without_metres(std::string words) {
  while (!words.empty() && (words.back() == 'm' || words.back() == ' ')) words.pop_back();
  return words;
}

// 1.010 and 1,010 may be 1.01 or 1010.
void check_thousands(const RawLayer& labels, const ThousandsDoubt& doubt) {
  if (!doubt.is_doubtful()) return;
  std::string whole = doubt.first();
  whole.erase(1, 1);
  throw InputError({labels.path()},
                   "labels say \"" + doubt.first() + "\", which may be " + doubt.first() +
                       " m or, with a sign between thousands, " + whole + " m",
                   "write them without the sign (field calculator of QGIS: replace(\"Text\", '.', "
                   "'')), or metres with two decimals, and name that layer with --labels");
}

std::vector<Vec3> labels_with_heights(const RawLayer& labels, std::vector<std::string>& notes) {
  std::vector<Vec3> found;
  ThousandsDoubt thousands;
  for (std::size_t i = 0; i < labels.lines.points.size(); ++i) {
    Vec3 label = labels.lines.points[i];
    std::string words = without_metres(labels.attributes[i].front());
    if (!parse_decimal(words, label.z())) continue;  // not the label of a height
    found.push_back(label);
    std::replace(words.begin(), words.end(), ',', '.');
    thousands.add(words);
  }
  check_thousands(labels, thousands);
  const std::size_t n_other = labels.lines.points.size() - found.size();
  notes.push_back(without_layer(labels.path()) + ": " +
                  counted(static_cast<std::int64_t>(found.size()), "label") + " of heights" +
                  (n_other > 0 ? "; " + counted(static_cast<std::int64_t>(n_other), "other text") +
                                     " passed over"
                               : std::string()));
  return found;
}

// Labels are beside the lines only where both are in one system and one unit.
void check_labels_beside(const RawLayer& contours, const RawLayer& labels) {
  if (!contours.own_crs.empty() && !labels.own_crs.empty() &&
      !same_crs(contours.own_crs, labels.own_crs))
    throw InputError({labels.path()},
                     "the labels are in " + crs_name(labels.own_crs) + ", the contours in " +
                         crs_name(contours.own_crs) + ", expected one CRS",
                     "take them there: ogr2ogr -t_srs " + crs_code(contours.own_crs) +
                         " labels.gpkg " + command_words(labels.path()));
  const DrawingUnit drawn = drawing_unit(contours.source.dataset->GetDescription());
  const DrawingUnit written = drawing_unit(labels.source.dataset->GetDescription());
  if (drawn.metres > 0 && written.metres > 0 && drawn.metres != written.metres)
    throw InputError({labels.path()},
                     "the labels are drawn in " + written.name + ", the contours in " + drawn.name +
                         ", expected one unit",
                     "bring the drawings to one unit first");
}

std::string where_line(const Polylines& lines, int line) {
  const Vec3& p = lines.points[lines.begin[line]];
  return "feature " + std::to_string(lines.feature[line]) + ", x " + text(p.x(), 10) + ", y " +
         text(p.y(), 10);
}

void check_labelled(const std::string& path, const Polylines& lines, const LabelledLines& found) {
  if (found.line_at_two >= 0)
    throw InputError({path},
                     "one contour has the labels " + text(found.two_heights[0], 8) + " and " +
                         text(found.two_heights[1], 8) +
                         " m: " + where_line(lines, found.line_at_two),
                     "move the label that belongs to another line, or part the lines there");
  if (found.without.empty()) return;
  const std::string unclear =
      found.unclear.empty()
          ? std::string()
          : "; " + counted(static_cast<std::int64_t>(found.unclear.size()), "label") +
                " between two contours";
  throw InputError({path},
                   std::to_string(found.without.size()) + " of " +
                       counted(lines.n_lines(), "contour") + " have no label, the first " +
                       where_line(lines, found.without.front()) + unclear,
                   "give each contour a label, or leave such contours in another layer");
}

// A Z that tells the lines apart must agree with their labels.
void check_z_beside_labels(const RawLayer& contours, const std::string& path,
                           const std::vector<double>& heights) {
  const HeightRange z = heights_of(contours.lines);
  if (!contours.has_z || contours.n_no_number > 0 || z.high - z.low <= same_height_m) return;
  for (std::size_t l = 0; l < heights.size(); ++l) {
    const double own = contours.lines.points[contours.lines.begin[l]].z();
    if (!differ(own, heights[l])) continue;
    throw InputError({path},
                     "the label says " + text(heights[l], 8) + ", the Z of the contour " +
                         text(own, 8) + ": " + where_line(contours.lines, static_cast<int>(l)),
                     "leave --labels away where Z is right");
  }
}

}  // namespace

void take_heights_of_labels(RawLayer& contours, RawLayer& labels, RawInputs& raw) {
  std::vector<std::string>& notes = raw.reading.notes;
  Polylines& lines = contours.lines;
  check_labels_beside(contours, labels);
  const LabelledLines found = heights_from_labels(lines, labels_with_heights(labels, notes));
  check_labelled(labels.path(), lines, found);
  check_z_beside_labels(contours, labels.path(), found.height);
  if (!found.unclear.empty())
    notes.push_back(without_layer(labels.path()) + ": " +
                    counted(static_cast<std::int64_t>(found.unclear.size()), "label") +
                    " between two contours passed over");
  for (std::size_t l = 0; l < found.height.size(); ++l)
    for (int i = lines.begin[l]; i < lines.begin[l + 1]; ++i) lines.points[i].z() = found.height[l];
  contours.taken.elevation_from = labels.taken.elevation_from = "labels";
  contours.decide("heights", "labels", "--labels");
  labels.lines = {};  // they have no place of their own
}

}  // namespace talus
