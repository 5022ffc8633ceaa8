// Table of options that a release no longer has, and their replacements.
#include "tools/frame/gone_options.hpp"

namespace talus {
namespace {

struct GoneOption {
  const char *tool, *option, *instead;
};

// Of every tool where `tool` is "".
constexpr GoneOption gone_options[] = {
    {"", "--runs-from", "the folder of the runs, or the runs themselves"},
    {"", "--without-from", "--without FOLDER"},
    {"", "--compare-from", "--compare FOLDER"},
    {"", "--missing", "the folder of the runs: ensemble.json in it counts those that lack"},
    {"", "--only-case", "the folder of the case, e.g. runs/CASE"},
    {"", "--case-weight", "weight in [variant.NAME] of the site file"},
    {"", "--class", "the folder of the runs: a run knows its class ([variant.CLASS])"},
    {"talus-batch", "--case", "a section [variant.NAME] with a weight in the site file"},
    {"talus-batch", "--weight", "weight in [variant.NAME] of the site file"},
    {"talus-dda", "--case", "--variant NAME, a section of the site file with a weight"},
    {"", "--max-failed-share", "[uncertainty] max_failed_share in the site file"},
    {"", "--allow-unfinished", "nothing: finish the run first (talus-dda --resume)"},
    {"", "--rest-speed-m-s", "nothing: blocks below 0.05 m/s at the end are deposited"},
    {"", "--failures", "nothing: ensemble.json says what became of each run"},
    {"talus-runout", "--csv", "--tables FOLDER, it is runout.csv there"},
    {"talus-runout", "--run-table", "--tables FOLDER, it is runs.csv there"},
    {"talus-runout", "--sensitivity", "--tables FOLDER, it is sensitivity.csv there"},
    {"talus-runout", "--curves", "--tables FOLDER, it is curves.csv there"},
    {"talus-runout", "--svg", "--tables FOLDER, it is runout.svg there"},
    {"talus-verify", "--quick", "nothing: it is done by default"},
    {"talus-profile", "--csv", "--tables FOLDER, it is crossings.csv there"},
    {"talus-profile", "--bins", "--tables FOLDER, it is bins.csv there"},
    {"talus-profile", "--stations", "--tables FOLDER, it is stations.csv there"},
    {"talus-profile", "--charts", "--tables FOLDER"},
    {"talus-tin", "--labels-field", "--elevation-field labels=FIELD"},
    {"talus-tin", "--breaklines-elevation-field", "--elevation-field breaklines=FIELD"},
    {"talus-tin", "--spots-elevation-field", "--elevation-field spots=FIELD"},
    {"talus-tin", "--breaklines-unit-m", "--unit-m breaklines=METRES"},
    {"talus-tin", "--spots-unit-m", "--unit-m spots=METRES"},
    {"talus-tin", "--boundary-unit-m", "--unit-m boundary=METRES"},
    {"talus-trn", "--reference-points-elevation-field", "--elevation-field FIELD"},
    {"talus-maps", "--png", "--pages png"},
    {"talus-maps", "--pdf", "--pages pdf"},
    {"talus-maps", "--page", "--pages png,pdf,a3"},
    {"talus-maps", "--co", "gdal_translate -co NAME=VALUE of the map"},
    {"talus-maps", "--resamples", "nothing: a bound of 10 to 29 runs is always drawn 200 times"},
    {"talus-maps", "--seed", "nothing: the bootstrap has one seed"},
    {"talus-hazard", "--png", "--pages png"},
    {"talus-hazard", "--pdf", "--pages pdf"},
    {"talus-hazard", "--page", "--pages png,pdf,a3"},
    {"talus-hazard", "--co", "gdal_translate -co NAME=VALUE of the map"},
    {"talus-trace", "--png", "--pages png"},
    {"talus-trace", "--pdf", "--pages pdf"},
    {"talus-trace", "--page", "--pages png,pdf,a3"},
    {"talus-trn", "--co", "gdal_translate -co NAME=VALUE of the terrain"},
    {"talus-fence", "--seed", "nothing: the bootstrap has one seed"},
    {"talus-blocks", "--obj", "talus-export BLOCKS.h5 -o BLOCKS.obj once the blocks are there"},
    {"talus-dda", "--xdmf", "talus-export RUN.h5 -o RUN.xmf once the run is there"},
    {"talus-dda", "--independent", "--set solver.blocks=alone, or the rocks as [rockfall.*]"},
    {"talus-check", "--independent", "--set solver.blocks=alone, or the rocks as [rockfall.*]"},
    {"talus-dda", "--law", "--set solver.law=VALUE"},
    {"talus-dda", "--duration-s", "--set solver.duration_s=VALUE"},
    {"talus-dda", "--time-step-s", "--set solver.time_step_s=VALUE"},
    {"talus-dda", "--accuracy", "--set solver.accuracy=VALUE"},
    {"talus-dda", "--frame-interval-s", "--set output.frame_interval_s=VALUE"},
    {"talus-dda", "--checkpoint-interval-s", "--set output.checkpoint_interval_s=VALUE"},
    {"talus-tin", "--layer", "'FILE|layername=LAYER'"},
    {"talus-tin", "--where", "'FILE|subset=FILTER'"},
    {"talus-tin", "--labels-layer", "--labels 'FILE|layername=LAYER'"},
    {"talus-tin", "--labels-where", "--labels 'FILE|subset=FILTER'"},
    {"talus-tin", "--breaklines-layer", "--breaklines 'FILE|layername=LAYER'"},
    {"talus-tin", "--breaklines-where", "--breaklines 'FILE|subset=FILTER'"},
    {"talus-tin", "--spots-layer", "--spots 'FILE|layername=LAYER'"},
    {"talus-tin", "--spots-where", "--spots 'FILE|subset=FILTER'"},
    {"talus-tin", "--boundary-layer", "--boundary 'FILE|layername=LAYER'"},
    {"talus-tin", "--boundary-where", "--boundary 'FILE|subset=FILTER'"},
    {"talus-trn", "--layer", "'FILE|layername=LAYER'"},
    {"talus-trn", "--where", "'FILE|subset=FILTER'"},
    {"talus-trn", "--reference-points-layer", "--reference-points 'FILE|layername=LAYER'"},
    {"talus-trn", "--reference-points-where", "--reference-points 'FILE|subset=FILTER'"},
    {"talus-profile", "--line-layer", "--line-file 'FILE|layername=LAYER'"},
    {"talus-profile", "--line-where", "--line-file 'FILE|subset=FILTER'"},
};

}  // namespace

std::string written_instead(const std::string& tool, int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string word(argv[i]), option = word.substr(0, word.find('='));
    for (const GoneOption& gone : gone_options)
      if ((!*gone.tool || tool == gone.tool) && option == gone.option)
        return option + " is gone: write " + gone.instead;
  }
  return "";
}

}  // namespace talus
