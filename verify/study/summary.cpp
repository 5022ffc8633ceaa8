// Tables of all cases as Markdown: claims, errors, bounds, times.
#include "verify/study/summary.hpp"

#include <cmath>

#include "base/text.hpp"

namespace talus {
namespace {

// Law paper's smallest error and its cost.
const VerifyRow* best_of_paper(const std::vector<VerifyRow>& rows) {
  const VerifyRow* best = nullptr;
  for (const VerifyRow& row : rows)
    if (row.law == "paper" && std::isfinite(row.error) && (!best || row.error < best->error))
      best = &row;
  return best;
}

std::string line_of(const MeasuredCase& measured) {
  const VerifyCase& c = *measured.about;
  const VerifyRow* own = default_row(measured.rows);
  const VerifyRow* paper = best_of_paper(measured.rows);
  std::string line =
      "| `" + c.name + "` | " + c.claim + " | " + c.reference + " | " + c.norm + " | ";
  line += own ? text(own->error, 2) + " | " + text(c.bound, 2) + " | " + text(1e3 * own->cpu, 3)
              : "not run | " + text(c.bound, 2) + " | -";
  line += paper ? " | " + text(paper->error, 2) + " | " + text(1e3 * paper->cpu, 3) : " | - | -";
  return line + " | `" + c.test + "` |\n";
}

// One method of running a case, at one step.
struct Column {
  std::string head;
  double dt = 0;
  bool is_paper = false;
  double stiffness = 0, tolerance_factor = 1;
  bool strains = false;
};

bool is_of(const VerifyRow& row, const Column& column, const VerifyCase& c) {
  return row.dt == column.dt && (row.law == "paper") == column.is_paper &&
         row.normal_stiffness == column.stiffness &&
         row.tolerance_factor == column.tolerance_factor &&
         row.strains == (column.strains || c.has_strains);
}

std::string cell_of(const MeasuredCase& measured, const Column& column) {
  for (const VerifyRow& row : measured.rows)
    if (is_of(row, column, *measured.about))
      return (std::isfinite(row.error) ? text(row.error, 2) : "lost") + " (" +
             text(1e3 * row.cpu, 3) + ")";
  return "-";
}

std::string table_of(const std::vector<MeasuredCase>& cases, const std::vector<Column>& columns) {
  std::string table = "| Case | Error is", rule = "|---|---";
  for (const Column& column : columns) {
    table += " | " + column.head;
    rule += "|---";
  }
  table += " |\n" + rule + "|\n";
  for (const MeasuredCase& measured : cases) {
    table += "| `" + measured.about->name + "` | " + measured.about->norm;
    for (const Column& column : columns) table += " | " + cell_of(measured, column);
    table += " |\n";
  }
  return table;
}

}  // namespace

const VerifyRow* default_row(const std::vector<VerifyRow>& rows) {
  for (const VerifyRow& row : rows)
    if (is_default(row) && row.dt == Settings{}.dt) return &row;
  return nullptr;
}

bool holds(const MeasuredCase& measured) {
  const VerifyRow* own = default_row(measured.rows);
  return own && own->error < measured.about->bound;
}

std::string summary_table(const std::vector<MeasuredCase>& cases) {
  std::string table =
      "| Case | Claim | Against | Error is | Error, default | Bound | CPU ms | Law paper: smallest "
      "error | CPU ms | Test |\n|---|---|---|---|---|---|---|---|---|---|\n";
  for (const MeasuredCase& measured : cases) table += line_of(measured);
  return table;
}

std::string steps_table(const std::vector<MeasuredCase>& cases) {
  std::vector<Column> columns;
  for (const double dt : {5e-2, 1e-2, 5e-3, 1e-3})
    columns.push_back({"talus, " + text(dt) + " s", dt});
  for (const double dt : {1e-2, 1e-3, 1e-4})
    columns.push_back({"paper, " + text(dt) + " s", dt, true, paper_stiffness});
  return table_of(cases, columns);
}

std::string settings_table(const std::vector<MeasuredCase>& cases) {
  const double dt = Settings{}.dt;
  std::vector<Column> columns = {{"default", dt}};
  for (const double stiffness : {1e8, 5e10})
    columns.push_back({"k_n " + text(stiffness) + " N/m", dt, false, stiffness});
  for (const double factor : {1e-2, 1e2, 1e4})
    columns.push_back({"tolerance x " + text(factor), dt, false, 0, factor});
  columns.push_back({"strains", dt, false, 0, 1, true});
  return table_of(cases, columns);
}

}  // namespace talus
