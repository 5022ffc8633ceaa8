// Reads lists of measured orientations as point clouds and stereonets write them.
#include "site/joint_list.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/column_text.hpp"
#include "base/error.hpp"
#include "base/text.hpp"
#include "base/units.hpp"
#include "blocks/joint_sets.hpp"

namespace talus {
namespace {

constexpr const char* names_hint =
    "a first line names them: Dip direction and Dip, Strike (Right) or Strike (Left) and Dip, or "
    "Trend and Plunge (of the pole)";
constexpr const char* number_hint =
    "write degrees clockwise from north: N45E is 45, S45W is 225; where a dip goes to is said by "
    "Strike (Right), Strike (Left) or Dip direction";

enum class Notation { direction_dip, strike_right_dip, strike_left_dip, trend_plunge };

const char* words_for(Notation notation) {
  switch (notation) {
    case Notation::strike_right_dip:
      return "strike, dip by the right-hand rule";
    case Notation::strike_left_dip:
      return "strike, dip by the left-hand rule";
    case Notation::trend_plunge:
      return "trend, plunge of poles";
    default:
      return "dip direction, dip";
  }
}

double around(double azimuth_deg) {
  const double rest = std::fmod(azimuth_deg, 360);
  return rest < 0 ? rest + 360 : rest;
}

constexpr double degrees_of_gon = 0.9;  // a full circle has 400 gon

void check_angle(const char* name, double angle, double highest, const Where& where) {
  if (angle >= 0 && angle <= highest) return;
  throw InputError(where,
                   std::string(name) + " is " + text(angle) + ", expected 0 to " + text(highest),
                   angle > highest && angle <= highest / degrees_of_gon
                       ? "if all are in gon: in a list name its columns Dip direction [gon] and "
                         "Dip [gon], in the site file write degrees (0.9 times the gon)"
                       : names_hint);
}

// --- words ---------------------------------------------------------------------------------------

// One angle: a number, with a degree sign if need be.
bool parse_angle(const ColumnText& list, std::string word, double& value) {
  for (const std::string_view sign : {"\xc2\xb0", "\xc2\xba", "\xb0", "\xba"})
    if (word.ends_with(sign)) word.resize(word.size() - sign.size());
  return parse_number(list, word, value);
}

// --- one orientation -----------------------------------------------------------------------------

Vec3 pole_by(Notation notation, double first, double second, const Where& where) {
  switch (notation) {
    case Notation::strike_right_dip:
    case Notation::strike_left_dip:
      check_angle("strike", first, 360, where);
      return checked_pole(around(first + (notation == Notation::strike_right_dip ? 90 : 270)),
                          second, where);
    case Notation::trend_plunge:
      check_angle("trend", first, 360, where);
      check_angle("plunge", second, 90, where);
      return checked_pole(around(first + 180), 90 - second, where);
    default:
      return checked_pole(first, second, where);
  }
}

Vec3 pole_of_pair(const ColumnText& list, Notation notation, const std::string& first,
                  const std::string& second, const Where& where) {
  double angles[2] = {};
  for (const int k : {0, 1}) {
    const std::string& word = k == 0 ? first : second;
    if (!parse_angle(list, word, angles[k]))
      throw InputError(where, "\"" + word + "\" is not a number", number_hint);
  }
  return pole_by(notation, angles[0], angles[1], where);
}

// --- lists with names ----------------------------------------------------------------------------

const std::vector<std::string> dip_names = {"dip",         "dipangle",     "truedip", "fallwinkel",
                                            "einfallen",   "inclinazione", "pendage", "buzamiento",
                                            "inclination", "fallen"};
const std::vector<std::string> direction_names = {
    "dipdirection",   "dipdir",           "dipazimuth",   "dipaz",      "ddr",
    "directionofdip", "einfallsrichtung", "fallrichtung", "immersione", "dirbuzamiento"};
const std::vector<std::string> right_names = {"strike",    "strikeright",    "striker",
                                              "strikerhr", "strikedipright", "strikerighthandrule",
                                              "streichen", "streichrichtung"};
const std::vector<std::string> left_names = {"strikeleft", "strikel", "strikelhr",
                                             "strikelefthandrule"};

// The unit is that in the brackets of a name: "Dip [gon]". Grad is a degree in German, and a gon in
// English.
double degrees_in_unit_of(const std::string& name, const ColumnText& list) {
  const std::size_t open = name.find_first_of("[("), close = name.find_first_of("])");
  if (open == std::string::npos || close == std::string::npos || close < open) return 1;
  const std::string unit = lower(name.substr(open + 1, close - open - 1));
  if (unit == "grad")
    throw InputError({list.file},
                     "column " + name + " has a unit of two meanings, 360 or 400 to the circle",
                     "write [deg] or [gon] in its name");
  return unit == "gon" || unit == "gradians" || unit == "neugrad" ? degrees_of_gon : 1;
}

// The word of a column in degrees.
std::string in_degrees(const ColumnText& list, const std::string& word, int column) {
  const double factor = degrees_in_unit_of(list.names[column], list);
  double value = 0;
  return factor != 1 && parse_number(list, word, value) ? text(factor * value) : word;
}

// Columns of the orientation.
struct NamedPair {
  Notation notation = Notation::direction_dip;
  int first = -1, second = -1;
};

NamedPair find_pair(const ColumnText& list) {
  const int dip = find_column(list, dip_names), direction = find_column(list, direction_names);
  const int right = find_column(list, right_names), left = find_column(list, left_names);
  const int trend = find_column(list, {"trend", "poletrend"});
  const int plunge = find_column(list, {"plunge", "poleplunge"});
  if (dip >= 0 && direction >= 0) return {Notation::direction_dip, direction, dip};
  if (dip >= 0 && left >= 0) return {Notation::strike_left_dip, left, dip};
  if (dip >= 0 && right >= 0) return {Notation::strike_right_dip, right, dip};
  if (trend >= 0 && plunge >= 0) return {Notation::trend_plunge, trend, plunge};
  return {};
}

std::array<int, 3> find_normal(const ColumnText& list) {
  const auto all = [&](const std::array<std::vector<std::string>, 3>& names) {
    return std::array{find_column(list, names[0]), find_column(list, names[1]),
                      find_column(list, names[2])};
  };
  return all({{{"normalx", "nx", "a"}, {"normaly", "ny", "b"}, {"normalz", "nz", "c"}}});
}

bool is_whole(const std::array<int, 3>& columns) {
  return std::all_of(columns.begin(), columns.end(), [](int c) { return c >= 0; });
}

const std::string& word_at(const ColumnText& list, std::size_t row, int column) {
  const std::vector<std::string>& words = list.rows[row];
  if (static_cast<std::size_t>(column) >= words.size() || words[column].empty())
    throw InputError({list.file, list.line[row]},
                     "there is nothing in column " + list.names[column],
                     "fill it in, or take the line out");
  return words[column];
}

Vec3 pole_of_normal(const ColumnText& list, std::size_t row, const std::array<int, 3>& columns) {
  Vec3 normal = Vec3::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string& word = word_at(list, row, columns[k]);
    if (!parse_number(list, word, normal[static_cast<Eigen::Index>(k)]))
      throw InputError({list.file, list.line[row]}, "\"" + word + "\" is not a number",
                       "a normal has three numbers");
  }
  if (!(normal.norm() > 0.5))
    throw InputError({list.file, list.line[row]}, "the normal has no length, expected 1");
  const Attitude plane = attitude(normal);
  return pole(plane.dip, plane.dip_direction);
}

// Number of joints that a line represents.
int quantity_of(const ColumnText& list, std::size_t row, int column) {
  if (column < 0) return 1;
  const std::string& word = word_at(list, row, column);
  double value = 0;
  if (parse_number(list, word, value) && value >= 1 && value <= 1000 && value == std::floor(value))
    return static_cast<int>(value);
  throw InputError({list.file, list.line[row]},
                   "the quantity is \"" + word + "\", expected a whole number of 1 to 1000");
}

std::string name_at(const ColumnText& list, int column) { return list.names[column]; }

OrientationList read_named(const ColumnText& list) {
  const NamedPair pair = find_pair(list);
  const std::array<int, 3> normal = find_normal(list);
  const bool by_normal = pair.first < 0 && is_whole(normal);
  if (pair.first < 0 && !by_normal)
    throw InputError({list.file}, "no columns of orientations are among: " + list_of_names(list),
                     names_hint);
  const int quadrant = find_column(list, {"quadrant", "dipquadrant", "quad", "dipquad"});
  if (quadrant >= 0 && pair.notation != Notation::direction_dip)
    throw InputError(
        {list.file},
        "column " + name_at(list, quadrant) + " says where strikes dip, which is not read",
        number_hint);
  const int quantity = find_column(list, {"quantity", "qty"});
  OrientationList found;
  found.is_computed = is_whole(normal);
  for (std::size_t row = 0; row < list.rows.size(); ++row) {
    const Where where{list.file, list.line[row]};
    Vec3 axis;
    if (by_normal) {
      axis = pole_of_normal(list, row, normal);
    } else {
      const auto angle_in = [&](int column) {
        return in_degrees(list, word_at(list, row, column), column);
      };
      axis = pole_of_pair(list, pair.notation, angle_in(pair.first), angle_in(pair.second), where);
    }
    found.poles.insert(found.poles.end(),
                       static_cast<std::size_t>(quantity_of(list, row, quantity)), axis);
  }
  std::string names = by_normal ? name_at(list, normal[0]) + ", " + name_at(list, normal[1]) +
                                      ", " + name_at(list, normal[2])
                                : name_at(list, pair.first) + ", " + name_at(list, pair.second);
  if (quantity >= 0) names += ", " + name_at(list, quantity);
  const int n_taken = (by_normal ? 3 : 2) + (quantity >= 0 ? 1 : 0);
  const auto n_others = static_cast<std::int64_t>(list.names.size()) - n_taken;
  found.taken_from = "columns " + names;
  if (!by_normal) found.taken_from += std::string(" (") + words_for(pair.notation) + ")";
  if (n_others > 0) found.taken_from += "; " + counted(n_others, "other column") + " passed over";
  return found;
}

// --- lists without names -------------------------------------------------------------------------

// 045/60 in one word, or two words, with any separator.
std::vector<std::string> pair_of_words(const ColumnText& list, std::size_t row) {
  std::vector<std::string> words = list.rows[row];
  const std::size_t mark = words.size() == 1 ? words[0].find_first_of("/,; \t") : std::string::npos;
  if (mark != std::string::npos) {
    const std::size_t second = words[0].find_first_not_of(" \t", mark + 1);
    if (second != std::string::npos) words = {words[0].substr(0, mark), words[0].substr(second)};
  }
  if (words.size() == 2) return words;
  throw InputError({list.file, list.line[row]},
                   std::to_string(words.size()) + " numbers, expected 2", names_hint);
}

// 60/045: an azimuth has three digits, a dip two.
bool looks_swapped(const std::vector<std::string>& pair) {
  const auto n_digits = [](const std::string& word) {
    return std::find_if_not(word.begin(), word.end(), [](char c) { return c >= '0' && c <= '9'; }) -
           word.begin();
  };
  return n_digits(pair[0]) == 2 && n_digits(pair[1]) == 3;
}

OrientationList read_pairs(const ColumnText& list) {
  OrientationList found;
  for (std::size_t row = 0; row < list.rows.size(); ++row) {
    const std::vector<std::string> pair = pair_of_words(list, row);
    if (looks_swapped(pair))
      throw InputError({list.file, list.line[row]},
                       "\"" + pair[0] + "\", \"" + pair[1] +
                           "\" look like dip, dip direction; expected dip direction, dip",
                       names_hint);
    found.poles.push_back(
        pole_of_pair(list, Notation::direction_dip, pair[0], pair[1], {list.file, list.line[row]}));
  }
  found.taken_from = "pairs of dip direction, dip";
  return found;
}

}  // namespace

bool may_be_radians(const OrientationList& list) {
  double steepest = 0, farthest = 0;
  for (const Vec3& axis : list.poles) {
    const Attitude plane = attitude(axis);
    steepest = std::max(steepest, plane.dip / degree);
    farthest = std::max(farthest, plane.dip_direction / degree);
  }
  constexpr double quarter = 90 * degree, circle = 360 * degree, level = 0.05, none = 1e-6;
  return !list.is_computed && list.poles.size() >= 3 && steepest > level &&
         steepest <= quarter + none && farthest <= circle + none;
}

Vec3 checked_pole(double direction_deg, double dip_deg, const Where& where) {
  check_angle("dip", dip_deg, 90, where);
  check_angle("dip direction", direction_deg, 360, where);
  return pole(dip_deg * degree, direction_deg * degree);
}

OrientationList read_orientations(const std::string& text, const std::string& file) {
  const ColumnText list = parse_columns(text, file);
  const bool has_names = !list.names.empty() && !list.names_in_remark;
  const bool names_tell = find_pair(list).first >= 0 || is_whole(find_normal(list));
  return has_names || names_tell ? read_named(list) : read_pairs(list);
}

}  // namespace talus
