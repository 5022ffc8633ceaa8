// Transitions between the phases of a block's life.
#include "scene/phase.hpp"

#include "base/error.hpp"

namespace talus {

using std::size_t;

BlockLives start_lives(const std::vector<Pose>& rest) {
  BlockLives lives;
  lives.phase.assign(rest.size(), Phase::near_ground);
  lives.local_time.assign(rest.size(), 0);
  lives.flight_end.assign(rest.size(), 0);
  lives.rest_pose = rest;
  lives.rest_steps.assign(rest.size(), 0);
  return lives;
}

void take_off(BlockLives& lives, size_t b, double until) {
  TALUS_ASSERT(lives.phase[b] == Phase::near_ground || lives.phase[b] == Phase::flight);
  lives.phase[b] = Phase::flight;
  lives.flight_end[b] = until;
}

void land(BlockLives& lives, size_t b, double time) {
  TALUS_ASSERT(lives.phase[b] == Phase::flight);
  lives.phase[b] = Phase::near_ground;
  lives.local_time[b] = time;
}

void go_to_sleep(BlockLives& lives, size_t b) {
  TALUS_ASSERT(takes_part(lives.phase[b]));
  lives.phase[b] = Phase::asleep;
}

void wake(BlockLives& lives, size_t b, double time) {
  TALUS_ASSERT(lives.phase[b] == Phase::asleep);
  lives.phase[b] = Phase::near_ground;
  lives.rest_steps[b] = 0;
  lives.local_time[b] = time;
}

void leave_domain(BlockLives& lives, size_t b) {
  TALUS_ASSERT(exists(lives.phase[b]));
  lives.phase[b] = Phase::left_domain;
}

void stop_for_good(BlockLives& lives, size_t b) { lives.phase[b] = Phase::stopped; }

void crush_to_debris(BlockLives& lives, size_t b) {
  TALUS_ASSERT(lives.phase[b] == Phase::near_ground);
  lives.phase[b] = Phase::crushed;
}

void break_up(BlockLives& lives, size_t b) {
  TALUS_ASSERT(takes_part(lives.phase[b]));
  lives.phase[b] = Phase::broken;
}

void keep_unborn(BlockLives& lives, size_t b) {
  TALUS_ASSERT(lives.phase[b] == Phase::near_ground);
  lives.phase[b] = Phase::unborn;
}

void be_born(BlockLives& lives, size_t b, double time) {
  TALUS_ASSERT(lives.phase[b] == Phase::unborn);
  lives.phase[b] = Phase::near_ground;
  lives.rest_steps[b] = 0;
  lives.local_time[b] = time;
}

}  // namespace talus
