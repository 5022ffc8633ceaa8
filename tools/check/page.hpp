// tools/check/page.hpp
// What a look found, as one page with its pictures.
#pragma once

#include <string>

#include "tools/check/look.hpp"

namespace talus {

/// `style`: style sheets. The same for the same inputs.
[[nodiscard]] std::string check_page(const Look& look, const std::string& run_id,
                                     const std::string& style);

}  // namespace talus
