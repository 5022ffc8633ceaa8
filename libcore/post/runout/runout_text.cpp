#include "post/runout/runout_text.hpp"

#include <algorithm>
#include <limits>

#include "base/csv.hpp"
#include "base/grouped_text.hpp"
#include "base/text.hpp"
#include "base/units.hpp"
#include "base/words.hpp"

namespace talus {
namespace {

// "101 to 103": smallest and largest of the runs that moved.
template <class Value>
std::string range_of(const std::vector<RunoutRun>& runs, const Value& value) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const RunoutRun& run : runs) {
    if (!run.event.moved.any()) continue;
    low = std::min(low, value(run));
    high = std::max(high, value(run));
  }
  return grouped_text(low) + " to " + grouped_text(high);
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
  const auto angle = [](const RunoutRun& r) { return r.event.event.path_angle() / degree; };
  const auto n = static_cast<std::size_t>(n_moved(runs));
  const RunoutRun& farthest = *farthest_run(runs);
  const auto length_95 = [](const RunoutRun& r) { return r.event.mass.length; };
  const auto angle_95 = [](const RunoutRun& r) { return r.event.mass.angle() / degree; };
  return "run-out of " + counted(static_cast<std::int64_t>(n), "run") +
         (n < runs.size() ? " that moved" : "") + ": H " + range_of(runs, height) + " m, L " +
         range_of(runs, path) + " m along the path, angle of reach " + range_of(runs, angle) +
         " deg; farthest: " + name_of(farthest, runs) + unsettled_toe(farthest.event) +
         "\n95 % of what moved came within " + range_of(runs, length_95) + " m of its top (" +
         range_of(runs, angle_95) + " deg)";
}

std::string reach_of_run(const std::string& run_id, const EventReach& reach) {
  const ReachLine& e = reach.event;
  const std::string out = "run-out of run " + run_id + ": H " + grouped_text(e.height) + " m, L " +
                          grouped_text(e.path) + " m along the path (" + grouped_text(e.chord) +
                          " m straight), angle of reach " + text(e.path_angle() / degree, 3) +
                          " deg (" + text(e.chord_angle() / degree, 3) + " deg)" +
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

// A column of the table of runs.
struct RunColumn {
  const char* heading;
  bool only_if_moved;  // else empty: there is no run-out
  std::string (*value)(const RunoutRun&);
};
using Run = const RunoutRun&;
constexpr RunColumn run_columns[] = {
    {"run_id", false, [](Run r) { return r.member.info.run_id; }},
    {"seed", false, [](Run r) { return std::to_string(r.member.info.seed); }},
    {"status", false, [](Run r) { return r.member.info.status; }},
    {"moved", false, [](Run r) { return std::string(r.event.moved.any() ? "1" : "0"); }},
    {"share_moved_1_m", false, [](Run r) { return text(r.event.moved.share, 7); }},
    {"share_moved_20_m", false, [](Run r) { return text(r.event.moved.share_far, 7); }},
    {"displacement_p50_m", false, [](Run r) { return text(r.event.moved.p50, 7); }},
    {"displacement_p90_m", false, [](Run r) { return text(r.event.moved.p90, 7); }},
    {"displacement_p95_m", false, [](Run r) { return text(r.event.moved.p95, 7); }},
    {"displacement_max_m", false, [](Run r) { return text(r.event.moved.largest, 7); }},
    {"H_m", true, [](Run r) { return text(r.event.event.height, 9); }},
    {"L_path_m", true, [](Run r) { return text(r.event.event.path, 9); }},
    {"L_chord_m", true, [](Run r) { return text(r.event.event.chord, 9); }},
    {"reach_angle_path_deg", true,
     [](Run r) { return text(r.event.event.path_angle() / degree, 9); }},
    {"reach_angle_chord_deg", true,
     [](Run r) { return text(r.event.event.chord_angle() / degree, 9); }},
    {"toe_block", true, [](Run r) { return std::to_string(r.event.toe_block); }},
    {"toe_fate", true, [](Run r) { return std::string(text(r.event.toe_fate)); }},
    {"moved_volume_m3", true, [](Run r) { return text(r.event.mass.moved_volume, 7); }},
    {"H95_m", true, [](Run r) { return text(r.event.mass.height, 7); }},
    {"L95_m", true, [](Run r) { return text(r.event.mass.length, 7); }},
    {"reach_angle_95_deg", true, [](Run r) { return text(r.event.mass.angle() / degree, 7); }},
    {"blocks_beyond_L95", true, [](Run r) { return std::to_string(r.event.mass.n_beyond); }},
    {"share_beyond_L95", true, [](Run r) { return text(r.event.mass.beyond_share, 7); }},
    {"toe_share", true, [](Run r) { return text(r.event.mass.toe_share, 7); }},
    {"outliers", true, [](Run r) { return std::to_string(r.event.mass.n_outliers); }},
    {"case", false, [](Run r) { return r.member.info.case_name; }},
    {"event", false, [](Run r) { return std::string(r.event.moved.is_event() ? "1" : "0"); }},
    {"run_weight", false, [](Run r) { return text(r.member.run_weight, 7); }},
};

std::string drawn_text(const RunoutRun& run, const std::string& name) {
  const auto found = std::find_if(run.drawn.begin(), run.drawn.end(),
                                  [&](const DrawnValue& value) { return value.name == name; });
  return found == run.drawn.end() ? "" : text(found->value, 7);
}

}  // namespace

