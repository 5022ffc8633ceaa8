// libcore/scene/state.hpp: public
// All that must be saved to resume a run, bit for bit: motion of the blocks, contact memory, time.
// filled by: start() in step/step.hpp; changed by step() alone
#pragma once

#include <cstdint>
#include <vector>

#include "contact/block_pairs.hpp"
#include "contact/contact.hpp"
#include "motion/motion.hpp"
#include "scene/bonds.hpp"
#include "scene/events.hpp"
#include "scene/phase.hpp"
#include "scene/scene.hpp"

namespace talus {

/// Sums since the start over all blocks, all in joule; each term is >= 0 except `contact`,
/// `base` and `water`.
struct EnergyLedger {
  double friction = 0;  ///< dissipated by sliding
  double impact = 0;    ///< dissipated by the restitution law
  double contact = 0;   ///< dissipated or stored by normal contact and strain damping
  double base = 0;      ///< put in by base motion and point loads
  double water = 0;     ///< put in by the pressure of water in joints
  double fence = 0;     ///< taken by panels of fences, and other yielding bodies
  double rolling = 0;   ///< dissipated by rolling and pivoting resistance, in hits too
  double drag = 0;      ///< dissipated by drag of ground and forests
  double breakage = 0;  ///< kinetic energy of crushed blocks, and work of fracture
  double removed = 0;   ///< kinetic energy of blocks stopped at the domain's edge
};

/// How the island of a block was last moved, and the data that decide on its next step
/// (step/mass/stages.hpp).
struct MassShare {
  bool is_in_mass = false;  ///< by the mass step
  int calm = 0;             ///< steps in a row in which few of its blocks moved
  int unsettled = 0;        ///< steps in a row whose last sweep changed too much
  int barred = 0;           ///< steps for which it is not a mass, since its forces were not found
  int steady = 0;           ///< substeps in a row that a long step would have followed as well
};

/// Load of a sleeping block when it fell asleep, from one neighbour.
struct SleepLoad {
  std::int32_t block = 0;    ///< asleep
  std::int32_t by = 0;       ///< the neighbour
  Vec6 load = Vec6::Zero();  ///< force, and couple about the centroid of `block` [N, N m]
};

/// Slip distance of a block, on ground whose friction follows that.
struct SlipMemory {
  double distance = 0;  ///< [m]
  double time = 0;      ///< when it did so last [s]
};

/// Counts since the start.
struct RunCounters {
  std::int64_t steps = 0;         ///< calls of step()
  std::int64_t substeps = 0;      ///< block steps with contact search
  std::int64_t flight_skips = 0;  ///< block steps skipped in flight
  std::int64_t impacts = 0;       ///< impact events
  std::int64_t passes = 0;        ///< Newton or open-close iterations
  std::int64_t unconverged = 0;   ///< block steps accepted without convergence
  std::int64_t cut_back = 0;      ///< block steps repeated with a shorter one
  int left_domain = 0;            ///< blocks that left the known terrain
};

/// Load on a block that may be crushed (step/crushing.hpp): means over law::load_time, and sums of
/// the current step, which are zero between steps.
struct BlockLoad {
  Mat3 press = Mat3::Zero();       ///< sum of N n n^T over its contacts, N the normal force [N]
  Vec3 push = Vec3::Zero();        ///< sum of their forces [N]
  Mat3 step_press = Mat3::Zero();  ///< [N s]
  Vec3 step_push = Vec3::Zero();   ///< [N s]
};

/// Record of a block that was deep in something (step/deep_blocks.hpp).
struct DeepBlock {
  std::int64_t steps = 0;     ///< that ended with it deep
  double first_time = 0;      ///< end of the first of them [s]
  double depth = 0;           ///< largest [m]
  double time = 0;            ///< when that was [s]
  Vec3 place = Vec3::Zero();  ///< of its centroid then [m]
  int partner = ground_name;  ///< the body that it was deep in: see scene/fixed_bodies.hpp
  bool is_deep = false;       ///< at the end of the last step
  bool is_too_fast = false;   ///< at some time since, it was faster than its fall can have made it
};

/// A block that something happened to, when and where.
struct NumericalFault {
  int block = -1;             ///< -1: it did not happen
  int partner = -1;           ///< of an overlap: the other body; -1: the ground
  double depth = 0;           ///< of an overlap [m]
  double time = 0;            ///< end of the step [s]
  Vec3 place = Vec3::Zero();  ///< of the block's centroid then [m]
};

/// Blocks for the limits of a run's health (step/numerical_faults.hpp): the deepest overlap, and
/// the first block of each other kind.
struct NumericalFaults {
  NumericalFault deepest, unconverged, not_finite, left_domain, fell_through;
};

/// Phases, local times and rest of the blocks are those of BlockLives.
struct State : BlockLives {  // clang-format off
  double time = 0;                          ///< end of the last step [s]
  std::int64_t stride = 1;                  ///< nominal steps that the next step takes at once
  std::vector<Motion> motion;               ///<                                     (n_blocks)
  std::vector<Vec3> acceleration;           ///< of the last step, by contact too [m/s2]  (n_blocks)
  std::vector<Vec3> spin_rate;              ///< angular acceleration, body axes [rad/s2] (n_blocks)
  std::vector<Vec3> support;                ///< by the ground in the last substep, hits aside [m/s2] (n_blocks)
  std::vector<Vec6> strain;                 ///< body axes; empty for rigid blocks [-]    (n_blocks)
  std::vector<Vec6> strain_rate;            ///< body axes; empty for rigid blocks [1/s]  (n_blocks)
  std::vector<std::vector<ContactMemory>> memory;  ///< contacts of block b with the ground and
                                                   ///< blocks of higher number       (n_blocks)
  std::vector<MassShare> mass;              ///< empty: none was in a mass so far       (n_blocks)
  std::vector<SleepLoad> carried;           ///< sorted by block, by
  PairState pairs;                          ///< close pairs of blocks and their axes
  PlacedHulls placed;                       ///< where the pairs were searched last
  std::vector<BlockBond> bonds;             ///< sorted by block_a, block_b            (n_bonds)
  std::vector<double> pressure;             ///< share left of that at the start [-]   (n_wet_faces)
  std::vector<DeepBlock> deep;              ///<                                     (n_blocks)
  std::vector<SlipMemory> slid;                ///< empty: friction follows no distance (n_blocks)
  std::vector<BlockLoad> load;              ///< empty: none is crushed                 (n_blocks)
  std::vector<CrushedBlock> crushed;        ///< by time
  std::vector<double> hit_loss;             ///< of the current step; empty: none breaks [J]
                                            ///< (n_blocks)
  std::vector<std::int32_t> n_hits;         ///< steps with a hit; empty: none breaks   (n_blocks)
  std::vector<Break> breaks;                ///< by time
  NumericalFaults numerical_faults;                          ///< so far
  YieldingState yielding;                   ///< state of fixed bodies that yield
  FenceState fence;                         ///< hits on the panels of fences
  std::vector<StemHit> stem_hits;           ///< in the order of their times, step by step
  HitChain stem_chain;                      ///< of `stem_hits`
  EnergyLedger ledger;
  RunCounters counters;
};  // clang-format on

/// Slip memory of a block up to now; `memory` nullptr: no ground keeps it.
struct Slide {
  const SlipMemory* memory = nullptr;
  double t = 0;  ///< now [s]
};
[[nodiscard]] inline Slide slide_of(const State& state, int b, double t) {
  return {state.slid.empty() ? nullptr : &state.slid[static_cast<std::size_t>(b)], t};
}

}  // namespace talus
