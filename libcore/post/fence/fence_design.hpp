// libcore/post/fence/fence_design.hpp
// The design check of a fence by a code whose factors are in a data file, because codes are paid
// for and change.
// in:    share/codes/*.csv (key, value, unit, mark, source), the barrier classes, statistics
// out:   design energy and height with their derivation, smallest class and height that meet them,
//        the governing demand, the verdict and its words
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/csv.hpp"
#include "post/fence/fence_summary.hpp"

namespace talus {

enum class DesignFormula {
  uni,  ///< UNI 11211-4: design mass and design speed
  onr,  ///< ONR 24810: energy percentile
};

struct DesignCode {
  std::string file;
  DesignFormula formula = DesignFormula::uni;
  std::map<std::string, double> factor;
  std::map<std::string, std::string> source;  ///< of each factor
  std::vector<std::string> from_memory;       ///< keys marked m
};
/// Throws InputError for an unknown formula, a key that the formula needs and the file lacks, and a
/// percentile that is none of percentile_levels.
[[nodiscard]] DesignCode design_code(const CsvTable& table);

struct BarrierClass {
  std::string name;
  double sel = 0, mel = 0;  ///< service and maximum energy level [J]; sel NaN for the lightest
};
[[nodiscard]] std::vector<BarrierClass> barrier_classes(const CsvTable& table);

struct DesignInput {
  double block_volume = 0;        ///< of the design block [m3]
  double mean_block_size = 0;     ///< mean of the cube roots of the blocks' volumes [m]
  double density = 0;             ///< [kg/m3]
  int consequence_class = 2;      ///< 1 to 3 (ONR)
  bool service_level = false;     ///< UNI: check against SEL instead of MEL
  double deflection = 0;          ///< d_MEL of the barrier [m]; NaN: not known
  double distance_to_object = 0;  ///< horizontal, from the fence downhill [m]; NaN: not known
  double free_border = std::numeric_limits<double>::quiet_NaN();  ///< f_min [m]; NaN: of the code
  std::string block_source = "given";                             ///< where block_volume comes from
  bool first_touches = false;  ///< arrivals are touches of a built fence, not of an open line
};

enum class DesignVerdict {
  meets,           ///< energy and height hold, and the distance where it is known
  does_not_meet,   ///< one of them does not
  energy_unknown,  ///< the fence has no capacity; all else holds
  too_few,         ///< arrivals for the percentiles that the code asks for
  nothing_came,
  first_touches,  ///< all holds, but for touches of a built fence: not design values
  still_moving,   ///< all holds, of a dam, but blocks that had not passed it moved at the end
  from_downhill,  ///< all holds, of a dam, but blocks came to its crest from the other side
};
[[nodiscard]] const char* text(DesignVerdict verdict);

/// A line of the derivation.
struct DesignStep {
  std::string symbol, name;
  double value = 0;  ///< NaN: not known
  std::string unit, source;
};

/// NaN where the sample or the input does not say.
struct DesignResult {
  DesignVerdict verdict = DesignVerdict::nothing_came;
  int n_arrivals = 0;
  int n_needed = 0;              ///< arrivals that the code's percentiles need
  double design_energy = 0;      ///< E_d [J]
  double required_capacity = 0;  ///< E_d with the factor on the barrier [J]
  double design_height = 0;      ///< [m]
  double required_height = 0;    ///< with the freeboard [m]
  double free_border = 0;        ///< f_min [m]
  std::string smallest_class;    ///< of barrier_classes; "none" when no class is enough
  double largest_class = 0;      ///< of all classes [J]
  double energy_use = 0;         ///< required over given capacity [-]
  double height_use = 0;         ///< required over given height [-]
  double required_distance = 0, distance_use = 0;
  std::string governs;  ///< "energy", "height" or "distance"; empty while the energy is unknown
  std::vector<DesignStep> steps;
};
/// The verdict and the demand, in the words of every output.
[[nodiscard]] std::string text(const DesignResult& result);

/// Empty: not judged, or nothing fails but the energy could not be checked.
[[nodiscard]] std::optional<bool> passes(const DesignResult& result);

/// When there are too few arrivals the largest values replace the percentiles, and the verdict
/// says so.
[[nodiscard]] DesignResult check_design(const DesignCode& code,
                                        const std::vector<BarrierClass>& classes,
                                        const DesignInput& input, const FencePartSummary& part,
                                        const Fence& fence);

/// f_min of the code [m].
[[nodiscard]] double free_border(const DesignCode& code, double mean_block_size);

/// Rules of the code for the fence's build that it does not meet: a sentence each.
[[nodiscard]] std::vector<std::string> build_remarks(const DesignCode& code, const Fence& fence);

}  // namespace talus
