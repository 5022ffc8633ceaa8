// Writes the page of a study from its results and a template.
#include "verify/study/page.hpp"

#include <algorithm>

#include "base/template_text.hpp"
#include "base/text.hpp"
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

void add_cases(Values& values, const Study& study, const std::string& pictures) {
  long n_run = 0, n_held = 0;
  for (const MeasuredCase& measured : study.cases) {
    n_run += default_row(measured.rows) ? 1 : 0;
    n_held += holds(measured) ? 1 : 0;
  }
  values["default_step"] = text(Settings{}.dt);
  values["n_held"] = number_of(n_held);
  values["cases_run"] = counted(n_run, "case");
  values["summary_table"] = as_lines(summary_table(study.cases, pictures));
}

void add_claims(Values& values, const Study& study) {
  const FrontCount front = front_count(study.cases);
  values["useful_error"] = text(useful_error);
  values["n_on_front"] = number_of(front.n_on_front);
  values["cases_compared"] = counted(front.n_compared, "case");
  values["claims_by_group"] = as_lines(claims_by_group(study.cases));
}

std::string corner_line(const StabilityRow& row) {
  const Corner& c = row.corner;
  const bool is_known = !c.norm.empty();
  return "| " + c.axis + " | " + text(c.value) + (c.unit == "1" ? "" : " " + c.unit) + " | " +
         c.scene + " | " + "**" + text_of(row.outcome) + "**" +
         (row.seen.refusal.empty() ? "" : ": " + row.seen.refusal) + " | " +
         (is_known ? text(row.seen.error, 2) + " " + c.norm : "-") + " | " +
         (is_known ? text(c.tolerance, 2) : "-") + " | " + text(row.seen.gain, 2) + " | " +
         text(row.seen.depth, 2) + " |\n";
}

// Of the corners that are not right.
std::string corner_table(const std::vector<StabilityRow>& corners) {
  std::string table =
      "| Varied | Value | Scene | It is | Error | Tolerance | Energy added / in play | Depth / "
      "radius |\n|---|---|---|---|---|---|---|---|\n";
  for (const StabilityRow& row : corners)
    if (row.outcome != Outcome::right) table += corner_line(row);
  return table;
}

void add_corners(Values& values, const Study& study) {
  values["gain_limit"] = text(100 * gain_limit);
  values["depth_limit"] = text(100 * depth_limit);
  values["corner_counts"] = corner_counts(study.corners);
  values["corner_table"] = as_lines(corner_table(study.corners));
}

void add_omissions(Values& values, const Study& study) {
  const auto n_held = std::count_if(study.omissions.begin(), study.omissions.end(),
                                    [](const OmissionRow& row) { return row.holds; });
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
  marks.parts = {{"quick", !study.full},
                 {"slide", study.slide.has_value()},
                 {"stability", !study.corners.empty()},
                 {"leaving_out", !study.omissions.empty()}};
  marks.values["pictures"] = pictures;
  add_head(marks.values, study);
  add_cases(marks.values, study, pictures);
  add_claims(marks.values, study);
  if (study.slide) marks.values["slide_reference"] = slide_reference(*study.slide);
  add_corners(marks.values, study);
  add_omissions(marks.values, study);
  return filled_template("page.md.in", page_template, marks);
}

}  // namespace talus
