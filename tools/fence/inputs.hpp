// tools/fence/inputs.hpp
// Inputs of talus-fence: the fences of the site file, and the runs at them.
#pragma once

#include <string>
#include <vector>

#include "post/fence/dam_result.hpp"
#include "tools/frame/fence_code.hpp"
#include "tools/frame/run_inputs.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

/// Every line of every [fence.*], on the ground. Throws InputError when there is none, or as
/// fence_lines().
[[nodiscard]] std::vector<FenceCase> fence_cases(Tool& tool, const Site& site, const Trn& trn);

/// Reads the runs of `inputs` and those `without_files` to compare with. `free_border`: f_min [m];
/// NaN: that of the code. Throws InputError for runs of other fences than those of the site file
/// (find_line, check_same_fence, check_one_kind).
/// Active dams of the site, whose lines it adds to those of the fences.
[[nodiscard]] std::vector<DamCase> dam_cases(Tool& tool, const Site& site, const Trn& trn,
                                             std::vector<FenceCase>& lines);

[[nodiscard]] FenceRuns read_fence_runs(RunInputs& inputs,
                                        const std::vector<std::string>& without_files,
                                        const std::vector<FenceCase>& fences,
                                        const DesignCode& code, double free_border,
                                        const std::string& site_file);

}  // namespace talus
