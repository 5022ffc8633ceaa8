// tools/frame/run_inputs.hpp
// Run files and their terrain as every tool that evaluates runs takes them.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "ensemble/clusters.hpp"
#include "ensemble/ensemble.hpp"
#include "ensemble/made_with.hpp"
#include "ensemble/run_set.hpp"
#include "ensemble/run_tags.hpp"
#include "import/dem_gdal.hpp"
#include "io/geopackage_gdal.hpp"
#include "post/hazard/frequency.hpp"
#include "post/maps/map_places.hpp"
#include "record/part_file.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

/// A part of many runs among the inputs.
struct PartInput {
  PartFile file;
  std::vector<int> member;  ///< of each of its runs, in RunInputs::members; -1: left out
};

/// Purpose of reading runs: to evaluate them, by their frames too, or to keep them, with all
/// that failed.
enum class RunUse { evaluated, evaluated_with_frames, reduced };

/// Runs that were wanted together.
struct RunSet {
  std::vector<std::string> files;          ///< runs and parts
  std::vector<CaseWeight> weights{};       ///< of the cases, as given
  std::string only_case{};                 ///< of these files the runs of this case; "": all
  int n_missing = 0;                       ///< runs that were wanted and have no result
  double max_failed_share = std::nan("");  ///< nan: as the first run says
};

/// Cases that are classes of hazard (`n_classes` of two or more) count by the frequencies of these,
/// not by their weights. Of one class, or none, cases are weighed.
void weigh_as_classes(RunSet& set, std::size_t n_classes);

/// How the settings of a set of runs compare with those of the sets before it (SettingsCheck).
enum class RunSettings {
  of_their_own,       ///< other cases, or runs to compare with
  with_other_fences,  ///< as before, but for the fences
  on_another_ground,  ///< of their own, as is the terrain: of the site as it is, or a variant
};

class RunInputs {
 public:
  /// Declares FOLDER|RUN.h5|PART.h5... and --trn on a tool.
  explicit RunInputs(Tool& tool, RunUse use = RunUse::evaluated);

  /// The terrain. Throws InputError (read_trn).
  [[nodiscard]] const Trn& trn();

  /// Runs by name: files, or folders and their ensemble.json. `role`: in the registry.
  [[nodiscard]] RunSet set_of(const std::vector<std::string>& paths, const std::string& role);
  /// Those that the command line names first.
  [[nodiscard]] const RunSet& runs();
  /// Those of each class of hazard, which are of the case of its name where there are several; all
  /// without classes, or with one.
  [[nodiscard]] std::vector<RunSet> of_classes(const std::vector<HazardClass>& classes);

  /// Checks that all runs of files and parts belong together (run_set.hpp), then hands them over
  /// one by one in the order of their run ids, with their places in `members`. So results do not
  /// depend on how runs are spread over files. A run of a part has no passages: parts() has. No
  /// more than one run file is held, except where of each only its last frame is wanted: then all,
  /// up to 200 MB of files. Few failed runs are left out. `role` names the set for run_id(). Throws
  /// InputError; Interrupted between two files.
  void read(const RunSet& set, const std::string& role, const RunParts& parts,
            const std::function<void(RunFile&, int)>& take,
            RunSettings settings = RunSettings::of_their_own);
  void read(const RunParts& parts, const std::function<void(RunFile&, int)>& take) {
    read(runs(), "runs", parts, take);
  }

  /// Reads all members once more, in the same order; those of parts without their passages.
  void read_again(const RunParts& parts, const std::function<void(RunFile&, int)>& take);

  /// Places for maps of the runs named by RUN.h5...: sources, fences and objects of the first run
  /// of each block set, of a hundred sets at most.
  [[nodiscard]] MapPlaces places() const;

  /// Those among the files read so far.
  [[nodiscard]] const std::vector<PartInput>& parts() const { return parts_; }

  /// Hands over the runs of parts with all their passages, and their places in `members`; those of
  /// one part are held together.
  void read_parts(
      const std::function<void(const RunFile&, const std::vector<Passage>&, int)>& take) const;

  /// Digest of the ids of the runs named by RUN.h5..., for the tag RUN_SET (run_set_id).
  [[nodiscard]] std::string run_set() const;

  /// Warns of runs that failed, have not ended or are missing; "" when all are there and whole, or
  /// those that are not are few, else the words for pictures and legends.
  [[nodiscard]] std::string remark() const;

  /// Of the runs named by RUN.h5... and those missing: left out.
  [[nodiscard]] double failed_share() const { return failed_share_; }
  /// Of those that were read last.
  [[nodiscard]] double last_failed_share() const { return last_failed_share_; }

  /// The cases of the runs named by RUN.h5... with their shares of the whole.
  [[nodiscard]] const std::vector<CaseWeight>& cases() const { return cases_; }
  /// Several cases without weights: a number over all of them is not a probability.
  [[nodiscard]] bool pools_unasked() const { return cases_.size() > 1 && !is_weighed_; }

  /// Warns when blocks were still moving as their runs ended, or had left the known terrain:
  /// deposits leave them out.
  void warn_of_ends() const;

  std::string trn_file;
  static constexpr double rest_speed_m_s = 0.05;  ///< of deposited blocks, at most
  double path_tolerance_m = 0.5;                  ///< tolerance of the lengths of paths
  int n_missing = 0;                ///< runs that were wanted first and have no result
  std::vector<RunMember> members;   ///< of the files read so far; of one call by run id
  std::vector<RunMember> left_out;  ///< failed runs

 private:
  // Where a member is stored: a run of a part, or a file of its own.
  struct Place {
    int part = -1, run = -1;
  };
  struct Found;
  [[nodiscard]] Found look_at(const RunSet& set, const RunParts& parts, bool at_once,
                              SettingsCheck& settings, bool on_another_ground);
  [[nodiscard]] double share_allowed(const RunSet& set, const Found& found) const;
  void leave_out_failed(Found& found, const RunSet& set, bool is_first);
  void weigh(std::vector<RunMember>& found, const RunSet& set, bool is_first);
  void check_reach(const RunFile& run, const RunMember& member) const;
  [[nodiscard]] RunFile read_member(std::size_t i, const RunParts& parts) const;
  void read_members(std::size_t first, const RunParts& parts,
                    const std::function<void(RunFile&, int)>& take);

  Tool& tool_;
  RunSetOptions set_options_;
  SettingsCheck settings_;  // of the sets read so far
  Trn trn_;
  bool has_trn_ = false;
  RunUse use_;
  std::vector<std::string> paths_;  // of the command line
  RunSet runs_;
  bool is_weighed_ = false;
  double max_failed_share_ = 0;
  std::vector<CaseWeight> cases_;  // of RUN.h5...
  std::vector<PartInput> parts_;
  std::vector<std::string> part_files_;  // of parts_
  std::vector<Place> places_;            // of members
  std::size_t n_first_ = 0;              // members of RUN.h5...
  double failed_share_ = 0, last_failed_share_ = 0;
};

/// The remark behind the description of each layer.
void mark_layers(std::vector<VectorLayer>& layers, const std::string& remark);

}  // namespace talus
