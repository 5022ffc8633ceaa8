// tools/runout/json.hpp
// How far runs came, as talus-runout writes it to JSON. Keys: docs/reference/formats.md#run-out
#pragma once

#include <vector>

#include "post/runout/mobility.hpp"
#include "post/runout/runout_runs.hpp"
#include "post/runout/runout_sensitivity.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

[[nodiscard]] Json balance_json(const Balance& balance);

/// `friction_deg`: shown beside H/L of the centre of mass; NaN: not shown.
[[nodiscard]] Json run_json(const RunoutRun& run, double friction_deg);

[[nodiscard]] Json percentiles_json(const MobilityPercentiles& percentiles);

/// A row a case, with the spread over its runs; empty where there is one.
[[nodiscard]] Json cases_json(const std::vector<RunoutRun>& runs,
                              const std::vector<MobilityRelation>& relations, bool confined);
/// How many of some runs are events, with which probability, and the spread over those that moved
/// and over the events.
void add_spreads(Json& to, const std::vector<RunoutRun>& runs, const std::vector<int>& some);

[[nodiscard]] Json mobility_json(const std::vector<MobilityRelation>& relations,
                                 const std::vector<MobilityEvent>& events);

}  // namespace talus
