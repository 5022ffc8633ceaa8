// tools/verify/talus_verify.cpp
// Error against run time for cases with a known answer and for a slide. Page:
// docs/tools/talus-verify.md
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "base/text.hpp"
#include "tools/frame/build_info.hpp"
#include "tools/frame/command_line.hpp"
#include "tools/frame/machine.hpp"
#include "tools/frame/shipped_data.hpp"
#include "tools/frame/tool.hpp"
#include "tools/verify/site.hpp"
#include "verify/cases/claims.hpp"
#include "verify/study/page.hpp"
#include "verify/study/peers.hpp"
#include "verify/study/summary.hpp"

namespace {

using namespace talus;  // NOLINT: a program of its own

struct Options {
  std::vector<std::string> cases;
  std::string out, page, peers;
  SiteStudyOptions site;
  bool full = false, list = false, stability = false, leaving_out = false;
};

void declare(Tool& tool, Options& o) {
  tool.list("cases", o.cases, "names of cases; all when none is given");
  tool.output_folder("-o,--out", o.out, "folder for the tables, the diagrams and the page");
  tool.output("--page", o.page, "write the page there; its diagrams stay in the folder");
  tool.flag("--full", o.full, "the whole study; without it few settings");
  const ToolOption site = tool.input(
      "--site", o.site.site, "site file: find the cheapest settings for this scene instead");
  tool.input("--trn", o.site.files.trn, "with --site: terrain").needs(site);
  tool.input("--blocks", o.site.files.blocks, "with --site: block set").needs(site);
  tool.flag("--settle", o.site.files.settle, "with --site: as in talus-dda").needs(site);
  tool.option("--tolerance", o.site.tolerance, "with --site: share of the answer, or per cent")
      .needs(site);
  tool.option("--quantity", o.site.quantity, "with --site: what must be right")
      .one_of({quantity_names.begin(), quantity_names.end()})
      .needs(site);
  tool.option("--runs", o.site.n_runs, "with --site: runs a setting").between(2, 1000).needs(site);
  tool.flag("--paper", o.site.with_paper, "with --site: law paper too, for comparison").needs(site);
  tool.flag("--stability", o.stability, "the stability chart too");
  tool.flag("--leaving-out", o.leaving_out,
            "what the scene plan leaves out, and what it saves, too");
  tool.flag("--list", o.list, "print the cases and end");
  tool.option("--peers", o.peers, "folder with tables of other engines, to draw and compare with");
  tool.footer("Example:\n  talus-verify slide_20 bounce_face -o verify --full");
}

// --- the runs ----------------------------------------------------------------------------------

std::string list_of_cases() {
  std::string out;
  for (const VerifyCase& c : verify_cases()) out += c.name + ": " + c.claim + "\n";
  return out + slide_name +
         ": 39 blocks slide down a bent slope, 20 s; error against its own limit";
}

void check_names(const Options& o) {
  std::vector<std::string> known = {slide_name};
  for (const VerifyCase& c : verify_cases()) known.push_back(c.name);
  for (const std::string& name : o.cases) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string near = nearest_name(name, known);
    throw UsageError({"", 0, "cases"}, name + " is not a case",
                     near.empty() ? "--list prints the cases" : "did you mean " + near + "?");
  }
}

bool is_wanted(const Options& o, const std::string& name) {
  return o.cases.empty() || std::find(o.cases.begin(), o.cases.end(), name) != o.cases.end();
}

// --- the study ---------------------------------------------------------------------------------

SlideData shipped_slide() {
  return read_slide(shipped_data("tests/data/terrain_F.asc"),
                    shipped_data("tests/data/blocks_39.obj"));
}

void draw(Tool& tool, const Options& o, const Chart& chart, const std::string& name) {
  tool.write_text(o.out + "/" + name + ".svg", chart_file(chart));
}

// Holds the error at the defaults against its bound; the quick slide has other steps.
void check_error(Tool& tool, const MeasuredCase& measured) {
  if (const VerifyRow* own = default_row(measured.rows))
    tool.check(measured.about->name, own->error, measured.about->bound, holds(measured));
}

MeasuredCase study_case(Tool& tool, const Options& o, const VerifyCase& c) {
  MeasuredCase measured;
  measured.about = &c;
  measured.worst = std::max(useful_error, c.bound);
  const double least_cpu = o.full ? 0.1 : 0.02;
  for (const Method& method : methods_of(c, o.full))
    for (const double dt : method.dt) measured.rows.push_back(measure(c, method, dt, least_cpu));
  if (!o.peers.empty()) measured.peers = read_peers(o.peers, c.name);
  draw(tool, o, work_precision_chart(c.name + ", error: " + c.norm, measured.rows, measured.peers),
       c.name);
  check_error(tool, measured);
  return measured;
}

void study_slide_too(Tool& tool, const Options& o, const ProgressFunction& progress, Study& study) {
  study.slide = study_slide(shipped_slide(), o.full, progress);
  const std::vector<PeerSlide> peers =
      o.peers.empty() ? std::vector<PeerSlide>{} : read_peer_slides(o.peers);
  for (const MeasuredCase& measured : measured_of(*study.slide, peers)) {
    const std::string& name = measured.about->name;
    Chart chart = work_precision_chart(name + ", error: m", measured.rows, measured.peers);
    add_band(chart, measured.known_to);
    draw(tool, o, chart, name);
    check_error(tool, measured);
    study.cases.push_back(measured);
  }
}

void study_cases(Tool& tool, const Options& o, const ProgressFunction& progress, Study& study) {
  double done = 0;
  for (const VerifyCase& c : verify_cases()) {
    progress(++done / static_cast<double>(verify_cases().size() + 1));
    if (is_wanted(o, c.name)) study.cases.push_back(study_case(tool, o, c));
  }
}

