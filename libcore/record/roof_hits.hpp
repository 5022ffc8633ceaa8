// libcore/record/roof_hits.hpp: public
// How blocks hit the roofs of galleries: how often, and the hit that was hardest.
// in:    the solver's segments, in the order of time; lines of galleries with their roofs
// out:   one row per block and roof
//
// A hit is a change of the velocity normal to the roof by more than 0.5 m/s, gravity taken off, of
// a block that touches the roof: from one segment to the next, or in a single one. A triangle of
// the terrain is roof where all its corners are: the steps at its sides are walls.
#pragma once

#include <cstdint>
#include <vector>

#include "record/crossings.hpp"

namespace talus {

struct Scene;
struct State;

struct RoofHit {
  std::int32_t block = 0, line = 0;
  std::int32_t n_hits = 0;
  // of the hit with the most energy along the normal of the roof
  double time = 0;               ///< [s]
  double mass = 0, volume = 0;   ///< of the body that hit [kg], [m3]
  Vec3 position = Vec3::Zero();  ///< of the centroid, local [m]
  Vec3 velocity = Vec3::Zero();  ///< just before [m/s]
  double normal_speed = 0;       ///< ... its part into the roof [m/s]

  [[nodiscard]] double normal_energy() const { return 0.5 * mass * normal_speed * normal_speed; }
};

struct RoofRecorder {
  std::vector<RecordLine> lines;     ///< of the run; those with a roof count
  std::vector<RoofHit> rows;         ///< in the order of the first hit
  std::vector<std::int32_t> row_of;  ///< of block b and line l at [b * n_lines + l], -1 none
  std::vector<Segment> last;         ///< of the step, of each block that moved, before what follows
  std::vector<std::int32_t> last_of;  ///< index into `last`, -1 none                  (n_blocks)
};

/// Empty, and records nothing, where no line has a roof.
[[nodiscard]] RoofRecorder start_roofs(const Scene& scene, const std::vector<RecordLine>& lines);

/// The next segment of a block in a step.
void record_roofs(RoofRecorder& recorder, const Scene& scene, const Segment& segment);
/// The step has ended with `state`.
void close_step(RoofRecorder& recorder, const Scene& scene, const State& state);

/// Takes back the rows of a run in progress.
void restore(RoofRecorder& recorder, const std::vector<RoofHit>& rows);

/// Rows to be written, in the order of line, then block.
[[nodiscard]] std::vector<RoofHit> sorted(const RoofRecorder& recorder);

}  // namespace talus
