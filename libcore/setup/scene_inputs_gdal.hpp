// libcore/setup/scene_inputs_gdal.hpp: public
// Inputs of a run, read and checked against one another before anything is computed.
#pragma once

#include "base/input_log.hpp"
#include "setup/dda_inputs.hpp"
#include "site/site.hpp"

namespace talus {

/// Throws InputError for blocks that overlap one another (`among_blocks`) or a fence by more than a
/// millimetre: how many, and of the deepest which two, how deep and where. With files.settle blocks
/// in the ground are lifted onto it, and those that overlap by up to a twentieth of their thickness
/// are moved apart. Then reads the forests: stems keep clear of the blocks (read_forests()).
void check_start(InputLog& log, const Site& site, DdaInputs& inputs, const DdaFiles& files,
                 bool among_blocks);

/// Reads TRN, blocks, ground classes, base motion and fences. Throws InputError for blocks of
/// another CRS, off the terrain or in the ground (unless files.settle), ground without a class, and
/// a base motion that ends early. Active fences are built, with law talus. Warns of a TRN that
/// the blocks were not made for.
[[nodiscard]] DdaInputs read_dda_inputs(InputLog& log, const Site& site, const DdaFiles& files);

}  // namespace talus
