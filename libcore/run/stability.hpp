// libcore/run/stability.hpp: public
// Factor of safety by strength reduction: the largest divisor of tan(friction), cohesion and
// tensile strength of all joints and grounds before blocks move.
// in:    a Scene at rest; water in its joints stays as it is at the start. Motion while
//        its ground shakes (Scene::base) is computed first
// out:   the factor of the blocks that go first, of the mass, and of each block
// refs:  Matsui and San 1992 (strength reduction); docs/tools/talus-stability.md
//
// A block moves when it is farther from where it was in the last quarter of a short run than in the
// quarter before, and accelerates by more than 5e-4 of gravity: a block that settles onto its
// contacts slows down. Where the ground shakes, the run begins when that has ended, and a block
// that is farther from its place than its own size, or moved before, has moved, too.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "blocks/block_set.hpp"
#include "scene/scene.hpp"

namespace talus {

/// Of the mass: the first part is more than a splinter; with half of it the mass goes.
constexpr double share_of_first = 0.01, share_of_mass = 0.5;

struct StabilitySettings {
  double duration = 1;             ///< of a run [s]
  double resolution = 0.01;        ///< of a factor, between a run that holds and one that moves [-]
  double least = 0.05, most = 20;  ///< factors tried [-]
};

/// A run with the strength divided by `factor`.
struct ReducedRun {
  double factor = 1;
  std::vector<bool> moves;  ///< (n_blocks)
  double moved_share = 0;   ///< of the mass [-]
  double displacement = 0;  ///< at the end, mean by mass [m]
};

/// A factor between those of two runs.
struct SafetyFactor {
  double holds = 0;  ///< largest factor tried at which it holds; 0: none
  double moves = 0;  ///< smallest at which it moves; infinity: none
  [[nodiscard]] double value() const { return (holds + moves) / 2; }
};

struct Stability {
  SafetyFactor first;  ///< of the blocks that go first: more than `share_of_first`
  SafetyFactor mass;   ///< of more than `share_of_mass`
  std::vector<double>
      of_block;  ///< smallest factor tried at which it moves; infinity: none (n_blocks)
  std::vector<ReducedRun> runs;  ///< by factor
};

/// The scene with its strength divided by `factor`, blocks at rest and water that does not drain.
[[nodiscard]] Scene with_strength_reduced(Scene scene, double factor);

[[nodiscard]] ReducedRun run_reduced(const Scene& scene, double factor,
                                     const StabilitySettings& settings);

/// `said`, where given, hears of each run.
[[nodiscard]] Stability find_stability(const Scene& scene, const StabilitySettings& settings,
                                       const std::function<void(const ReducedRun&)>& said = {});

/// The factor by formula (blocks/limit_equilibrium.hpp) of blocks that slide as one body over the
/// faces that were cut at the failure surface, under the loads of the scene. None where these are
/// no plane and no wedge.
[[nodiscard]] std::optional<double> factor_as_one_body(const Scene& scene, const BlockSet& blocks);

}  // namespace talus
