// tools/report/trees.hpp
// The section of the report on trees that were hit.
#pragma once

#include <string>

#include "tools/report/data.hpp"

namespace talus {

/// What forests took, and the trees that were hit most; "" where no forest stood.
[[nodiscard]] std::string tree_section(const ReportData& data);

}  // namespace talus
