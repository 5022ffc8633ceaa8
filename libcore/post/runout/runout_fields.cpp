// Fields of the tables of a run-out: blocks, runs, and points of the curves over time.
#include "post/runout/runout_fields.hpp"

#include "base/units.hpp"

namespace talus {
namespace {

constexpr FieldType words = FieldType::text, whole = FieldType::integer;
constexpr double kilo = 1e3;

using Value = FieldValue;
using Block = const RunBlock&;
using Run = const RunoutRun&;
using Point = const CurvePoint&;

// None where nothing moved: run-out is undefined.
Value if_moved(Run r, Value value) { return r.event.moved.any() ? std::move(value) : Value(); }

}  // namespace

const std::vector<Field<RunBlock>>& block_fields() {
  static const std::vector<Field<RunBlock>> fields = {
      {"run_id", "", "Run", [](Block b) -> Value { return b.run.member.info.run_id; }, words},
      {"block", "", "Block", [](Block b) -> Value { return b.block.block; }, whole},
      {"fate", "", "Fate", [](Block b) -> Value { return text(b.block.fate); }, words},
      {"volume_m3", "m3", "Volume", [](Block b) -> Value { return b.run.volume[b.block.block]; }},
      {"mass_kg", "kg", "Mass", [](Block b) -> Value { return b.run.mass[b.block.block]; }},
      {"z_m", "m", "Elevation of the centroid",
       [](Block b) -> Value { return b.run.end[b.block.block].z() + b.origin.z(); }},
      {"drop_m", "m", "Drop", [](Block b) -> Value { return b.block.reach.height; }},
      {"path_length_m", "m", "Length of the path in plan",
       [](Block b) -> Value { return b.block.reach.path; }},
      {"chord_length_m", "m", "Length in a straight line in plan",
       [](Block b) -> Value { return b.block.reach.chord; }},
      {"reach_angle_path_deg", "deg", "Reach angle along the path",
       [](Block b) -> Value { return b.block.reach.path_angle() / degree; }},
      {"reach_angle_chord_deg", "deg", "Reach angle in a straight line",
       [](Block b) -> Value { return b.block.reach.chord_angle() / degree; }},
      {"max_speed_m_s", "m/s", "Largest speed", [](Block b) -> Value { return b.block.max_speed; }},
      {"max_energy_kj", "kJ", "Largest kinetic energy, with spin",
       [](Block b) -> Value { return b.block.max_energy / kilo; }},
      {"displacement_m", "m", "Displacement, straight",
       [](Block b) -> Value { return b.run.displacement[b.block.block]; }}};
  return fields;
}

const std::vector<Field<RunoutRun>>& run_fields() {
  static const std::vector<Field<RunoutRun>> fields = {
      {"run_id", "", "Run", [](Run r) -> Value { return r.member.info.run_id; }, words},
      {"seed", "", "Seed", [](Run r) -> Value { return r.member.info.seed; }, whole},
      {"status", "", "Status", [](Run r) -> Value { return r.member.info.status; }, words},
      {"moved", "", "Whether a block moved",
       [](Run r) -> Value { return r.event.moved.any() ? 1 : 0; }, whole},
      {"share_moved_1_m", "", "Share of the mass that moved more than 1 m",
       [](Run r) -> Value { return r.event.moved.share; }},
      {"share_moved_20_m", "", "Share of the mass that moved more than 20 m",
       [](Run r) -> Value { return r.event.moved.share_far; }},
      {"displacement_p50_m", "m", "Displacement by mass, median",
       [](Run r) -> Value { return r.event.moved.p50; }},
      {"displacement_p90_m", "m", "Displacement by mass, 90th percentile",
       [](Run r) -> Value { return r.event.moved.p90; }},
      {"displacement_p95_m", "m", "Displacement by mass, 95th percentile",
       [](Run r) -> Value { return r.event.moved.p95; }},
      {"displacement_max_m", "m", "Displacement of a block, largest",
       [](Run r) -> Value { return r.event.moved.largest; }},
      {"H_m", "m", "H", [](Run r) -> Value { return r.event.event.height; }},
      {"L_path_m", "m", "L along the path", [](Run r) -> Value { return r.event.event.path; }},
      {"L_chord_m", "m", "L in a straight line",
       [](Run r) -> Value { return r.event.event.chord; }},
      {"reach_angle_path_deg", "deg", "Reach angle along the path",
       [](Run r) -> Value { return r.event.event.path_angle() / degree; }},
      {"reach_angle_chord_deg", "deg", "Reach angle in a straight line",
       [](Run r) -> Value { return r.event.event.chord_angle() / degree; }},
      {"angle_monotone_along_path", "", "Whether the angle falls all along the path",
       [](Run r) -> Value { return if_moved(r, r.event.profile.monotone ? 1 : 0); }, whole},
      {"smallest_angle_along_path_deg", "deg", "Smallest angle along the path",
       [](Run r) -> Value { return if_moved(r, r.event.profile.smallest / degree); }},
      {"toe_block", "", "Farthest block",
       [](Run r) -> Value { return if_moved(r, r.event.toe_block); }, whole},
      {"toe_fate", "", "Fate of the farthest block",
       [](Run r) -> Value { return if_moved(r, text(r.event.toe_fate)); }, words},
      {"moved_volume_m3", "m3", "Volume that moved",
       [](Run r) -> Value { return if_moved(r, r.event.mass.moved_volume); }},
      {"H95_m", "m", "H of 95 % of what moved",
       [](Run r) -> Value { return if_moved(r, r.event.mass.height); }},
      {"L95_m", "m", "L of 95 % of what moved",
       [](Run r) -> Value { return if_moved(r, r.event.mass.length); }},
      {"reach_angle_95_deg", "deg", "Reach angle of 95 % of what moved",
       [](Run r) -> Value { return if_moved(r, r.event.mass.angle() / degree); }},
      {"blocks_beyond_L95", "", "Number of blocks beyond L95",
       [](Run r) -> Value { return if_moved(r, r.event.mass.n_beyond); }, whole},
      {"share_beyond_L95", "", "Share of what moved beyond L95",
       [](Run r) -> Value { return if_moved(r, r.event.mass.beyond_share); }},
      {"toe_share", "", "Share of the farthest block in what moved",
       [](Run r) -> Value { return if_moved(r, r.event.mass.toe_share); }},
      {"outliers", "", "Number of blocks far beyond L95",
       [](Run r) -> Value { return if_moved(r, r.event.mass.n_outliers); }, whole},
      {"case", "", "Case", [](Run r) -> Value { return r.member.info.case_name; }, words},
      {"event", "", "Whether enough moved for an event",
       [](Run r) -> Value { return r.event.moved.is_event() ? 1 : 0; }, whole},
      {"run_weight", "", "Weight of the run", [](Run r) -> Value { return r.member.run_weight; }}};
  return fields;
}

const std::vector<Field<PathPoint>>& path_point_fields() {
  using At = const PathPoint&;
  static const std::vector<Field<PathPoint>> fields = {
      {"time_s", "s", "Time", [](At p) -> Value { return p.path.time[p.point]; }},
      {"distance_m", "m", "Distance along the path in plan",
       [](At p) -> Value { return p.path.distance[p.point]; }},
      {"height_m", "m", "Height of the centroid above the ground",
       [](At p) -> Value { return p.path.height[p.point]; }},
      {"speed_m_s", "m/s", "Speed", [](At p) -> Value { return p.path.speed[p.point]; }},
      {"energy_kj", "kJ", "Kinetic energy, with spin",
       [](At p) -> Value { return p.path.energy[p.point] / kilo; }},
      {"spin_rad_s", "rad/s", "Spin", [](At p) -> Value { return p.path.spin[p.point]; }}};
  return fields;
}

const std::vector<Field<PathPoint>>& impact_fields() {
  using At = const PathPoint&;
  static const std::vector<Field<PathPoint>> fields = {
      {"time_s", "s", "Time", [](At p) -> Value { return p.path.time[p.point]; }},
      {"height_m", "m", "Height of the centroid above the ground",
       [](At p) -> Value { return p.path.height[p.point]; }},
      {"speed_before_m_s", "m/s", "Speed in the frame before",
       [](At p) -> Value { return p.path.speed[p.point - 1]; }},
      {"speed_after_m_s", "m/s", "Speed in the frame after",
       [](At p) -> Value { return p.path.speed[p.point]; }},
      {"energy_before_kj", "kJ", "Kinetic energy in the frame before, with spin",
       [](At p) -> Value { return p.path.energy[p.point - 1] / kilo; }},
      {"energy_after_kj", "kJ", "Kinetic energy in the frame after, with spin",
       [](At p) -> Value { return p.path.energy[p.point] / kilo; }},
      {"spin_before_rad_s", "rad/s", "Spin in the frame before",
       [](At p) -> Value { return p.path.spin[p.point - 1]; }},
      {"spin_after_rad_s", "rad/s", "Spin in the frame after",
       [](At p) -> Value { return p.path.spin[p.point]; }}};
  return fields;
}

const std::vector<Field<CurvePoint>>& curve_fields() {
  static const std::vector<Field<CurvePoint>> fields = {
      {"run_id", "", "Run", [](Point p) -> Value { return p.run.member.info.run_id; }, words},
      {"time_s", "s", "Time", [](Point p) -> Value { return p.row.time; }},
      {"x_m", "m", "Centre of mass, x",
       [](Point p) -> Value { return p.row.centre_of_mass.x() + p.origin.x(); }},
      {"y_m", "m", "Centre of mass, y",
       [](Point p) -> Value { return p.row.centre_of_mass.y() + p.origin.y(); }},
      {"z_m", "m", "Centre of mass, elevation",
       [](Point p) -> Value { return p.row.centre_of_mass.z() + p.origin.z(); }},
      {"mean_speed_m_s", "m/s", "Mean speed, by mass",
       [](Point p) -> Value { return p.row.mean_speed; }},
      {"max_speed_m_s", "m/s", "Largest speed", [](Point p) -> Value { return p.row.max_speed; }},
      {"front_m", "m", "Largest horizontal distance of a block from its start",
       [](Point p) -> Value { return p.row.front; }},
      {"translational_energy_kj", "kJ", "Kinetic energy of translation",
       [](Point p) -> Value { return p.row.translation / kilo; }},
      {"rotational_energy_kj", "kJ", "Kinetic energy of rotation",
       [](Point p) -> Value { return p.row.rotation / kilo; }}};
  return fields;
}

}  // namespace talus
