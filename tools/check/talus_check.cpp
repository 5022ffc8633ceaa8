// tools/check/talus_check.cpp
// A look at a site before anything is computed: a picture, numbers and doubts. Page:
// docs/tools/talus-check.md
#include "base/read_file.hpp"
#include "base/text.hpp"
#include "base/write_bytes.hpp"
#include "post/hazard/frequency.hpp"
#include "post/hazard/risk.hpp"
#include "setup/site_crs_gdal.hpp"
#include "tools/check/look.hpp"
#include "tools/check/page.hpp"
#include "tools/check/words.hpp"
#include "tools/frame/doubts.hpp"
#include "tools/frame/doubts_json.hpp"
#include "tools/frame/filing_keys.hpp"
#include "tools/frame/hazard_recipe.hpp"
#include "tools/frame/shipped_data.hpp"
#include "tools/frame/site_options.hpp"
#include "tools/frame/tool.hpp"

namespace {

using namespace talus;  // NOLINT: a program of its own

struct Options {
  CheckFiles files;
  std::string page, report;
  double probe_s = -1;  // chosen by the number of blocks
  std::int64_t n_runs = 0;
  std::vector<std::string> reports;
  DoubtOptions doubts;
};

void declare(Tool& tool, Options& o) {
  tool.input("--trn", o.files.trn, "terrain before the slide (talus-trn)").required();
  tool.input("--bed", o.files.bed, "terrain that the blocks lie on (talus-blocks --trn-out)")
      .required();
  tool.input("--blocks", o.files.blocks, "block set (talus-blocks)").required();
  tool.output("-o,--out", o.page, "page with map, section and numbers (HTML)");
  tool.output("--report", o.report, "the numbers (JSON)");
  tool.option("--probe-s", o.probe_s,
              "seconds of the run that the engine computes, 0: none; not given: 4, or 1 or "
              "none with so many blocks that the probe would take more than 20 CPU s")
      .between(0.0, 60.0)
      .without_default();
  tool.option("--runs", o.n_runs,
              "runs that are to be computed, for their time; 0: [solver] n_runs")
      .between(0, 1000000);
  tool.flag("--settle", o.files.settle,
            "the runs lift blocks onto the ground and move small overlaps apart");
  tool.inputs("--reports", o.reports,
              "reports of the stages before (JSON), whose doubts are shown too");
  declare_doubts(tool, o.doubts, "go on with implausible values");
  tool.footer(
      "Example:\n  talus-check site.toml --trn trn.tif --bed bed.tif --blocks blocks.h5 -o "
      "check.html");
}

// Also where the site is refused: the page shows why.
void write(Tool& tool, const std::string& path, const std::string& content) {
  const auto* const bytes = reinterpret_cast<const unsigned char*>(content.data());
  write_bytes(tool.stage_also_if_refused(path), {bytes, content.size()});
}

// As long as the probe stays a matter of seconds.
double probe_duration(const Options& o, const Look& look) {
  if (!can_be_probed(look) ||
      (refusal_of(look.doubts).state == DoubtState::refused && !o.doubts.accept))
    return 0;
  if (o.probe_s >= 0) return o.probe_s;
  constexpr double most_cpu_s = 20;
  const int n = n_blocks(look.inputs.parts.blocks);
  const double second = moves_alone(look.work.site) ? expected_cpu_s_alone(n)
                                                    : cpu_s_of_a_packed_second(n, probe_step_s);
  return 4 * second <= most_cpu_s ? 4 : second <= most_cpu_s ? 1 : 0;
}

// With the doubts of the stages before, then those of this one.
CheckPage page_of(Tool& tool, const Options& o, const std::vector<Doubt>& last) {
  CheckPage page;
  for (const std::string& file : o.reports) {
    page.reports.push_back(Json::parse_or_null(read_file(file)));
    if (!page.reports.back().is_object())
      throw InputError({file}, "is not a report", "name those that talus tools write (--report)");
    for (Doubt& doubt : doubts_of(page.reports.back())) page.doubts.push_back(std::move(doubt));
  }
  for (const std::vector<Doubt>& own : {tool.doubts_found(), last})
    page.doubts.insert(page.doubts.end(), own.begin(), own.end());
  page.run_id = tool.run_id();
  page.style = shipped_data("tools/report/report.css") + shipped_data("tools/check/check.css");
  return page;
}

// A site that is refused is drawn as far as it was read.
void look_or_show(Tool& tool, const Options& o, const Site& site, Look& look) {
  try {
    look_at(tool, site, o.files, look);
  } catch (const InputError& error) {
    if (!o.page.empty() && !look.work.ground.elevation.empty())
      write(tool, o.page, refused_page(look, page_of(tool, o, {error.doubt()})));
    throw;
  }
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  Tool tool("talus-check",
            "Looks at a site before anything is computed: will the mass move, is everything where "
            "it should be, how long will it take.");
  SiteOptions site_options(tool);
  site_options.take_inputs();
  declare(tool, o);
  tool.leave_out_of_run_id({"runs"});  // for the time alone, which is said and not written
  return tool.run(argc, argv, [&] {
    const Site& site = site_options.load();
    check_site_crs(site);
    // refused now, not after the runs
    const Recipe recipe = read_recipe(tool, site);
    check_exposure(site, recipe, hazard_classes(site));
    if (const std::string words = unused_exposure(site, recipe); !words.empty()) tool.warn(words);
    Look look;
    for (const std::string& file : o.reports)
      if (const Json report = Json::parse_or_null(read_file(file));
          report.is_object() && report.value("tool", "") == "talus-stability")
        look.stability = report;
    look_or_show(tool, o, site, look);
    check_filing(site, recipe, look.work.ground.crs_wkt);
    find_doubts(look);
    probe_look(tool, probe_duration(o, look), look);
    if (tool.interrupted()) throw Interrupted();
    find_doubts(look);
    const Json report = check_json(look, tool.run_id());
    if (o.doubts.accept) accept(look.doubts);
    const CheckPage page = page_of(tool, o, look.doubts);
    if (!o.page.empty()) write(tool, o.page, check_page(look, page));
    tool.report(o.report, report, true);
    o.doubts.crs_wkt = look.work.ground.crs_wkt;
    static_cast<void>(judge(tool, o.doubts, look.doubts));
    tool.result(report,
                check_text(look, page.doubts, o.n_runs > 0 ? o.n_runs : site.solver.n_runs));
  });
}
