// libcore/scene/phase.hpp: public
// A block's life: the states that it may be in, the questions that the engine asks of them, and the
// transitions between them. Nothing else sets a phase.
//
//     unborn -> near_ground <-> flight
//               near_ground <-> asleep
//               near_ground, flight, asleep -> left_domain | stopped
//               near_ground -> crushed | broken
//
// A transition changes the life alone. Its caller books the energy and clears the memory
// (step/substep.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "motion/pose.hpp"

namespace talus {

/// Phase of a block. The numbers are in run files and checkpoints: append only.
enum class Phase : std::uint8_t {
  near_ground,  ///< contact is searched in every step
  flight,       ///< free until flight_end; its motion is that at `local_time`
  asleep,       ///< at rest
  left_domain,  ///< left the known terrain: stopped where it left, and counted
  stopped,      ///< its numbers failed: stopped at its last good state, and flagged
  unborn,       ///< not there yet: a fragment of a block that is still whole
  crushed,      ///< debris that supports nothing, where it was crushed
  broken,       ///< not there any more: its fragments are
};
inline constexpr Phase last_phase = Phase::broken;

// --- questions ---------------------------------------------------------------------------------

/// Whether it moves or may be moved: by the step, by other blocks, by a support that yields.
[[nodiscard]] constexpr bool takes_part(Phase phase) {
  return phase == Phase::near_ground || phase == Phase::flight || phase == Phase::asleep;
}
/// Whether a step leaves it where it is unless something wakes it.
[[nodiscard]] constexpr bool does_not_move(Phase phase) {
  return phase == Phase::asleep || !takes_part(phase);
}
/// Whether its mass and its energy count.
[[nodiscard]] constexpr bool exists(Phase phase) {
  return phase != Phase::unborn && phase != Phase::broken;
}
/// Whether nothing ever touches it, wherever it lies.
[[nodiscard]] constexpr bool carries_nothing(Phase phase) {
  return !exists(phase) || phase == Phase::crushed;
}

// --- the lives of all blocks -------------------------------------------------------------------

struct BlockLives {  // clang-format off
  std::vector<Phase> phase;                 ///<                                     (n_blocks)
  std::vector<double> local_time;           ///< time of its motion; lags in flight [s] (n_blocks)
  std::vector<double> flight_end;           ///< nothing can be hit before; of a block that does
                                            ///< not fly: it can not before [s]      (n_blocks)
  std::vector<Pose> rest_pose;              ///< pose that it has not left ...       (n_blocks)
  std::vector<int> rest_steps;              ///< ... for this many steps             (n_blocks)
};  // clang-format on

/// All blocks near the ground at time 0, each at its pose of `rest`.
[[nodiscard]] BlockLives start_lives(const std::vector<Pose>& rest);

[[nodiscard]] inline Phase phase_of(const BlockLives& lives, int b) { return lives.phase[b]; }
[[nodiscard]] inline bool takes_part(const BlockLives& lives, int b) {
  return takes_part(phase_of(lives, b));
}

// --- transitions -------------------------------------------------------------------------------

/// It flies on from its local time: nothing can be hit before `until`.
void take_off(BlockLives& lives, std::size_t b, double until);
/// Its flight ends at `time`.
void land(BlockLives& lives, std::size_t b, double time);
void go_to_sleep(BlockLives& lives, std::size_t b);
/// A body that it rests on, or one near it, moves at `time`.
void wake(BlockLives& lives, std::size_t b, double time);
void leave_domain(BlockLives& lives, std::size_t b);
void stop_for_good(BlockLives& lives, std::size_t b);
/// It is debris from now on.
void crush_to_debris(BlockLives& lives, std::size_t b);
/// Its fragments, which be_born(), take its place.
void break_up(BlockLives& lives, std::size_t b);
/// It is not there until be_born(). Before the first step alone.
void keep_unborn(BlockLives& lives, std::size_t b);
/// It is there from `time` on, near the ground.
void be_born(BlockLives& lives, std::size_t b, double time);

}  // namespace talus
