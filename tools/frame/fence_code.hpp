// tools/frame/fence_code.hpp
// Design codes and barrier classes of share/codes, as tools for fences read them.
#pragma once

#include <string>
#include <vector>

#include "post/fence/fence_result.hpp"

namespace talus {

/// A design code and the barrier classes, as they were read.
struct FenceCode {
  DesignCode code;
  std::string sha256;  ///< of the code's file
  std::vector<BarrierClass> classes;
};
/// `name`: uni, onr, or a data file. Throws InputError when it is none of them, or as
/// design_code().
[[nodiscard]] FenceCode read_fence_code(const std::string& name);

}  // namespace talus
