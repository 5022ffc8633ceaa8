// libcore/io/blocks_hdf5.hpp: public
// The block set as an HDF5 file; docs/reference/formats.md lists its datasets.
#pragma once

#include <map>
#include <string>

#include "blocks/block_set.hpp"

namespace talus {

/// Writes the whole set; the same set and tags give the same bytes. `tags` become text attributes
/// of the root, e.g. RUN_ID. Throws InputError when anything cannot be written, or the set breaks a
/// promise: no file is written that read_blocks() would call damaged.
void write_blocks(const std::string& path, const BlockSet& set,
                  const std::map<std::string, std::string>& tags = {});

/// Whether an HDF5 file of Talus holds blocks at rest, not a run. Throws InputError (H5Reader).
[[nodiscard]] bool is_block_set(const std::string& path);

/// Reads and checks a block set (broken_promise). Throws InputError for files that are not one, are
/// damaged, or break a promise of block_set.hpp.
[[nodiscard]] BlockSet read_blocks(const std::string& path);

}  // namespace talus
