#include "verify/summary.hpp"

#include <cmath>

#include "base/text.hpp"

namespace talus {
namespace {

// Law paper's smallest error and what it cost.
const VerifyRow* best_of_paper(const std::vector<VerifyRow>& rows) {
  const VerifyRow* best = nullptr;
  for (const VerifyRow& row : rows)
    if (row.law == "paper" && std::isfinite(row.error) && (!best || row.error < best->error))
      best = &row;
  return best;
}

std::string line_of(const CaseOutcome& outcome) {
  const VerifyCase& c = *outcome.about;
  const VerifyRow* own = default_row(outcome.rows);
  const VerifyRow* paper = best_of_paper(outcome.rows);
  std::string line =
      "| `" + c.name + "` | " + c.claim + " | " + c.reference + " | " + c.norm + " | ";
  line += own ? text(own->error, 2) + " | " + text(c.bound, 2) + " | " + text(1e3 * own->cpu, 3)
              : "not run | " + text(c.bound, 2) + " | -";
  line += paper ? " | " + text(paper->error, 2) + " | " + text(1e3 * paper->cpu, 3) : " | - | -";
  return line + " | `" + c.test + "` |\n";
}

}  // namespace

const VerifyRow* default_row(const std::vector<VerifyRow>& rows) {
  for (const VerifyRow& row : rows)
    if (row.method == "talus" && row.dt == Settings{}.dt) return &row;
  return nullptr;
}

bool holds(const CaseOutcome& outcome) {
  const VerifyRow* own = default_row(outcome.rows);
  return own && own->error < outcome.about->bound;
}

std::string summary_table(const std::vector<CaseOutcome>& outcomes) {
  std::string table =
      "| Case | Claim | Against | Error is | Error, default | Bound | CPU ms | Law paper: smallest "
      "error | CPU ms | Test |\n|---|---|---|---|---|---|---|---|---|---|\n";
  for (const CaseOutcome& outcome : outcomes) table += line_of(outcome);
  return table;
}

}  // namespace talus
