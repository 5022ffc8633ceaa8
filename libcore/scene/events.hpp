// libcore/scene/events.hpp: public
// Events of a block, a row each: hits on fences and stems, and its end. The state collects them,
// run files keep them.
#pragma once

#include <cstdint>

#include "base/types.hpp"

namespace talus {

/// First touch of a block and a panel, and its outcome.
struct FenceHit {
  std::int32_t block = 0, line = 0, panel = 0;  ///< panel: number in its line
  double time = 0;                              ///< of the first touch [s]
  double chainage = 0;                          ///< of the place, from the line's first point [m]
  Vec3 velocity = Vec3::Zero();                 ///< of the centroid before [m/s]
  double translational_energy = 0;              ///< before [J]
  double rotational_energy = 0;                 ///< before [J]
  double energy_after = 0;   ///< kinetic, with spin, at the end of the last touch so far [J]
  double work = 0;           ///< taken from this block by the panel's yielding so far [J]
  double top_height = 0;     ///< of the block's highest vertex above the panel's base there [m]
  double bottom_height = 0;  ///< of its lowest vertex [m]
};

/// First touch of a block and a stem, and its outcome.
struct StemHit {
  std::int32_t block = 0, stem = 0;  ///< stem: of the scene
  double time = 0;                   ///< of the first touch [s]
  double height = 0;                 ///< of the place above the foot [m]
  Vec3 velocity = Vec3::Zero();      ///< of the centroid before [m/s]
  double translational_energy = 0;   ///< before [J]
  double rotational_energy = 0;      ///< before [J]
  double energy_after = 0;  ///< kinetic, with spin, at the end of the last touch so far [J]
  double work = 0;          ///< taken from this block so far [J]
};

/// A block that was crushed.
struct CrushedBlock {
  std::int32_t block = 0;
  double time = 0;            ///< [s]
  double load = 0;            ///< that went through it, mean over law::load_time [N]
  double strength = 0;        ///< the load that it could carry [N]
  Vec3 place = Vec3::Zero();  ///< of its centroid; it stays there as debris [m]
  double volume = 0;          ///< [m3]
  double mass = 0;            ///< [kg]
};

/// A block that broke into two pieces.
struct Break {
  std::int32_t block = 0;
  std::int32_t first_piece = 0;  ///< the other one is the next
  std::int32_t released = 0;     ///< the released block that it was part of
  std::int32_t generation = 0;   ///< of the block
  double time = 0;               ///< [s]
  Vec3 place = Vec3::Zero();     ///< of its centroid [m]
  double volume = 0;             ///< of the block [m3]
  double hit_loss = 0;           ///< normal energy that the hit took, or left of it to a piece [J]
  double fracture = 0;           ///< work of fracture, part of that [J]
  double separation = 0;         ///< that drives the pieces apart, part of that [J]
};

}  // namespace talus
