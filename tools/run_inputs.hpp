// tools/run_inputs.hpp
// Run files and their terrain as every tool that evaluates runs takes them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "io/raster_gdal.hpp"
#include "post/run_set.hpp"
#include "tool.hpp"

namespace talus {

class RunInputs {
 public:
  /// Declares RUN.h5..., --trn, --allow-unfinished and --rest-speed-m-s on a tool.
  explicit RunInputs(Tool& tool);

  /// The terrain. Throws InputError (read_trn).
  [[nodiscard]] const Trn& trn();

  /// Reads each file in turn, checks that it belongs to the others (run_set.hpp) and hands it over
  /// with its place in `members`. Throws InputError; Interrupted between two files.
  void read(const std::vector<std::string>& files, const RunParts& parts,
            const std::function<void(RunFile&, int)>& take);
  void read(const RunParts& parts, const std::function<void(RunFile&, int)>& take) {
    read(files, parts, take);
  }

  /// Warns of unfinished runs; "" when all are whole, else what pictures and legends say.
  [[nodiscard]] std::string remark() const;

  std::vector<std::string> files;
  std::string trn_file;
  double rest_speed_m_s = 0.05;
  bool allow_unfinished = false;
  std::vector<RunMember> members;  ///< of the files read so far

 private:
  Tool& tool_;
  RunSetOptions set_options_;
  Trn trn_;
  bool has_trn_ = false;
};

}  // namespace talus
