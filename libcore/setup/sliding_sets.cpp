// Joint sets that a daylighting failure surface may lie on, and why the rest offer none.
#include "setup/sliding_sets.hpp"

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "base/units.hpp"
#include "base/words.hpp"

namespace talus {

std::string tenths(double value) { return text(std::round(10 * value) / 10); }

std::string named_attitude(const FailurePlane& plane) {
  return plane.set + " (" + tenths(plane.attitude.dip / degree) + " degrees towards " +
         tenths(plane.attitude.dip_direction / degree) + ")";
}

double friction_below(const Site& site, const Trn& ground, const Area& area,
                      const std::vector<std::uint8_t>& classes) {
  if (classes.empty()) return site.grounds[0].friction_deg * degree;
  const auto friction_at = [&](const Cell& cell) {
    const auto index = static_cast<std::size_t>(first_triangle(ground, cell)) / 2;
    return site.grounds[classes[index]].friction_deg;
  };
  const Vec2& corner = area.rings[0][0];
  double largest = friction_at(locate(ground, corner.x(), corner.y()).cell);
  for (int row = 0; row + 1 < ground.n_rows; ++row)
    for (int col = 0; col + 1 < ground.n_cols; ++col) {
      const Vec2 middle(ground.node0.x() + (col + 0.5) * ground.cell_size,
                        ground.node0.y() - (row + 0.5) * ground.cell_size);
      if (contains(area, middle)) largest = std::max(largest, friction_at({row, col}));
    }
  return largest * degree;
}

std::vector<std::string> names_joined(const std::string& said) {
  std::vector<std::string> names;
  for (size_t begin = 0; begin <= said.size();) {
    const size_t end = std::min(said.find('+', begin), said.size());
    const size_t first = said.find_first_not_of(' ', begin),
                 last = said.find_last_not_of(' ', end - 1);
    names.push_back(first < end && last != std::string::npos && last >= first
                        ? said.substr(first, std::min(last + 1, end) - first)
                        : "");
    begin = end + 1;
  }
  if (said.empty()) names.clear();
  return names;
}

void check_sliding_set(const Site& site, const FailurePlanes& found) {
  const std::vector<std::string> wanted = names_joined(site.source.sliding_set);
  if (wanted.size() > 2)
    throw InputError(where_of(site, "source.sliding_set"),
                     "sliding_set names " + std::to_string(wanted.size()) +
                         " sets, expected one, or two for a wedge (\"one + other\")");
  for (const std::string& name : wanted) {
    const bool is_there = std::any_of(found.planes.begin(), found.planes.end(),
                                      [&](const FailurePlane& plane) { return plane.set == name; });
    if (is_there) continue;
    throw InputError(where_of(site, "source.sliding_set"),
                     "there is no joint set " + name +
                         "; there are: " + list_of(found.planes, &FailurePlane::set));
  }
}

std::string what_would_go(const FailurePlanes& found) {
  const double friction_deg = found.friction / degree, slope_deg = found.slope.dip / degree;
  if (slope_deg <= friction_deg + 1)
    return "the slope is no steeper than friction: nothing slides off it on a plane";
  const double fall = found.slope.dip_direction / degree;
  const auto azimuth = [&](double off) {
    return tenths(std::fmod(std::round(fall) + off + 360, 360));
  };
  return "a set that dips " + tenths(std::ceil(friction_deg)) + " to " +
         tenths(std::floor(slope_deg)) + " degrees towards " + azimuth(-widest_lateral_deg) +
         " to " + azimuth(widest_lateral_deg) + " would let the mass go";
}

InputError no_plane_daylights(const Site& site, const FailurePlanes& found,
                              const std::vector<FailureWedge>& wedges) {
  const std::string& wanted = site.source.sliding_set;
  std::string reasons;
  for (const FailurePlane& plane : found.planes)
    if (wanted.empty() || plane.set == wanted)
      reasons += "; " + named_attitude(plane) + " " + plane.why_not;
  if (names_joined(wanted).size() != 1)
    for (const FailureWedge& wedge : wedges)
      if (!wedge.why_not.empty()) reasons += "; " + pair_name(wedge) + " " + wedge.why_not;
  return {where_of(site, "source.failure_surface"),
          (wanted.empty() ? "no joint set makes" : "set " + wanted + " does not make") +
              std::string(" a failure surface that daylights at the foot of the source, where the "
                          "slope dips ") +
              tenths(found.slope.dip / degree) + " degrees towards " +
              tenths(found.slope.dip_direction / degree) + reasons,
          what_would_go(found) +
              "; else change the polygon, friction_deg of the ground, or give the surface by hand "
              "(failure_surface = \"plane\", \"raster\", \"slbl\")"};
}

}  // namespace talus