void study_stability(Tool& tool, const Options& o, const ProgressFunction& progress, Study& study) {
  const std::vector<Corner> corners = stability_corners();
  for (const Corner& corner : corners) {
    progress(static_cast<double>(study.corners.size()) / static_cast<double>(corners.size()));
    study.corners.push_back(run_corner(corner));
  }
  tool.write_text(o.out + "/stability.csv", stability_csv(study.corners));
  tool.write_text(o.out + "/stability.svg", svg_of(stability_picture(study.corners)));
  const auto n_broken =
      std::count_if(study.corners.begin(), study.corners.end(),
                    [](const StabilityRow& row) { return row.outcome == Outcome::broken; });
  tool.check("broken corners", static_cast<double>(n_broken), 0, n_broken == 0);
}

// Runs each scene with all kept and as its plan has it.
void study_leaving_out(Tool& tool, const Options& o, const ProgressFunction& progress,
                       Study& study) {
  const SlideData slide = shipped_slide();
  const std::vector<Omission> list = omissions(slide, o.full);
  for (const Omission& omission : list) {
    progress(static_cast<double>(study.omissions.size()) / static_cast<double>(list.size()));
    const OmissionRow row = compare(omission, o.full ? 5 : 1);
    tool.check(omission.item + ", " + omission.scene, row.apart, row.limit, row.holds);
    study.omissions.push_back(row);
  }
}

// --- the result --------------------------------------------------------------------------------

Json as_json(const MeasuredCase& measured) {
  const VerifyRow* own = default_row(measured.rows);
  const LawComparison laws = laws_of(measured);
  Json json = {{"case", measured.about->name},
               {"claim", measured.about->claim},
               {"error", own ? own->error : std::nan("")},
               {"bound", measured.about->bound},
               {"holds", own ? Json(holds(measured)) : Json()},
               {"talus_on_front", laws.is_on_front}};
  if (laws.is_compared)
    json["cpu_ratio_paper_over_talus"] = {{"least", laws.least_ratio},
                                          {"at_papers_best_error", laws.ratio_at_best}};
  return json;
}

// Command that makes the study again, folders by their parts.
std::string command_of(const Options& o) {
  std::string command = "talus-verify";
  for (const std::string& name : o.cases) command += " " + name;
  for (const auto& [is_on, flag] :
       {std::pair{o.full, " --full"}, std::pair{o.stability, " --stability"},
        std::pair{o.leaving_out, " --leaving-out"}, std::pair{!o.peers.empty(), " --peers PEERS"},
        std::pair{true, " -o DIR"}, std::pair{!o.page.empty(), " --page PAGE"}})
    if (is_on) command += flag;
  return command;
}

// The page, in the folder or where --page says; its diagrams stay in the folder. Returns where.
std::string write_page(Tool& tool, const Options& o, const Study& study) {
  namespace fs = std::filesystem;
  const std::string page = o.page.empty() ? o.out + "/verification.md" : o.page;
  const fs::path diagrams = fs::absolute(o.out).lexically_normal().lexically_relative(
      fs::absolute(page).lexically_normal().parent_path());
  tool.write_text(page, study_page(shipped_data("verify/study/page.md.in"), study,
                                   diagrams == "." ? "" : diagrams.string() + "/"));
  return page;
}

void run(Tool& tool, const Options& o) {
  Study study;
  study.commit = build_commit;
  study.commit_date = build_commit_date;
  study.machine = processor_name();
  study.command = command_of(o);
  study.full = o.full;
  const ProgressFunction progress = tool.progress();
  const auto part = [&progress](int which) {  // of four
    return [=](double done) { progress((which + done) / 4); };
  };
  study_cases(tool, o, part(0), study);
  if (is_wanted(o, slide_name)) study_slide_too(tool, o, part(1), study);
  if (o.stability) study_stability(tool, o, part(2), study);
  if (o.leaving_out) study_leaving_out(tool, o, part(3), study);
  std::vector<VerifyRow> rows;
  Json list = Json::array();
  for (const MeasuredCase& measured : study.cases) {
    rows.insert(rows.end(), measured.rows.begin(), measured.rows.end());
    list.push_back(as_json(measured));
  }
  tool.write_text(o.out + "/verify.csv", csv_of(rows, processor_name(), build_commit));
  const std::string page = write_page(tool, o, study);
  tool.result({{"commit", build_commit}, {"page", page}, {"cases", list}},
              summary_table(study.cases) + "\n" +
                  (o.full ? claims_by_group(study.cases) + "\n" : "") + page + "\n");
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  Tool tool("talus-verify",
            "Error against run time for cases with a known answer and for a slide.");
  declare(tool, o);
  return tool.run(argc, argv, [&] {
    if (o.list) {
      tool.result({{"cases", list_of_cases()}}, list_of_cases());
      return;
    }
    if (o.out.empty())
      throw UsageError({"", 0, "--out"}, "no folder is named", "give -o DIR, or --list");
    if (!o.site.site.empty()) {
      if (!o.cases.empty() || o.full || o.stability || o.leaving_out || !o.peers.empty() ||
          !o.page.empty())
        throw UsageError({"", 0, "--site"}, "looks at the scene of a site file alone",
                         "leave out --full, --stability, --leaving-out, --peers, --page "
                         "and the names of cases");
      if (o.site.files.trn.empty() || o.site.files.blocks.empty())
        throw UsageError({"", 0, "--site"}, "needs a terrain and blocks",
                         "give --trn TRN.tif and --blocks BLOCKS.h5");
      const std::string table = study_site(tool, o.site, o.out);
      tool.result({{"table", table}}, table);
      return;
    }
    check_names(o);
    run(tool, o);
  });
}
