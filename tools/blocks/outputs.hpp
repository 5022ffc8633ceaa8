// tools/blocks/outputs.hpp
// The files that talus-blocks writes.
#pragma once

#include <string>

#include "setup/source_work.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

/// Paths of the command line; all but `blocks` may be empty: not asked for.
struct BlocksOutputs {
  std::string blocks, trn, report, footprints, stereonet, size_curve;
};

/// Writes the outputs that are asked for.
void write_outputs(Tool& tool, const BlocksOutputs& files, const BlocksWork& work,
                   const Json& report);

}  // namespace talus
