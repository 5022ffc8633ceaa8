// libcore/setup/search_lines.hpp: public
// The candidate lines of [fence_search.*], as every tool makes them from the same terrain.
#pragma once

#include <vector>

#include "base/input_log.hpp"
#include "record/crossings.hpp"
#include "record/object_hits.hpp"
#include "site/site.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// Candidates of one search, named fence_search.NAME.1, .2 ...; all on the ground.
struct SearchCandidates {
  std::vector<RecordLine> lines;
  double step = 0;  ///< from line to line in the end [m]
};

/// Which object a search protects; index into the site's objects. Throws InputError for one that
/// names none, or another one.
[[nodiscard]] int protected_object(const Site& site, const FenceSearchSettings& search);

/// Throws InputError for settings that contradict each other, and for a search without room: no
/// line between its distances on ground for a fence. Warns where the step had to grow.
[[nodiscard]] SearchCandidates search_candidates(InputLog& log, const Site& site, const Trn& trn,
                                                 const FenceSearchSettings& search,
                                                 const std::vector<RecordObject>& objects);

}  // namespace talus
