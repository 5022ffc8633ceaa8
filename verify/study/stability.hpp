// verify/study/stability.hpp
// The stability chart: scenes at the ends of every range of input, and the outcome of each.
// in:    settings of law talus
// out:   right, outside its tolerance, refused with a reason, or broken (which must not happen)
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "draw/drawing.hpp"
#include "scene/scene.hpp"

namespace talus {

enum class Outcome {
  right,    ///< stable, and the answer within the tolerance
  inexact,  ///< stable, but outside the tolerance
  refused,  ///< not computed, with a reason
  broken,   ///< no finite number, energy from nothing, or a block in the ground
};
[[nodiscard]] std::string text_of(Outcome outcome);

/// Findings on a scene.
struct Seen {
  double error = 0;  ///< in the corner's norm; 0 where it has no closed form
  bool finite = true;
  double gain = 0;  ///< energy that the numbers added, largest, over the energy in play [-]
  double depth =
      0;  ///< deepest vertex below the ground, or ground in the block, over its radius [-]
  std::string refusal;  ///< message of the error that refused it; empty: it ran
  bool left = false;    ///< a block left the terrain, so the rest was not seen
};

/// One place of the chart.
struct Corner {
  std::string axis;  ///< varied quantity
  double value = 0;  ///< of it
  std::string unit;
  std::string scene;  ///< motion in it
  std::string norm;   ///< meaning of the error; empty: no closed form, watched only
  double tolerance = 0;
  std::function<Seen()> run;
};

/// Limits of a right result: energy gained, and depth, which the compliance of contacts explains.
/// From `deep_share` (solver/law_numbers.hpp) on a depth is broken.
inline constexpr double gain_limit = 1e-3, depth_limit = 0.02;

[[nodiscard]] Outcome judge(const Corner& corner, const Seen& seen);

/// All corners in the order of the chart, at the default settings but for the varied one.
[[nodiscard]] std::vector<Corner> stability_corners();

/// A corner with its verdict.
struct StabilityRow {
  Corner corner;
  Seen seen;
  Outcome outcome = Outcome::right;
};
[[nodiscard]] StabilityRow run_corner(const Corner& corner);

/// Table as CSV, and as a picture: a line an axis, a coloured field a value.
[[nodiscard]] std::string stability_csv(const std::vector<StabilityRow>& rows);
[[nodiscard]] Drawing stability_picture(const std::vector<StabilityRow>& rows);

}  // namespace talus
