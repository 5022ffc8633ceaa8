// Run-out in words and as tables.
#include "post/runout/runout_text.hpp"

#include <algorithm>
#include <limits>

#include "base/grouped_text.hpp"
#include "base/text.hpp"
#include "base/units.hpp"
#include "base/words.hpp"
#include "post/runout/runout_fields.hpp"

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
  if (runs[0].member.info.independent)
    return "rocks fell one by one: H, L and angle of reach of all together mean nothing";
  return runs.size() > 1 ? reach_of_runs(runs)
                         : reach_of_run(runs[0].member.info.run_id, runs[0].event);
}

FieldValue drawn_value(const RunoutRun& run, const std::string& name) {
  const auto found = std::find_if(run.drawn.begin(), run.drawn.end(),
                                  [&](const DrawnValue& value) { return value.name == name; });
  return found == run.drawn.end() ? FieldValue() : FieldValue(found->value);
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
             percent(one.moved.share) +
             (one.moved.of_rocks ? " of the rocks by more than " : " of the mass by more than ") +
             text(moved_m) + " m";
    if (length.n > 0)
      lines += "; largest L " + grouped_text(length.largest) + " m, L95 " +
               grouped_text(mass_length.largest) + " m, smallest angle of reach " +
               text(angle.smallest, 3) + " deg";
  }
  if (cases.empty()) return "";
  std::vector<RunMember> members;
  for (const RunoutRun& run : runs) members.push_back(run.member);
  return lines + "\ntotals over all runs use these case weights: " + text(case_shares(members));
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
  const std::vector<DrawnValue> drawn =
      runs.empty() ? std::vector<DrawnValue>{} : runs.front().drawn;
  std::vector<FieldValue> names = names_of(run_fields());
  for (const DrawnValue& value : drawn) names.emplace_back(value.name);
  std::string out = csv_row(names);
  for (const RunoutRun& r : runs) {
    std::vector<FieldValue> row = values_of(run_fields(), r);
    for (const DrawnValue& value : drawn) row.push_back(drawn_value(r, value.name));
    out += csv_row(row);
  }
  return out;
}

std::string block_csv(const std::vector<RunoutRun>& runs, const Vec3& origin) {
  std::string out = csv_row(names_of(block_fields()));
  for (const RunoutRun& r : runs)
    for (const BlockReach& b : r.event.blocks)
      out += csv_row(values_of(block_fields(), {r, b, origin}));
  return out;
}

std::string curve_csv(const std::vector<RunoutRun>& runs, const Vec3& origin) {
  std::string out = csv_row(names_of(curve_fields()));
  for (const RunoutRun& r : runs)
    if (r.has_frames)
      for (const CurveRow& row : r.curves)
        out += csv_row(values_of(curve_fields(), {r, row, origin}));
  return out;
}

}  // namespace talus
