// tools/frame/run_inputs.hpp
// Run files and their terrain as every tool that evaluates runs takes them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "io/geopackage_gdal.hpp"
#include "io/raster_gdal.hpp"
#include "post/run_set.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

class RunInputs {
 public:
  /// Declares RUN.h5..., --trn, --allow-unfinished, --missing and --rest-speed-m-s on a tool.
  explicit RunInputs(Tool& tool);

  /// The terrain. Throws InputError (read_trn).
  [[nodiscard]] const Trn& trn();

  /// Checks that all files belong together (run_set.hpp), then reads them one by one in the order
  /// of their run ids, and hands each over with its place in `members`. So results do not depend on
  /// the order of the command line. No more than one run is held, except where of each only its
  /// last frame is wanted: then all, up to 200 MB of files. Throws InputError; Interrupted between
  /// two files.
  void read(const std::vector<std::string>& files, const RunParts& parts,
            const std::function<void(RunFile&, int)>& take);
  void read(const RunParts& parts, const std::function<void(RunFile&, int)>& take) {
    read(files, parts, take);
  }

  /// Reads all members once more, in the same order.
  void read_again(const RunParts& parts, const std::function<void(RunFile&, int)>& take);

  /// Digest of the ids of the runs named by RUN.h5..., for the tag RUN_SET (run_set_id).
  [[nodiscard]] std::string run_set() const;

  /// Warns of runs that failed, have not ended or are missing; "" when all are there and whole,
  /// else what pictures and legends say.
  [[nodiscard]] std::string remark() const;

  /// Warns when blocks were still moving as their runs ended, or had left the known terrain:
  /// deposits leave them out.
  void warn_of_ends() const;

  std::vector<std::string> files;
  std::string trn_file;
  double rest_speed_m_s = 0.05;
  bool allow_unfinished = false;
  int n_missing = 0;               ///< runs that were wanted and gave no file
  std::vector<RunMember> members;  ///< of the files read so far; of one call by run id

 private:
  void read_members(std::size_t first, const RunParts& parts,
                    const std::function<void(RunFile&, int)>& take);

  Tool& tool_;
  RunSetOptions set_options_;
  Trn trn_;
  bool has_trn_ = false;
};

/// The remark behind the description of each layer.
void mark_layers(std::vector<VectorLayer>& layers, const std::string& remark);

}  // namespace talus
