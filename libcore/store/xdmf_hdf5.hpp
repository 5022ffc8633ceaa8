// libcore/store/xdmf_hdf5.hpp: public
// A run as ParaView shows it: XDMF 3 with the blocks' faces as polygons, frame by frame.
#pragma once

#include <string>

#include "record/run_file.hpp"

namespace talus {

/// Writes the description to `path` and its numbers to `data_path` (HDF5), which the description
/// calls `data_name`: the final name of that file. Points are local, in single precision; cells
/// carry block, speed [m/s]. Throws InputError when they cannot be written.
void write_xdmf(const std::string& path, const std::string& data_path, const std::string& data_name,
                const RunFile& run);

}  // namespace talus
