// libcore/record/passage_flight.hpp
// Passages of a flight, cut into pieces of which only those are followed that matter: where the
// covered cells may change, and where the block's top may come higher than it has.
#pragma once

#include "record/passage_piece.hpp"

namespace talus {

/// The flight that `motion` follows, in `n` equal pieces. `piece`: the first one's start; its
/// duration, sag, turn and sagitta are those of each.
void record_flight(PassageRecorder& recorder, const Scene& scene, SegmentMotion& motion,
                   const PassagePiece& piece, int n);

}  // namespace talus
