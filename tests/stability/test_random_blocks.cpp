// Random thin, tiny and fast blocks on rough ground: none below it by more than the stated
// tolerance, none lost, no NaN, energy that only falls. The long form runs many more, on real
// terrain.
#include <gtest/gtest.h>

#include "stability/random_blocks.hpp"

namespace {

using namespace talus;

TEST(RandomBlocks, StayAboveRoughGroundAndNeverGainEnergy) {
  const Trn trn = stability::rough_trn(101, 5.0, 17);
  const stability::Outcome outcome = stability::run_random_blocks(trn, 150, 4.0, 1);
  stability::expect_sound(outcome, 150);
}

}  // namespace
