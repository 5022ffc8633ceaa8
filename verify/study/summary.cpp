// Tables of all cases as Markdown: claims, errors, bounds, times.
#include "verify/study/summary.hpp"

#include <cmath>

#include "base/text.hpp"
#include "verify/cases/claims.hpp"

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

std::string line_of(const MeasuredCase& measured, const std::optional<std::string>& pictures) {
  const VerifyCase& c = *measured.about;
  const VerifyRow* own = default_row(measured.rows);
  const VerifyRow* paper = best_of_paper(measured.rows);
  const LawComparison laws = laws_of(measured);
  std::string line = "| `" + c.name + "`";
  if (pictures) line = "| [`" + c.name + "`](" + *pictures + c.name + ".svg)";
  line += " | " + c.claim + " | " + c.reference + " | " + c.norm + " | ";
  line += own ? text(own->error, 2) + " | " + text(c.bound, 2) + " | " + text(1e3 * own->cpu, 3)
              : "not run | " + text(c.bound, 2) + " | -";
  line += " | " + (paper ? text(paper->error, 2) : "-");
  line += " | " + (laws.is_compared ? ratio_text(laws.ratio_at_best) : "-");
  return line + " | `" + c.test + "` |\n";
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

std::string summary_table(const std::vector<MeasuredCase>& cases,
                          const std::optional<std::string>& pictures) {
  std::string table =
      "| Case | Claim | Against | Error is | Error | Bound | CPU ms | Law paper errs by | takes "
      "times "
      "as long | Test |\n|---|---|---|---|---|---|---|---|---|---|\n";
  for (const MeasuredCase& measured : cases) table += line_of(measured, pictures);
  return table;
}

}  // namespace talus
