#include "report/field_words.hpp"

#include <algorithm>
#include <span>
#include <string_view>
#include <utility>

namespace talus {
namespace {

using Words = std::pair<std::string_view, std::string_view>;

// Ends of names, longer ones first where one ends another.
constexpr Words units[] = {
    {"_rad_s", "rad/s"}, {"_m_s", "m/s"}, {"_1_m", "> 1 m"}, {"_20_m", "> 20 m"}, {"_per_a", "1/a"},
    {"_per_m", "1/m"},   {"_m2", "m2"},   {"_m3", "m3"},     {"_kj", "kJ"},       {"_kg", "kg"},
    {"_deg", "deg"},     {"_m", "m"},     {"_s", "s"},       {"_a", "a"}};

// Parts that stand behind a comma.
constexpr Words bounds[] = {
    {"p05", "5th percentile"},  {"p50", "median"},          {"p90", "90th percentile"},
    {"p95", "95th percentile"}, {"p99", "99th percentile"}, {"mean", "mean"},
    {"max", "largest"},         {"lo", "lower bound"},      {"hi", "upper bound"}};

constexpr Words parts[] = {{"ke", "kinetic energy"}, {"n", "number of"}, {"max", "largest"}};

// Names that say little by their parts.
constexpr Words whole[] = {{"L_path_m", "L along the path [m]"},
                           {"L_chord_m", "L in a straight line [m]"},
                           {"chord_length_m", "Length in a straight line [m]"},
                           {"reach_angle_chord_deg", "Reach angle in a straight line [deg]"},
                           {"z_m", "Elevation [m]"},
                           {"n", "Number of blocks"},
                           {"n_on_the_object", "Number on the object"},
                           {"p_hit", "Probability of a hit"},
                           {"p_class", "Probability of a hit, class"},
                           {"what", "Point"}};

std::string_view found(std::span<const Words> table, std::string_view part) {
  for (const auto& [key, words] : table)
    if (key == part) return words;
  return {};
}

}  // namespace

std::string field_words(const std::string& name) {
  if (const std::string_view words = found(whole, name); !words.empty()) return std::string(words);
  std::string_view rest = name;
  std::string_view unit;
  for (const auto& [end, words] : units)
    if (rest.size() > end.size() && rest.ends_with(end)) {
      unit = words;
      rest.remove_suffix(end.size());
      break;
    }
  std::string out;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('_'), rest.size());
    const std::string_view part = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (const std::string_view bound = found(bounds, part); !bound.empty() && !out.empty()) {
      out += ", " + std::string(bound);
      continue;
    }
    const std::string_view words = found(parts, part);
    out += (out.empty() ? "" : " ") + std::string(words.empty() ? part : words);
  }
  if (!out.empty() && out[0] >= 'a' && out[0] <= 'z') out[0] += 'A' - 'a';
  if (!unit.empty()) out += " [" + std::string(unit) + "]";
  return out;
}

}  // namespace talus
