// tools/frame/build_info.hpp
// Version and commit of the build, written into the run registry. build_info.cpp is generated.
#pragma once

namespace talus {

extern const char* const build_version;      ///< "0.2.0"
extern const char* const build_commit;       ///< short hash, "-dirty" if not only docs changed
extern const char* const build_commit_date;  ///< of that commit, "2026-11-25", or "unknown"

}  // namespace talus
