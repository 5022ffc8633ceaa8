// Writes the page of a study from its results and a template.
#include "verify/study/page.hpp"

#include <algorithm>

#include "base/template_text.hpp"
#include "base/text.hpp"
#include "site/plan.hpp"
#include "verify/cases/claims.hpp"
#include "verify/study/summary.hpp"

namespace talus {
namespace {

using Values = std::map<std::string, std::string>;

// Without its last newline: the template ends the line.
std::string as_lines(std::string table) {
  if (!table.empty() && table.back() == '\n') table.pop_back();
  return table;
}

std::string number_of(std::ptrdiff_t n) { return std::to_string(n); }

void add_head(Values& values, const Study& study) {
  values["command"] = study.command;
  values["commit"] = study.commit;
  values["commit_date"] = study.commit_date;
  values["machine"] = study.machine;
  values["extent"] = study.full ? "full" : "quick";
}

void add_cases(Values& values, const Study& study) {
  long n_run = 0, n_held = 0;
  for (const MeasuredCase& measured : study.cases) {
    n_run += default_row(measured.rows) ? 1 : 0;
    n_held += holds(measured) ? 1 : 0;
  }
  values["default_step"] = text(Settings{}.dt);
  values["n_held"] = number_of(n_held);
  values["cases_run"] = counted(n_run, "case");
  values["summary_table"] = as_lines(summary_table(study.cases));
  values["paper_stiffness"] = text(paper_stiffness, 2);
  values["steps_table"] = as_lines(steps_table(study.cases));
  values["settings_table"] = as_lines(settings_table(study.cases));
}

void add_claims(Values& values, const Study& study) {
  const FrontCount front = front_count(study.cases);
  values["useful_error"] = text(useful_error);
  values["n_on_front"] = number_of(front.n_on_front);
  values["cases_compared"] = counted(front.n_compared, "case");
  values["claims_by_group"] = as_lines(claims_by_group(study.cases));
  values["claims_table"] = as_lines(claims_table(study.cases));
}

// Two diagrams a row.
std::string diagram_table(const Study& study, const std::string& pictures) {
  std::string table = "| | |\n|---|---|\n";
  for (std::size_t i = 0; i < study.cases.size(); ++i) {
    const std::string& name = study.cases[i].about->name;
    table += "| ![" + name + "](" + pictures + name + ".svg) ";
    if (i % 2 == 1 || i + 1 == study.cases.size()) table += "|\n";
  }
  return table;
}

std::string corner_line(const StabilityRow& row) {
  const Corner& c = row.corner;
  const bool is_known = !c.norm.empty();
  return "| " + c.axis + " | " + text(c.value) + (c.unit == "1" ? "" : " " + c.unit) + " | " +
         c.scene + " | " +
         (row.outcome == Outcome::right ? "right" : "**" + text_of(row.outcome) + "**") +
         (row.seen.refusal.empty() ? "" : ": " + row.seen.refusal) + " | " +
         (is_known ? text(row.seen.error, 2) + " " + c.norm : "-") + " | " +
         (is_known ? text(c.tolerance, 2) : "-") + " | " + text(row.seen.gain, 2) + " | " +
         text(row.seen.depth, 2) + " |\n";
}

std::string corner_table(const std::vector<StabilityRow>& corners) {
  std::string table =
      "| Varied | Value | Scene | It is | Error | Tolerance | Energy added / in play | Depth / "
      "radius |\n|---|---|---|---|---|---|---|---|\n";
  for (const StabilityRow& row : corners) table += corner_line(row);
  return table;
}

void add_corners(Values& values, const Study& study) {
  values["gain_limit"] = text(100 * gain_limit);
  values["depth_limit"] = text(100 * depth_limit);
  values["corner_counts"] = corner_counts(study.corners);
  values["corner_table"] = as_lines(corner_table(study.corners));
}

// The rules of the scene plan as it prints them, and the effect of the full plan on a scene that
// has nothing to keep them for.
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

void add_omissions(Values& values, const Study& study) {
  const auto n_held = std::count_if(study.omissions.begin(), study.omissions.end(),
                                    [](const OmissionRow& row) { return row.holds; });
  values["rules_table"] = as_lines(table_of_rules());
  values["strain_that_matters"] = text(strain_that_matters);
  values["n_omissions_held"] = number_of(n_held);
  values["omission_rows"] = counted(static_cast<long>(study.omissions.size()), "row");
  values["omission_table"] = as_lines(omission_table(study.omissions));
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

std::string study_page(const std::string& page_template, const Study& study,
                       const std::string& pictures) {
  TemplateMarks marks;
  marks.parts = {{"full", study.full},
                 {"quick", !study.full},
                 {"slide", study.slide.has_value()},
                 {"stability", !study.corners.empty()},
                 {"leaving_out", !study.omissions.empty()}};
  marks.values["pictures"] = pictures;
  marks.values["diagrams"] = as_lines(diagram_table(study, pictures));
  add_head(marks.values, study);
  add_cases(marks.values, study);
  add_claims(marks.values, study);
  if (study.slide) marks.values["slide_table"] = as_lines(slide_table(*study.slide));
  add_corners(marks.values, study);
  add_omissions(marks.values, study);
  return filled_template("page.md.in", page_template, marks);
}

}  // namespace talus
