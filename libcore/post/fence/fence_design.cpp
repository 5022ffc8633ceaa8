// Design check of a fence by a code: design energy and height, their derivation, the verdict.
#include "post/fence/fence_design.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/grouped_text.hpp"
#include "base/numbers.hpp"
#include "base/text.hpp"
#include "post/statistics.hpp"

namespace talus {
namespace {

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
  std::vector<DesignStep> steps;
};

// A factor of the code, with its source.
DesignStep factor_step(const DesignCode& code, const std::string& key, const char* symbol,
                       const char* name) {
  const auto source = code.source.find(key);
  const bool guessed =
      std::find(code.from_memory.begin(), code.from_memory.end(), key) != code.from_memory.end();
  return {symbol, name, factor(code, key), "",
          key +
              (source == code.source.end() || source->second.empty() ? "" : ": " + source->second) +
              (guessed ? " (not checked against the print)" : "")};
}

// Value used for a percentile of the arrivals: the percentile, or the largest value where they are
// too few.
DesignStep sample_step(const QuantitySummary& quantity, double p, const FencePartSummary& part,
                       double scale, const char* symbol, const std::string& what,
                       const char* unit) {
  const std::string n = counted(part.n, "arrival");
  if (is_enough(part.n_eff, p))
    return {symbol, what + ", " + text(100 * p) + "th percentile", percentile(quantity, p) * scale,
            unit, "of " + n};
  return {symbol, what + ", largest", quantity.largest * scale, unit,
          "of " + n + "; the " + text(100 * p) + "th percentile needs " +
              std::to_string(smallest_sample(p))};
}

// E_d = 1/2 m_d v_d^2 gamma_r with v_d = v_p gamma_trajectory gamma_survey and m_d = V rho
// gamma_volume gamma_density.
Demand uni_demand(const DesignCode& code, const DesignInput& input, const FencePartSummary& part) {
  const double p_v = factor(code, "speed_percentile"), p_h = factor(code, "height_percentile");
  const double by_site = factor(code, "gamma_trajectory") * factor(code, "gamma_survey");
  const DesignStep speed = sample_step(part.speed, p_v, part, 1, "v_p", "speed", "m/s");
  const DesignStep top = sample_step(part.top, p_h, part, 1, "h_p", "top above the base", "m");
  const double mass = input.block_volume * input.density * factor(code, "gamma_volume") *
                      factor(code, "gamma_density");
  const double v_d = speed.value * by_site;
  const double energy = 0.5 * mass * v_d * v_d * factor(code, "gamma_risk");
  const char* const level = input.service_level ? "gamma_energy_sel" : "gamma_energy_mel";
  const double height = top.value * by_site * factor(code, "gamma_height");
  Demand out{energy,
             factor(code, level),
             height,
             std::max(smallest_sample(p_v), smallest_sample(p_h)),
             {}};
  out.steps = {{"V", "volume of the design block", input.block_volume, "m3", input.block_source},
               {"rho", "density", input.density, "kg/m3", "mean of the blocks"},
               factor_step(code, "gamma_volume", "g_V", "factor on the volume"),
               factor_step(code, "gamma_density", "g_rho", "factor on the density"),
               {"m_d", "design mass", mass / 1e3, "t", "V rho g_V g_rho"},
               speed,
               factor_step(code, "gamma_trajectory", "g_t", "factor on the trajectories"),
               factor_step(code, "gamma_survey", "g_s", "factor on the survey"),
               {"v_d", "design speed", v_d, "m/s", "v_p g_t g_s"},
               factor_step(code, "gamma_risk", "g_R", "factor on the risk"),
               {"E_d", "design energy", energy / 1e3, "kJ", "1/2 m_d v_d^2 g_R"},
               factor_step(code, level, "g_E", "factor on the barrier"),
               {"E_req", "capacity needed", energy * out.barrier_factor / 1e3, "kJ", "E_d g_E"},
               top,
               factor_step(code, "gamma_height", "g_h", "factor on the height"),
               {"h_d", "design height", height, "m", "h_p g_t g_s g_h"}};
  return out;
}

Demand onr_demand(const DesignCode& code, const DesignInput& input, const FencePartSummary& part) {
  const std::string consequence = "_cc" + std::to_string(input.consequence_class);
  const double p_e = factor(code, "energy_percentile"), p_h = factor(code, "height_percentile");
  const DesignStep energy = sample_step(part.energy, p_e, part, 1e-3, "E_k", "energy", "kJ");
  const DesignStep top = sample_step(part.top, p_h, part, 1, "h_k", "top above the base", "m");
  const double e_d = 1e3 * energy.value * factor(code, "gamma_energy" + consequence);
  const double height = top.value * factor(code, "gamma_height" + consequence);
  return {e_d,
          1,
          height,
          std::max(smallest_sample(p_e), smallest_sample(p_h)),
          {energy,
           factor_step(code, "gamma_energy" + consequence, "g_E", "factor on the energy"),
           {"E_d", "design energy, capacity needed", e_d / 1e3, "kJ", "E_k g_E"},
           top,
           factor_step(code, "gamma_height" + consequence, "g_h", "factor on the height"),
           {"h_d", "design height", height, "m", "h_k g_h"}}};
}

Demand demand_of(const DesignCode& code, const DesignInput& input, const FencePartSummary& part) {
  return code.formula == DesignFormula::uni ? uni_demand(code, input, part)
                                            : onr_demand(code, input, part);
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

void judge(DesignResult& result, bool enough, bool first_touches) {
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
  else if (!energy_known)
    result.verdict = DesignVerdict::energy_unknown;
  else
    result.verdict = first_touches ? DesignVerdict::first_touches : DesignVerdict::meets;
  if (!energy_known && !(largest > 1)) result.governs.clear();
}

// The end of the derivation: the demand beside the capacity of the fence.
void add_fence_steps(DesignResult& result, const DesignCode& code, const DesignInput& input,
                     const Fence& fence) {
  const bool given = !std::isnan(input.free_border);
  result.steps.push_back({"f_min", "freeboard", result.free_border, "m",
                          given ? "given (--free-border-m)"
                                : "max(" + text(factor(code, "f_min_m")) + " m, " +
                                      text(factor(code, "f_min_share_of_block")) +
                                      " of the mean block size)"});
  result.steps.push_back({"h_req", "height needed", result.required_height, "m", "h_d + f_min"});
  result.steps.push_back(
      {"E", "capacity of the fence", fence.capacity / 1e3, "kJ",
       std::isnan(fence.capacity) ? "not given (capacity_kj)" : "capacity_kj of the site file"});
  result.steps.push_back(
      {"h", "height of the fence", fence.height, "m", "height_m of the site file"});
  if (!std::isnan(result.required_distance))
    result.steps.push_back({"D", "distance needed to what stands behind", result.required_distance,
                            "m", "by the deflection (--deflection-m)"});
}

// "needs 1,320 kJ (class 4) and a height of 2.92 m"
std::string needs(const DesignResult& r) {
  const std::string largest = r.largest_class > 0
                                  ? ": above the largest, " + grouped_text(r.largest_class / 1e3) +
                                        " kJ; a net is not an option"
                                  : "";
  return "needs " + needed_text(r.required_capacity / 1e3) + " kJ (" +
         (r.smallest_class == "none" ? "no ETAG class" + largest
                                     : "ETAG class " + r.smallest_class) +
         ") and a height of " + needed_text(r.required_height) + " m";
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
    code.source[key] = table.at(row, "source");
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
  constexpr std::array names = {
      "meets",        "does not meet",      "energy not checked", "too few arrivals",
      "nothing came", "first touches only", "still moving",       "from downhill"};
  return names[static_cast<std::size_t>(verdict)];
}

std::string text(const DesignResult& r) {
  switch (r.verdict) {
    case DesignVerdict::meets:
      return "meets the code: " + needs(r);
    case DesignVerdict::does_not_meet:
      return "does not meet the code, " + r.governs + " governs: " + needs(r);
    case DesignVerdict::energy_unknown:
      return "high enough; no capacity given: energy not checked: " + needs(r);
    case DesignVerdict::too_few:
      return "not judged: too few arrivals, " + std::to_string(r.n_arrivals) + " of the " +
             std::to_string(r.n_needed) + " that the code needs; by the largest of them it " +
             needs(r);
    case DesignVerdict::nothing_came:
      return "not judged: nothing came to it";
    case DesignVerdict::first_touches:
      return "not judged: first touches of a standing fence are not design values; by them it " +
             needs(r);
    case DesignVerdict::still_moving:
    case DesignVerdict::from_downhill:
      break;  // of dams alone
  }
  return "";
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
  if (result.verdict == DesignVerdict::meets) return true;
  if (result.verdict == DesignVerdict::does_not_meet) return false;
  return std::nullopt;
}

DesignResult check_design(const DesignCode& code, const std::vector<BarrierClass>& classes,
                          const DesignInput& input, const FencePartSummary& part,
                          const Fence& fence) {
  DesignResult result;
  result.free_border = free_border_of(code, input);
  if (part.n == 0) {
    for (double* value : {&result.design_energy, &result.required_capacity, &result.design_height,
                          &result.required_height, &result.largest_class, &result.energy_use,
                          &result.height_use, &result.required_distance, &result.distance_use})
      *value = no_value;
    return result;
  }
  Demand demand = demand_of(code, input, part);
  result.n_arrivals = part.n;
  result.n_needed = demand.n_needed;
  result.design_energy = demand.energy;
  result.required_capacity = demand.energy * demand.barrier_factor;
  result.design_height = demand.height;
  result.required_height = demand.height + result.free_border;
  result.steps = std::move(demand.steps);
  result.smallest_class = "none";
  for (const BarrierClass& c : classes) {
    const double level = input.service_level ? c.sel : c.mel;
    if (level > result.largest_class) result.largest_class = level;
    if (result.smallest_class == "none" && level >= result.required_capacity)
      result.smallest_class = c.name;
  }
  result.energy_use = result.required_capacity / fence.capacity;
  result.height_use = result.required_height / fence.height;
  result.required_distance = required_distance(code, input.deflection);
  result.distance_use = result.required_distance / input.distance_to_object;
  judge(result, part.n_eff + 1e-9 >= demand.n_needed, input.first_touches);
  add_fence_steps(result, code, input, fence);
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
