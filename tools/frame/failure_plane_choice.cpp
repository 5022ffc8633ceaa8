// Planes and wedges that a mass can leave on, in words and as JSON.
#include "tools/frame/failure_plane_choice.hpp"

#include <cmath>

#include "base/grouped_text.hpp"
#include "base/text.hpp"
#include "base/units.hpp"
#include "base/words.hpp"
#include "setup/sliding_sets.hpp"

namespace talus {
namespace {

std::string attitude_text(const Json& plane) {
  return "dips " + tenths(plane["dip_deg"].get<double>()) + " degrees towards " +
         tenths(plane["dip_direction_deg"].get<double>());
}

Json json_of(const FailurePlane& plane, double friction, const Vec3& origin) {
  Json row = {{"set", plane.set},
              {"dip_deg", plane.attitude.dip / degree},
              {"dip_direction_deg", plane.attitude.dip_direction / degree},
              {"off_fall_line_deg", plane.lateral / degree},
              {"why_not", plane.why_not.empty() ? Json() : Json(plane.why_not)}};
  if (!plane.why_not.empty()) return row;
  const Vec3 point = plane.point + origin;
  row["above_friction_deg"] = (plane.attitude.dip - friction) / degree;
  row["point_m"] = {point.x(), point.y(), point.z()};
  row["free_share_of_foot"] = plane.foot.free_share;
  row["largest_step_at_foot_m"] = plane.foot.largest_step;
  row["comes_out_from_m"] = number_or_null(plane.foot.exit_low + origin.z());
  row["comes_out_to_m"] = number_or_null(plane.foot.exit_high + origin.z());
  row["volume_m3"] = plane.volume;
  row["mean_depth_m"] = plane.mean_depth;
  row["largest_depth_m"] = plane.max_depth;
  row["share_over_rising_bed"] = plane.rising_share;
  return row;
}

// Where the plane daylights at the foot, and how much of it is steeper than friction.
std::string foot_text(const Json& plane) {
  std::string words = tenths(plane["above_friction_deg"].get<double>()) +
                      " degrees steeper than friction; comes out of the ground along " +
                      percent(plane["free_share_of_foot"].get<double>()) + " of the foot";
  if (!plane["comes_out_from_m"].is_null())
    words += ", " + grouped_text(std::round(plane["comes_out_from_m"].get<double>()), 5) + " to " +
             grouped_text(std::round(plane["comes_out_to_m"].get<double>()), 5) + " m";
  if (plane["largest_step_at_foot_m"].get<double>() > 0)
    words += ", a step of up to " + text(plane["largest_step_at_foot_m"].get<double>(), 2) +
             " m on the rest";
  return words;
}

std::string mass_text(const Json& plane) {
  return grouped_text(plane["volume_m3"].get<double>(), 3) + " m3, " +
         text(plane["mean_depth_m"].get<double>(), 3) + " m deep on average, " +
         text(plane["largest_depth_m"].get<double>(), 3) + " m at most";
}

double azimuth_deg(double azimuth) { return std::fmod(azimuth / degree + 360, 360); }
std::string azimuth_text(double azimuth) { return tenths(azimuth_deg(azimuth)); }

Json wedge_json(const FailureWedge& wedge, const Vec3& origin) {
  Json row = {{"sets", pair_name(wedge)},
              {"plunge_deg", wedge.line.plunge / degree},
              {"trend_deg", azimuth_deg(wedge.line.trend)},
              {"factor_of_safety", number_or_null(wedge.line.factor)},
              {"why_not", wedge.why_not.empty() ? Json() : Json(wedge.why_not)}};
  if (!wedge.why_not.empty()) return row;
  const Vec3 first = wedge.first_point + origin, second = wedge.second_point + origin;
  row["first_point_m"] = {first.x(), first.y(), first.z()};
  row["second_point_m"] = {second.x(), second.y(), second.z()};
  row["free_share_of_foot"] = wedge.free_share;
  row["largest_step_at_foot_m"] = wedge.largest_step;
  row["volume_m3"] = wedge.volume;
  row["mean_depth_m"] = wedge.mean_depth;
  row["largest_depth_m"] = wedge.max_depth;
  return row;
}

}  // namespace

std::string planes_text(const FailurePlanes& found, const Vec3& origin) {
  std::string lines = "slope: dips " + tenths(found.slope.dip / degree) + " degrees towards " +
                      tenths(found.slope.dip_direction / degree) + "; friction of the ground " +
                      tenths(found.friction / degree) + " degrees";
  for (size_t i = 0; i < found.planes.size(); ++i) {
    const FailurePlane& plane = found.planes[i];
    lines += "\n" + named_attitude(plane) + ": ";
    if (!plane.why_not.empty()) {
      lines += plane.why_not;
      continue;
    }
    const Json row = json_of(plane, found.friction, origin);
    lines += mass_text(row) + "; " + foot_text(row);
    if (static_cast<int>(i) == found.best) lines += " (taken)";
  }
  return lines;
}

std::string wedges_text(const std::vector<FailureWedge>& wedges, bool all, int taken) {
  std::string lines;
  for (size_t i = 0; i < wedges.size(); ++i) {
    const FailureWedge& wedge = wedges[i];
    if (!wedge.why_not.empty()) {
      if (all) lines += "\n" + pair_name(wedge) + " (wedge): " + wedge.why_not;
      continue;
    }
    lines += "\n" + pair_name(wedge) + " (wedge along " + tenths(wedge.line.plunge / degree) +
             " degrees towards " + azimuth_text(wedge.line.trend) +
             "): " + mass_text(wedge_json(wedge, Vec3::Zero())) + "; factor of safety " +
             text(wedge.line.factor, 3) + "; comes out of the ground along " +
             percent(wedge.free_share) + " of the foot" +
             (static_cast<int>(i) == taken ? " (taken)" : "");
  }
  return lines;
}

std::string best_plane_text(const Json& planes) {
  for (const Json& wedge : planes["wedges"])
    if (wedge["sets"] == planes["taken"])
      return "failure wedge of sets " + wedge["sets"].get<std::string>() + ": along " +
             tenths(wedge["plunge_deg"].get<double>()) + " degrees towards " +
             tenths(wedge["trend_deg"].get<double>()) + ", factor of safety " +
             text(wedge["factor_of_safety"].get<double>(), 3) + "; comes out of the ground along " +
             percent(wedge["free_share_of_foot"].get<double>()) + " of the foot";
  for (const Json& plane : planes["sets"])
    if (plane["set"] == planes["taken"])
      return "failure plane of set " + plane["set"].get<std::string>() + ": " +
             attitude_text(plane) + ", " + foot_text(plane);
  return "";
}

Json planes_json(const FailurePlanes& found, const std::vector<FailureWedge>& wedges, int wedge,
                 const Vec3& origin) {
  Json rows = Json::array(), pairs = Json::array();
  for (const FailureWedge& one : wedges) pairs.push_back(wedge_json(one, origin));
  Json taken;
  if (found.best >= 0) taken = found.planes[found.best].set;
  if (wedge >= 0) taken = pair_name(wedges[wedge]);
  for (const FailurePlane& plane : found.planes)
    rows.push_back(json_of(plane, found.friction, origin));
  return {{"slope_dip_deg", found.slope.dip / degree},
          {"slope_dip_direction_deg", found.slope.dip_direction / degree},
          {"friction_deg", found.friction / degree},
          {"taken", taken},
          {"sets", rows},
          {"wedges", pairs}};
}

}  // namespace talus
