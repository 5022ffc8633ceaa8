// libcore/scene/fixed_bodies.hpp: public
// Bodies without mass that no block moves: panels of fences, prisms of a blocky slope. Some of them
// yield (Yielding). Blocks meet them through the search that finds other blocks; for the solver of
// an island they are the ground.
// in:    convex bodies, their class of ground, and how they yield
// out:   effect of a contact with a fixed body; hits so far on those that yield
//
// A fixed body has an id of its own, from 0. Only the search of pairs knows it as a body of
// Blocks::hulls (fixed_of(), hull_of_fixed() in scene/scene.hpp).
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "base/types.hpp"
#include "contact/ground.hpp"
#include "motion/pose.hpp"
#include "scene/events.hpp"
#include "scene/hit_chain.hpp"

namespace talus {

/// How a fixed body yields: a rigid body on a plastic brake, without mass. It resists each block
/// with `force` at most, is pushed along, and stays where it was pushed. Its work is the sum of
/// force times the distance that each block pushes it; at `capacity` it breaks and is gone.
struct Yielding {
  static constexpr double no_limit = std::numeric_limits<double>::infinity();
  double capacity = no_limit;  ///< energy that it takes before it breaks; infinite: rigid [J]
  double force = no_limit;     ///< with which it resists each block while it yields [N]
  Vec3 axis = Vec3::Zero();    ///< unit vector along which alone it yields; zero: along any push
  int body = 0;                ///< id of the fixed body
};

/// A panel of a fence: the plate between two neighbouring posts. Lengths in local coordinates.
struct FencePanel {
  int line = 0;         ///< index of the fence's line among those of the run
  int number = 0;       ///< of the panel in its line, from 0
  Vec3 foot_a, foot_b;  ///< of the posts; the base is straight between them [m]
  double chainage = 0;  ///< of foot_a along the line, horizontal [m]
  int yielding = 0;     ///< index into FixedBodies::yieldings
};

/// Bodies that stay where they are.
struct FixedBodies {  // clang-format off
  std::vector<Pose> pose;           ///< body axes parallel to the local ones            (n_fixed)
  std::vector<int> contact_class;   ///< index into `classes`                            (n_fixed)
  std::vector<int> yielding;        ///< index into `yieldings`, -1: it does not         (n_fixed)
  std::vector<int> panel;           ///< index into `panels`, -1: no panel               (n_fixed)
  std::vector<GroundClass> classes;
  std::vector<Yielding> yieldings;
  std::vector<FencePanel> panels;
};  // clang-format on

/// State of a yielding body, from its hits since the start.
struct Yielded {
  double work = 0;                        ///< taken so far, <= capacity [J]
  double deflection = 0;                  ///< along its axis, lasting [m]
  Vec3 shift = Vec3::Zero();              ///< of a body without an axis, lasting [m]
  double broken_at = Yielding::no_limit;  ///< time; infinite while it is whole [s]
  int broken_by = -1;                     ///< block; -1 while it is whole
};

/// State of a body that was pushed; bodies that nothing pushed have none.
struct MetBody {
  std::int32_t yielding = 0;  ///< index into `yieldings`; after them, the stems
  Yielded met;
};

/// Part of the state. Blocks that meet each other share one world: each finds fences and trees as
/// other blocks left them. Rocks that fall one by one have a world each: every body there is as it
/// was at the start, except those that the rock itself and its pieces pushed.
struct YieldingState {  // clang-format off
  std::vector<std::vector<MetBody>> worlds;  ///< bodies pushed there, ascending          (n_worlds)
  std::vector<int> shifted;         ///< fixed bodies pushed in the shared world, in that order
};  // clang-format on

/// Effect of one block on one yielding body, over a substep.
struct YieldPush {
  int block = 0, yielding = 0;  ///< yielding: index into `yieldings`; after them, the stems
  double work = 0;              ///< taken from the block [J]
  double power = 0;             ///< of the force at the start of the substep [W]
  double shift = 0;             ///< that the body is pushed on, along `along` [m]
  double to = 0;  ///< position along `along` that it is pushed to, where shift is not 0 [m]
  Vec3 along = Vec3::Zero();  ///< the body's axis; without one, normal of the contact
};

/// Hits on the panels of fences since the start; part of the state.
struct FenceState {
  std::vector<FenceHit> hits;  ///< in the order of their times, step by step
  HitChain chain;              ///< of `hits`
};

// --- names of partners of a contact ------------------------------------------------------------
// ContactKey::body_b and DeepBlock::partner: a block by its number, the ground, or a fixed body.

inline constexpr int ground_name = -1;
[[nodiscard]] constexpr int name_of_fixed(int id) { return -2 - id; }
[[nodiscard]] constexpr bool names_fixed(int name) { return name <= -2; }
[[nodiscard]] constexpr int fixed_of_name(int name) { return -2 - name; }

}  // namespace talus
