// tools/check/page.hpp
// Results of a look at a site, as one page with its pictures.
#pragma once

#include <string>

#include "tools/check/look.hpp"

namespace talus {

struct CheckPage {
  std::vector<Doubt> doubts;  ///< of all stages
  std::vector<Json> reports;  ///< of the stages before
  std::string run_id, style;  ///< style sheets
};

/// The same for the same inputs.
[[nodiscard]] std::string check_page(const Look& look, const CheckPage& page);
/// Of a site that cannot be looked at: the doubts, and a map of the inputs that were read.
[[nodiscard]] std::string refused_page(const Look& look, const CheckPage& page);

}  // namespace talus
