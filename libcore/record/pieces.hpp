// libcore/record/pieces.hpp: public
// Runs in which blocks broke, for evaluation: a row for each piece that is there at the end, from
// the release on.
// in:    a run file with all bodies that could have been (blocks/fragments.hpp)
// out:   the same file with those that are
//
// Until it comes off, a piece moves in its block: it has the place, the passages, the crossings and
// the energy of the block. Its weight is its share of the released block's volume, so sums over
// pieces are those over blocks.
#pragma once

#include "record/run_file.hpp"

namespace talus {

/// Replaces the bodies of `run` by those that exist at its end; does nothing where nothing can
/// break. Hits on fences, and rows of one body alone, go to its largest piece. Needs
/// phases; frames, passages, crossings and hits of objects as far as they were read.
void merge_pieces(RunFile& run);

/// The released block that each block is or is part of, by its number in the run  (n_blocks)
[[nodiscard]] std::vector<int> released_of(const RunFile& run);
/// Whose fences and trees the blocks of a run met: those of the released block where rocks fall one
/// by one; 0 where all share them  (n_blocks)
[[nodiscard]] std::vector<int> worlds_of(const RunFile& run);
/// How many blocks were released, or how many worlds there are.
[[nodiscard]] int count_different(const std::vector<int>& numbers);

}  // namespace talus
