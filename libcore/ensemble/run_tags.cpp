// Names and values with which every output identifies the runs that it was made from.
#include "ensemble/run_tags.hpp"

#include <algorithm>

#include "base/text.hpp"
#include "ensemble/clusters.hpp"

namespace talus {
namespace {

template <class Field>
auto sum_of(const std::vector<RunMember>& runs, Field field) {
  auto total = runs.empty() ? decltype(runs[0].*field){} : runs[0].*field;
  for (std::size_t i = 1; i < runs.size(); ++i) total += runs[i].*field;
  return total;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> tags_of(const std::vector<RunMember>& runs,
                                                         const std::vector<RunMember>& left_out) {
  const RunFaults faults = faults_of(runs, left_out);
  double weight = 0, penetration = 0;
  for (const int i : order_by_id(runs)) {
    weight += runs[i].weight;
    penetration = std::max(penetration, runs[i].largest_penetration);
  }
  const std::string n_runs = std::to_string(runs.size());
  std::vector<std::pair<std::string, std::string>> tags = {
      {"N_RUNS", n_runs},
      {"N_FAILED", std::to_string(faults.failed.size() + faults.left_out.size())},
      {"DENOMINATOR", "N = " + text(weight, 9) + ", the statistical weight of all " +
                          std::to_string(sum_of(runs, &RunMember::n_blocks)) +
                          " blocks released in " + n_runs + (runs.size() == 1 ? " run" : " runs")}};
  if (!runs.empty()) {
    tags.emplace_back("SITE", runs[0].info.site);
    tags.emplace_back("VERSION", runs[0].info.version);
    if (!runs[0].measure.empty()) tags.emplace_back("MEASURE", runs[0].measure);
  }
  if (!runs.empty()) tags.emplace_back("INTERVALS_OVER", text(clusters_of(runs)));
  tags.emplace_back("N_MOVING_AT_END", std::to_string(sum_of(runs, &RunMember::n_moving)));
  if (const std::vector<CaseWeight> cases = case_shares(runs); cases.size() > 1)
    tags.emplace_back("CASES", text(cases));
  if (!left_out.empty()) tags.emplace_back("N_LEFT_OUT", std::to_string(left_out.size()));
  if (const int n = n_repeats(runs); n > 0) tags.emplace_back("N_REPEATS", std::to_string(n));
  const std::string wrong = text(faults), left_out_words = left_out_text(faults);
  const std::string health = wrong.empty() ? "all runs finished within their limits" : wrong;
  tags.emplace_back("HEALTH",
                    left_out_words.empty() ? health : left_out_words + "; of the rest: " + health);
  tags.emplace_back("HEALTH_LARGEST_PENETRATION_M", text(penetration, 4));
  tags.emplace_back("HEALTH_UNCONVERGED_STEPS",
                    std::to_string(sum_of(runs, &RunMember::unconverged)));
  tags.emplace_back("HEALTH_LEFT_DOMAIN", std::to_string(sum_of(runs, &RunMember::left_domain)));
  tags.emplace_back("HEALTH_FELL_THROUGH", std::to_string(sum_of(runs, &RunMember::fell_through)));
  tags.emplace_back("HEALTH_NOT_FINITE", std::to_string(sum_of(runs, &RunMember::not_finite)));
  const std::vector<std::string> warnings = warnings_of(runs);
  std::string words;
  for (const std::string& line : warnings) words += (words.empty() ? "" : "; ") + line;
  if (!words.empty()) tags.emplace_back("WARNINGS", words);
  return tags;
}

}  // namespace talus
