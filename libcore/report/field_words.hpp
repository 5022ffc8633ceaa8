// libcore/report/field_words.hpp: public
// The name of a column or band in words, with its unit, as a reader of tables sees it.
#pragma once

#include <string>

namespace talus {

/// "energy_p95_hi_kj" -> "Energy, 95th percentile, upper bound [kJ]"
[[nodiscard]] std::string field_words(const std::string& name);

}  // namespace talus
