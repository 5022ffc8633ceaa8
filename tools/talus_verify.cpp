// tools/talus_verify.cpp
// Error against run time for cases with a known answer and for a slide. Page:
// docs/tools/talus-verify.md
#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.hpp"
#include "build_info.hpp"
#include "command_line.hpp"
#include "machine.hpp"
#include "shipped_data.hpp"
#include "tool.hpp"
#include "verify/claims.hpp"
#include "verify/ensemble.hpp"
#include "verify/leaving_out.hpp"
#include "verify/peers.hpp"
#include "verify/stability.hpp"
#include "verify/summary.hpp"
#include "verify_site.hpp"

namespace {

using namespace talus;  // NOLINT: a program of its own

struct Options {
  std::vector<std::string> cases;
  std::string out, peers;
  SiteStudyOptions site;
  bool quick = false, full = false, list = false, stability = false, leaving_out = false;
};

constexpr const char* slide_name = "slide39";

void declare(Tool& tool, Options& o) {
  tool.app().add_option("cases", o.cases, "names of cases; all when none is given");
  tool.output_folder("-o,--out", o.out, "folder for the table, the diagrams and the summary");
  CLI::Option* quick = tool.flag("--quick", o.quick, "few settings; what is done by default");
  tool.flag("--full", o.full, "the whole study")->excludes(quick);
  CLI::Option* site = tool.input("--site", o.site.site,
                                 "site file: find the cheapest settings for this scene instead");
  tool.input("--trn", o.site.files.trn, "with --site: terrain")->needs(site);
  tool.input("--blocks", o.site.files.blocks, "with --site: block set")->needs(site);
  tool.flag("--settle", o.site.files.settle, "with --site: as in talus-dda")->needs(site);
  tool.option("--tolerance", o.site.tolerance, "with --site: share of the answer, or per cent")
      ->needs(site);
  tool.option("--quantity", o.site.quantity, "with --site: what must be right")
      ->check(CLI::IsMember(quantity_names))
      ->needs(site);
  tool.option("--runs", o.site.n_runs, "with --site: runs a setting")
      ->check(CLI::Range(2, 1000))
      ->needs(site);
  tool.flag("--paper", o.site.with_paper, "with --site: law paper too, for comparison")
      ->needs(site);
  tool.flag("--stability", o.stability, "the stability chart too");
  tool.flag("--leaving-out", o.leaving_out,
            "what the scene plan leaves out, and what it saves, too");
  tool.flag("--list", o.list, "print the cases and end");
  tool.app().add_option("--peers", o.peers,
                        "folder with tables of other engines, to draw and compare with");
  tool.footer("Example:\n  talus-verify slide_20 bounce_face -o verify --full");
}

// --- what is run -------------------------------------------------------------------------------

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

CaseOutcome run_case(const VerifyCase& c, const Options& o) {
  CaseOutcome out{&c, {}};
  const double least_cpu = o.full ? 0.1 : 0.02;
  for (const Method& method : methods_of(c, o.full))
    for (const double dt : method.dt) out.rows.push_back(measure(c, method, dt, least_cpu));
  return out;
}

// --- the slide ---------------------------------------------------------------------------------

// What the table of cases says of the slide, by Quantity. Bound: half a per cent of the way of the
// centre.
const std::array<VerifyCase, 3>& slide_claims() {
  static const std::array<VerifyCase, 3> claims = [] {
    std::array<VerifyCase, 3> made;
    const char* what[] = {"the mean place of 39 blocks after a slide of 20 s",
                          "the place that nine tenths of them stay before",
                          "the standard deviation of their places"};
    for (std::size_t q = 0; q < made.size(); ++q) {
      made[q].name = std::string(slide_name) + "_" + quantity_names[q];
      made[q].claim = std::string(what[q]) + " hardly hangs on the step";
      made[q].reference = "law talus at its shortest step, means of many starts";
      made[q].norm = "m";
      made[q].test = "SlideOf39Blocks.CentreAgreesBetweenOneAndTenMilliseconds";
      made[q].bound = 0.8;
    }
    return made;
  }();
  return claims;
}

struct SlideOutcome {
  std::vector<EnsembleResult> results;
  EnsembleReference reference;
  double way = 0;  ///< of the centre, reference [m]
};

// The settings of the slide: others first, then the defaults from the longest step to the
// reference, which is the last. Law paper with the stiffness of the paper, and with a softer one.
std::vector<Method> slide_methods(bool full) {
  const std::vector<double> ladder =
      full ? std::vector<double>{1e-1, 7e-2, 5e-2, 4e-2, 3e-2, 2e-2, 1e-2, 5e-3, 2e-3, 1e-3}
           : std::vector<double>{2e-2, 1e-2};
  Method soft{"talus, k_n 1e8", {}, {1e-2, 5e-3}},
      loose{"talus, tolerance x 100", {}, {1e-2, 5e-3}};
  Method tight{"talus, tolerance x 0.01", {}, {1e-2, 5e-3}};
  soft.settings.normal_stiffness = 1e8;
  loose.settings.tolerance_factor = 100;
  tight.settings.tolerance_factor = 0.01;
  Method paper{"paper, k_n 5e10", {}, {1e-3}}, paper_soft{"paper, k_n 5e8", {}, {1e-3}};
  paper.settings.law = paper_soft.settings.law = Law::paper;
  paper.settings.normal_stiffness = 5e10;
  paper_soft.settings.normal_stiffness = 5e8;
  std::vector<Method> methods;
  if (full) {
    paper.dt = {1e-3, 2e-4, 1e-4};
    methods = {soft, loose, tight, paper_soft};
  }
  methods.push_back(paper);
  methods.push_back({"talus", {}, ladder});
  return methods;
}

// One block in a run goes far now and then, which moves the mean of eight runs by half a metre; so
// what is compared with the reference, and the reference, are means of many.
int slide_runs(const Method& method, bool full) {
  if (!full) return 1;
  if (method.settings.law == Law::paper) return 6;
  return method.name == "talus" ? 96 : 8;
}

double down_the_slope(const Vec3&, const Vec3& now) { return 320 - now.y(); }

SlideData shipped_slide() {
  return read_slide(shipped_data("terrain_F.asc"), shipped_data("blocks_39.obj"));
}

SlideOutcome run_slide(const Options& o) {
  const SlideData data = shipped_slide();
  SlideOutcome out;
  for (const Method& method : slide_methods(o.full))
    for (const double dt : method.dt) {
      Settings settings = method.settings;
      settings.dt = dt;
      const auto scene = [&](std::uint64_t seed) { return slide_scene(data, settings, seed); };
      out.results.push_back(
          run_ensemble(scene, slide_runs(method, o.full), o.full ? 20 : 4, down_the_slope));
      out.results.back().method = method.name;
    }
  out.reference = reference_of(out.results.back(), out.results[out.results.size() - 2]);
  const auto at_rest = [&data](std::uint64_t) { return slide_scene(data, {}, 0); };
  out.way = out.reference.mean[0] - run_ensemble(at_rest, 1, 0, down_the_slope).mean[0];
  return out;
}

std::string slide_table(const SlideOutcome& slide) {
  std::string table =
      "| Settings | dt [s] | centre [m] | nine tenths stay before [m] | spread [m] | CPU s a run | "
      "steps "
      "accepted unconverged |\n|---|---|---|---|---|---|---|\n";
  for (const EnsembleResult& result : slide.results) {
    table += "| " + result.method + " | " + text(result.settings.dt);
    for (std::size_t q = 0; q < result.mean.size(); ++q)
      table += " | " + text(result.mean[q], 5) +
               (result.n_runs > 1 ? " ± " + text(result.standard_error[q], 2) : "");
    table += " | " + text(result.cpu, 3) + " | " + std::to_string(result.sums.unconverged) + " |\n";
  }
  return table + "\nUncertainty of the reference (last line): centre " +
         text(slide.reference.band[0], 2) + " m, nine tenths " + text(slide.reference.band[1], 2) +
         " m, spread " + text(slide.reference.band[2], 2) + " m.\n";
}

std::vector<PeerPoint> slide_peers(const Options& o, const EnsembleReference& reference) {
  std::vector<PeerPoint> points;
  if (o.peers.empty()) return points;
  for (const PeerSlide& peer : read_peer_slides(o.peers))
    points.push_back({peer.name, peer.cpu, std::abs(peer.centre - reference.mean[0])});
  return points;
}

// --- the result --------------------------------------------------------------------------------

Json as_json(const CaseOutcome& outcome, double worst = useful_error) {
  const VerifyRow* own = default_row(outcome.rows);
  const LawComparison laws = compare_laws(outcome.rows, worst);
  Json json = {{"case", outcome.about->name},
               {"claim", outcome.about->claim},
               {"error", own ? own->error : std::nan("")},
               {"bound", outcome.about->bound},
               {"holds", own ? Json(holds(outcome)) : Json()},
               {"talus_on_front", laws.is_on_front}};
  if (laws.is_compared)
    json["cpu_ratio_paper_over_talus"] = {{"least", laws.least_ratio},
                                          {"at_papers_best_error", laws.ratio_at_best}};
  return json;
}

// Runs a case, writes its diagram, holds its error against its bound.
CaseOutcome study_case(Tool& tool, const Options& o, const VerifyCase& c,
                       std::vector<MeasuredCase>& measured) {
  CaseOutcome outcome = run_case(c, o);
  std::vector<PeerPoint> peers;
  if (!o.peers.empty()) peers = read_peers(o.peers, c.name);
  measured.push_back({c.name, outcome.rows, peers});
  tool.write_text(
      o.out + "/" + c.name + ".svg",
      chart_file(work_precision_chart(c.name + ", error: " + c.norm, outcome.rows, peers)));
  const VerifyRow* own = default_row(outcome.rows);
  tool.check(c.name, own ? own->error : std::nan(""), c.bound, holds(outcome));
  return outcome;
}

// Adds its three quantities as cases; returns its table.
std::string study_slide(Tool& tool, const Options& o, std::vector<CaseOutcome>& outcomes,
                        std::vector<MeasuredCase>& measured) {
  const SlideOutcome slide = run_slide(o);
  for (std::size_t q = 0; q < quantity_names.size(); ++q) {
    const VerifyCase& claim = slide_claims()[q];
    const std::string& name = claim.name;
    const std::vector<VerifyRow> own =
        rows_of(name, static_cast<Quantity>(q), slide.results, slide.reference);
    outcomes.push_back({&claim, own});
    if (const VerifyRow* at_default = default_row(own))  // --quick has other steps
      tool.check(name, at_default->error, claim.bound, holds(outcomes.back()));
    const double band = slide.reference.band[q];
    std::vector<PeerPoint> peers;
    if (q == 0) peers = slide_peers(o, slide.reference);
    const std::string title = "slide39, error of the " + std::string(quantity_names[q]) + " [m]";
    // the last is the reference, which has no error
    Chart chart = work_precision_chart(title, {own.begin(), own.end() - 1}, peers);
    add_band(chart, band);
    tool.write_text(o.out + "/" + name + ".svg", chart_file(chart));
    measured.push_back({name, own, peers, useful_error * slide.way, band});
  }
  return slide_table(slide);
}

// Writes the chart; returns how many corners came out how.
std::string study_stability(Tool& tool, const Options& o) {
  std::vector<StabilityRow> rows;
  int count[4] = {0, 0, 0, 0};
  for (const Corner& corner : stability_corners()) {
    rows.push_back(run_corner(corner));
    ++count[static_cast<int>(rows.back().outcome)];
  }
  tool.write_text(o.out + "/stability.csv", stability_csv(rows));
  tool.write_text(o.out + "/stability.svg", stability_svg(rows));
  std::string line = std::to_string(rows.size()) + " corners:";
  for (const Outcome outcome :
       {Outcome::right, Outcome::inexact, Outcome::refused, Outcome::broken})
    line += " " + std::to_string(count[static_cast<int>(outcome)]) + " " + text_of(outcome);
  const int n_broken = count[static_cast<int>(Outcome::broken)];
  tool.check("broken corners", n_broken, 0, n_broken == 0);
  return line + "\n";
}

// Runs each scene with all kept and as its plan has it; returns the table.
std::string study_leaving_out(Tool& tool, const Options& o) {
  const SlideData slide = shipped_slide();
  std::vector<OmissionRow> rows;
  for (const Omission& omission : omissions(slide, o.full)) {
    rows.push_back(compare(omission, o.full ? 5 : 1));
    const OmissionRow& row = rows.back();
    tool.check(omission.item + ", " + omission.scene, row.apart, row.limit, row.holds);
  }
  return omission_table(rows);
}

void run(Tool& tool, const Options& o) {
  const ProgressFunction progress = tool.progress();
  std::vector<CaseOutcome> outcomes;
  std::vector<MeasuredCase> measured;
  double done = 0;
  for (const VerifyCase& c : verify_cases()) {
    progress(++done / static_cast<double>(verify_cases().size() + 1));
    if (!is_wanted(o, c.name)) continue;
    outcomes.push_back(study_case(tool, o, c, measured));
  }
  const std::string slide =
      is_wanted(o, slide_name) ? study_slide(tool, o, outcomes, measured) : "";
  std::vector<VerifyRow> rows;
  Json list = Json::array();
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    rows.insert(rows.end(), outcomes[i].rows.begin(), outcomes[i].rows.end());
    list.push_back(as_json(outcomes[i], measured[i].worst));
  }
  std::string summary = "Commit " + std::string(build_commit) + ", " + processor_name() +
                        (o.full ? ", full study.\n\n" : ", quick study.\n\n") +
                        summary_table(outcomes);
  if (!slide.empty()) summary += "\n" + slide;
  summary +=
      "\nCPU time at equal error, law talus with its defaults (for the slide: errors within "
      "the reference's uncertainty count as equal):\n\n" +
      claims_table(measured);
  if (o.stability) summary += "\n" + study_stability(tool, o);
  if (o.leaving_out) summary += "\n" + study_leaving_out(tool, o);
  tool.write_text(o.out + "/verify.csv", csv_of(rows, processor_name(), build_commit));
  tool.write_text(o.out + "/summary.md", summary);
  tool.result({{"commit", build_commit}, {"cases", list}}, summary);
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
      if (!o.cases.empty() || o.quick || o.full || o.stability || o.leaving_out)
        throw UsageError({"", 0, "--site"}, "looks at the scene of a site file alone",
                         "leave out --quick, --full, --stability, --leaving-out and the names of "
                         "cases");
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
