// libcore/record/frames.hpp: public
// States of all blocks at equal intervals of time, cut out of the solver's segments.
// in:    segments, in the order of time for each block
// out:   frames; they change nothing in the run, whatever their interval
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "record/motion.hpp"

namespace talus {

struct Scene;

/// One block in one frame.
struct FrameBlock {
  Vec3 position = Vec3::Zero();      ///< of the centroid, local [m]
  Quat attitude = Quat::Identity();  ///< body to local axes, w >= 0
  Vec3 velocity = Vec3::Zero();      ///< [m/s]
  Vec3 spin = Vec3::Zero();          ///< local axes [rad/s]
  Vec6 strain = Vec6::Zero();        ///< body axes, of the step's end [-]
};

struct Frame {
  double time = 0;                 ///< [s]
  std::vector<FrameBlock> blocks;  ///<                                              (n_blocks)
};

/// Frame k is at time k * interval, and the last one at the end of the run.
struct FrameSampler {
  double interval = 0;             ///< > 0 [s]
  std::deque<Frame> open;          ///< frames that some block has not reached yet, oldest first
  std::int64_t n_closed = 0;       ///< frames taken so far: index of open.front()
  std::vector<std::int64_t> next;  ///< first frame that block b has not reached     (n_blocks)
  std::vector<FrameBlock> latest;  ///< of block b                                   (n_blocks)
};

[[nodiscard]] FrameSampler start_frames(const Scene& scene, double interval);

/// The place and motion of a block at `time`: at the start, and for blocks that get no segments.
void record_start(FrameSampler& sampler, const Scene& scene, int block, const Motion& motion,
                  const Vec6& strain);
/// The next segment of a block, which `motion` follows; `strain` is that at its end (zero for rigid
/// blocks).
void record_frames(FrameSampler& sampler, const Scene& scene, SegmentMotion& motion,
                   const Vec6& strain);

/// The frames with a time below or at `time`, to which all blocks have come: those without a
/// segment up to there have been at rest.
[[nodiscard]] std::vector<Frame> take_frames(FrameSampler& sampler, double time);
/// The blocks as they are now, as a frame at `time`.
[[nodiscard]] Frame last_frame(const FrameSampler& sampler, double time);

}  // namespace talus
