// libcore/post/fence_search/search.hpp
// Which fences would protect an object, their costs and the residual hits.
// in:    candidate lines with their crossings (screen.hpp), what can be built and its prices
// out:   options that no other beats in all respects, and the cheapest that do what is asked
//
// Options are stretches of candidate lines that hold different shares of the hits, with each height
// and class that can be built, and pairs of such fences: the second is sought for the blocks that
// the first lets through, whether it is below, above or beside it. Pairs are looked at where they
// can cost less than the cheapest single fence that does what is asked for.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "post/fence_search/screen.hpp"
#include "terrain/trn.hpp"

namespace talus {

struct SearchSettings {
  double share = 0.95;                      ///< of the hits on the object, to be stopped
  std::vector<double> heights{3, 4, 5, 6};  ///< ascending [m]
  std::vector<double> capacities;           ///< of the classes, ascending [J]
  std::vector<double> prices_per_m;         ///< one a class
  double price_per_m2 = 0;
  double spacing = 10;  ///< of posts [m]
  int min_fields = 3, end_fields = 1;
  double max_length = std::numeric_limits<double>::infinity();  ///< [m]
  bool two_fences = true;
  double bulking = 1.3;  ///< volume of piled blocks over that of their rock [-]
};

[[nodiscard]] double cost_of(const PlacedFence& fence, const SearchSettings& settings);

/// Reason why an option does not meet the demand.
enum class SearchFault { share, height, energy, storage, length };
[[nodiscard]] const char* text(SearchFault fault);

/// One fence of an option.
struct OptionPart {
  PlacedFence placed;
  FenceDemand demand;
  FieldLoads loads;
  double storage = 0;   ///< behind it [m3]
  double retained = 0;  ///< as it lies, median over runs [m3]
};
struct FenceOption {
  std::vector<OptionPart> parts;    ///< one or two fences
  double length = 0;                ///< of all [m]
  double height = 0, capacity = 0;  ///< the largest [m], [J]
  double cost = 0;
  double stopped = 0;               ///< share of the hits on the object, by weight
  std::vector<BlockWeight> hit;     ///< blocks that still come to the object, by run
  double residual = 0;              ///< their share of the runs
  Interval residual_interval;       ///< 95 %; NaN: too few runs
  std::vector<SearchFault> faults;  ///< none: the option meets the demand
};
/// Which of its demands is nearest to what it has: "height", "energy of single blocks", "energies
/// within a second", "energies of a run", "storage".
[[nodiscard]] std::string governs(const FenceOption& option);

/// A set of fences with all that is said of it. `code`: design code; `trn`: for the storage.
[[nodiscard]] FenceOption option_of(const SearchRuns& runs, const std::vector<SearchLine>& lines,
                                    const std::vector<PlacedFence>& fences, const DesignCode& code,
                                    const SearchSettings& settings, const Trn& trn);

/// Smallest height and class that the demand asks for, the largest where none is enough.
void size_fence(PlacedFence& fence, const FenceDemand& demand, const SearchSettings& settings);

/// The cheapest fence on a part of a line that meets the demand; where none does, the one
/// that is sized for the arrivals.
[[nodiscard]] FenceOption cheapest_on(const SearchRuns& runs, const std::vector<SearchLine>& lines,
                                      const PlacedFence& place, const DesignCode& code,
                                      const SearchSettings& settings, const Trn& trn);

/// Whether option `a` is nowhere worse than `b` and somewhere better: in length, height, capacity,
/// cost and share that is not stopped.
[[nodiscard]] bool beats(const FenceOption& a, const FenceOption& b);

struct FenceSearchResult {
  /// Not beaten by any other; by cost.
  std::vector<FenceOption> front;
  /// Options that meet the demand, the cheapest of each line or pair; by cost.
  std::vector<FenceOption> proposals;
  FenceOption nearest;  ///< without a proposal: the nearest option; no parts: nothing was placed
  int n_options = 0;    ///< looked at
};
/// Nothing hits the object: no front and no proposals.
[[nodiscard]] FenceSearchResult search_fences(const SearchRuns& runs,
                                              const std::vector<SearchLine>& lines,
                                              const DesignCode& code,
                                              const SearchSettings& settings, const Trn& trn);

/// Those of the front that no cheaper one equals in the blocks stopped: a curve, by cost.
[[nodiscard]] std::vector<FenceOption> cost_curve(const std::vector<FenceOption>& front);

/// Whether two shares with their 95 % intervals, of trials that are independent of each other,
/// differ by no more than chance would have it 19 times of 20 (Newcombe 1998, method 10).
[[nodiscard]] bool shares_agree(double a, const Interval& of_a, double b, const Interval& of_b);

}  // namespace talus
