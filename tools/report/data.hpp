// tools/report/data.hpp
// Data of a report.
// in:    the results in a site's folder, as the tools wrote them
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "ensemble/run_set.hpp"
#include "record/run_file.hpp"
#include "report/map_figures.hpp"
#include "report/run_health.hpp"
#include "report/texts.hpp"
#include "site/site.hpp"
#include "store/runs.hpp"
#include "terrain/trn.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

/// Results of a measure of the site; JSON is null where a file is missing.
struct MeasureResults {
  std::string name;
  Json fence, hazard, trace;
};

/// Everything that the sections show; JSON is null and text empty where a file is missing.
struct ReportData {
  ReportData(const Site& of_site, Texts of_page) : site(of_site), texts(std::move(of_page)) {}

  const Site& site;
  Texts texts;  ///< the words of the page
  Json tin, trn, blocks, runout, fence, places, calibrate, hazard, trace, search,
      stability;                         ///< of tools
  std::vector<MeasureResults> measures;  ///< compared
  std::vector<Doubt> doubts;  ///< of the stages, from the import to the look before the runs
  Trn terrain, bed;           ///< before the slide; the ground that the blocks slide on
  std::string mobility_svg, stereonet_svg, sizes_svg, curves_csv;
  std::vector<std::string> search_svgs;  ///< of each fence search
  MapSheet sheet;                        ///< common part of the maps
  std::vector<MapPicture> maps, hazard_maps;
  std::vector<MapPicture> change_map;                     ///< one, or none
  CasePictures case_maps;                                 ///< of several cases
  std::vector<std::pair<std::string, Json>> case_fences;  ///< the same, as `fence`
  std::vector<RunFile> runs;  ///< info and health, by seed and name; frames left out    (n_runs)
  std::vector<std::string> run_names;  ///< "1", or "CASE_1"                            (n_runs)
  bool rocks_alone = false;            ///< the blocks of each run fell one by one
  std::string repeats;                 ///< runs that are the same but for their seed; "": none
  RunFaults faults;                    ///< of these runs
  int n_in_parts = 0;                  ///< of them, without frames of their own
  RunFile shown;                       ///< the run of the animation, whole
  std::string shown_name;
  std::vector<std::vector<Vec3>> trails;  ///< of the blocks of all runs, local
  std::vector<LimitOverRuns> limits;
  std::vector<RunRecord> steps;  ///< each behind those whose outputs it read
  std::string run_id, version;
  std::string runs_to_add;  ///< in the words of the map of reach; "": there is none
};

/// "1 of 12 runs failed its numerical checks"; "" where nothing is wrong. The basis of fences
/// also counts runs that they are compared with.
[[nodiscard]] std::string remark_of(const ReportData& data);
[[nodiscard]] std::string fence_remark_of(const ReportData& data);

}  // namespace talus
