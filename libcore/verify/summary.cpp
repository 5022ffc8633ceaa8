#include "verify/summary.hpp"

#include <array>
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

constexpr std::array talus_steps = {5e-2, 1e-2, 5e-3, 1e-3};
constexpr std::array paper_steps = {1e-2, 1e-3, 1e-4};

// Law paper as its authors use it; strains only where the case asks for them.
bool is_usual_paper(const VerifyRow& row, const VerifyCase& c) {
  return row.law == "paper" && row.normal_stiffness == paper_stiffness &&
         row.strains == c.has_strains;
}

std::string cell_of(const VerifyRow* row) {
  if (!row) return "-";
  if (!std::isfinite(row->error)) return "lost (" + text(1e3 * row->cpu, 3) + ")";
  return text(row->error, 2) + " (" + text(1e3 * row->cpu, 3) + ")";
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
  std::string head = "| Case | Error is", rule = "|---|---";
  const auto add_steps = [&](const std::string& law, const auto& steps) {
    std::string name = law + ", ";
    for (const double dt : steps) {
      head += " | " + name + text(dt) + " s";
      rule += "|---";
      name.clear();
    }
  };
  add_steps("talus", talus_steps);
  add_steps("paper", paper_steps);
  std::string table = head + " |\n" + rule + "|\n";
  for (const MeasuredCase& measured : cases) {
    const VerifyCase& c = *measured.about;
    table += "| `" + c.name + "` | " + c.norm;
    const auto add_cells = [&](const auto& steps, const auto& is_wanted) {
      for (const double dt : steps) {
        const VerifyRow* found = nullptr;
        for (const VerifyRow& row : measured.rows)
          if (row.dt == dt && is_wanted(row)) found = &row;
        table += " | " + cell_of(found);
      }
    };
    add_cells(talus_steps, is_default);
    add_cells(paper_steps, [&c](const VerifyRow& row) { return is_usual_paper(row, c); });
    table += " |\n";
  }
  return table;
}

}  // namespace talus
