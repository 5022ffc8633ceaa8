// libcore/contact/scales.hpp: public
// Scales that many rules of the contact geometry share.
#pragma once

namespace talus {

/// [size of the body, thickness, skin; rad] Less than this is nothing: lengths, bare parts of a
/// face, distances from a side; edges that open by less are flat.
inline constexpr double negligible = 1e-6;
/// [size of the body; cosine; of a time, speed or capacity] Less than this is rounding.
inline constexpr double rounding = 1e-9;
/// [cosine; m; of the sum's terms] Less than this is in the last figures of doubles.
inline constexpr double last_figures = 1e-12;
/// [separation, overlap] Features that differ by less than this part of it are as good as each
/// other.
inline constexpr double hardly_better = 0.1;
/// [thickness; width of a seam] Another axis must be better by so much; features outlast such a
/// motion.
inline constexpr double feature_slack = 1e-3;
/// [thickness, radius] The same for axes of one direction, and of pairs that pass each other in a
/// mass; the longest motion that an axis outlasts.
inline constexpr double axis_slack = 2e-2;
/// [radius] Motion that a list of near features is to outlast.
inline constexpr double largest_skin = 0.1;

}  // namespace talus
