// tools/frame/fault_json.hpp
// Runs that failed, as every tool that evaluates runs writes them to JSON.
#pragma once

#include "ensemble/run_set.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

[[nodiscard]] inline Json fault_json(const std::vector<RunFault>& faults) {
  Json list = Json::array();
  for (const RunFault& fault : faults)
    list.push_back({{"run", fault.name},
                    {"run_id", fault.run_id},
                    {"seed", fault.seed},
                    {"reason", fault.words}});
  return list;
}

/// Adds the keys failed_runs and, where there are any, left_out_runs.
inline void add_faults(Json& result, const RunFaults& faults) {
  result["failed_runs"] = fault_json(faults.failed);
  if (!faults.left_out.empty()) result["left_out_runs"] = fault_json(faults.left_out);
}

}  // namespace talus
