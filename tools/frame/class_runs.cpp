#include "tools/frame/class_runs.hpp"

#include <algorithm>
#include <filesystem>

#include "tools/frame/command_line.hpp"
#include "tools/frame/options.hpp"

namespace talus {
namespace {

std::string listed(const std::vector<HazardClass>& classes) {
  std::string out;
  for (const HazardClass& c : classes) out += (out.empty() ? "" : ", ") + c.name;
  return out;
}

}  // namespace

void add_class_option(Tool& tool, std::vector<std::string>& given) {
  tool.app()
      .add_option("--class", given,
                  "NAME=RUN.h5 or NAME=@LIST: runs or parts of [hazard.class.NAME]; not needed "
                  "for a single class")
      ->allow_extra_args(false);
  tool.leave_out_of_run_id({"class"});  // the runs themselves stand for it, as in class_files()
}

std::vector<ClassFiles> class_files(Tool& tool, RunInputs& runs,
                                    const std::vector<std::string>& given,
                                    const std::vector<HazardClass>& classes,
                                    const std::string& site_file) {
  if (given.empty()) {
    if (classes.size() > 1)
      throw InputError({site_file},
                       "has " + std::to_string(classes.size()) + " classes (" + listed(classes) +
                           "), and nothing says which runs are of which",
                       "give --class " + classes[0].name + "=RUN.h5 for each file, or --class " +
                           classes[0].name + "=@LIST");
    return {{classes.empty() ? "all" : classes[0].name, runs.files()}};
  }
  std::vector<ClassFiles> out;
  for (const HazardClass& c : classes) out.push_back({c.name, {}});
  for (const std::string& words : given) {
    const std::size_t sign = words.find('=');
    if (sign == std::string::npos || sign == 0 || sign + 1 == words.size())
      throw UsageError({"", 0, "--class"}, "is " + words + ", expected NAME=FILE or NAME=@LIST",
                       "e.g. --class V1=runs/run_1.h5");
    const std::string name = words.substr(0, sign), file = words.substr(sign + 1);
    auto at = std::find_if(out.begin(), out.end(), [&](const auto& c) { return c.name == name; });
    if (at == out.end() && !classes.empty())
      throw InputError({site_file}, "has no [hazard.class." + name + "]",
                       "known: " + listed(classes));
    if (at == out.end()) at = out.insert(out.end(), {name, {}});
    if (file[0] != '@') {
      at->files.push_back(file);
      continue;
    }
    for (const std::string& path : listed_files(file.substr(1))) at->files.push_back(path);
  }
  for (const ClassFiles& c : out) {
    tool.leave_out_of_run_id({"class." + c.name});
    if (c.files.empty())
      throw InputError(
          {site_file}, "class " + c.name + " has no runs",
          "give --class " + c.name + "=RUN.h5, or take [hazard.class." + c.name + "] out");
    for (const std::string& path : c.files) {
      if (!std::filesystem::exists(path))
        throw InputError({path}, "there is no such file", "it is named for class " + c.name);
      tool.read_also("class." + c.name, path);
    }
  }
  return out;
}

}  // namespace talus
