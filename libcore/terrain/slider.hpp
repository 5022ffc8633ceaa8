// libcore/terrain/slider.hpp: public
// A point that slides down the ground under Coulomb friction: how long a mass will move, before
// anything is computed.
// in:    a smooth terrain, friction, where it starts
// out:   when and where it comes to rest
#pragma once

#include <cstdint>
#include <vector>

#include "terrain/trn.hpp"

namespace talus {

/// Tangent of the friction angle of the ground: of one class, or by class of each cell.
struct SlidingFriction {
  std::vector<double> tangent{0};        ///< of each class
  std::vector<std::uint8_t> cell_class;  ///< empty: one class                          (n_cells)
};

struct SliderPath {
  double time = 0;           ///< to rest, or to where it left the known ground [s]
  double path = 0;           ///< in plan [m]
  Vec2 end = Vec2::Zero();   ///< where it is then
  bool left = false;         ///< it left the known ground, or slid for `longest` seconds
  std::vector<Vec2> points;  ///< of each step, when asked for
};

inline constexpr double slider_step_s = 0.1;
inline constexpr double longest_slide_s = 600;

/// From rest at `start`. The speed is kept where the slope bends.
[[nodiscard]] SliderPath slide_from(const Trn& ground, const SlidingFriction& friction,
                                    const Vec2& start, bool with_points = false);

/// How long to compute, from the times of sliders all over a source: 1.7 times their 95th
/// percentile, 10 s at least. Nine runs of masses ended within 1.6 times that percentile [s].
[[nodiscard]] double duration_for(std::vector<double> times);

}  // namespace talus
