// Results at a fence in words: summary, notes and table.
#include "post/fence/fence_text.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/grouped_text.hpp"
#include "base/text.hpp"
#include "record/pieces.hpp"

namespace talus {
namespace {

// "63 first touches of the fence, 2 crossings of its line"
std::string arrivals_text(const FenceResult& r) {
  int n_touches = 0;
  for (const FenceArrival& a : r.arrivals) n_touches += a.by_touch;
  const int n_crossings = r.whole.n - n_touches;
  std::string out;
  if (n_touches > 0)
    out = std::to_string(n_touches) + (n_touches == 1 ? " first touch" : " first touches") +
          " of the fence";
  if (n_crossings > 0)
    out += (out.empty() ? "" : ", ") + std::to_string(n_crossings) +
           (n_crossings == 1 ? " crossing" : " crossings") + " of its line";
  return out;
}

// "; design by 70 crossings of its line in 10 runs without the fence, largest energy 42,960 kJ;
// does not meet the code, energy governs: needs ..."
std::string design_text(const FenceResult& r) {
  if (r.at_basis.n == 0) return "";
  const bool is_other = r.basis == DesignBasis::without_fence;
  return "; " +
         (is_other ? "design by " + basis_text(r) + ", largest energy " +
                         grouped_text(r.at_basis.energy.largest / 1e3) + " kJ; "
                   : std::string()) +
         text(r.design);
}

// "Panels broke in 2 of 5 runs: panel 3 at 4.21 s by block 17, ..."; empty where none did. Of rocks
// that fell one by one: "Panels broke for 3 of 80 rocks, each of which met all of them: ...".
std::string broken_text(std::size_t index, const FenceRunGroup& group) {
  constexpr int most = 5;
  int n_with = 0, n_worlds = 0, n = 0;
  std::string list;
  for (const FenceRun& run : group.runs) {
    std::set<int> with;  // rocks, or all blocks
    n_worlds += count_different(run.world);
    for (const PanelRow& panel : run.at_fence[index].broken) {
      with.insert(panel.rock);
      if (++n > most) continue;
      list += (n == 1 ? ": panel " : ", panel ") + std::to_string(panel.panel) + " at " +
              text(panel.broken_at, 4) + " s by block " + std::to_string(panel.broken_by);
    }
    n_with += static_cast<int>(with.size());
  }
  if (n == 0) return "";
  if (n > most) list += " and " + std::to_string(n - most) + " more (JSON: broken_panels)";
  if (fell_one_by_one(group))
    return "Panels broke for " + std::to_string(n_with) + " of " + counted(n_worlds, "rock") +
           ", each of which met the whole fence" + list + ".";
  return "Panels broke in " + std::to_string(n_with) + " of " + std::to_string(n_runs(group)) +
         (n_runs(group) == 1 ? " run" : " runs") + list + ".";
}

}  // namespace

std::string verdicts_text(const std::string& name, std::size_t index, const FenceRunGroup& group) {
  std::map<Verdict, int> count;
  int total = 0;
  for (const FenceRun& run : group.runs)
    for (const BlockVerdict& v : run.at_fence[index].verdicts) ++count[v.verdict], ++total;
  const int n = n_runs(group);
  std::string out = name + ": " + std::to_string(total) + " blocks of " + std::to_string(n) +
                    (n == 1 ? " run:" : " runs:");
  for (const auto& [verdict, n_blocks] : count)
    out += " " + std::to_string(n_blocks) + " " + text(verdict) + ",";
  std::replace(out.begin() + static_cast<std::ptrdiff_t>(out.find(':')), out.end(), '_', ' ');
  out.back() = ';';
  return out;
}

const char* recorded_at(const FenceArrival& arrival) {
  return arrival.by_touch ? "first touch" : "crossing";
}

std::string basis_text(const FenceResult& r) {
  const auto n = static_cast<std::int64_t>(r.at_basis.n);
  const std::string runs = " in " + counted(r.n_basis_runs, "run");
  switch (r.basis) {
    case DesignBasis::open_line:
      return counted(n, "crossing") + " of its line" + runs + ", in which it stops nothing";
    case DesignBasis::without_fence:
      return counted(n, "crossing") + " of its line" + runs + " without the fence";
    case DesignBasis::first_touches:
      break;
  }
  return std::to_string(n) + (n == 1 ? " first touch" : " first touches") +
         " of the standing fence" + runs;
}

std::string basis_note(const FenceResult& r, const std::string& fence, bool one_by_one) {
  const std::string rests = "The design check rests on " + basis_text(r);
  switch (r.basis) {
    case DesignBasis::open_line:
      return rests + ".";
    case DesignBasis::without_fence:
      return rests +
             ": these energies and heights are for design. First touches of the standing "
             "fence are not" +
             (one_by_one ? "." : ": rocks that it stopped dam those behind them.");
    case DesignBasis::first_touches:
      break;
  }
  return rests +
         (one_by_one
              ? ", which are not design values: what comes to a line that stops nothing is."
              : ", which are not design values: rocks that it stopped dam those behind them, "
                "and a line that stops nothing may see several times the energy.") +
         " Compute runs without the fence (make WITHOUT=yes; or talus-dda --set fence." + fence +
         ".active=false) and give them by --without.";
}

std::string fence_summary(const FenceCase& fence, std::size_t index, const FenceResult& result,
                          const FenceRunGroup& group) {
  const std::string out = verdicts_text("fence " + fence.line.name, index, group);
  if (result.whole.n == 0) return out + " nothing came to it" + design_text(result);
  return out + " " + arrivals_text(result) + ": largest energy " +
         grouped_text(result.whole.energy.largest / 1e3) + " kJ, highest top " +
         text(result.whole.top.largest, 3) + " m" + design_text(result);
}

std::vector<std::string> fence_notes(const FenceCase& fence, std::size_t index,
                                     const FenceResult& result, const FenceRunGroup& group,
                                     const DesignCode& code) {
  const bool standing = stood(group, index);
  std::vector<std::string> notes;
  notes.emplace_back(standing
                         ? "The runs were computed with the fence standing: verdicts are observed."
                         : "The runs were computed without the fence: verdicts say what each block "
                           "would meet at the line; how blocks pile up, deflect or break the fence "
                           "one after the other was not modelled.");
  const bool one_by_one = fell_one_by_one(group);
  if (one_by_one)
    notes.emplace_back(
        "The rocks fell one by one: hits do not add up, and no rock is dammed by another.");
  if (result.at_basis.n > 0) notes.push_back(basis_note(result, fence.line.name, one_by_one));
  notes.emplace_back(
      "Barrier classes are tested with single blocks at mid-field; hits at posts, by "
      "several blocks at once or in a damaged field are not covered by them.");
  if (result.whole.window_hits > 1)
    notes.push_back("Up to " + std::to_string(result.whole.window_hits) +
                    " blocks come within one "
                    "second: the sum of their energies stands beside the single-block check.");
  if (std::fmax(result.retained, result.kept) > 0.5 * result.storage)
    notes.emplace_back(
        "The retained volume fills more than half of the storage wedge: the fence is "
        "then loaded by a deposit, for which no barrier class is tested.");
  if (std::isnan(fence.fence.capacity))
    notes.emplace_back(standing
                           ? "The fence has no capacity_kj: it stood rigid, and the design check "
                             "leaves its energy open."
                           : "The fence has no capacity_kj: no block counts as piercing it, and "
                             "the design check leaves its energy open.");
  if (const int n = n_unsettled(group, index); n > 0)
    notes.push_back(std::to_string(n) + " of the blocks that the fence stopped " +
                    (n == 1 ? "was" : "were") +
                    " still moving when the run ended: they may pass it yet.");
  if (std::string broken = broken_text(index, group); !broken.empty())
    notes.push_back(std::move(broken));
  for (std::string& remark : build_remarks(code, fence.fence)) notes.push_back(std::move(remark));
  return notes;
}

}  // namespace talus
