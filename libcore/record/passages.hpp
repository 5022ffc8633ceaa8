// libcore/record/passages.hpp: public
// Which cells each block passed and how: one row per block and cell, kept up between all steps.
// in:    the solver's segments; the terrain; a grid of cells (the TRN's, or one of its own)
// out:   rows whose number grows with the cells touched, not with steps; frames do not enter
//
// A cell is passed while any part of the block's footprint lies over it (or its centroid, by
// choice). The footprint is the vertical projection of the block's vertices, replaced by the
// polygon with the same extent along eight axes 22.5 degrees apart: it holds the footprint, so no
// cell is missed, and exceeds it by at most a tenth of its longest side. A piece of motion is
// straight in plan; where the block turns in it by theta < 0.25 rad, the extents change linearly
// from end to end, widened by the sagitta r theta^2 / 8 (r theta^2 / 4 in free tumbling, whose axis
// turns too; below 2 % of the radius). Entry and exit of each cell and the largest values in
// between are then found in closed form.
#pragma once

#include "record/passage_recorder.hpp"

namespace talus {

/// The grid of the TRN's own cells, or of cells of `cell_size` from the same north-west corner that
/// covers it (NaN: the TRN's). Throws InputError for more than 1e8 cells.
[[nodiscard]] PassageGrid passage_grid(const Trn& trn, double cell_size);

/// Empty table; the blocks' start is their first passage.
[[nodiscard]] PassageRecorder start_passages(const Scene& scene, const PassageGrid& grid,
                                             bool by_centroid);
/// A block's place and motion before its first segment.
void record_start(PassageRecorder& recorder, const Scene& scene, int block, const Motion& motion,
                  double time);
/// The next segment of a block, which `motion` follows; segments of one block come in the order of
/// time.
void record_passages(PassageRecorder& recorder, const Scene& scene, SegmentMotion& motion);
/// Writes the pending values into the table; further segments may follow.
void flush_passages(PassageRecorder& recorder);

}  // namespace talus
