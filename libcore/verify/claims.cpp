#include "verify/claims.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.hpp"

namespace talus {
namespace {

// Errors that the reference cannot tell apart made equal.
MeasuredCase as_known(MeasuredCase measured) {
  for (VerifyRow& row : measured.rows) row.error = std::max(row.error, measured.known_to);
  for (PeerPoint& peer : measured.peers) peer.error = std::max(peer.error, measured.known_to);
  return measured;
}

bool is_asked_of_peers(const MeasuredCase& measured) { return !measured.peers.empty(); }

std::string verdict_on_paper(const LawComparison& laws, double asked) {
  if (laws.least_ratio >= asked) return "holds";
  return laws.ratio_at_best >= asked ? "at its smallest error" : "no";
}

std::string verdict_on_peers(double at_default_step, double at_any) {
  if (at_default_step >= 1) return "holds";
  return at_any >= 1 ? "at other steps" : "no";
}

// Smallest error of the other engines and what it cost.
std::string best_peer(const std::vector<PeerPoint>& peers) {
  const auto best =
      std::min_element(peers.begin(), peers.end(),
                       [](const PeerPoint& a, const PeerPoint& b) { return a.error < b.error; });
  return best->name + ": " + text(best->error, 2) + " (" + text(1e3 * best->cpu, 3) + ")";
}

std::string line_of(const MeasuredCase& given) {
  const MeasuredCase measured = as_known(given);
  const LawComparison laws = compare_laws(measured.rows, measured.worst);
  const double asked = asked_of_paper(measured.name);
  std::string line = "| `" + measured.name + "` | " + (laws.is_on_front ? "yes" : "no");
  line += laws.is_compared
              ? " | " + ratio_text(laws.ratio_at_best) + " | " + ratio_text(laws.least_ratio)
              : " | - | -";
  line += asked > 0 && laws.is_compared
              ? " | " + text(asked) + " | " + verdict_on_paper(laws, asked)
              : " | - | -";
  if (!is_asked_of_peers(measured)) return line + " | - | - | - | - |\n";
  const double any = peer_ratio(measured, false), at_default_step = peer_ratio(measured, true);
  return line + " | " + best_peer(given.peers) + " | " + ratio_text(any) + " | " +
         ratio_text(at_default_step) + " | " + verdict_on_peers(at_default_step, any) + " |\n";
}

}  // namespace

double asked_of_paper(const std::string& case_name) {
  const auto begins = [&case_name](const char* with) { return case_name.rfind(with, 0) == 0; };
  if (begins("bounce_") || begins("slide39")) return 50;
  return begins("slide_") || begins("oblique") ? 10 : 0;
}

double peer_ratio(const MeasuredCase& measured, bool default_step_only) {
  double least = std::nan("");
  for (const PeerPoint& peer : measured.peers) {
    if (!(peer.error <= measured.worst)) continue;
    double cheapest = std::numeric_limits<double>::infinity();
    for (const VerifyRow& row : measured.rows)
      if (is_default(row) && (!default_step_only || row.dt == Settings{}.dt) &&
          row.error <= peer.error)
        cheapest = std::min(cheapest, row.cpu);
    const double ratio = peer.cpu / cheapest;
    if (!(ratio >= least)) least = ratio;
  }
  return least;
}

std::string claims_table(const std::vector<MeasuredCase>& cases) {
  std::string table =
      "| Case | on the front of both laws | paper / talus at paper's smallest error | least over "
      "paper's front | asked | | other engines: smallest error (CPU ms) | other engines / talus, "
      "least | at the default step | asked: 1 |\n|---|---|---|---|---|---|---|---|---|---|\n";
  for (const MeasuredCase& measured : cases) {
    const bool has_paper = std::any_of(measured.rows.begin(), measured.rows.end(),
                                       [](const VerifyRow& row) { return row.law == "paper"; });
    if (has_paper || is_asked_of_peers(measured)) table += line_of(measured);
  }
  return table;
}

}  // namespace talus
