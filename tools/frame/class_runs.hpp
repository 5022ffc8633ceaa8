// tools/frame/class_runs.hpp
// Which runs are of which class of [hazard.class.*].
#pragma once

#include <string>
#include <vector>

#include "post/hazard/frequency.hpp"
#include "tools/frame/run_inputs.hpp"

namespace talus {

/// Declares --class on a tool.
void add_class_option(Tool& tool, std::vector<std::string>& given);

/// The files of a class; `name` as in [hazard.class.NAME].
struct ClassFiles {
  std::string name;
  std::vector<std::string> files;
};

/// Of --class NAME=FILE or NAME=@LIST, in the order of the site file; without --class all runs are
/// of the one class. Throws InputError for names that the site file does not have, classes without
/// runs, and runs of several classes that are not told apart.
[[nodiscard]] std::vector<ClassFiles> class_files(Tool& tool, RunInputs& runs,
                                                  const std::vector<std::string>& given,
                                                  const std::vector<HazardClass>& classes,
                                                  const std::string& site_file);

}  // namespace talus
