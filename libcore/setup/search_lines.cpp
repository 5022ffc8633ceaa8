// Candidate lines of [fence_search.*], the same in every tool.
#include "setup/search_lines.hpp"

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "base/units.hpp"
#include "base/words.hpp"
#include "setup/fence_candidates.hpp"

namespace talus {
namespace {

Where where_of_search(const Site& site, const FenceSearchSettings& search) {
  return {site.file, search.line, "fence_search." + search.name};
}

void check_ascending(const Site& site, const FenceSearchSettings& search, const char* key,
                     const std::vector<double>& values) {
  if (std::is_sorted(values.begin(), values.end()) &&
      std::adjacent_find(values.begin(), values.end()) == values.end())
    return;
  throw InputError(where_of(site, "fence_search." + search.name + "." + key),
                   std::string(key) + " does not ascend", "give each value once, the least first");
}

void check_settings(const Site& site, const FenceSearchSettings& search) {
  const std::string& name = search.name;
  const bool is_plain = std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-';
  });
  if (!is_plain)
    throw InputError(where_of_search(site, search), "has a name that no file can have everywhere",
                     "use letters, digits, - and _");
  if (!(search.between_m[0] < search.between_m[1]))
    throw InputError(where_of(site, "fence_search." + name + ".between_m"),
                     "between_m is [" + text(search.between_m[0]) + ", " +
                         text(search.between_m[1]) + "]: there is no room between these",
                     "give the nearest distance from the object first, then the farthest");
  check_ascending(site, search, "heights_m", search.heights_m);
  check_ascending(site, search, "classes_kj", search.classes_kj);
  if (!search.prices_per_m.empty() && !search.classes_kj.empty() &&
      search.prices_per_m.size() != search.classes_kj.size())
    throw InputError(where_of(site, "fence_search." + name + ".prices_per_m"),
                     "has " +
                         counted(static_cast<std::int64_t>(search.prices_per_m.size()), "price") +
                         " for " + std::to_string(search.classes_kj.size()) + " classes",
                     "give one price for each of classes_kj");
}

// Why a line is not found, and the remedy.
[[noreturn]] void refuse_no_room(const Site& site, const FenceSearchSettings& search,
                                 const FenceCandidates& found, double least_length) {
  const std::string between = text(search.between_m[0]) + " to " + text(search.between_m[1]) +
                              " m from object " + search.protect;
  if (found.n_in_zone == 0)
    throw InputError(where_of_search(site, search),
                     "has no room: no known ground " + between + " is higher than the object",
                     "raise the second number of between_m, or make the terrain larger");
  throw InputError(
      where_of_search(site, search),
      "has no room: no line " + between + " is " + text(least_length) + " m long (" +
          std::to_string(found.n_too_short) + " are shorter; slopes end lines at " +
          counted(found.n_cut, "place") + ")",
      "raise max_line_slope_deg or max_ground_slope_deg, lower min_fields, end_fields or step_m, "
      "or take the other style");
}

}  // namespace

int protected_object(const Site& site, const FenceSearchSettings& search) {
  std::vector<std::string> names;
  for (const ObjectSettings& object : site.objects) names.push_back(object.name);
  const auto found = std::find(names.begin(), names.end(), search.protect);
  if (!search.protect.empty() && found != names.end())
    return static_cast<int>(found - names.begin());
  if (names.empty())
    throw InputError(where_of_search(site, search), "has no object to protect: the site has none",
                     "add [object.NAME] with its polygon, line or position_m, and protect = "
                     "\"NAME\"");
  const std::string nearest = nearest_name(search.protect, names);
  throw InputError(where_of_search(site, search),
                   search.protect.empty()
                       ? "does not say what it protects"
                       : "protects \"" + search.protect + "\", which is not an object",
                   (nearest.empty() ? std::string() : "did you mean " + nearest + "? ") +
                       "protect names an [object.*]: " + list_of(names));
}

SearchCandidates search_candidates(InputLog& log, const Site& site, const Trn& trn,
                                   const FenceSearchSettings& search,
                                   const std::vector<RecordObject>& objects) {
  check_settings(site, search);
  const RecordObject& object = objects[protected_object(site, search)];
  CandidateSettings settings;
  settings.nearest = search.between_m[0];
  settings.farthest = search.between_m[1];
  settings.step = search.step_m;
  settings.by_contours = search.style == "contour";
  settings.most = static_cast<int>(search.max_candidates);
  settings.spacing = search.post_spacing_m;
  settings.least_length =
      search.post_spacing_m *
      static_cast<double>(std::max(search.min_fields, 2 * search.end_fields + 1));
  settings.line_slope = std::tan(search.max_line_slope_deg * degree);
  settings.ground_slope = std::tan(search.max_ground_slope_deg * degree);
  const FenceCandidates found = fence_candidates(trn, object, settings);
  if (found.lines.empty()) refuse_no_room(site, search, found, settings.least_length);
  if (found.step > search.step_m)
    log.warn("fence_search." + search.name + ": candidate lines stand " + text(found.step, 3) +
             " m apart instead of " + text(search.step_m) + ": no more than max_candidates, " +
             std::to_string(search.max_candidates) + ", are watched");
  SearchCandidates out;
  out.step = found.step;
  for (std::size_t i = 0; i < found.lines.size(); ++i)
    out.lines.push_back(
        record_line(std::string(candidate_prefix) + search.name + "." + std::to_string(i + 1),
                    posts_on_ground(trn, found.lines[i], 1.001 * search.post_spacing_m,
                                    where_of_search(site, search))));
  return out;
}

}  // namespace talus
