#include "post/runout/runout_text.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "base/csv.hpp"
#include "base/text.hpp"

namespace talus {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

// "101.4 to 103.3": smallest and largest of the runs that moved.
template <class Value>
std::string range_of(const std::vector<RunoutRun>& runs, int digits, const Value& value) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const RunoutRun& run : runs) {
    if (!run.event.moved.any()) continue;
    low = std::min(low, value(run));
    high = std::max(high, value(run));
  }
  return text(low, digits) + " to " + text(high, digits);
}

// ", its farthest block still moving"
std::string unsettled_toe(const EventReach& reach) {
  switch (reach.toe_fate) {
    case Fate::moving:
      return ", the farthest block still moving";
    case Fate::left_domain:
      return ", where the farthest block left the terrain";
    case Fate::deposited:
      break;
  }
  return "";
}

std::string name_of(const RunoutRun& run, const std::vector<RunoutRun>& runs) {
  std::vector<RunMember> members;
  for (const RunoutRun& r : runs) members.push_back(r.member);
  return names_of(members)[&run - runs.data()];
}

std::string reach_of_runs(const std::vector<RunoutRun>& runs) {
  const auto height = [](const RunoutRun& r) { return r.event.event.height; };
  const auto path = [](const RunoutRun& r) { return r.event.event.path; };
  const auto angle = [](const RunoutRun& r) { return r.event.event.path_angle() * degrees; };
  const auto n = static_cast<std::size_t>(n_moved(runs));
  const RunoutRun& farthest = *farthest_run(runs);
  const auto length_95 = [](const RunoutRun& r) { return r.event.mass.length; };
  const auto angle_95 = [](const RunoutRun& r) { return r.event.mass.angle() * degrees; };
  return "run-out of " + counted(static_cast<std::int64_t>(n), "run") +
         (n < runs.size() ? " that moved" : "") + ": H " + range_of(runs, 5, height) + " m, L " +
         range_of(runs, 5, path) + " m along the path, angle of reach " + range_of(runs, 4, angle) +
         " deg; farthest: " + name_of(farthest, runs) + unsettled_toe(farthest.event) +
         "\n95 % of what moved came within " + range_of(runs, 4, length_95) + " m of its top (" +
         range_of(runs, 3, angle_95) + " deg)";
}

std::string reach_of_run(const std::string& run_id, const EventReach& reach) {
  const ReachLine& e = reach.event;
  const std::string out = "run-out of run " + run_id + ": H " + text(e.height, 5) + " m, L " +
                          text(e.path, 5) + " m along the path (" + text(e.chord, 5) +
                          " m straight), angle of reach " + text(e.path_angle() * degrees, 4) +
                          " deg (" + text(e.chord_angle() * degrees, 4) + " deg)" +
                          unsettled_toe(reach);
  const std::string line = energy_line_text(reach.profile);
  const std::string mass = "\n" + text(reach.mass);
  return out + mass + (line.empty() ? "" : "\n" + line);
}

std::string reach_text(const std::vector<RunoutRun>& runs) {
  if (n_moved(runs) == 0) return "no run-out: no H, L and angle of reach";
  return runs.size() > 1 ? reach_of_runs(runs)
                         : reach_of_run(runs[0].member.info.run_id, runs[0].event);
}

}  // namespace

std::string standing_runs(const std::vector<RunoutRun>& runs) {
  std::int64_t n = 0, n_stopped = 0;
  for (const RunoutRun& run : runs) {
    if (run.event.moved.any()) continue;
    ++n;
    n_stopped += run.member.info.status != "done";
  }
  if (n == 0) return "";
  const std::string stopped =
      n_stopped == 0 ? ""
                     : "; " + std::to_string(n_stopped) + " of them failed or were interrupted";
  return std::to_string(n) + " of " + counted(static_cast<std::int64_t>(runs.size()), "run") +
         " did not move (no block by more than " + text(moved_m) + " m" + stopped + ")";
}

std::string energy_line_text(const AngleProfile& profile) {
  constexpr double matters = 1 / degrees;
  const double at_toe = profile.at_end();
  if (!(at_toe - profile.smallest >= matters)) return "";
  return "energy line: the ground flattens at " + text(profile.smallest_at, 4) +
         " m from where the farthest block started and is steeper again beyond. A line of " +
         text(at_toe * degrees, 3) +
         " deg (start to toe) ends there; a model that works with a "
         "line reaches the toe with " +
         text(profile.smallest * degrees, 3) + " deg";
}

std::string text(const MassReach& reach) {
  const auto percent = [](double share) { return text(100 * share, 2) + " %"; };
  std::string words = percent(reach_share) + " of what moved came within " + text(reach.length, 4) +
                      " m of its top, " + text(reach.height, 4) + " m below (" +
                      text(reach.angle() * degrees, 3) + " deg)";
  if (reach.n_beyond > 0)
    words += "; " + counted(reach.n_beyond, "block") + ", " + percent(reach.beyond_share) +
             " of it, went farther, the farthest is " + percent(reach.toe_share) + " of it";
  if (reach.n_outliers > 0)
    words += "; " + counted(reach.n_outliers, "outlier") + " beyond " + text(outlier_factor) +
             " times that";
  return words;
}

