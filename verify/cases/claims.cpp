// Tables of claims: CPU time at equal error, and comparisons with law paper and other engines.
#include "verify/cases/claims.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.hpp"

namespace talus {
namespace {

// Cases that are taken together: their names begin so.
struct ClaimGroup {
  const char* words;
  std::vector<std::string> begins;
};

const std::vector<ClaimGroup>& groups() {
  static const std::vector<ClaimGroup> list = {
      {"a block that slides, straight and obliquely", {"slide_", "oblique"}},
      {"bounce", {"bounce_"}},
      {"the slide of 39 blocks", {"slide39"}}};
  return list;
}

bool is_of(const ClaimGroup& group, const std::string& case_name) {
  return std::any_of(group.begins.begin(), group.begins.end(),
                     [&](const std::string& with) { return case_name.rfind(with, 0) == 0; });
}

// Errors that the reference cannot tell apart made equal.
MeasuredCase as_known(MeasuredCase measured) {
  for (VerifyRow& row : measured.rows) row.error = std::max(row.error, measured.known_to);
  for (PeerPoint& peer : measured.peers) peer.error = std::max(peer.error, measured.known_to);
  return measured;
}

bool has_paper(const MeasuredCase& measured) {
  return std::any_of(measured.rows.begin(), measured.rows.end(),
                     [](const VerifyRow& row) { return row.law == "paper"; });
}

bool has_peers(const MeasuredCase& measured) { return !measured.peers.empty(); }

// The smallest of several ratios, and of which case.
struct Least {
  double ratio = std::numeric_limits<double>::infinity();
  std::string words = "-";

  void look_at(double other, const VerifyCase& of, const std::string& where = "") {
    if (!(other < ratio)) return;
    ratio = other;
    words = ratio_text(other) + " (`" + of.name + "`" + where + ")";
  }
};

std::string where_paper_errs_by(double error, const VerifyCase& of) {
  return ", where law paper errs by " + text(error, 2) + (of.norm == "m" ? " m" : "");
}

std::string line_on_paper(const ClaimGroup& group, const std::vector<MeasuredCase>& cases) {
  Least over_all, at_best;
  for (const MeasuredCase& measured : cases) {
    const VerifyCase& c = *measured.about;
    const LawComparison laws = laws_of(measured);
    if (!is_of(group, c.name) || !laws.is_compared) continue;
    over_all.look_at(laws.least_ratio, c, where_paper_errs_by(laws.least_at, c));
    at_best.look_at(laws.ratio_at_best, c, where_paper_errs_by(laws.best_error, c));
  }
  if (std::isinf(over_all.ratio)) return "";
  return "| law paper: " + std::string(group.words) + " | " + at_best.words + " | " +
         over_all.words + " |\n";
}

std::string line_on_peers(const std::vector<MeasuredCase>& cases, bool default_step_only) {
  Least least;
  for (const MeasuredCase& measured : cases)
    if (has_peers(measured))
      least.look_at(peer_ratio(measured, default_step_only), *measured.about);
  if (std::isinf(least.ratio)) return "";
  return std::string("| other engines, law talus at ") +
         (default_step_only ? "its default step" : "any step") + " | - | " + least.words + " |\n";
}

}  // namespace

LawComparison laws_of(const MeasuredCase& measured) {
  return compare_laws(as_known(measured).rows, measured.worst);
}

double peer_ratio(const MeasuredCase& given, bool default_step_only) {
  MeasuredCase measured = as_known(given);
  if (default_step_only)
    std::erase_if(measured.rows, [](const VerifyRow& row) { return row.dt != Settings{}.dt; });
  double least = std::nan("");
  for (const PeerPoint& peer : measured.peers) {
    if (!(peer.error <= measured.worst)) continue;
    const double ratio = peer.cpu / cheapest(measured.rows, peer.error);
    if (!(ratio >= least)) least = ratio;
  }
  return least;
}

FrontCount front_count(const std::vector<MeasuredCase>& cases) {
  FrontCount count;
  for (const MeasuredCase& measured : cases)
    if (has_paper(measured)) {
      ++count.n_compared;
      count.n_on_front += laws_of(measured).is_on_front ? 1 : 0;
    }
  return count;
}

std::string claims_by_group(const std::vector<MeasuredCase>& cases) {
  std::string table =
      "| CPU time at equal error, over that of law talus | least at its smallest errors | least "
      "over all its errors |\n|---|---|---|\n";
  for (const ClaimGroup& group : groups()) table += line_on_paper(group, cases);
  return table + line_on_peers(cases, false) + line_on_peers(cases, true);
}

}  // namespace talus
