// libcore/sampling/sensitivity.hpp: public
// Share of a result of many runs that depends on one of the numbers drawn, from the runs alone.
// refs:  Plischke, Borgonovo and Smith 2013 (indices from the runs that are there)
#pragma once

#include <vector>

namespace talus {

/// Fewer runs say nothing that could be told from chance.
inline constexpr int least_runs_for_sensitivity = 200;

/// Ranks from 1; equal values share the mean of theirs.                                 (n)
[[nodiscard]] std::vector<double> ranks_of(const std::vector<double>& values);

/// Spearman's rank correlation, -1 to 1; NaN where one of the two is constant.
[[nodiscard]] double rank_correlation(const std::vector<double>& x, const std::vector<double>& y);

/// First-order index: share of the variance of y that x alone explains, by the polynomial in the
/// rank of x that fits best, of degree 8 or through all values of x where they are fewer; less the
/// share that chance would explain. 0 to 1 up to an error of about one over the root of n, also
/// below 0; NaN where one is constant. Points of a design need no order for it: neighbours in the
/// order of x, which other methods compare, are far apart in Sobol's points and not random pairs.
[[nodiscard]] double first_order_index(const std::vector<double>& x, const std::vector<double>& y);

/// The same of a quantity whose values have no order: between groups of equal `group`. NaN where
/// each is a group of its own.
[[nodiscard]] double share_between_groups(const std::vector<double>& group,
                                          const std::vector<double>& y);

}  // namespace talus
