// tools/frame/shipped_data.hpp
// Data files (of share/, of tools/report/, the page of talus-verify) as they were when the tool was
// built.
#pragma once

#include <string>
#include <vector>

namespace talus {

/// Content of the file NAME. Throws InputError for another name.
[[nodiscard]] const std::string& shipped_data(const std::string& name);
/// Names of the files of a folder, "share/hazard/".
[[nodiscard]] std::vector<std::string> shipped_names(const std::string& folder);

}  // namespace talus
