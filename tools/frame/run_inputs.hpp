// tools/frame/run_inputs.hpp
// Run files and their terrain as every tool that evaluates runs takes them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "io/geopackage_gdal.hpp"
#include "io/raster_gdal.hpp"
#include "post/made_with.hpp"
#include "post/maps/map_places.hpp"
#include "post/run_set.hpp"
#include "record/part_file.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

/// A part of many runs among the inputs.
struct PartInput {
  PartFile file;
  std::vector<int> member;  ///< of each of its runs, in RunInputs::members; -1: left out
};

/// What runs are read for: to say something of them, or to keep them, with all that failed.
enum class RunUse { evaluated, reduced };

/// How the settings of a set of runs compare with those of the sets before it (SettingsCheck).
enum class RunSettings {
  of_their_own,       ///< other cases, or runs to compare with
  with_other_fences,  ///< as before, but for the fences
};

class RunInputs {
 public:
  /// Declares RUN.h5|PART.h5..., --runs-from, --trn and --allow-unfinished on a tool; of runs that
  /// are evaluated also --missing, --max-failed-share and --rest-speed-m-s.
  explicit RunInputs(Tool& tool, RunUse use = RunUse::evaluated);

  /// The terrain. Throws InputError (read_trn).
  [[nodiscard]] const Trn& trn();

  /// The files of the command line and of the list that --runs-from names. Throws InputError when
  /// there is none.
  [[nodiscard]] const std::vector<std::string>& files();

  /// Checks that all runs of files and parts belong together (run_set.hpp), then hands them over
  /// one by one in the order of their run ids, with their places in `members`. So results do not
  /// depend on how runs are spread over files. A run of a part has no passages: parts() has. No
  /// more than one run file is held, except where of each only its last frame is wanted: then all,
  /// up to 200 MB of files. Failed runs within --max-failed-share are left out. `role` names the
  /// set for run_id(). Throws InputError; Interrupted between two files.
  void read(const std::vector<std::string>& paths, const std::string& role, const RunParts& parts,
            const std::function<void(RunFile&, int)>& take,
            RunSettings settings = RunSettings::of_their_own);
  void read(const RunParts& parts, const std::function<void(RunFile&, int)>& take) {
    read(files(), "runs", parts, take);
  }

  /// Reads all members once more, in the same order; those of parts without their passages.
  void read_again(const RunParts& parts, const std::function<void(RunFile&, int)>& take);

  /// What stands on maps of the runs read so far: sources, fences and objects of the first run of
  /// each block set, of a hundred sets at most.
  [[nodiscard]] MapPlaces places() const;

  /// Those among the files read so far.
  [[nodiscard]] const std::vector<PartInput>& parts() const { return parts_; }

  /// Digest of the ids of the runs named by RUN.h5..., for the tag RUN_SET (run_set_id).
  [[nodiscard]] std::string run_set() const;

  /// Warns of runs that failed, have not ended or are missing; "" when all are there and whole, or
  /// those that are not are few, else what pictures and legends say.
  [[nodiscard]] std::string remark() const;

  /// Of the runs named by RUN.h5... and those missing: left out.
  [[nodiscard]] double failed_share() const { return failed_share_; }
  /// Of those that were read last.
  [[nodiscard]] double last_failed_share() const { return last_failed_share_; }

  /// The cases of the runs named by RUN.h5... with their shares of the whole.
  [[nodiscard]] const std::vector<CaseWeight>& cases() const { return cases_; }
  /// Several cases that nobody weighed: what stands for all of them is no probability.
  [[nodiscard]] bool pools_unasked() const { return cases_.size() > 1 && weights_given.empty(); }

  /// Warns when blocks were still moving as their runs ended, or had left the known terrain:
  /// deposits leave them out.
  void warn_of_ends() const;

  std::string trn_file;
  double rest_speed_m_s = 0.05;
  double path_tolerance_m = 0.5;  ///< that lengths of paths are wanted with
  double max_failed_share = 0.02;
  std::vector<std::string> weights_given;  ///< NAME=WEIGHT of --case-weight
  std::string only_case;                   ///< of --only-case
  bool allow_unfinished = false;
  int n_missing = 0;                ///< runs that were wanted and gave no file
  std::vector<RunMember> members;   ///< of the files read so far; of one call by run id
  std::vector<RunMember> left_out;  ///< failed runs

 private:
  // Where a member stands: a run of a part, or a file of its own.
  struct Place {
    int part = -1, run = -1;
  };
  struct Found;
  [[nodiscard]] Found look_at(const std::vector<std::string>& paths, const RunParts& parts,
                              bool at_once, SettingsCheck& settings);
  void leave_out_failed(Found& found, bool is_first);
  void take_one_case(Found& found) const;
  void weigh(std::vector<RunMember>& found, bool is_first);
  void check_reach(const RunFile& run, const RunMember& member) const;
  [[nodiscard]] RunFile read_member(std::size_t i, const RunParts& parts) const;
  void read_members(std::size_t first, const RunParts& parts,
                    const std::function<void(RunFile&, int)>& take);

  Tool& tool_;
  RunSetOptions set_options_;
  SettingsCheck settings_;  // of the sets read so far
  Trn trn_;
  bool has_trn_ = false;
  std::vector<std::string> files_;
  std::string runs_from_;
  bool has_listed_ = false;
  std::vector<CaseWeight> cases_;  // of RUN.h5...
  std::vector<PartInput> parts_;
  std::vector<std::string> part_files_;  // of parts_
  std::vector<Place> places_;            // of members
  std::size_t n_first_ = 0;              // members of RUN.h5...
  double failed_share_ = 0, last_failed_share_ = 0;
};

/// The lines of a list of files, blanks left out; none where no list is named. Throws InputError.
[[nodiscard]] std::vector<std::string> listed_files(const std::string& list);

/// The remark behind the description of each layer.
void mark_layers(std::vector<VectorLayer>& layers, const std::string& remark);

}  // namespace talus
