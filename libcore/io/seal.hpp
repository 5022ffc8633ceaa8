// libcore/io/seal.hpp
// The seal of a file: the SHA-256 of all bytes before it, as text at the end of the file.
//
// It follows the HDF5 file, where HDF5 does not look: the library itself does not survive every
// file that was damaged (reading beyond a chunk's memory, for one).
#pragma once

#include <cstddef>
#include <string>

namespace talus {

/// To be put behind these bytes.
[[nodiscard]] std::string seal_of(const void* bytes, std::size_t n_bytes);

/// Whether the file ends with the seal of its other bytes.
[[nodiscard]] bool is_sealed(const std::string& path);

}  // namespace talus
