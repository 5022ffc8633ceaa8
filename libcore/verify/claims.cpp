#include "verify/claims.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.hpp"

namespace talus {
namespace {

// How many times less CPU time than law paper was asked for, of which cases: names begin so.
struct Target {
  const char* words;
  double asked;
  std::vector<std::string> begins;
};

const std::vector<Target>& targets() {
  static const std::vector<Target> list = {
      {"A block that slides, straight and obliquely", 10, {"slide_", "oblique"}},
      {"Bounce", 50, {"bounce_"}},
      {"The slide", 50, {"slide39"}}};
  return list;
}

bool is_of(const Target& target, const std::string& case_name) {
  return std::any_of(target.begins.begin(), target.begins.end(),
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

std::string verdict_on_paper(double least, double at_best, double asked) {
  if (least >= asked) return "holds";
  return at_best >= asked ? "at its smallest error" : "no";
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

std::string line_of(const MeasuredCase& measured) {
  const LawComparison laws = laws_of(measured);
  const std::string& name = measured.about->name;
  const double asked = asked_of_paper(name);
  std::string line = "| `" + name + "` | " + (laws.is_on_front ? "yes" : "no");
  line += laws.is_compared
              ? " | " + ratio_text(laws.ratio_at_best) + " | " + ratio_text(laws.least_ratio)
              : " | - | -";
  line += asked > 0 && laws.is_compared
              ? " | " + text(asked) + " | " +
                    verdict_on_paper(laws.least_ratio, laws.ratio_at_best, asked)
              : " | - | -";
  if (!has_peers(measured)) return line + " | - | - | - | - |\n";
  const double any = peer_ratio(measured, false), at_default_step = peer_ratio(measured, true);
  return line + " | " + best_peer(measured.peers) + " | " + ratio_text(any) + " | " +
         ratio_text(at_default_step) + " | " + verdict_on_peers(at_default_step, any) + " |\n";
}

// The smallest of several ratios, whose it is, and where law paper errs by how much.
struct Least {
  double ratio = std::numeric_limits<double>::infinity();
  std::string words;

  void look_at(double other, const VerifyCase& of, double error) {
    if (other >= ratio) return;
    ratio = other;
    words = ratio_text(other) + " (`" + of.name + "`, where it errs by " + text(error, 2) +
            (of.norm == "m" ? " m)" : ")");
  }
};

std::string words_on(const Target& target, const std::vector<MeasuredCase>& cases) {
  Least over_all, at_best;
  for (const MeasuredCase& measured : cases) {
    if (!is_of(target, measured.about->name)) continue;
    const LawComparison laws = laws_of(measured);
    if (!laws.is_compared) continue;
    over_all.look_at(laws.least_ratio, *measured.about, laws.least_at);
    at_best.look_at(laws.ratio_at_best, *measured.about, laws.best_error);
  }
  if (over_all.words.empty()) return "";
  return "- " + std::string(target.words) + ": asked, " + text(target.asked) +
         " times less CPU time than law paper at equal error. Least over all errors of law "
         "paper: " +
         over_all.words + "; least at its smallest errors: " + at_best.words + ". **" +
         verdict_on_paper(over_all.ratio, at_best.ratio, target.asked) + "**\n";
}

std::string words_on_peers(const std::vector<MeasuredCase>& cases) {
  std::string list;
  for (const MeasuredCase& measured : cases) {
    if (!has_peers(measured)) continue;
    const double any = peer_ratio(measured, false), at_default_step = peer_ratio(measured, true);
    list += (list.empty() ? " `" : ", `") + measured.about->name + "` " +
            verdict_on_peers(at_default_step, any) + " (" + ratio_text(at_default_step) +
            " at the default step, " + ratio_text(any) + " at any)";
  }
  if (list.empty()) return "";
  return "- Other engines: asked, no more CPU time than the best of them at equal error, with one "
         "default setting:" +
         list + ".\n";
}

}  // namespace

double asked_of_paper(const std::string& case_name) {
  for (const Target& target : targets())
    if (is_of(target, case_name)) return target.asked;
  return 0;
}

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

std::string claims_table(const std::vector<MeasuredCase>& cases) {
  std::string table =
      "| Case | on the front of both laws | paper / talus at paper's smallest error | least over "
      "paper's front | asked | | other engines: smallest error (CPU ms) | other engines / talus, "
      "least | at the default step | asked: 1 |\n|---|---|---|---|---|---|---|---|---|---|\n";
  for (const MeasuredCase& measured : cases)
    if (has_paper(measured) || has_peers(measured)) table += line_of(measured);
  return table;
}

std::string claims_list(const std::vector<MeasuredCase>& cases) {
  int n_compared = 0, n_on_front = 0;
  for (const MeasuredCase& measured : cases)
    if (has_paper(measured)) {
      ++n_compared;
      n_on_front += laws_of(measured).is_on_front ? 1 : 0;
    }
  std::string list = "- Law talus has a step on the Pareto front of both laws in " +
                     std::to_string(n_on_front) + " of " + counted(n_compared, "case") + ".\n";
  for (const Target& target : targets()) list += words_on(target, cases);
  return list + words_on_peers(cases);
}

}  // namespace talus
