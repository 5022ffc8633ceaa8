// libcore/dda/fixed_bodies.hpp
// Bodies without mass that no block moves: panels of fences, prisms of a blocky slope. Blocks meet
// them through the same search as other blocks; for the solver of an island they are the ground.
// in:    hulls appended to Blocks::hulls after those of the blocks; panels from dda/fence.hpp
// out:   what a contact with a fixed body does; what panels have met so far
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "base/types.hpp"
#include "contact/ground.hpp"
#include "contact/pose.hpp"

namespace talus {

/// A panel of a fence: the plate between two neighbouring posts. Lengths in local coordinates.
struct FencePanel {
  static constexpr double no_limit = std::numeric_limits<double>::infinity();
  int line = 0;                ///< index of the fence's line among those of the run
  int number = 0;              ///< of the panel in its line, from 0
  Vec3 foot_a, foot_b;         ///< of the posts; the base is straight between them [m]
  double chainage = 0;         ///< of foot_a along the line, horizontal [m]
  Vec3 normal;                 ///< horizontal unit vector to the left of the line
  double capacity = no_limit;  ///< energy that it takes before it breaks; infinite: rigid [J]
  double force = no_limit;     ///< with which it resists each block while it gives way [N]
};

/// Bodies that stay where they are. Body n_blocks + f of Blocks::hulls is fixed body f.
struct FixedBodies {  // clang-format off
  std::vector<Pose> pose;           ///< body axes parallel to the local ones            (n_fixed)
  std::vector<int> contact_class;   ///< index into `classes`                            (n_fixed)
  std::vector<int> panel;           ///< index into `panels`, -1: no panel               (n_fixed)
  std::vector<GroundClass> classes;
  std::vector<FencePanel> panels;
};  // clang-format on

/// What one block does to one panel that gives way, over a substep.
struct PanelPush {
  int block = 0, panel = 0;
  double work = 0;   ///< taken from the block [J]
  double power = 0;  ///< of the force at the start of the substep [W]
  double shift = 0;  ///< that the panel is pushed on, along its normal [m]
  double to = 0;  ///< FencePanel deflection that the block pushes it to, where shift is not 0 [m]
};

/// First touch of a block and a panel, and what became of it.
struct FenceHit {
  std::int32_t block = 0, line = 0, panel = 0;  ///< panel: number in its line
  double time = 0;                              ///< of the first touch [s]
  double chainage = 0;                          ///< of the place, from the line's first point [m]
  Vec3 velocity = Vec3::Zero();                 ///< of the centroid before [m/s]
  double translational_energy = 0;              ///< before [J]
  double rotational_energy = 0;                 ///< before [J]
  double energy_after = 0;   ///< kinetic, with spin, at the end of the last touch so far [J]
  double work = 0;           ///< taken from this block by the panel's giving way so far [J]
  double top_height = 0;     ///< of the block's highest vertex above the panel's base there [m]
  double bottom_height = 0;  ///< of its lowest vertex [m]
};

/// What the panels have met since the start; part of the state.
struct FenceState {  // clang-format off
  std::vector<double> deflection;  ///< along FencePanel::normal, lasting [m]            (n_panels)
  std::vector<double> work;        ///< taken so far, <= capacity [J]                    (n_panels)
  std::vector<double> broken_at;   ///< time; infinite while it stands [s]               (n_panels)
  std::vector<int> broken_by;      ///< block; -1 while it stands                        (n_panels)
  std::vector<FenceHit> hits;      ///< in the order of their times, step by step
};  // clang-format on

}  // namespace talus
