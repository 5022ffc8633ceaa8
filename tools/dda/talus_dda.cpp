// tools/dda/talus_dda.cpp
// Moves blocks by three-dimensional discontinuous deformation analysis. Page:
// docs/tools/talus-dda.md
#include "base/processor_time.hpp"
#include "setup/set_up_gdal.hpp"
#include "setup/site_crs_gdal.hpp"
#include "tools/dda/report.hpp"
#include "tools/dda/run.hpp"
#include "tools/frame/site_options.hpp"
#include "tools/frame/tool.hpp"

namespace {

using namespace talus;  // NOLINT: a program of its own

void declare(Tool& tool, SiteOptions& site, DdaOptions& o) {
  tool.input("--trn", o.request.files.trn,
             "terrain that the blocks slide on (talus-trn, talus-blocks)")
      .required();
  tool.input("--blocks", o.request.files.blocks, "block set (talus-blocks)").required();
  tool.output("-o,--out", o.out, "run to write (HDF5); not needed for --plan");
  tool.flag("--plan{show}", o.plan,
            "print what the scene needs and what is left out, then end; --plan=full "
            "computes everything");
  tool.flag("--resume", o.resume, "go on from the checkpoint of a run that was stopped, if any");
  tool.flag(
      "--settle", o.request.files.settle,
      "lift blocks that start below the ground onto it with what lies on them, and move blocks "
      "apart that overlap a little");
  tool.option("--passages-by", o.passages_by,
              "a cell is passed while the footprint or only the centroid is over it")
      .one_of({"footprint", "centroid"});
  tool.option("--threads", o.threads,
              "threads that share a step or the rocks; 0, the default: all that the machine or the "
              "Slurm task gives, one inside make -j; the run has the same bytes with any number")
      .between(0, 1024);
  site.option(tool, "--seed", "solver.seed", "seed of scatter and jitter");
  tool.footer(
      "Example:\n  talus-dda site.toml --trn bed.tif --blocks blocks.h5 -o run.h5\n"
      "A run that was stopped leaves run.h5.part: a readable run, and where --resume goes on.");
  // All that was given or read counts for the run's id, but for settings in which a resumed run may
  // differ. The site file counts by its effective values.
  tool.leave_out_of_run_id(site.names());
  tool.leave_out_of_run_id(
      {"resume", "threads", "output.checkpoint_interval_s", "output.frames", "output.whole_share"});
}

}  // namespace

int main(int argc, char** argv) {
  DdaOptions o;
  Tool tool("talus-dda", "Moves blocks by three-dimensional discontinuous deformation analysis.");
  SiteOptions site_options(tool, DrawScope::all);
  site_options.take_additions(tool);
  site_options.take_inputs();
  declare(tool, site_options, o);
  bool is_written = false;
  const int code = tool.run(argc, argv, [&] {
    const double cpu_start = processor_seconds();
    const Site& site = site_options.load();
    check_site_crs(site);
    check_options(tool, o);
    o.request.full_plan = o.plan == "full";
    o.request.surfaces_later = true;
    SetUp setup = plan_scene(site, o.request, tool);
    if (o.plan == "show") {
      tool.leave_out_of_run_id({"plan"});
      read_files_of_scene(site, tool, setup);
      return tool.result({{"plan", plan_json(setup.plan)},
                          {"config", print_config(site)},
                          {"made_with", tool.made_with({"trn", "blocks"})},
                          {"trn_sha256", setup.inputs.trn_sha256},
                          {"blocks_hash", setup.inputs.parts.blocks.content_hash}},
                         as_text(setup.plan));
    }
    make_scene(site, o.request, tool, setup);
    compute_run(tool, site, setup, o, cpu_start);
    is_written = true;
  });
  if (is_written && (code == 0 || code == 3)) remove_checkpoints(o);
  return code;
}