std::string cases_text(const std::vector<RunoutRun>& runs) {
  std::string lines;
  const std::vector<RunoutCase> cases = cases_of(runs);
  for (const RunoutCase& one : cases) {
    const Spread length =
        spread_over(runs, one.runs, [](const RunoutRun& r) { return r.event.event.path; });
    const Spread mass_length =
        spread_over(runs, one.runs, [](const RunoutRun& r) { return r.event.mass.length; });
    const Spread angle = spread_over(
        runs, one.runs, [](const RunoutRun& r) { return r.event.event.path_angle() * degrees; });
    lines += "\ncase " + (one.name.empty() ? std::string("without a name") : one.name) + ": " +
             std::to_string(length.n) + " of " +
             counted(static_cast<std::int64_t>(one.runs.size()), "run") + " moved, " +
             text(100 * one.moved.share, 3) + " % of the mass by more than " + text(moved_m) + " m";
    if (length.n > 0)
      lines += "; largest L " + text(length.largest, 4) + " m, L95 " +
               text(mass_length.largest, 4) + " m, smallest angle of reach " +
               text(angle.smallest, 3) + " deg";
  }
  if (cases.empty()) return "";
  return lines + "\nwhat stands for all runs together counts each run of each case alike";
}

std::string runout_summary(const RunoutRuns& all) {
  const std::string standing = standing_runs(all.runs);
  return (standing.empty() ? "" : standing + "\n") +
         (all.runs.size() > 1 ? "moved, all runs together: " : "moved: ") + text(all.moved) + "\n" +
         reach_text(all.runs) + cases_text(all.runs) + "\nvolume: released " +
         text(all.balance.released, 6) + " m3 = deposited " + text(all.balance.deposited, 6) +
         " + moving " + text(all.balance.moving, 6) + " + left " + text(all.balance.left, 6);
}

std::string run_csv(const std::vector<RunoutRun>& runs) {
  std::vector<std::string> headings = {"run_id",
                                       "seed",
                                       "status",
                                       "moved",
                                       "share_moved_1_m",
                                       "share_moved_20_m",
                                       "displacement_p50_m",
                                       "displacement_p90_m",
                                       "displacement_p95_m",
                                       "displacement_max_m",
                                       "H_m",
                                       "L_path_m",
                                       "L_chord_m",
                                       "reach_angle_path_deg",
                                       "reach_angle_chord_deg",
                                       "toe_block",
                                       "toe_fate",
                                       "moved_volume_m3",
                                       "H95_m",
                                       "L95_m",
                                       "reach_angle_95_deg",
                                       "blocks_beyond_L95",
                                       "share_beyond_L95",
                                       "toe_share",
                                       "outliers",
                                       "case"};
  const std::vector<DrawnValue> drawn =
      runs.empty() ? std::vector<DrawnValue>{} : runs.front().drawn;
  for (const DrawnValue& value : drawn) headings.push_back(value.name);
  std::string out = csv_line(headings);
  for (const RunoutRun& r : runs) {
    const Moved& m = r.event.moved;
    std::vector<std::string> row = {r.member.info.run_id, std::to_string(r.member.info.seed),
                                    r.member.info.status, m.any() ? "1" : "0"};
    for (const double value : {m.share, m.share_far, m.p50, m.p90, m.p95, m.largest})
      row.push_back(text(value, 7));
    if (m.any()) {
      const ReachLine& e = r.event.event;
      for (const double value :
           {e.height, e.path, e.chord, e.path_angle() * degrees, e.chord_angle() * degrees})
        row.push_back(text(value, 9));
      row.push_back(std::to_string(r.event.toe_block));
      row.emplace_back(text(r.event.toe_fate));
      const MassReach& mass = r.event.mass;
      for (const double value :
           {mass.moved_volume, mass.height, mass.length, mass.angle() * degrees,
            static_cast<double>(mass.n_beyond), mass.beyond_share, mass.toe_share,
            static_cast<double>(mass.n_outliers)})
        row.push_back(text(value, 7));
    }
    row.resize(25);
    row.push_back(case_of(r.member.file));
    for (const DrawnValue& column : drawn) {
      const auto found = std::find_if(r.drawn.begin(), r.drawn.end(), [&](const DrawnValue& value) {
        return value.name == column.name;
      });
      row.push_back(found == r.drawn.end() ? "" : text(found->value, 7));
    }
    out += csv_line(row);
  }
  return out;
}

std::string block_csv(const std::vector<RunoutRun>& runs) {
  std::string out =
      csv_line({"run_id", "block", "fate", "volume_m3", "mass_kg", "drop_m", "path_length_m",
                "chord_length_m", "reach_angle_path_deg", "reach_angle_chord_deg", "max_speed_m_s",
                "max_energy_kj", "displacement_m"});
  for (const RunoutRun& r : runs)
    for (const BlockReach& b : r.event.blocks)
      out += csv_line({r.member.info.run_id, std::to_string(b.block), text(b.fate),
                       text(r.volume[b.block], 9), text(r.mass[b.block], 9),
                       text(b.reach.height, 9), text(b.reach.path, 9), text(b.reach.chord, 9),
                       text(b.reach.path_angle() * degrees, 7),
                       text(b.reach.chord_angle() * degrees, 7), text(b.max_speed, 7),
                       text(b.max_energy / 1e3, 7), text(r.displacement[b.block], 7)});
  return out;
}

std::string curve_csv(const std::vector<RunoutRun>& runs, const Vec3& origin) {
  std::string out =
      csv_line({"run_id", "time_s", "x_m", "y_m", "z_m", "mean_speed_m_s", "max_speed_m_s",
                "front_m", "translational_energy_kj", "rotational_energy_kj"});
  for (const RunoutRun& r : runs) {
    if (!r.has_frames) continue;
    for (const CurveRow& row : r.curves) {
      const Vec3 at = row.centre_of_mass + origin;
      out += csv_line({r.member.info.run_id, text(row.time, 9), text(at.x(), 11), text(at.y(), 11),
                       text(at.z(), 9), text(row.mean_speed, 7), text(row.max_speed, 7),
                       text(row.front, 7), text(row.translation / 1e3, 7),
                       text(row.rotation / 1e3, 7)});
    }
  }
  return out;
}

}  // namespace talus
