#include "verify/page.hpp"

#include <algorithm>

#include "base/text.hpp"
#include "scene/plan.hpp"
#include "verify/claims.hpp"
#include "verify/summary.hpp"

namespace talus {
namespace {

std::string head_of(const Study& study) {
  return "# Verification\nWhat is claimed, against what is known exactly, and what it costs. This "
         "page is written by `" +
         study.command +
         "`, all of it; change the program, not the page. What was measured by other means stands "
         "in [measurements](measurements.md), what was observed in the field beside what is "
         "simulated in [validation](validation.md).\n\nCommit " +
         study.commit + " of " + study.commit_date + ", " + study.machine + ", " +
         (study.full ? "full" : "quick") +
         " study. Times are processor time of the start and all steps of a case, one core; set-up "
         "of the scene and the integration of a reference are not in them.\n";
}

std::string part_on_cases(const Study& study, const std::string& pictures) {
  long n_run = 0, n_held = 0;
  for (const MeasuredCase& measured : study.cases) {
    n_run += default_row(measured.rows) ? 1 : 0;
    n_held += holds(measured) ? 1 : 0;
  }
  return "\n## All cases\nLaw talus at its default settings and its default step of " +
         text(Settings{}.dt) +
         " s: one setting for all. Law paper where it errs least, of all its steps and "
         "stiffnesses. `Verify/EachCase.IsWithinItsBound` holds every error below its bound (of "
         "the slide: the test named), the test named looks at it more closely. " +
         std::to_string(n_held) + " of " + counted(n_run, "case") + " within their bounds.\n\n" +
         summary_table(study.cases) +
         "\nThe same at several steps, law talus at its defaults, law paper at k_n = " +
         text(paper_stiffness, 2) +
         " N/m: error, in brackets CPU ms. *lost*: a block went through the ground or left the "
         "terrain (of the slide: went through), or what was looked for did not happen, which is no "
         "answer. All rows: [verify.csv](" +
         pictures + "verify.csv).\n\n" + steps_table(study.cases) +
         (study.full ? "\nThe same with law talus at its default step, one setting changed "
                       "(`tolerance`: of the solver, on the residual at which contact forces count "
                       "as found; blocks that touch each other have no strains):\n\n" +
                           settings_table(study.cases)
                     : "");
}

std::string part_on_claims(const Study& study) {
  return "\n## CPU time at equal error\nFor each error of law paper on its own front, its CPU time "
         "over that of the cheapest step of law talus that errs no more, all else at its default; "
         "above 1 law talus takes less, 0: it never gets as close. Errors of " +
         text(useful_error) +
         " and above (of the slide: that share of its way; of a case with a wider bound: that) are "
         "no answers and not compared, nor are steps of law talus at which contacts get deeper "
         "than a tenth of a block (flag `deep`); errors of the slide within the uncertainty of its "
         "reference count as equal to it. Other engines were measured elsewhere, on another core: "
         "figures beside theirs are ratios of two machines.\n\n" +
         (study.full ? "" : "A quick study has two steps a law: its ratios say little.\n\n") +
         claims_list(study.cases) + "\n" + claims_table(study.cases);
}

std::string part_on_diagrams(const Study& study, const std::string& pictures) {
  std::string part =
      "\n## Work-precision diagrams\nError against CPU time, both logarithmic, a curve a method; "
      "black rings are on the Pareto front of both laws, pale points are other engines. Errors "
      "below 1e-16 are drawn there.\n\n| | |\n|---|---|\n";
  for (std::size_t i = 0; i < study.cases.size(); ++i) {
    const std::string& name = study.cases[i].about->name;
    part += "| ![" + name + "](" + pictures + name + ".svg) ";
    if (i % 2 == 1 || i + 1 == study.cases.size()) part += "|\n";
  }
  return part;
}

std::string part_on_slide(const SlideStudy& slide) {
  return "\n## The slide of 39 blocks\nIt has no closed form. Its starts differ by 1 mm/s; what is "
         "compared are means of many: the mean place of the rock, the place that nine tenths of it "
         "stay before, and its spread, ± standard error; never the toe of one run. The reference "
         "is the line through the means of the three shortest steps, at a step of nothing "
         "(Richardson's extrapolation, first order); its uncertainty is its standard error and the "
         "distance of the two shortest steps from it, together.\n\n" +
         slide_table(slide);
}

std::string part_on_corners(const Study& study, const std::string& pictures) {
  std::string part =
      "\n## Stability chart\nWhat is varied, over its range, all else at its default. *Right*: "
      "finite, the numbers add no more than " +
      text(100 * gain_limit) +
      " % to the energy in play, no vertex deeper in the ground and no ground deeper in the block "
      "than " +
      text(100 * depth_limit) +
      " % of the block's radius, and the answer within its tolerance; where no answer is known "
      "(tolerance -) nothing more. *Inexact*: stable, outside the tolerance. *Refused*: with a "
      "reason. *Broken*: none of these. Each corner is a test, `Stability/Corners.IsRight`.\n\n![" +
      std::string("stability chart](") + pictures + "stability.svg)\n\n" +
      corner_counts(study.corners) + " Numbers: [stability.csv](" + pictures +
      "stability.csv).\n\n| Varied | Value | Scene | It is | Error | Tolerance | Energy added / in "
      "play | Depth / radius |\n|---|---|---|---|---|---|---|---|\n";
  for (const StabilityRow& row : study.corners) {
    const Corner& c = row.corner;
    const bool is_known = !c.norm.empty();
    part += "| " + c.axis + " | " + text(c.value) + (c.unit == "1" ? "" : " " + c.unit) + " | " +
            c.scene + " | " +
            (row.outcome == Outcome::right ? "right" : "**" + text_of(row.outcome) + "**") +
            (row.seen.refusal.empty() ? "" : ": " + row.seen.refusal) + " | " +
            (is_known ? text(row.seen.error, 2) + " " + c.norm : "-") + " | " +
            (is_known ? text(c.tolerance, 2) : "-") + " | " + text(row.seen.gain, 2) + " | " +
            text(row.seen.depth, 2) + " |\n";
  }
  return part;
}

// The rules of the scene plan as it prints them, and what the full plan does with a scene that has
// nothing to keep them for.
std::string table_of_rules() {
  std::string table = "| Item | Rule | Kept by `--plan=full` |\n|---|---|---|\n";
  PlanFacts nothing;
  nothing.passages = false;
  const ScenePlan plan = make_plan(nothing, false), full = make_plan(nothing, true);
  for (std::size_t i = 0; i < plan.items.size(); ++i) {
    const PlanItem& item = plan.items[i];
    table += "| " + item.item + " | " + item.rule + " | " +
             (item.on != full.items[i].on ? "yes" : "as the scene asks") + " |\n";
  }
  return table;
}

std::string part_on_omissions(const Study& study) {
  const auto n_held = std::count_if(study.omissions.begin(), study.omissions.end(),
                                    [](const OmissionRow& row) { return row.holds; });
  return "\n## Leaving out\nWhat a scene does not need is left out by these rules; `talus-dda "
         "--plan` prints the reason for a scene of your own.\n\n" +
         table_of_rules() +
         "\nScenes with an item kept and left out, CPU times of the start and all steps (medians, "
         "in turn), and how far the blocks end apart. The first rows are six scenes with the plan "
         "of `talus-dda` and with the full one (*all but strains*: both with the strains of the "
         "plan). Allowed: the same bits where nothing is approximated; 1e-9 m where blocks sleep "
         "or a strength of nothing has to break first; 1e-11 and 1e-12 m for a friction and a "
         "motion of nothing; 1e-5 of the way for edges of a plane, which bear a part of the weight "
         "when they are looked at; a share of " +
         text(strain_that_matters) +
         " of the way for strains; where a last bit ends metres away, means of many starts within "
         "three standard errors. Each row is a test, `Plan/LeavingOut.ChangesNoMoreThanItMay`, the "
         "whole slide aside. " +
         std::to_string(n_held) + " of " +
         counted(static_cast<long>(study.omissions.size()), "row") + " hold.\n\n" +
         omission_table(study.omissions);
}

}  // namespace

std::string corner_counts(const std::vector<StabilityRow>& corners) {
  std::string line = counted(static_cast<long>(corners.size()), "corner") + ":";
  const char* comma = "";
  for (const Outcome outcome :
       {Outcome::right, Outcome::inexact, Outcome::refused, Outcome::broken}) {
    const auto n =
        std::count_if(corners.begin(), corners.end(),
                      [outcome](const StabilityRow& row) { return row.outcome == outcome; });
    line += comma + std::string(" ") + std::to_string(n) + " " + text_of(outcome);
    comma = ",";
  }
  return line + ".";
}

std::string study_page(const Study& study, const std::string& pictures) {
  std::string page = head_of(study) + part_on_cases(study, pictures) + part_on_claims(study);
  if (study.slide) page += part_on_slide(*study.slide);
  page += part_on_diagrams(study, pictures);
  if (!study.corners.empty()) page += part_on_corners(study, pictures);
  if (!study.omissions.empty()) page += part_on_omissions(study);
  return page + not_verified();
}

std::string not_verified() {
  return R"(
## What is not verified
What is not modelled at all stands in [limits](limits.md). Of what is:
- Strains of blocks that touch each other: computed rigid. Strains are compared with closed forms on lone blocks alone.
- Fences that a slide fills: panels are checked with single blocks and a few at a time, not with what a mass does to a net.
- Hits in turn within a step, far ends of long blocks, blocks thrown at others that were out of reach, and splinters: bounded by health checks over seeds, compared with nothing exact.
- Thin plates over peaks: some are deeper in the ground than allowed for a time.
- Steps above 0.05 s with several blocks: health flags what goes wrong, nothing refuses them.
- Restitution of several blocks that hit at once: a rule (Newton's, lowered where hits follow in turn), compared with momentum and energy alone.
- The slide's reference is that of law talus itself: where its steps agree may still be off by what all its steps have in common. Means of other rigid engines lie from 12 m short of it to 6 m beyond.
- Corners of the stability chart without a tolerance: nothing exact is known of them.
)";
}

}  // namespace talus
