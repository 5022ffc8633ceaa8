// libcore/setup/source_cut_gdal.hpp: public
// [source] and [joints.*] of the site file: the mass between the ground and the failure surface,
// and the blocks that its joints cut it into.
#pragma once

#include "base/input_log.hpp"
#include "setup/source_work.hpp"

namespace talus {

/// The polygon of [source], from the site file or the vector file that it names, reprojected with a
/// note and checked (check_area). Throws InputError where the section names none or both.
[[nodiscard]] Area read_source_area(InputLog& log, const BlocksWork& work);

/// Reads [joints.*] with the files that it names into `work.sets`.
void plan_sets(InputLog& log, BlocksWork& work);

/// The planes of `work.sets` that a mass can leave on, into `work.planes`.
void find_planes(InputLog& log, BlocksWork& work);

/// The wedges of pairs of `work.sets`, into `work.wedges`; after find_planes().
void find_wedges(BlocksWork& work);

/// Where the polygon of [source] is written.
[[nodiscard]] Where where_of_area(const BlocksWork& work);

/// Draws the joints of `work.sets`, cuts the mass by them and puts the blocks into `work.blocks`,
/// as they are cut (`exact`) or made convex. `beside`: mean spacings from the middle of the mass to
/// the place that offset_m is from. Throws InputError for more than source.max_blocks.
void cut_by_joints(InputLog& log, bool exact, const MassMeasure& measure, double beside,
                   BlocksWork& work);

/// Finds the mass, draws the joints and puts the blocks into `work.blocks`, as they are cut
/// (`exact`) or made convex. Warns of parts left out or below the limits. Throws InputError
/// for more blocks than source.max_blocks, and where none is left.
void cut_source(InputLog& log, bool exact, BlocksWork& work);

/// By how much the volumes of the pieces differ from that of the mass, as a share of it.
[[nodiscard]] double volume_error(const BlocksWork& work);

}  // namespace talus
