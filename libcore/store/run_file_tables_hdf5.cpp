#include "store/run_file_tables_hdf5.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <type_traits>

#include "base/error.hpp"

namespace talus {
namespace {

// A table is stored column by column. One list of columns serves writing and reading: it calls
// column(name, units, description, field) with a function that gives a row's field.

template <class Visit>
void passage_columns(Visit&& column) {
  column(
      "block", "1", "index of the block", [](Passage & p) -> auto& { return p.block; });
  column(
      "cell", "1", "row * n_cols + column of the cell, row 0 in the north, column 0 in the west",
      [](Passage & p) -> auto& { return p.cell; });
  column(
      "speed_m_s", "m/s", "largest speed of the centroid",
      [](Passage & p) -> auto& { return p.largest.speed; });
  column(
      "translational_energy_j", "J", "largest kinetic energy of translation",
      [](Passage & p) -> auto& { return p.largest.translational_energy; });
  column(
      "total_energy_j", "J", "largest kinetic energy of translation and rotation together",
      [](Passage & p) -> auto& { return p.largest.total_energy; });
  column(
      "centroid_height_m", "m",
      "largest height of the centroid above the ground below it, vertical; NaN: no known ground",
      [](Passage & p) -> auto& { return p.largest.centroid_height; });
  column(
      "top_height_m", "m",
      "largest height of the highest vertex above the ground below the centroid, vertical",
      [](Passage & p) -> auto& { return p.largest.top_height; });
  column(
      "first_time_s", "s", "when the block came over the cell",
      [](Passage & p) -> auto& { return p.first_time; });
  column(
      "travel_angle_rad", "rad",
      "then: atan(drop of the centroid since its start / length of its path in plan); NaN: it had "
      "not moved in plan",
      [](Passage & p) -> auto& { return p.travel_angle; });
  column(
      "heading_rad", "rad", "then: direction of the centroid, from x to y; NaN: it stood in plan",
      [](Passage & p) -> auto& { return p.heading; });
}

template <class Visit>
void object_hit_columns(Visit&& column) {
  using Hit = ObjectHit;
  column(
      "block", "1", "index of the block", [](Hit & h) -> auto& { return h.block; });
  column(
      "object", "1", "index of the object", [](Hit & h) -> auto& { return h.object; });
  column(
      "time_s", "s", "of the first touch in plan", [](Hit & h) -> auto& { return h.time; });
  column(
      "position_x_m", "m", "centroid then, local x",
      [](Hit & h) -> auto& { return h.position.x(); });
  column(
      "position_y_m", "m", "centroid then, local y",
      [](Hit & h) -> auto& { return h.position.y(); });
  column(
      "position_z_m", "m", "centroid then, local z",
      [](Hit & h) -> auto& { return h.position.z(); });
  column(
      "speed_m_s", "m/s", "of the centroid then", [](Hit & h) -> auto& { return h.speed; });
  column(
      "translational_energy_j", "J", "then",
      [](Hit & h) -> auto& { return h.translational_energy; });
  column(
      "total_energy_j", "J", "with rotation, then",
      [](Hit & h) -> auto& { return h.total_energy; });
  column(
      "top_height_m", "m", "highest vertex above the ground below the centroid, then",
      [](Hit & h) -> auto& { return h.top_height; });
  column(
      "bottom_height_m", "m", "lowest vertex above it, then",
      [](Hit & h) -> auto& { return h.bottom_height; });
  column(
      "largest_speed_m_s", "m/s", "while over the object",
      [](Hit & h) -> auto& { return h.largest_speed; });
  column(
      "largest_translational_energy_j", "J", "while over the object",
      [](Hit & h) -> auto& { return h.largest_translational_energy; });
  column(
      "largest_total_energy_j", "J", "while over the object",
      [](Hit & h) -> auto& { return h.largest_total_energy; });
  column(
      "largest_top_height_m", "m", "while over the object",
      [](Hit & h) -> auto& { return h.largest_top_height; });
}

template <class Visit>
void crossing_columns(Visit&& column) {
  column(
      "block", "1", "index of the block", [](Crossing & c) -> auto& { return c.block; });
  column(
      "line", "1", "index of the line", [](Crossing & c) -> auto& { return c.line; });
  column(
      "segment", "1", "segment of the line, from 0",
      [](Crossing & c) -> auto& { return c.segment; });
  column(
      "direction", "1", "+1 to the left of the line seen from its first point, -1 to the right",
      [](Crossing & c) -> auto& { return c.direction; });
  column(
      "n_crossings", "1", "how often the line itself was crossed, returns included; 0: beside it",
      [](Crossing & c) -> auto& { return c.n_crossings; });
  column(
      "time_s", "s", "when the centroid crossed", [](Crossing & c) -> auto& { return c.time; });
  column(
      "chainage_m", "m",
      "where, horizontally from the line's first point; below 0 or above its length: beside it",
      [](Crossing & c) -> auto& { return c.chainage; });
  column(
      "position_x_m", "m", "centroid, local x",
      [](Crossing & c) -> auto& { return c.position.x(); });
  column(
      "position_y_m", "m", "centroid, local y",
      [](Crossing & c) -> auto& { return c.position.y(); });
  column(
      "position_z_m", "m", "centroid, local z",
      [](Crossing & c) -> auto& { return c.position.z(); });
  column(
      "velocity_x_m_s", "m/s", "velocity, x", [](Crossing & c) -> auto& { return c.velocity.x(); });
  column(
      "velocity_y_m_s", "m/s", "velocity, y", [](Crossing & c) -> auto& { return c.velocity.y(); });
  column(
      "velocity_z_m_s", "m/s", "velocity, z", [](Crossing & c) -> auto& { return c.velocity.z(); });
  column(
      "spin_x_rad_s", "rad/s", "angular velocity, x",
      [](Crossing & c) -> auto& { return c.spin.x(); });
  column(
      "spin_y_rad_s", "rad/s", "angular velocity, y",
      [](Crossing & c) -> auto& { return c.spin.y(); });
  column(
      "spin_z_rad_s", "rad/s", "angular velocity, z",
      [](Crossing & c) -> auto& { return c.spin.z(); });
  column(
      "translational_energy_j", "J", "kinetic energy of translation",
      [](Crossing & c) -> auto& { return c.translational_energy; });
  column(
      "rotational_energy_j", "J", "kinetic energy of rotation",
      [](Crossing & c) -> auto& { return c.rotational_energy; });
  column(
      "centroid_height_m", "m", "centroid above the line's base",
      [](Crossing & c) -> auto& { return c.centroid_height; });
  column(
      "top_height_m", "m", "highest vertex above the line's base",
      [](Crossing & c) -> auto& { return c.top_height; });
  column(
      "bottom_height_m", "m", "lowest vertex above the line's base",
      [](Crossing & c) -> auto& { return c.bottom_height; });
}

template <class Visit>
void hit_columns(Visit&& column) {
  column(
      "block", "1", "index of the block", [](FenceHit & h) -> auto& { return h.block; });
  column(
      "line", "1", "index of the fence's line", [](FenceHit & h) -> auto& { return h.line; });
  column(
      "panel", "1", "panel of the fence, from 0 at its first point",
      [](FenceHit & h) -> auto& { return h.panel; });
  column(
      "time_s", "s", "of the first touch", [](FenceHit & h) -> auto& { return h.time; });
  column(
      "chainage_m", "m", "where, horizontally from the line's first point",
      [](FenceHit & h) -> auto& { return h.chainage; });
  column(
      "velocity_x_m_s", "m/s", "velocity before, x",
      [](FenceHit & h) -> auto& { return h.velocity.x(); });
  column(
      "velocity_y_m_s", "m/s", "velocity before, y",
      [](FenceHit & h) -> auto& { return h.velocity.y(); });
  column(
      "velocity_z_m_s", "m/s", "velocity before, z",
      [](FenceHit & h) -> auto& { return h.velocity.z(); });
  column(
      "translational_energy_j", "J", "kinetic energy of translation before",
      [](FenceHit & h) -> auto& { return h.translational_energy; });
  column(
      "rotational_energy_j", "J", "kinetic energy of rotation before",
      [](FenceHit & h) -> auto& { return h.rotational_energy; });
  column(
      "energy_after_j", "J", "kinetic energy with spin when block and panel last touched",
      [](FenceHit & h) -> auto& { return h.energy_after; });
  column(
      "work_j", "J", "energy that the panel took from the block by giving way; 0: it was rigid",
      [](FenceHit & h) -> auto& { return h.work; });
  column(
      "top_height_m", "m", "highest vertex above the panel's base",
      [](FenceHit & h) -> auto& { return h.top_height; });
  column(
      "bottom_height_m", "m", "lowest vertex above the panel's base",
      [](FenceHit & h) -> auto& { return h.bottom_height; });
}

template <class Visit>
void tree_hit_columns(Visit&& column) {
  column(
      "stem", "1", "id of the stem in its forest: of a list its row, else its number in the stand",
      [](TreeHitRow & t) -> auto& { return t.stem; });
  column(
      "forest", "1", "index of its forest", [](TreeHitRow & t) -> auto& { return t.forest; });
  column(
      "species", "1",
      "0 conifer, 1 broadleaf, 2 larch, 3 spruce, 4 fir, 5 pine, 6 maple, 7 beech, 8 oak, 9 "
      "robinia",
      [](TreeHitRow & t) -> auto& { return t.species; });
  column(
      "x_m", "m", "foot of the stem, local", [](TreeHitRow & t) -> auto& { return t.foot.x(); });
  column(
      "y_m", "m", "foot of the stem, local", [](TreeHitRow & t) -> auto& { return t.foot.y(); });
  column(
      "z_m", "m", "foot of the stem, local", [](TreeHitRow & t) -> auto& { return t.foot.z(); });
  column(
      "dbh_m", "m", "diameter at breast height", [](TreeHitRow & t) -> auto& { return t.dbh; });
  column(
      "capacity_j", "J", "energy that breaks it, before anything hit it",
      [](TreeHitRow & t) -> auto& { return t.capacity; });
  column(
      "left_j", "J", "what was left of that at the end of the run; 0: it is broken",
      [](TreeHitRow & t) -> auto& { return t.left; });
  column(
      "broken_at_s", "s", "when it broke; infinite: it stands",
      [](TreeHitRow & t) -> auto& { return t.broken_at; });
  column(
      "broken_by", "1", "block that broke it; -1: it stands",
      [](TreeHitRow & t) -> auto& { return t.broken_by; });
  column(
      "block", "1", "index of the block", [](TreeHitRow & t) -> auto& { return t.hit.block; });
  column(
      "time_s", "s", "of the first touch", [](TreeHitRow & t) -> auto& { return t.hit.time; });
  column(
      "height_m", "m", "of the first touch above the foot",
      [](TreeHitRow & t) -> auto& { return t.hit.height; });
  column(
      "velocity_x_m_s", "m/s", "velocity before, x",
      [](TreeHitRow & t) -> auto& { return t.hit.velocity.x(); });
  column(
      "velocity_y_m_s", "m/s", "velocity before, y",
      [](TreeHitRow & t) -> auto& { return t.hit.velocity.y(); });
  column(
      "velocity_z_m_s", "m/s", "velocity before, z",
      [](TreeHitRow & t) -> auto& { return t.hit.velocity.z(); });
  column(
      "translational_energy_j", "J", "kinetic energy of translation before",
      [](TreeHitRow & t) -> auto& { return t.hit.translational_energy; });
  column(
      "rotational_energy_j", "J", "kinetic energy of rotation before",
      [](TreeHitRow & t) -> auto& { return t.hit.rotational_energy; });
  column(
      "energy_after_j", "J", "kinetic energy with spin when block and stem last touched",
      [](TreeHitRow & t) -> auto& { return t.hit.energy_after; });
  column(
      "work_j", "J", "energy that the stem took from the block",
      [](TreeHitRow & t) -> auto& { return t.hit.work; });
}

template <class Visit>
void panel_columns(Visit&& column) {
  column(
      "line", "1", "index of the fence's line", [](PanelRow & p) -> auto& { return p.line; });
  column(
      "panel", "1", "panel of the fence, from 0 at its first point",
      [](PanelRow & p) -> auto& { return p.panel; });
  column(
      "capacity_j", "J", "energy that it takes before it breaks; infinite: rigid",
      [](PanelRow & p) -> auto& { return p.capacity; });
  column(
      "work_j", "J", "energy taken from blocks", [](PanelRow & p) -> auto& { return p.work; });
  column(
      "deflection_m", "m", "lasting, to the left of the line",
      [](PanelRow & p) -> auto& { return p.deflection; });
  column(
      "broken_at_s", "s", "when it broke; infinite: it stands",
      [](PanelRow & p) -> auto& { return p.broken_at; });
  column(
      "broken_by", "1", "block that broke it; -1: it stands",
      [](PanelRow & p) -> auto& { return p.broken_by; });
}

template <class Visit>
void break_columns(Visit&& column) {
  column(
      "block", "1", "body that broke", [](Break & b) -> auto& { return b.block; });
  column(
      "first_piece", "1", "the first of its two pieces; the other is the next body",
      [](Break & b) -> auto& { return b.first_piece; });
  column(
      "released", "1", "released block that the body was part of",
      [](Break & b) -> auto& { return b.released; });
  column(
      "generation", "1", "breaks of the released block before that, from piece to piece",
      [](Break & b) -> auto& { return b.generation; });
  column(
      "time_s", "s", "when it broke", [](Break & b) -> auto& { return b.time; });
  column(
      "position_x_m", "m", "its centroid then, local",
      [](Break & b) -> auto& { return b.place.x(); });
  column(
      "position_y_m", "m", "its centroid then, local",
      [](Break & b) -> auto& { return b.place.y(); });
  column(
      "position_z_m", "m", "its centroid then, local",
      [](Break & b) -> auto& { return b.place.z(); });
  column(
      "volume_m3", "m3", "of the body", [](Break & b) -> auto& { return b.volume; });
  column(
      "hit_loss_j", "J", "normal energy that the hit took, or left of it to a piece",
      [](Break & b) -> auto& { return b.hit_loss; });
  column(
      "fracture_j", "J", "work of fracture, part of that",
      [](Break & b) -> auto& { return b.fracture; });
  column(
      "separation_j", "J", "kinetic energy that drives the pieces apart, part of that",
      [](Break & b) -> auto& { return b.separation; });
}

template <class Visit>
void crushed_columns(Visit&& column) {
  column(
      "block", "1", "index of the block", [](CrushedBlock & c) -> auto& { return c.block; });
  column(
      "time_s", "s", "when it was crushed", [](CrushedBlock & c) -> auto& { return c.time; });
  column(
      "load_n", "N", "that was pressed through it, mean over 0.1 s",
      [](CrushedBlock & c) -> auto& { return c.load; });
  column(
      "strength_n", "N", "load that it could bear",
      [](CrushedBlock & c) -> auto& { return c.strength; });
  column(
      "position_x_m", "m", "centroid, where its debris stays, local",
      [](CrushedBlock & c) -> auto& { return c.place.x(); });
  column(
      "position_y_m", "m", "centroid, where its debris stays, local",
      [](CrushedBlock & c) -> auto& { return c.place.y(); });
  column(
      "position_z_m", "m", "centroid, where its debris stays, local",
      [](CrushedBlock & c) -> auto& { return c.place.z(); });
  column(
      "volume_m3", "m3", "of the block", [](CrushedBlock & c) -> auto& { return c.volume; });
  column(
      "mass_kg", "kg", "of the block", [](CrushedBlock & c) -> auto& { return c.mass; });
}

template <class Visit>
void deep_columns(Visit&& column) {
  column(
      "block", "1", "index of the block", [](DeepRow & d) -> auto& { return d.block; });
  column(
      "partner", "1",
      "block in which it was deepest; -1: the ground, -2: a fence, -3: a fixed body",
      [](DeepRow & d) -> auto& { return d.partner; });
  column(
      "line", "1", "index of the fence's line; -1: no fence",
      [](DeepRow & d) -> auto& { return d.line; });
  column(
      "panel", "1", "panel of the fence; -1: no fence",
      [](DeepRow & d) -> auto& { return d.panel; });
  column(
      "steps", "1", "steps that ended with it deep", [](DeepRow & d) -> auto& { return d.steps; });
  column(
      "first_time_s", "s", "end of the first of them",
      [](DeepRow & d) -> auto& { return d.first_time; });
  column(
      "time_s", "s", "when it was deepest", [](DeepRow & d) -> auto& { return d.time; });
  column(
      "depth_m", "m", "largest overlap of the two bodies",
      [](DeepRow & d) -> auto& { return d.depth; });
  column(
      "thickness_m", "m", "of the block", [](DeepRow & d) -> auto& { return d.thickness; });
  column(
      "position_x_m", "m", "centroid when it was deepest, local",
      [](DeepRow & d) -> auto& { return d.place.x(); });
  column(
      "position_y_m", "m", "centroid when it was deepest, local",
      [](DeepRow & d) -> auto& { return d.place.y(); });
  column(
      "position_z_m", "m", "centroid when it was deepest, local",
      [](DeepRow & d) -> auto& { return d.place.z(); });
  column(
      "mass_share", "1", "of the mass of all blocks",
      [](DeepRow & d) -> auto& { return d.mass_share; });
  column(
      "ends_in_toe", "1", "1: it ends farther from the top than 95 % of the mass",
      [](DeepRow & d) -> auto& { return d.ends_in_toe; });
  column(
      "met_fence", "1", "1: it was in a fence, or deep before it touched one or crossed its line",
      [](DeepRow & d) -> auto& { return d.met_fence; });
  column(
      "is_too_fast", "1", "1: it was faster than its fall can have made it",
      [](DeepRow & d) -> auto& { return d.is_too_fast; });
}

template <class Visit>
void health_columns(Visit&& column) {
  column(
      "time_s", "s", "end of the interval", [](HealthRow & h) -> auto& { return h.time; });
  column(
      "shortest_dt_s", "s", "shortest step with contact search; 0: none",
      [](HealthRow & h) -> auto& { return h.shortest_dt; });
  column(
      "steps", "1", "steps in the interval", [](HealthRow & h) -> auto& { return h.steps; });
  column(
      "substeps", "1", "block steps with contact search in the interval",
      [](HealthRow & h) -> auto& { return h.substeps; });
  column(
      "passes", "1", "iterations of the contact law in the interval",
      [](HealthRow & h) -> auto& { return h.passes; });
  column(
      "flips", "1", "contacts that opened, closed, or changed between stick and slip",
      [](HealthRow & h) -> auto& { return h.flips; });
  column(
      "impacts", "1", "impacts in the interval", [](HealthRow & h) -> auto& { return h.impacts; });
  column(
      "unconverged", "1", "block steps accepted without convergence in the interval",
      [](HealthRow & h) -> auto& { return h.unconverged; });
  column(
      "left_domain", "1", "blocks that have left the known terrain",
      [](HealthRow & h) -> auto& { return h.left_domain; });
  column(
      "fell_through", "1", "steps so far that ended with a block below the ground",
      [](HealthRow & h) -> auto& { return h.fell_through; });
  column(
      "not_finite", "1", "steps so far in which a block was stopped for want of a finite number",
      [](HealthRow & h) -> auto& { return h.not_finite; });
  column(
      "largest_penetration_m", "m",
      "largest overlap of a contact that presses, or of two bodies, in the interval",
      [](HealthRow & h) -> auto& { return h.largest_penetration; });
  column(
      "translational_energy_j", "J", "kinetic energy of translation, all blocks",
      [](HealthRow & h) -> auto& { return h.translation; });
  column(
      "rotational_energy_j", "J", "kinetic energy of rotation, all blocks",
      [](HealthRow & h) -> auto& { return h.rotation; });
  column(
      "potential_energy_j", "J", "potential energy above the local zero, all blocks",
      [](HealthRow & h) -> auto& { return h.potential; });
  column(
      "elastic_energy_j", "J", "elastic energy, all blocks",
      [](HealthRow & h) -> auto& { return h.elastic; });
  column(
      "friction_loss_j", "J", "dissipated by friction since the start",
      [](HealthRow & h) -> auto& { return h.friction; });
  column(
      "impact_loss_j", "J", "dissipated by impacts since the start",
      [](HealthRow & h) -> auto& { return h.impact; });
  column(
      "contact_loss_j", "J", "dissipated or stored by normal contact since the start",
      [](HealthRow & h) -> auto& { return h.contact; });
  column(
      "base_work_j", "J", "put in by base motion and point loads since the start",
      [](HealthRow & h) -> auto& { return h.base; });
  column(
      "fence_loss_j", "J", "taken by panels of fences that gave way since the start",
      [](HealthRow & h) -> auto& { return h.fence; });
  column(
      "removed_energy_j", "J", "kinetic energy of blocks stopped at the edge since the start",
      [](HealthRow & h) -> auto& { return h.removed; });
}

// Missing where nothing broke or was crushed.
template <class Visit>
void breakage_column(Visit&& column) {
  column(
      "breakage_loss_j", "J",
      "kinetic energy of blocks that were crushed, and work of fracture, since the start",
      [](HealthRow & h) -> auto& { return h.breakage; });
}

// Missing in runs of earlier versions.
template <class Visit>
void soil_columns(Visit&& column) {
  column(
      "rolling_loss_j", "J", "dissipated by rolling and pivoting resistance since the start",
      [](HealthRow & h) -> auto& { return h.rolling; });
  column(
      "drag_loss_j", "J", "dissipated by drag of the ground since the start",
      [](HealthRow & h) -> auto& { return h.drag; });
}

constexpr auto by_accuracy = static_cast<std::size_t>(SubstepCut::inaccurate);

// Missing in runs of earlier versions.
template <class Visit>
void cut_columns(Visit&& column) {
  for (std::size_t k = 0; k < substep_cut_names.size(); ++k) {
    if (k == by_accuracy) continue;
    column((std::string("cut_") + substep_cut_names[k]).c_str(), "1",
           "substeps of islands made again for this reason in the interval (docs/theory, stage 8)",
           [k](HealthRow & h) -> auto& { return h.cuts[k]; });
  }
}

// Missing in runs of earlier versions.
template <class Visit>
void accuracy_columns(Visit&& column) {
  column(
      "cut_inaccurate", "1",
      "substeps made again in the interval because of their estimated error ([solver] accuracy)",
      [](HealthRow & h) -> auto& { return h.cuts[by_accuracy]; });
  column(
      "largest_error", "1",
      "largest estimated error of a substep that was accepted in the interval, over the way",
      [](HealthRow & h) -> auto& { return h.largest_error; });
}

template <class Row, class Field>
using FieldType = std::remove_cvref_t<std::invoke_result_t<Field, Row&>>;

template <class Row, class Columns>
void write_table(H5Writer& file, const std::string& group, const std::string& description,
                 const std::vector<Row>& rows, Columns&& columns) {
  file.group(group, description);
  columns([&](const char* name, const char* units, const char* meaning, auto field) {
    std::vector<FieldType<Row, decltype(field)>> values;
    values.reserve(rows.size());
    for (Row row : rows) values.push_back(field(row));  // no copy of all of them
    file.array<FieldType<Row, decltype(field)>>(group + "/" + name, values,
                                                {{"row", values.size()}}, units, meaning);
  });
}

// `wanted`: the columns to read; empty: all.
template <class Row, class Columns>
std::vector<Row> read_table(const H5Reader& file, const std::string& group, Columns&& columns,
                            const std::set<std::string>& wanted = {}) {
  std::vector<Row> rows;
  bool is_first = true;
  columns([&](const char* name, const char*, const char*, auto field) {
    if (!wanted.empty() && !wanted.contains(name)) return;
    const auto values = file.array<FieldType<Row, decltype(field)>>(group + "/" + name, 1);
    if (is_first) rows.resize(values.size());
    is_first = false;
    if (values.size() != rows.size())
      throw InputError({group + "/" + name}, "has " + std::to_string(values.size()) +
                                                 " rows, the columns beside it have " +
                                                 std::to_string(rows.size()));
    for (std::size_t i = 0; i < rows.size(); ++i) field(rows[i]) = values[i];
  });
  return rows;
}

}  // namespace

void write_passage_table(H5Writer& file, const std::vector<Passage>& rows) {
  write_table(file, "passages", "one row per block and cell that it passed", rows,
              [](auto&& column) { passage_columns(column); });
}

void write_part_rows(H5Writer& file, const std::vector<PartRow>& rows) {
  file.group("rows", "one row per cell, run and block that passed it");
  const auto put = [&](const char* name, const char* units, const char* meaning, auto&& value) {
    using Value = std::remove_cvref_t<decltype(value(rows.front()))>;
    std::vector<Value> values;
    values.reserve(rows.size());
    for (const PartRow& row : rows) values.push_back(value(row));
    file.array<Value>(std::string("rows/") + name, values, {{"row", values.size()}}, units,
                      meaning);
  };
  put("run", "1", "index of the run", [](const PartRow& row) { return row.run; });
  passage_columns([&](const char* name, const char* units, const char* meaning, auto field) {
    if (std::string(name) == "cell") return;  // those of the group cells
    put(name, units, meaning, [&field](const PartRow& row) {
      Passage passage = row.passage;
      return field(passage);
    });
  });
}

std::vector<PartRow> read_part_rows(const H5Reader& file, std::size_t first, std::size_t n) {
  std::vector<PartRow> rows(n);
  const std::vector<std::int32_t> run = file.rows<std::int32_t>("rows/run", 1, first, n);
  for (std::size_t i = 0; i < n; ++i) rows[i].run = run[i];
  passage_columns([&](const char* name, const char*, const char*, auto field) {
    if (std::string(name) == "cell") return;
    using Value = FieldType<Passage, decltype(field)>;
    const std::vector<Value> values = file.rows<Value>(std::string("rows/") + name, 1, first, n);
    for (std::size_t i = 0; i < n; ++i) field(rows[i].passage) = values[i];
  });
  return rows;
}

void write_crossing_table(H5Writer& file, const std::vector<Crossing>& rows) {
  write_table(file, "crossings", "one row per block and line that it crossed or passed beside",
              rows, [](auto&& column) { crossing_columns(column); });
}

void write_object_hit_table(H5Writer& file, const std::vector<ObjectHit>& rows) {
  write_table(file, "object_hits", "one row per block and object that it touched", rows,
              [](auto&& column) { object_hit_columns(column); });
}

namespace {

// Only where rocks fell one by one.
template <class Visit>
void rock_column(Visit&& column) {
  column(
      "rock", "1",
      "released block that alone met the panel so, by its number in the run; -1: as it was at the "
      "start",
      [](PanelRow & p) -> auto& { return p.rock; });
}

}  // namespace

void write_panel_table(H5Writer& file, const std::vector<PanelRow>& rows) {
  const bool has_rocks =
      std::any_of(rows.begin(), rows.end(), [](const PanelRow& row) { return row.rock >= 0; });
  write_table(file, "fence_panels",
              has_rocks ? "one row per panel of the fences that stood, and one more per rock that "
                          "pushed it, as that left it"
                        : "one row per panel of the fences that stood, at the end",
              rows, [has_rocks](auto&& column) {
                panel_columns(column);
                if (has_rocks) rock_column(column);
              });
}

void write_hit_table(H5Writer& file, const std::vector<FenceHit>& rows) {
  write_table(file, "fence_hits", "one row per block and panel that it touched", rows,
              [](auto&& column) { hit_columns(column); });
}

void write_break_table(H5Writer& file, const std::vector<Break>& rows) {
  write_table(file, "breaks", "one row per block or piece that broke in two, by time", rows,
              [](auto&& column) { break_columns(column); });
}

void write_crushed_table(H5Writer& file, const std::vector<CrushedBlock>& rows) {
  write_table(file, "crushed_blocks", "one row per block that was crushed, by time", rows,
              [](auto&& column) { crushed_columns(column); });
}

void write_tree_hit_table(H5Writer& file, const std::vector<TreeHitRow>& rows) {
  write_table(file, "tree_hits", "one row per block and stem that it touched", rows,
              [](auto&& column) { tree_hit_columns(column); });
}

void write_deep_table(H5Writer& file, const std::vector<DeepRow>& rows) {
  write_table(file, "deep_blocks",
              "one row per block that was in something by more than a tenth of its thickness", rows,
              [](auto&& column) { deep_columns(column); });
}

void write_health_table(H5Writer& file, const std::vector<HealthRow>& rows) {
  const bool has_soil = std::any_of(rows.begin(), rows.end(), [](const HealthRow& row) {
    return row.rolling != 0 || row.drag != 0;
  });
  const bool any_breakage =
      std::any_of(rows.begin(), rows.end(), [](const HealthRow& row) { return row.breakage != 0; });
  write_table(file, "health", "how the computation went, interval by interval", rows,
              [has_soil, any_breakage](auto&& column) {
                health_columns(column);
                if (has_soil) soil_columns(column);
                if (any_breakage) breakage_column(column);
                cut_columns(column);
                accuracy_columns(column);
              });
}

namespace {

// Columns of health that not all runs have.
template <class Columns, class Take>
void read_beside(const H5Reader& file, const std::string& first, std::vector<HealthRow>& rows,
                 Columns&& columns, Take&& take) {
  if (!file.has(first)) return;
  const std::vector<HealthRow> read = read_table<HealthRow>(file, "health", columns);
  if (read.size() != rows.size())
    throw InputError({first}, "has " + std::to_string(read.size()) +
                                  " rows, the columns beside it have " +
                                  std::to_string(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) take(read[i], rows[i]);
}

}  // namespace

std::vector<Passage> read_passage_table(const H5Reader& file) {
  return read_table<Passage>(file, "passages", [](auto&& column) { passage_columns(column); });
}

std::vector<Crossing> read_crossing_table(const H5Reader& file) {
  return read_table<Crossing>(file, "crossings", [](auto&& column) { crossing_columns(column); });
}

std::vector<ObjectHit> read_object_hit_table(const H5Reader& file) {
  return read_table<ObjectHit>(file, "object_hits",
                               [](auto&& column) { object_hit_columns(column); });
}

std::vector<PanelRow> read_panel_table(const H5Reader& file) {
  const bool has_rocks = file.has("fence_panels/rock");
  return read_table<PanelRow>(file, "fence_panels", [has_rocks](auto&& column) {
    panel_columns(column);
    if (has_rocks) rock_column(column);
  });
}

std::vector<FenceHit> read_hit_table(const H5Reader& file) {
  return read_table<FenceHit>(file, "fence_hits", [](auto&& column) { hit_columns(column); });
}

std::vector<Break> read_break_table(const H5Reader& file) {
  return read_table<Break>(file, "breaks", [](auto&& column) { break_columns(column); });
}

std::vector<CrushedBlock> read_crushed_table(const H5Reader& file) {
  return read_table<CrushedBlock>(file, "crushed_blocks",
                                  [](auto&& column) { crushed_columns(column); });
}

std::vector<TreeHitRow> read_tree_hit_table(const H5Reader& file) {
  return read_table<TreeHitRow>(file, "tree_hits", [](auto&& column) { tree_hit_columns(column); });
}

std::vector<DeepRow> read_deep_table(const H5Reader& file) {
  return read_table<DeepRow>(file, "deep_blocks", [](auto&& column) { deep_columns(column); });
}

std::vector<HealthRow> read_health_table(const H5Reader& file, bool only_faults) {
  std::set<std::string> wanted;
  if (only_faults)
    wanted = {"unconverged", "left_domain", "fell_through", "not_finite", "largest_penetration_m"};
  std::vector<HealthRow> rows = read_table<HealthRow>(
      file, "health", [](auto&& column) { health_columns(column); }, wanted);
  if (only_faults) return rows;
  read_beside(
      file, std::string("health/cut_") + substep_cut_names.front(), rows,
      [](auto&& column) { cut_columns(column); },
      [](const HealthRow& read, HealthRow& row) { row.cuts = read.cuts; });
  read_beside(
      file, "health/cut_inaccurate", rows, [](auto&& column) { accuracy_columns(column); },
      [](const HealthRow& read, HealthRow& row) {
        row.cuts[by_accuracy] = read.cuts[by_accuracy];
        row.largest_error = read.largest_error;
      });
  read_beside(
      file, "health/rolling_loss_j", rows, [](auto&& column) { soil_columns(column); },
      [](const HealthRow& read, HealthRow& row) {
        row.rolling = read.rolling;
        row.drag = read.drag;
      });
  read_beside(
      file, "health/breakage_loss_j", rows, [](auto&& column) { breakage_column(column); },
      [](const HealthRow& read, HealthRow& row) { row.breakage = read.breakage; });
  return rows;
}

}  // namespace talus
