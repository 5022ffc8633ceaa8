// libcore/record/deep_rows.hpp: public
// Blocks that were deep in something, weighed: their mass, and whether they affect maps and fences.
// in:    State::deep
// out:   rows of the run file, their weight for its health, and a line of words for each
#pragma once

#include <span>
#include <string>
#include <vector>

#include "record/crossings.hpp"
#include "record/run_file.hpp"

namespace talus {

struct NumericalFault;

/// A row a block that was deep, at state.time; by block.
[[nodiscard]] std::vector<DeepRow> deep_rows(const Scene& scene, const State& state,
                                             std::span<const Crossing> crossings);

/// Of the mass of all blocks [-].
[[nodiscard]] double mass_share(std::span<const DeepRow> rows);

/// Blocks that end in the toe, met a fence, or were faster than their fall can have made them.
[[nodiscard]] int n_that_matter(std::span<const DeepRow> rows);

/// Those that matter first, then the heaviest.
[[nodiscard]] std::vector<DeepRow> by_weight(std::span<const DeepRow> rows);

/// The deepest overlap of a run, which need not be deep for its block; `deepest.block` is one.
[[nodiscard]] DeepRow deepest_row(const Scene& scene, const NumericalFault& deepest);

/// "the ground", "block 7", "panel 2 of fence NAME".
[[nodiscard]] std::string partner_name(const DeepRow& row, std::span<const RecordLine> lines);

/// Block, partner, time, place on the map, depth, thickness, share of the mass, and its
/// effect. `origin`: map coordinates of the local zero [m].
[[nodiscard]] std::string deep_words(const DeepRow& row, std::span<const RecordLine> lines,
                                     const Vec3& origin);

/// Block, time, place on the map and share of the mass; nothing where it did not happen.
[[nodiscard]] std::string fault_words(const Scene& scene, const NumericalFault& fault,
                                      const Vec3& origin);

}  // namespace talus
