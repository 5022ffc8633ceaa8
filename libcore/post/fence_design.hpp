// libcore/post/fence_design.hpp
// The design check of a fence by a code whose factors stand in a data file, because codes are paid
// for and change.
// in:    share/codes/*.csv (key, value, unit, mark, source), the barrier classes, statistics
// out:   design energy and height, smallest class and height that meet them, what governs
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/csv.hpp"
#include "post/fence.hpp"

namespace talus {

enum class DesignFormula {
  uni,  ///< UNI 11211-4: design mass and design speed
  onr,  ///< ONR 24810: energy percentile
};

struct DesignCode {
  std::string file;
  DesignFormula formula = DesignFormula::uni;
  std::map<std::string, double> factor;
  std::vector<std::string> from_memory;  ///< keys marked m
};
/// Throws InputError for an unknown formula or a key that the formula needs and the file lacks.
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
};

/// NaN where the sample or the input does not say.
struct DesignResult {
  bool enough = false;           ///< arrivals for the percentiles that the code asks for
  int n_needed = 0;              ///< arrivals that they need
  double design_energy = 0;      ///< E_d [J]
  double required_capacity = 0;  ///< E_d with the factor on the barrier [J]
  double design_height = 0;      ///< [m]
  double required_height = 0;    ///< with the free border [m]
  double free_border = 0;        ///< f_min [m]
  std::string smallest_class;    ///< of barrier_classes; "above all" when none is enough
  double energy_use = 0;         ///< required over given capacity [-]
  double height_use = 0;         ///< required over given height [-]
  double required_distance = 0, distance_use = 0;
  std::string governs;  ///< "energy", "height" or "distance"
  bool pass = false;    ///< all that could be checked holds
};
/// When there are too few arrivals the largest values stand in for the percentiles, `enough` is
/// false, and nothing passes.
[[nodiscard]] DesignResult check_design(const DesignCode& code,
                                        const std::vector<BarrierClass>& classes,
                                        const DesignInput& input, const FencePartSummary& part,
                                        const Fence& fence);

/// f_min of the code [m].
[[nodiscard]] double free_border(const DesignCode& code, double mean_block_size);

}  // namespace talus
