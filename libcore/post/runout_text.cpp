#include "post/runout_text.hpp"

#include <algorithm>
#include <numbers>

#include "base/csv.hpp"
#include "base/text.hpp"

namespace talus {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

// "101.4 to 103.3": smallest and largest of the runs.
template <class Value>
std::string range_of(const std::vector<RunoutRun>& runs, int digits, const Value& value) {
  double low = value(runs[0]), high = low;
  for (const RunoutRun& run : runs) {
    low = std::min(low, value(run));
    high = std::max(high, value(run));
  }
  return text(low, digits) + " to " + text(high, digits);
}

std::string reach_of_runs(const std::vector<RunoutRun>& runs) {
  const auto height = [](const RunoutRun& r) { return r.event.event.height; };
  const auto path = [](const RunoutRun& r) { return r.event.event.path; };
  const auto angle = [](const RunoutRun& r) { return r.event.event.path_angle() * degrees; };
  return "run-out of " + std::to_string(runs.size()) + " runs: H " + range_of(runs, 5, height) +
         " m, L " + range_of(runs, 5, path) + " m along the path, angle of reach " +
         range_of(runs, 4, angle) + " deg";
}

std::string reach_of_run(const std::string& run_id, const EventReach& reach) {
  const ReachLine& e = reach.event;
  const std::string out = "run-out of run " + run_id + ": H " + text(e.height, 5) + " m, L " +
                          text(e.path, 5) + " m along the path (" + text(e.chord, 5) +
                          " m straight), angle of reach " + text(e.path_angle() * degrees, 4) +
                          " deg (" + text(e.chord_angle() * degrees, 4) + " deg)";
  if (reach.profile.monotone) return out;
  return out + "\nenergy line: seen from the toe block's start the angle is smallest, " +
         text(reach.profile.smallest * degrees, 4) + " deg, at " +
         text(reach.profile.smallest_at, 4) +
         " m, not at the toe: a straight line from start to toe runs up to " +
         text(reach.profile.missing_head, 3) +
         " m below the ground, so an energy line of that angle stops short of the toe";
}

}  // namespace

std::string runout_summary(const RunoutRuns& all) {
  std::string out = all.runs.size() > 1
                        ? reach_of_runs(all.runs)
                        : reach_of_run(all.runs[0].member.info.run_id, all.runs[0].event);
  out += "\nvolume: released " + text(all.balance.released, 6) + " m3 = deposited " +
         text(all.balance.deposited, 6) + " + moving " + text(all.balance.moving, 6) + " + left " +
         text(all.balance.left, 6);
  return out;
}

std::string block_csv(const std::vector<RunoutRun>& runs) {
  std::string out = csv_line({"run_id", "block", "fate", "volume_m3", "mass_kg", "drop_m",
                              "path_length_m", "chord_length_m", "reach_angle_path_deg",
                              "reach_angle_chord_deg", "max_speed_m_s", "max_energy_kj"});
  for (const RunoutRun& r : runs)
    for (const BlockReach& b : r.event.blocks)
      out += csv_line({r.member.info.run_id, std::to_string(b.block), text(b.fate),
                       text(r.volume[b.block], 9), text(r.mass[b.block], 9),
                       text(b.reach.height, 9), text(b.reach.path, 9), text(b.reach.chord, 9),
                       text(b.reach.path_angle() * degrees, 7),
                       text(b.reach.chord_angle() * degrees, 7), text(b.max_speed, 7),
                       text(b.max_energy / 1e3, 7)});
  return out;
}

std::string curve_csv(const std::vector<RunoutRun>& runs, const Vec3& origin) {
  std::string out =
      csv_line({"run_id", "time_s", "x_m", "y_m", "z_m", "mean_speed_m_s", "max_speed_m_s",
                "front_m", "translational_energy_kj", "rotational_energy_kj"});
  for (const RunoutRun& r : runs)
    for (const CurveRow& row : r.curves) {
      const Vec3 at = row.centre_of_mass + origin;
      out += csv_line({r.member.info.run_id, text(row.time, 9), text(at.x(), 11), text(at.y(), 11),
                       text(at.z(), 9), text(row.mean_speed, 7), text(row.max_speed, 7),
                       text(row.front, 7), text(row.translation / 1e3, 7),
                       text(row.rotation / 1e3, 7)});
    }
  return out;
}

}  // namespace talus