std::string standing_runs(const std::vector<RunoutRun>& runs) {
  std::int64_t n = 0, n_stopped = 0;
  for (const RunoutRun& run : runs) {
    if (run.event.moved.any()) continue;
    ++n;
    n_stopped += run.member.info.status != "done";
  }
  const auto n_all = static_cast<std::int64_t>(runs.size());
  const auto n_events = static_cast<std::int64_t>(events_among(runs, all_of(runs)).size());
  const std::int64_t n_few = n_all - n - n_events;
  const std::string few = n_few == 0
                              ? ""
                              : std::to_string(n_few) + " of " + counted(n_all, "run") +
                                    " moved less than " + percent(event_share) + " of the mass";
  if (n == 0) return few;
  const std::string stopped =
      n_stopped == 0 ? ""
                     : "; " + std::to_string(n_stopped) + " of them failed or were interrupted";
  return std::to_string(n) + " of " + counted(static_cast<std::int64_t>(runs.size()), "run") +
         " did not move (no block by more than " + text(moved_m) + " m" + stopped + ")" +
         (few.empty() ? "" : ", and " + few);
}

std::string energy_line_text(const AngleProfile& profile) {
  constexpr double matters = degree;
  const double at_toe = profile.at_end();
  if (!(at_toe - profile.smallest >= matters)) return "";
  return "energy line: the ground flattens at " + grouped_text(profile.smallest_at) +
         " m from where the farthest block started and is steeper again beyond. A line of " +
         text(at_toe / degree, 3) +
         " deg (start to toe) ends there; a model that works with a "
         "line reaches the toe with " +
         text(profile.smallest / degree, 3) + " deg";
}

std::string text(const MassReach& reach) {
  std::string words = percent(reach_share) + " of what moved came within " +
                      grouped_text(reach.length) + " m of its top, " + grouped_text(reach.height) +
                      " m below (" + text(reach.angle() / degree, 3) + " deg)";
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
        runs, one.runs, [](const RunoutRun& r) { return r.event.event.path_angle() / degree; });
    const std::size_t n_events = events_among(runs, one.runs).size();
    lines += "\ncase " + (one.name.empty() ? std::string("without a name") : one.name) + ": " +
             std::to_string(length.n) + " of " +
             counted(static_cast<std::int64_t>(one.runs.size()), "run") + " moved" +
             (n_events < length.n ? " (" + std::to_string(n_events) + " events)" : "") + ", " +
             percent(one.moved.share) + " of the mass by more than " + text(moved_m) + " m";
    if (length.n > 0)
      lines += "; largest L " + grouped_text(length.largest) + " m, L95 " +
               grouped_text(mass_length.largest) + " m, smallest angle of reach " +
               text(angle.smallest, 3) + " deg";
  }
  if (cases.empty()) return "";
  std::vector<RunMember> members;
  for (const RunoutRun& run : runs) members.push_back(run.member);
  return lines + "\nwhat stands for all runs together weighs the cases as " +
         text(case_shares(members));
}

std::string runout_summary(const RunoutRuns& all) {
  const std::string standing = standing_runs(all.runs);
  return (standing.empty() ? "" : standing + "\n") +
         (all.runs.size() > 1 ? "moved, all runs together: " : "moved: ") + text(all.moved) + "\n" +
         reach_text(all.runs) + cases_text(all.runs) + "\nvolume" +
         (all.runs.size() > 1
              ? " of all " + counted(static_cast<std::int64_t>(all.runs.size()), "run")
              : "") +
         ": released " + grouped_text(all.balance.released, 4) + " m3 = deposited " +
         grouped_text(all.balance.deposited, 4) + " + moving " +
         grouped_text(all.balance.moving, 4) + " + left " + grouped_text(all.balance.left, 4);
}

std::string run_csv(const std::vector<RunoutRun>& runs) {
  std::vector<std::string> headings;
  for (const RunColumn& column : run_columns) headings.emplace_back(column.heading);
  const std::vector<DrawnValue> drawn =
      runs.empty() ? std::vector<DrawnValue>{} : runs.front().drawn;
  for (const DrawnValue& value : drawn) headings.push_back(value.name);
  std::string out = csv_line(headings);
  for (const RunoutRun& r : runs) {
    std::vector<std::string> row;
    for (const RunColumn& column : run_columns)
      row.push_back(column.only_if_moved && !r.event.moved.any() ? "" : column.value(r));
    for (const DrawnValue& value : drawn) row.push_back(drawn_text(r, value.name));
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
                       text(b.reach.path_angle() / degree, 7),
                       text(b.reach.chord_angle() / degree, 7), text(b.max_speed, 7),
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
