// libcore/post/hazard/risk.hpp: public
// Annual risk of the people at an object.
// in:    rates of hits of the object by intensity; who is there, of [object.*]; a recipe of risk
// out:   the annual probability of death of the one most at risk with its interval, expected deaths
//        a year, the class
//
// Hits come at random (Poisson). One that finds the person there kills with the vulnerability of
// its intensity: the annual risk is 1 - exp(-presence (sum over intensities of rate times
// vulnerability)). Vulnerabilities do not fall with the intensity, so the bounds of the risk are
// those at the bounds of the rates above each break.
#pragma once

#include <span>
#include <vector>

#include "post/hazard/frequency.hpp"
#include "post/hazard/recipe.hpp"
#include "post/paired.hpp"

namespace talus {

/// Throws InputError where a recipe of risk finds no object, no frequency, or an object without
/// presence, vulnerability and persons_per_day that fit the recipe; other recipes need none.
void check_exposure(const Site& site, const Recipe& recipe,
                    const std::vector<HazardClass>& classes);

/// Keys of objects on the people there that a recipe without [risk] does not read; empty: none.
[[nodiscard]] std::string unused_exposure(const Site& site, const Recipe& recipe);

struct ObjectRisk {
  Rate individual;          ///< a year, of the one most at risk [-]
  double deaths = 0;        ///< expected of all who are there [1/a]
  std::size_t kind = 0;     ///< index into Recipe::classes
  bool is_certain = false;  ///< the same class at both bounds
};
/// `rates`: of HazardRates::above() the breaks of the recipe.                 (n_breaks + 1)
[[nodiscard]] ObjectRisk risk_of(const Recipe& recipe, const ObjectSettings& object,
                                 std::span<const Rate> rates);

/// The annual risk of who would die so often a year if they never did; the same as a curve, for
/// differences of risks.
[[nodiscard]] double individual_risk(double deaths_of_one);
inline constexpr AmountCurve risk_curve = {
    individual_risk, [](double deaths_of_one) { return 1 - individual_risk(deaths_of_one); }};

/// Probability that an event of an intensity kills the one most at risk [-].
[[nodiscard]] double death_by(const Recipe& recipe, const ObjectSettings& object, float intensity);

}  // namespace talus
