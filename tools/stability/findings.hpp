// tools/stability/findings.hpp
// Stability of a mass before it fails, in numbers and in words.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "post/statistics.hpp"
#include "run/stability.hpp"
#include "scene/joint_water.hpp"
#include "site/site.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

/// Datum of the height of the water.
enum class WaterMeasure { above_foot, below_surface, above_given, in_cracks };
[[nodiscard]] WaterMeasure measure_of(const WaterSettings& water);

/// With the water higher by `rise` than the site file says; `range.dry`: without any.
struct AtLevel {
  double rise = 0;
  Stability found;
  std::optional<double> as_one_body;  ///< by limit equilibrium; none: on no plane and no wedge
};

/// A group of blocks: the mass, or the blocks that go first.
struct GroupFound {
  double share = share_of_mass;    ///< of the mass that moves where the group fails
  std::optional<double> fails_at;  ///< rise of the water; none: it is stable, or not asked for
  int n_failed = 0;                ///< of the samples
};

struct Findings {
  double seismic = 0;  ///< pseudo-static coefficient
  bool has_water = false;
  WaterMeasure measure = WaterMeasure::above_given;
  WaterRange range;
  double at_given = 0;          ///< height of the water of the site file, by the measure [m]
  std::vector<AtLevel> levels;  ///< by rise; one without water
  std::size_t given = 0;        ///< the level of the site file
  GroupFound mass, first{share_of_first, {}, 0};
  std::optional<Stability> shaken;
  int n_samples = 0;

  [[nodiscard]] const Stability& as_given() const { return levels[given].found; }
};

/// Blocks that move where the first do.
[[nodiscard]] std::vector<int> first_blocks(const Stability& found);

/// Sentences for people who decide, without full stops.
[[nodiscard]] std::vector<std::string> sentences_of(const Findings& findings);
[[nodiscard]] Json json_of(const Findings& findings);

}  // namespace talus
