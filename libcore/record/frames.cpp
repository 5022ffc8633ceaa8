// Samples the states of all blocks at equal intervals of time.
#include "record/frames.hpp"

#include "motion/rotation.hpp"
#include "scene/scene.hpp"

namespace talus {
namespace {

FrameBlock frame_block(const Motion& motion, const Vec3& inertia, const Vec6& strain) {
  FrameBlock block;
  block.position = motion.pose.position;
  block.attitude = motion.pose.attitude;
  if (block.attitude.w() < 0) block.attitude.coeffs() = -block.attitude.coeffs();
  block.velocity = motion.velocity;
  block.spin = angular_velocity(motion.pose.attitude, motion.angular_momentum, inertia);
  block.strain = strain;
  return block;
}

double time_of(const FrameSampler& sampler, std::int64_t index) {
  return static_cast<double>(index) * sampler.interval;
}

Frame& frame_at(FrameSampler& sampler, std::int64_t index) {
  while (sampler.n_closed + static_cast<std::int64_t>(sampler.open.size()) <= index) {
    const std::int64_t made = sampler.n_closed + static_cast<std::int64_t>(sampler.open.size());
    sampler.open.push_back(
        {time_of(sampler, made), std::vector<FrameBlock>(sampler.latest.size())});
  }
  return sampler.open[index - sampler.n_closed];
}

}  // namespace

FrameSampler start_frames(const Scene& scene, double interval) {
  const auto n = static_cast<std::size_t>(n_blocks(scene));
  return {interval, {}, 0, std::vector<std::int64_t>(n, 0), std::vector<FrameBlock>(n)};
}

void record_start(FrameSampler& sampler, const Scene& scene, int block, const Motion& motion,
                  const Vec6& strain) {
  sampler.latest[block] = frame_block(motion, scene.blocks.inertia[block], strain);
}

void record_frames(FrameSampler& sampler, const Scene& scene, SegmentMotion& motion,
                   const Vec6& strain) {
  const Segment& segment = motion.segment();
  const int b = segment.block;
  const Vec3& inertia = scene.blocks.inertia[b];
  std::int64_t& next = sampler.next[b];
  for (; time_of(sampler, next) < segment.t_start; ++next)
    frame_at(sampler, next).blocks[b] = sampler.latest[b];
  for (double t; (t = time_of(sampler, next)) <= segment.t_end; ++next)
    frame_at(sampler, next).blocks[b] = frame_block(motion.at(t), inertia, strain);
  sampler.latest[b] = frame_block(segment.end, inertia, strain);
}

std::vector<Frame> take_frames(FrameSampler& sampler, double time) {
  std::vector<Frame> taken;
  while (time_of(sampler, sampler.n_closed) <= time) {
    Frame& frame = frame_at(sampler, sampler.n_closed);
    for (std::size_t b = 0; b < frame.blocks.size(); ++b) {
      if (sampler.next[b] > sampler.n_closed) continue;
      frame.blocks[b] = sampler.latest[b];
      ++sampler.next[b];
    }
    taken.push_back(std::move(frame));
    sampler.open.pop_front();
    ++sampler.n_closed;
  }
  return taken;
}

Frame last_frame(const FrameSampler& sampler, double time) { return {time, sampler.latest}; }

}  // namespace talus
