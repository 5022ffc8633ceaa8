#include "post/fence_design.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/text.hpp"
#include "post/statistics.hpp"

namespace talus {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

double factor(const DesignCode& code, const std::string& key) { return code.factor.at(key); }

// Index of a percentile among those of a summary, -1: it is none of them.
int level_of(double p) {
  for (std::size_t k = 0; k < percentile_levels.size(); ++k)
    if (std::abs(percentile_levels[k].p - p) < 1e-9) return static_cast<int>(k);
  return -1;
}

double percentile(const QuantitySummary& quantity, double p) {
  TALUS_ASSERT(level_of(p) >= 0);
  return quantity.percentile[level_of(p)].value;
}

struct Demand {
  double energy, barrier_factor, height;
  int n_needed;
};

// E_d = 1/2 m_d v_d^2 gamma_r with v_d = v_p gamma_trajectory gamma_survey and m_d = V rho
// gamma_volume gamma_density.
Demand uni_demand(const DesignCode& code, const DesignInput& input, const FencePartSummary& part,
                  bool enough_speed, bool enough_height) {
  const double p_v = factor(code, "speed_percentile"), p_h = factor(code, "height_percentile");
  const double by_site = factor(code, "gamma_trajectory") * factor(code, "gamma_survey");
  const double speed = (enough_speed ? percentile(part.speed, p_v) : part.speed.largest) * by_site;
  const double mass = input.block_volume * input.density * factor(code, "gamma_volume") *
                      factor(code, "gamma_density");
  const double top = enough_height ? percentile(part.top, p_h) : part.top.largest;
  return {0.5 * mass * speed * speed * factor(code, "gamma_risk"),
          factor(code, input.service_level ? "gamma_energy_sel" : "gamma_energy_mel"),
          top * by_site * factor(code, "gamma_height"),
          std::max(smallest_sample(p_v), smallest_sample(p_h))};
}

Demand onr_demand(const DesignCode& code, const DesignInput& input, const FencePartSummary& part,
                  bool enough_energy, bool enough_height) {
  const std::string consequence = "_cc" + std::to_string(input.consequence_class);
  const double p_e = factor(code, "energy_percentile"), p_h = factor(code, "height_percentile");
  const double energy = enough_energy ? percentile(part.energy, p_e) : part.energy.largest;
  const double top = enough_height ? percentile(part.top, p_h) : part.top.largest;
  return {energy * factor(code, "gamma_energy" + consequence), 1,
          top * factor(code, "gamma_height" + consequence),
          std::max(smallest_sample(p_e), smallest_sample(p_h))};
}

Demand demand_of(const DesignCode& code, const DesignInput& input, const FencePartSummary& part) {
  const auto enough = [&part](double p) { return part.n_eff + 1e-9 >= smallest_sample(p); };
  const bool enough_height = enough(factor(code, "height_percentile"));
  if (code.formula == DesignFormula::uni)
    return uni_demand(code, input, part, enough(factor(code, "speed_percentile")), enough_height);
  return onr_demand(code, input, part, enough(factor(code, "energy_percentile")), enough_height);
}

double required_distance(const DesignCode& code, double deflection) {
  const auto extra = code.factor.find("deflection_extra_m");
  const double scaled = factor(code, "deflection_factor") * deflection;
  return extra == code.factor.end() ? scaled : std::max(scaled, deflection + extra->second);
}

std::vector<std::string> needed_keys(DesignFormula formula) {
  if (formula == DesignFormula::uni)
    return {"speed_percentile", "height_percentile", "gamma_trajectory", "gamma_survey",
            "gamma_volume",     "gamma_density",     "gamma_risk",       "gamma_energy_mel",
            "gamma_energy_sel", "gamma_height",      "f_min_m",          "f_min_share_of_block",
            "deflection_factor"};
  return {"energy_percentile", "height_percentile",    "gamma_energy_cc1", "gamma_energy_cc2",
          "gamma_energy_cc3",  "gamma_height_cc1",     "gamma_height_cc2", "gamma_height_cc3",
          "f_min_m",           "f_min_share_of_block", "deflection_factor"};
}

void check_percentiles(const DesignCode& code) {
  std::string levels;
  for (const PercentileLevel& level : percentile_levels)
    levels += (levels.empty() ? "" : ", ") + text(level.p);
  for (const auto& [key, value] : code.factor)
    if (key.ends_with("_percentile") && level_of(value) < 0)
      throw InputError({code.file}, key + " is " + text(value) + ", expected one of " + levels,
                       "these are the percentiles that are computed; write 0.95 for 95 %");
}

void judge(DesignResult& result, bool enough) {
  const std::array<std::pair<double, const char*>, 3> uses = {{{result.energy_use, "energy"},
                                                               {result.height_use, "height"},
                                                               {result.distance_use, "distance"}}};
  double largest = -1;
  for (const auto& [use, name] : uses) {
    if (std::isnan(use) || use <= largest) continue;
    largest = use;
    result.governs = name;
  }
  const bool energy_known = !std::isnan(result.energy_use);
  if (!enough)
    result.verdict = DesignVerdict::too_few;
  else if (largest > 1)
    result.verdict = DesignVerdict::does_not_meet;
  else
    result.verdict = energy_known ? DesignVerdict::meets : DesignVerdict::energy_unknown;
  if (!energy_known && !(largest > 1)) result.governs.clear();
}

// f_min as given, or that of the code.
double free_border_of(const DesignCode& code, const DesignInput& input) {
  return std::isnan(input.free_border) ? free_border(code, input.mean_block_size)
                                       : input.free_border;
}

}  // namespace

