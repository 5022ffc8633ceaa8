// Fields of the tables of a run: names, units, titles.
#include "record/tables.hpp"

namespace talus {
namespace {

template <class Row, class Member>
Row row_of(Member Row::*);

template <auto member>
Slot of(decltype(row_of(member))& row) {
  return &(row.*member);
}
template <auto member, int axis>
Slot of(decltype(row_of(member))& row) {
  return &(row.*member)[axis];
}
template <SubstepCut why>
Slot cut(HealthRow& row) {
  return &row.cuts[static_cast<std::size_t>(why)];
}

}  // namespace

template <>
const Table<Passage>& table_of() {
  static const Table<Passage> table = {
      "passages",
      "blocks and the cells that they passed",
      {
          {"block", "1", "index of the block", of<&Passage::block>},
          {"cell", "1",
           "row * n_cols + column of the cell, row 0 in the north, column 0 in the west",
           of<&Passage::cell>},
          {"speed_m_s", "m/s", "largest speed of the centroid",
           [](Passage& p) -> Slot { return &p.largest.speed; }},
          {"translational_energy_j", "J", "largest kinetic energy of translation",
           [](Passage& p) -> Slot { return &p.largest.translational_energy; }},
          {"total_energy_j", "J", "largest kinetic energy with spin",
           [](Passage& p) -> Slot { return &p.largest.total_energy; }},
          {"centroid_height_m", "m",
           "largest height of the centroid above the ground below it, vertical; NaN: no known "
           "ground",
           [](Passage& p) -> Slot { return &p.largest.centroid_height; }},
          {"top_height_m", "m",
           "largest height of the highest vertex above the ground below the centroid, vertical",
           [](Passage& p) -> Slot { return &p.largest.top_height; }},
          {"first_time_s", "s", "time at which the block came over the cell",
           of<&Passage::first_time>},
          {"travel_angle_rad", "rad",
           "atan(drop of the centroid since its start / length of its path in plan) at that time; "
           "NaN: it had not moved in plan",
           of<&Passage::travel_angle>},
          {"heading_rad", "rad",
           "direction of the centroid at that time, from x to y; NaN: it stood in plan",
           of<&Passage::heading>},
      }};
  return table;
}

template <>
const Table<Crossing>& table_of() {
  static const Table<Crossing> table = {
      "crossings",
      "blocks and the lines that they crossed or passed beside",
      {
          {"block", "1", "index of the block", of<&Crossing::block>},
          {"line", "1", "index of the line", of<&Crossing::line>},
          {"segment", "1", "segment of the line, from 0", of<&Crossing::segment>},
          {"direction", "1",
           "+1 to the left of the line seen from its first point, -1 to the right",
           of<&Crossing::direction>},
          {"n_crossings", "1",
           "how often the line itself was crossed, returns included; 0: beside it",
           of<&Crossing::n_crossings>},
          {"time_s", "s", "time at which the centroid crossed", of<&Crossing::time>},
          {"chainage_m", "m",
           "place of the crossing, horizontally from the line's first point; below 0 or above its "
           "length: beside it",
           of<&Crossing::chainage>},
          {"position_x_m", "m", "centroid, local x", of<&Crossing::position, 0>},
          {"position_y_m", "m", "centroid, local y", of<&Crossing::position, 1>},
          {"position_z_m", "m", "centroid, local z", of<&Crossing::position, 2>},
          {"velocity_x_m_s", "m/s", "velocity, x", of<&Crossing::velocity, 0>},
          {"velocity_y_m_s", "m/s", "velocity, y", of<&Crossing::velocity, 1>},
          {"velocity_z_m_s", "m/s", "velocity, z", of<&Crossing::velocity, 2>},
          {"spin_x_rad_s", "rad/s", "angular velocity, x", of<&Crossing::spin, 0>},
          {"spin_y_rad_s", "rad/s", "angular velocity, y", of<&Crossing::spin, 1>},
          {"spin_z_rad_s", "rad/s", "angular velocity, z", of<&Crossing::spin, 2>},
          {"translational_energy_j", "J", "kinetic energy of translation",
           of<&Crossing::translational_energy>},
          {"rotational_energy_j", "J", "kinetic energy of rotation",
           of<&Crossing::rotational_energy>},
          {"centroid_height_m", "m", "centroid above the line's base",
           of<&Crossing::centroid_height>},
          {"top_height_m", "m", "highest vertex above the line's base", of<&Crossing::top_height>},
          {"bottom_height_m", "m", "lowest vertex above the line's base",
           of<&Crossing::bottom_height>},
      }};
  return table;
}

template <>
const Table<ObjectHit>& table_of() {
  static const Table<ObjectHit> table = {
      "object_hits",
      "blocks and the objects that they touched",
      {
          {"block", "1", "index of the block", of<&ObjectHit::block>},
          {"object", "1", "index of the object", of<&ObjectHit::object>},
          {"time_s", "s", "time of the first touch in plan", of<&ObjectHit::time>},
          {"position_x_m", "m", "centroid at the first touch, local x",
           of<&ObjectHit::position, 0>},
          {"position_y_m", "m", "centroid at the first touch, local y",
           of<&ObjectHit::position, 1>},
          {"position_z_m", "m", "centroid at the first touch, local z",
           of<&ObjectHit::position, 2>},
          {"speed_m_s", "m/s", "speed of the centroid at the first touch", of<&ObjectHit::speed>},
          {"translational_energy_j", "J", "kinetic energy of translation at the first touch",
           of<&ObjectHit::translational_energy>},
          {"total_energy_j", "J", "kinetic energy with spin at the first touch",
           of<&ObjectHit::total_energy>},
          {"top_height_m", "m",
           "highest vertex above the ground below the centroid, at the first touch",
           of<&ObjectHit::top_height>},
          {"bottom_height_m", "m",
           "lowest vertex above the ground below the centroid, at the first touch",
           of<&ObjectHit::bottom_height>},
          {"largest_speed_m_s", "m/s", "largest speed while over the object",
           of<&ObjectHit::largest_speed>},
          {"largest_translational_energy_j", "J",
           "largest kinetic energy of translation while over the object",
           of<&ObjectHit::largest_translational_energy>},
          {"largest_total_energy_j", "J", "largest kinetic energy with spin while over the object",
           of<&ObjectHit::largest_total_energy>},
          {"largest_top_height_m", "m",
           "largest height of the highest vertex while over the object",
           of<&ObjectHit::largest_top_height>},
      }};
  return table;
}

template <>
const Table<RoofHit>& table_of() {
  static const Table<RoofHit> table = {
      "roof_hits",
      "blocks and the roofs of galleries that they hit: the hit with the most energy along the "
      "normal",
      {
          {"block", "1", "index of the block", of<&RoofHit::block>},
          {"line", "1", "index of the line at the valley edge of the roof", of<&RoofHit::line>},
          {"n_hits", "1", "hits of the roof by the block", of<&RoofHit::n_hits>},
          {"time_s", "s", "time of the hit", of<&RoofHit::time>},
          {"mass_kg", "kg", "mass of the body that hit", of<&RoofHit::mass>},
          {"volume_m3", "m3", "its volume", of<&RoofHit::volume>},
          {"position_x_m", "m", "centroid, local x", of<&RoofHit::position, 0>},
          {"position_y_m", "m", "centroid, local y", of<&RoofHit::position, 1>},
          {"position_z_m", "m", "centroid, local z", of<&RoofHit::position, 2>},
          {"velocity_x_m_s", "m/s", "velocity just before, x", of<&RoofHit::velocity, 0>},
          {"velocity_y_m_s", "m/s", "velocity just before, y", of<&RoofHit::velocity, 1>},
          {"velocity_z_m_s", "m/s", "velocity just before, z", of<&RoofHit::velocity, 2>},
          {"normal_speed_m_s", "m/s", "its part normal to the roof, into it",
           of<&RoofHit::normal_speed>},
      }};
  return table;
}

template <>
const Table<PanelRow>& table_of() {
  static const Table<PanelRow> table = {
      "fence_panels",
      "panels of the fences that stood, at the end; of rocks that fell one by one, at the start, "
      "then once more per rock that pushed them, as that rock left them",
      {
          {"line", "1", "index of the fence's line", of<&PanelRow::line>},
          {"panel", "1", "panel of the fence, from 0 at its first point", of<&PanelRow::panel>},
          {"capacity_j", "J", "energy that the panel takes before it breaks; infinite: rigid",
           of<&PanelRow::capacity>},
          {"work_j", "J", "energy taken from blocks", of<&PanelRow::work>},
          {"deflection_m", "m", "lasting deflection, to the left of the line",
           of<&PanelRow::deflection>},
          {"broken_at_s", "s", "time at which the panel broke; infinite: it stands",
           of<&PanelRow::broken_at>},
          {"broken_by", "1", "block that broke the panel; -1: it stands", of<&PanelRow::broken_by>},
          {"rock", "1",
           "released block that alone met the panel so, by its number in the run; -1: as it was at "
           "the start",
           of<&PanelRow::rock>, Kept::where_any},
      }};
  return table;
}

template <>
const Table<FenceHit>& table_of() {
  static const Table<FenceHit> table = {
      "fence_hits",
      "blocks and the panels that they touched",
      {
          {"block", "1", "index of the block", of<&FenceHit::block>},
          {"line", "1", "index of the fence's line", of<&FenceHit::line>},
          {"panel", "1", "panel of the fence, from 0 at its first point", of<&FenceHit::panel>},
          {"time_s", "s", "time of the first touch", of<&FenceHit::time>},
          {"chainage_m", "m", "place of the first touch, horizontally from the line's first point",
           of<&FenceHit::chainage>},
          {"velocity_x_m_s", "m/s", "velocity before the first touch, x",
           of<&FenceHit::velocity, 0>},
          {"velocity_y_m_s", "m/s", "velocity before the first touch, y",
           of<&FenceHit::velocity, 1>},
          {"velocity_z_m_s", "m/s", "velocity before the first touch, z",
           of<&FenceHit::velocity, 2>},
          {"translational_energy_j", "J", "kinetic energy of translation before the first touch",
           of<&FenceHit::translational_energy>},
          {"rotational_energy_j", "J", "kinetic energy of rotation before the first touch",
           of<&FenceHit::rotational_energy>},
          {"energy_after_j", "J", "kinetic energy with spin when block and panel last touched",
           of<&FenceHit::energy_after>},
          {"work_j", "J",
           "energy that the panel took from the block by giving way; 0: it was rigid",
           of<&FenceHit::work>},
          {"top_height_m", "m", "highest vertex above the panel's base", of<&FenceHit::top_height>},
          {"bottom_height_m", "m", "lowest vertex above the panel's base",
           of<&FenceHit::bottom_height>},
      }};
  return table;
}

template <>
const Table<TreeHitRow>& table_of() {
  static const Table<TreeHitRow> table = {
      "tree_hits",
      "blocks and the stems that they touched",
      {
          {"stem", "1",
           "id of the stem in its forest: of a list its row, else its number in the stand",
           of<&TreeHitRow::stem>},
          {"forest", "1", "index of its forest", of<&TreeHitRow::forest>},
          {"species", "1",
           "0 conifer, 1 broadleaf, 2 larch, 3 spruce, 4 fir, 5 pine, 6 maple, 7 beech, 8 oak, 9 "
           "robinia",
           of<&TreeHitRow::species>},
          {"x_m", "m", "foot of the stem, local x", of<&TreeHitRow::foot, 0>},
          {"y_m", "m", "foot of the stem, local y", of<&TreeHitRow::foot, 1>},
          {"z_m", "m", "foot of the stem, local z", of<&TreeHitRow::foot, 2>},
          {"dbh_m", "m", "diameter at breast height", of<&TreeHitRow::dbh>},
          {"capacity_j", "J", "energy that breaks the stem, before anything hit it",
           of<&TreeHitRow::capacity>},
          {"left_j", "J",
           "capacity left at the end of the run; 0: it is broken. Of rocks that fell one by one, "
           "by that rock alone",
           of<&TreeHitRow::left>},
          {"broken_at_s", "s", "time at which the stem broke; infinite: it stands",
           of<&TreeHitRow::broken_at>},
          {"broken_by", "1", "block that broke the stem; -1: it stands",
           of<&TreeHitRow::broken_by>},
          {"block", "1", "index of the block", [](TreeHitRow& t) -> Slot { return &t.hit.block; }},
          {"time_s", "s", "time of the first touch",
           [](TreeHitRow& t) -> Slot { return &t.hit.time; }},
          {"height_m", "m", "height of the first touch above the foot",
           [](TreeHitRow& t) -> Slot { return &t.hit.height; }},
          {"velocity_x_m_s", "m/s", "velocity before the first touch, x",
           [](TreeHitRow& t) -> Slot { return &t.hit.velocity.x(); }},
          {"velocity_y_m_s", "m/s", "velocity before the first touch, y",
           [](TreeHitRow& t) -> Slot { return &t.hit.velocity.y(); }},
          {"velocity_z_m_s", "m/s", "velocity before the first touch, z",
           [](TreeHitRow& t) -> Slot { return &t.hit.velocity.z(); }},
          {"translational_energy_j", "J", "kinetic energy of translation before the first touch",
           [](TreeHitRow& t) -> Slot { return &t.hit.translational_energy; }},
          {"rotational_energy_j", "J", "kinetic energy of rotation before the first touch",
           [](TreeHitRow& t) -> Slot { return &t.hit.rotational_energy; }},
          {"energy_after_j", "J", "kinetic energy with spin when block and stem last touched",
           [](TreeHitRow& t) -> Slot { return &t.hit.energy_after; }},
          {"work_j", "J", "energy that the stem took from the block",
           [](TreeHitRow& t) -> Slot { return &t.hit.work; }},
      }};
  return table;
}

template <>
const Table<HealthRow>& table_of() {
  static const Table<HealthRow> table = {
      "health",
      "how the computation went, interval by interval",
      {
          {"time_s", "s", "end of the interval", of<&HealthRow::time>},
          {"shortest_dt_s", "s", "shortest step with contact search; 0: none",
           of<&HealthRow::shortest_dt>},
          {"steps", "1", "steps in the interval", of<&HealthRow::steps>},
          {"substeps", "1", "block steps with contact search in the interval",
           of<&HealthRow::substeps>},
          {"passes", "1", "iterations of the contact law in the interval", of<&HealthRow::passes>},
          {"flips", "1",
           "contacts that opened, closed, or changed between stick and slip; with law talus only "
           "of blocks that touch nothing but the ground",
           of<&HealthRow::flips>},
          {"impacts", "1", "impacts in the interval", of<&HealthRow::impacts>},
          {"unconverged", "1", "block steps accepted without convergence in the interval",
           of<&HealthRow::unconverged>, Kept::as_fault},
          {"left_domain", "1", "blocks that have left the known terrain",
           of<&HealthRow::left_domain>, Kept::as_fault},
          {"fell_through", "1", "steps so far that ended with a block below the ground",
           of<&HealthRow::fell_through>, Kept::as_fault},
          {"not_finite", "1",
           "steps so far in which a block was stopped because a number was not finite",
           of<&HealthRow::not_finite>, Kept::as_fault},
          {"largest_penetration_m", "m",
           "largest overlap in the interval of a contact that presses; where it exceeds a "
           "hundredth of the thickness, of the two bodies",
           of<&HealthRow::largest_penetration>, Kept::as_fault},
          {"translational_energy_j", "J", "kinetic energy of translation, all blocks",
           of<&HealthRow::translation>},
          {"rotational_energy_j", "J", "kinetic energy of rotation, all blocks",
           of<&HealthRow::rotation>},
          {"potential_energy_j", "J", "potential energy above the local zero, all blocks",
           of<&HealthRow::potential>},
          {"elastic_energy_j", "J", "elastic energy, all blocks", of<&HealthRow::elastic>},
          {"friction_loss_j", "J", "dissipated by friction since the start",
           of<&HealthRow::friction>},
          {"impact_loss_j", "J", "dissipated by impacts since the start", of<&HealthRow::impact>},
          {"contact_loss_j", "J", "dissipated or stored by normal contact since the start",
           of<&HealthRow::contact>},
          {"base_work_j", "J", "put in by base motion and point loads since the start",
           of<&HealthRow::base>},
          {"fence_loss_j", "J", "taken by panels and stems that gave way since the start",
           of<&HealthRow::fence>},
          {"removed_energy_j", "J", "kinetic energy of blocks stopped at the edge since the start",
           of<&HealthRow::removed>},
          {"rolling_loss_j", "J", "dissipated by rolling and pivoting resistance since the start",
           of<&HealthRow::rolling>, Kept::where_any},
          {"drag_loss_j", "J", "dissipated by drag of the ground since the start",
           of<&HealthRow::drag>, Kept::where_any},
          {"breakage_loss_j", "J",
           "kinetic energy of blocks that were crushed, and work of fracture, since the start",
           of<&HealthRow::breakage>, Kept::where_any},
          {"water_work_j", "J", "put in by the pressure of water in joints since the start",
           of<&HealthRow::water>, Kept::where_any},
          {"cut_yielding_touched", "1",
           "substeps made again because a fence or stem is first "
           "touched within it",
           cut<SubstepCut::yielding_touched>},
          {"cut_unconverged", "1", "substeps made again because its forces did not converge",
           cut<SubstepCut::unconverged>},
          {"cut_deep", "1",
           "substeps made again because a block would end deep in "
           "something",
           cut<SubstepCut::deep>},
          {"cut_hit", "1",
           "substeps made again because a contact of a small island "
           "closes within it",
           cut<SubstepCut::hit>},
          {"cut_bond_broken", "1",
           "substeps made again because a bond carries more than it "
           "holds",
           cut<SubstepCut::bond_broken>},
          {"cut_woken", "1",
           "substeps made again because a block asleep carries what it "
           "did not fall asleep under",
           cut<SubstepCut::woken>},
          {"cut_yielding_used_up", "1",
           "substeps made again because a fence or stem has taken all "
           "that it can",
           cut<SubstepCut::yielding_used_up>},
          {"cut_inaccurate", "1",
           "substeps made again because its estimated error is above "
           "[solver] accuracy",
           cut<SubstepCut::inaccurate>},
          {"largest_error", "1",
           "largest estimated error of a substep accepted in the interval, as a share of the "
           "displacement",
           of<&HealthRow::largest_error>},
      }};
  return table;
}

template <>
const Table<Break>& table_of() {
  static const Table<Break> table = {
      "breaks",
      "blocks and pieces that broke in two, by time",
      {
          {"block", "1", "body that broke", of<&Break::block>},
          {"first_piece", "1", "the first of its two pieces; the other is the next body",
           of<&Break::first_piece>},
          {"released", "1", "released block that the body was part of", of<&Break::released>},
          {"generation", "1", "breaks of the released block before this one, from piece to piece",
           of<&Break::generation>},
          {"time_s", "s", "time of the break", of<&Break::time>},
          {"position_x_m", "m", "centroid at the break, local x", of<&Break::place, 0>},
          {"position_y_m", "m", "centroid at the break, local y", of<&Break::place, 1>},
          {"position_z_m", "m", "centroid at the break, local z", of<&Break::place, 2>},
          {"volume_m3", "m3", "volume of the body", of<&Break::volume>},
          {"hit_loss_j", "J", "normal energy that the hit took, or that was left of it to a piece",
           of<&Break::hit_loss>},
          {"fracture_j", "J", "work of fracture, part of hit_loss_j", of<&Break::fracture>},
          {"separation_j", "J", "kinetic energy that drives the pieces apart, part of hit_loss_j",
           of<&Break::separation>},
      }};
  return table;
}

template <>
const Table<CrushedBlock>& table_of() {
  static const Table<CrushedBlock> table = {
      "crushed_blocks",
      "blocks that were crushed, by time",
      {
          {"block", "1", "index of the block", of<&CrushedBlock::block>},
          {"time_s", "s", "time at which the block was crushed", of<&CrushedBlock::time>},
          {"load_n", "N", "load that was pressed through it, mean over 0.1 s",
           of<&CrushedBlock::load>},
          {"strength_n", "N", "load that it could carry", of<&CrushedBlock::strength>},
          {"position_x_m", "m", "centroid, where its debris stays, local x",
           of<&CrushedBlock::place, 0>},
          {"position_y_m", "m", "centroid, where its debris stays, local y",
           of<&CrushedBlock::place, 1>},
          {"position_z_m", "m", "centroid, where its debris stays, local z",
           of<&CrushedBlock::place, 2>},
          {"volume_m3", "m3", "volume of the block", of<&CrushedBlock::volume>},
          {"mass_kg", "kg", "mass of the block", of<&CrushedBlock::mass>},
      }};
  return table;
}

template <>
const Table<DeepRow>& table_of() {
  static const Table<DeepRow> table = {
      "deep_blocks",
      "blocks that were in something by more than a tenth of their thickness",
      {
          {"block", "1", "index of the block", of<&DeepRow::block>},
          {"partner", "1",
           "block in which it was deepest; -1: the ground, -2: a fence, -3: a fixed body",
           of<&DeepRow::partner>},
          {"line", "1", "index of the fence's line; -1: no fence", of<&DeepRow::line>},
          {"panel", "1", "panel of the fence; -1: no fence", of<&DeepRow::panel>},
          {"steps", "1", "steps that ended with the block deep", of<&DeepRow::steps>},
          {"first_time_s", "s", "end of the first of these steps", of<&DeepRow::first_time>},
          {"time_s", "s", "time at which it was deepest", of<&DeepRow::time>},
          {"depth_m", "m", "largest overlap of the two bodies", of<&DeepRow::depth>},
          {"thickness_m", "m", "thickness of the block", of<&DeepRow::thickness>},
          {"position_x_m", "m", "centroid when it was deepest, local x", of<&DeepRow::place, 0>},
          {"position_y_m", "m", "centroid when it was deepest, local y", of<&DeepRow::place, 1>},
          {"position_z_m", "m", "centroid when it was deepest, local z", of<&DeepRow::place, 2>},
          {"mass_share", "1", "its share of the mass of all blocks", of<&DeepRow::mass_share>},
          {"ends_in_toe", "1", "1: it ends farther from the top than 95 % of the mass",
           of<&DeepRow::ends_in_toe>},
          {"met_fence", "1",
           "1: it was in a fence, or deep before it touched one or crossed its line",
           of<&DeepRow::met_fence>},
          {"is_too_fast", "1", "1: it was faster than its fall can have made it",
           of<&DeepRow::is_too_fast>},
      }};
  return table;
}

}  // namespace talus
