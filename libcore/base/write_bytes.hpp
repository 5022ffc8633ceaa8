// libcore/base/write_bytes.hpp: public
// Bytes as a file that is on the disk when the call returns.
#pragma once

#include <span>
#include <string>

namespace talus {

/// Writes bytes to `path`, synced to the disk. The file is a new one: an existing file of that name
/// is removed, and a link is not followed. Throws InputError with the system's reason (disk full,
/// file too large, no permission); a partly written file is removed. `end`: more bytes, after
/// `bytes`.
void write_bytes(const std::string& path, std::span<const unsigned char> bytes,
                 std::span<const unsigned char> end = {});

}  // namespace talus
