// libcore/base/read_file.hpp: public
// Reads files whole, or their first bytes.
#pragma once

#include <string>

namespace talus {

/// The bytes of a file. Throws InputError with `hint` when it cannot be read to its end, and when
/// it is longer than the memory allows.
[[nodiscard]] std::string read_file(const std::string& path, const std::string& hint = "");

/// The first bytes of a file, at most n; none where it cannot be read.
[[nodiscard]] std::string first_bytes(const std::string& path, std::size_t n);

}  // namespace talus