DesignCode design_code(const CsvTable& table) {
  DesignCode code;
  code.file = table.file;
  bool has_formula = false;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const std::string& key = table.at(row, "key");
    if (key == "formula") {
      const std::string& name = table.at(row, "value");
      if (name != "uni" && name != "onr")
        throw InputError({table.file, table.line[row]},
                         "formula is \"" + name + "\", expected uni or onr",
                         "the formula is one of those that talus-fence knows");
      code.formula = name == "uni" ? DesignFormula::uni : DesignFormula::onr;
      has_formula = true;
      continue;
    }
    code.factor[key] = table.number(row, "value");
    if (table.at(row, "mark") == "m") code.from_memory.push_back(key);
  }
  if (!has_formula)
    throw InputError({table.file}, "names no formula, expected uni or onr",
                     "take a copy of a file of share/codes/ and change its numbers");
  for (const std::string& key : needed_keys(code.formula))
    if (!code.factor.contains(key) || !(code.factor[key] >= 0))
      throw InputError({table.file}, "gives no value for " + key,
                       "take a copy of a file of share/codes/ and change its numbers");
  check_percentiles(code);
  return code;
}

const char* text(DesignVerdict verdict) {
  constexpr std::array names = {"meets", "does not meet", "energy not checked", "too few arrivals"};
  return names[static_cast<std::size_t>(verdict)];
}

std::vector<BarrierClass> barrier_classes(const CsvTable& table) {
  std::vector<BarrierClass> classes;
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    classes.push_back({table.at(row, "class"), table.number(row, "sel_kj") * 1e3,
                       table.number(row, "mel_kj") * 1e3});
  return classes;
}

double free_border(const DesignCode& code, double mean_block_size) {
  return std::max(factor(code, "f_min_m"), factor(code, "f_min_share_of_block") * mean_block_size);
}

std::optional<bool> passes(const DesignResult& result) {
  if (result.verdict == DesignVerdict::energy_unknown) return std::nullopt;
  return result.verdict == DesignVerdict::meets;
}

DesignResult check_design(const DesignCode& code, const std::vector<BarrierClass>& classes,
                          const DesignInput& input, const FencePartSummary& part,
                          const Fence& fence) {
  DesignResult result;
  if (part.n == 0) {
    result = {
        DesignVerdict::too_few, 0, none, none, none, none, none, "", none, none, none, none, ""};
    result.free_border = free_border_of(code, input);
    return result;
  }
  const Demand demand = demand_of(code, input, part);
  result.n_needed = demand.n_needed;
  result.design_energy = demand.energy;
  result.required_capacity = demand.energy * demand.barrier_factor;
  result.design_height = demand.height;
  result.free_border = free_border_of(code, input);
  result.required_height = demand.height + result.free_border;
  result.smallest_class = "above all";
  for (const BarrierClass& c : classes) {
    const double level = input.service_level ? c.sel : c.mel;
    if (!(level >= result.required_capacity)) continue;
    result.smallest_class = c.name;
    break;
  }
  result.energy_use = result.required_capacity / fence.capacity;
  result.height_use = result.required_height / fence.height;
  result.required_distance = required_distance(code, input.deflection);
  result.distance_use = result.required_distance / input.distance_to_object;
  judge(result, part.n_eff + 1e-9 >= demand.n_needed);
  return result;
}

std::vector<std::string> build_remarks(const DesignCode& code, const Fence& fence) {
  std::vector<std::string> remarks;
  const auto longest = code.factor.find("row_length_max_m"),
             fewest = code.factor.find("fields_min");
  if (longest != code.factor.end() && length(fence) > longest->second)
    remarks.push_back("The fence is " + text(length(fence), 4) +
                      " m long: the code asks for rows of " + text(longest->second) +
                      " m at most, or for anchors in between.");
  if (fewest != code.factor.end() && n_fields(fence) < fewest->second)
    remarks.push_back("The fence has " + std::to_string(n_fields(fence)) +
                      (n_fields(fence) == 1 ? " field" : " fields") + ": the code asks for " +
                      text(fewest->second) + " at least.");
  return remarks;
}

}  // namespace talus
