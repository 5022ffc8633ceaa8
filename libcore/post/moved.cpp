// Share of the released mass that moved, and percentiles of its displacement.
#include "post/moved.hpp"

#include "base/grouped_text.hpp"
#include "base/numbers.hpp"
#include "base/text.hpp"
#include "base/words.hpp"
#include "post/deposit.hpp"

namespace talus {
Moved moved_of(std::vector<WeightedValue> displacement_and_mass, bool of_rocks) {
  sort_values(displacement_and_mass);
  Moved out;
  out.of_rocks = of_rocks;
  double moved = 0, far = 0;
  for (const auto& [displacement, mass] : displacement_and_mass) {
    out.mass += mass;
    if (displacement > moved_m) moved += mass;
    if (displacement > moved_far_m) far += mass;
  }
  if (!(out.mass > 0)) return {0, of_rocks, no_value, no_value, no_value, no_value, no_value, 0};
  const auto percentile = [&](double p) { return weighted_percentile(displacement_and_mass, p); };
  out.share = moved / out.mass;
  out.share_far = far / out.mass;
  out.p50 = percentile(0.5);
  out.p90 = percentile(0.9);
  out.p95 = percentile(0.95);
  out.largest = displacement_and_mass.back().value;
  return out;
}

Moved moved_of_run(const RunFile& run) {
  return moved_of(displacements(run), run.info.independent);
}

std::vector<double> counted_by(const RunFile& run) {
  return run.info.independent ? std::vector<double>(run.blocks.mass.size(), 1) : run.blocks.mass;
}

std::vector<WeightedValue> displacements(const RunFile& run) {
  const std::vector<double> counted = counted_by(run);
  std::vector<WeightedValue> out;
  for (int block = 0; block < n_blocks(run); ++block)
    out.push_back({(last_pose(run, block).position - first_pose(run, block).position).norm(),
                   counted[block]});
  return out;
}

std::string text(const Moved& moved) {
  return percent(moved.share) + " of the " + (moved.of_rocks ? "rocks" : "mass") +
         " moved more than " + text(moved_m) + " m, " + percent(moved.share_far) + " more than " +
         text(moved_far_m) + " m; displacement by " + (moved.of_rocks ? "rock" : "mass") +
         ": p50 " + grouped_text(moved.p50, 3) + " m, p90 " + grouped_text(moved.p90, 3) +
         " m, p95 " + grouped_text(moved.p95, 3) + " m";
}

std::string standing_mass_warning(const Moved& moved) {
  if (!(moved.share < least_moved)) return "";
  if (!moved.any()) return "no block moved more than " + text(moved_m) + " m: there is no run-out";
  if (moved.of_rocks) return "";  // that stay are counted as such
  return "only " + percent(moved.share) + " of the mass moved more than " + text(moved_m) +
         " m: L and the angle of reach are those of few blocks, not of the released volume; see "
         "whether the failure surface comes out at the foot of the source";
}

}  // namespace talus
