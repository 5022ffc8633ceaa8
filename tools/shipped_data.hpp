// tools/shipped_data.hpp
// The data files of share/ as they were when the tool was built.
#pragma once

#include <string>

namespace talus {

/// Content of share/NAME. Throws InputError for another name.
[[nodiscard]] const std::string& shipped_data(const std::string& name);

}  // namespace talus
