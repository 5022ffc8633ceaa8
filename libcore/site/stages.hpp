// libcore/site/stages.hpp: public
// Sections and keys of the site file that each stage of the pipeline reads.
#pragma once

#include <string>
#include <vector>

#include "site/site.hpp"

namespace talus {

/// import, tin, trn, blocks, rock (blocks of other masses), run, stability, fence, place, hazard,
/// trace, search.
[[nodiscard]] const std::vector<std::string>& stage_names();

/// Whether results of the stage depend on the value.
[[nodiscard]] bool stage_reads(const std::string& stage, const EffectiveValue& value);

}  // namespace talus
