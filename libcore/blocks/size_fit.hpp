// libcore/blocks/size_fit.hpp: public
// How large the blocks are that come once in 30, 100, 300 years.
// in:    mean edges of blocks that lie on a slope, one event of known size and return period
// out:   a law of sizes, the frequency of blocks of any size, design volumes with bounds
// refs:  Illeditsch and Preh: laws of the mean edge a = V^(1/3), anchored at one event
//
// With lambda_0 blocks a year of any size, those above a come lambda_0 (1 - F(a)) times a year. The
// anchor event gives lambda_0 = (1 / T_a) / (1 - F(a_a)), and V_T = F^-1(1 - 1 / (T lambda_0))^3.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace talus {

enum class SizeLaw { exponential, lognormal, weibull };
[[nodiscard]] const char* text(SizeLaw law);

/// A law of the edge, fitted by its likelihood.
struct SizeFit {
  SizeLaw law = SizeLaw::exponential;
  double first = 0;   ///< mean [m]; mean of ln a; shape
  double second = 0;  ///< none; standard deviation of ln a; scale [m]
  double aic = 0;     ///< Akaike's: the smallest fits best
  double ks = 0;      ///< Kolmogorov's distance from the list [-]
  [[nodiscard]] double exceedance(double edge) const;     ///< 1 - F(edge)
  [[nodiscard]] double edge_of(double exceedance) const;  ///< 0 < exceedance <= 1 [m]
};

/// `edges` > 0, two or more different ones.
[[nodiscard]] SizeFit fit_sizes(SizeLaw law, const std::vector<double>& edges);
/// All laws, the best first.
[[nodiscard]] std::vector<SizeFit> fit_sizes(const std::vector<double>& edges);

struct SizeAnchor {
  double volume = 0, years = 0;  ///< a block of this volume or more comes once in this many years
};
/// Blocks a year of any size.
[[nodiscard]] double rate_of_all(const SizeFit& fit, const SizeAnchor& anchor);
/// The volume that a block has or exceeds once in `years`; 0 where none comes so often [m3].
[[nodiscard]] double volume_of_years(const SizeFit& fit, const SizeAnchor& anchor, double years);

/// 5 and 95 % of volume_of_years() over 200 resamples of the list, refitted with the same law.
[[nodiscard]] std::array<double, 2> volume_bounds(SizeLaw law, const std::vector<double>& edges,
                                                  const SizeAnchor& anchor, double years);

}  // namespace talus
