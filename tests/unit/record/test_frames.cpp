// Frames at equal intervals.
#include <gtest/gtest.h>

#include "hand_made.hpp"
#include "record/frames.hpp"
#include "record/motion.hpp"

namespace {

using namespace talus_test;
using talus::Frame;
using talus::FrameSampler;
using talus::Vec6;

const Vec6 no_strain = Vec6::Zero();

// Block 0 flies in one segment, block 1 slides in steps of 0.03 s, block 2 is at rest.
struct ThreeBlocks {
  Scene scene;
  std::vector<Segment> segments;
  std::vector<Motion> starts;
  ThreeBlocks() {
    scene.gravity = {0, 0, -9.81};
    for (int b = 0; b < 3; ++b) {
      add_box(scene, {1, 2, 3});
      Motion motion;
      motion.pose.position = {10.0 * b, 0, 0};
      motion.velocity = b == 2 ? Vec3::Zero() : Vec3(3, 1, 2);
      motion.angular_momentum = b == 2 ? Vec3::Zero() : Vec3(9000, 2000, -3000);
      starts.push_back(motion);
    }
    segments.push_back(flight(scene, 0, starts[0], 0, 1));
    Motion motion = starts[1];
    for (int i = 0; i < 34; ++i) {
      segments.push_back(slide(1, motion, 0.03 * i, 0.03 * (i + 1), {1, 0, 0}, {0, 0, 0.01}));
      motion = segments.back().end;
    }
  }
};

std::vector<Frame> frames_of(const ThreeBlocks& run, double interval, bool take_often) {
  FrameSampler sampler = talus::start_frames(run.scene, interval);
  for (int b = 0; b < 3; ++b) talus::record_start(sampler, run.scene, b, run.starts[b], no_strain);
  std::vector<Frame> frames;
  const auto take = [&](double time) {
    for (Frame& frame : talus::take_frames(sampler, time)) frames.push_back(std::move(frame));
  };
  for (const Segment& segment : run.segments) {
    talus::SegmentMotion motion;
    motion.follow(segment, run.scene.blocks.inertia[static_cast<std::size_t>(segment.block)]);
    talus::record_frames(sampler, run.scene, motion, no_strain);
    if (take_often && segment.block == 1) take(std::min(segment.t_end, 1.0));
  }
  take(1.0);
  return frames;
}

bool same_bits(const Frame& a, const Frame& b) {
  if (a.blocks.size() != b.blocks.size()) return false;
  for (std::size_t i = 0; i < a.blocks.size(); ++i)
    if (a.blocks[i].position != b.blocks[i].position ||
        a.blocks[i].attitude.coeffs() != b.blocks[i].attitude.coeffs() ||
        a.blocks[i].velocity != b.blocks[i].velocity || a.blocks[i].spin != b.blocks[i].spin)
      return false;
  return true;
}

TEST(Frames, StandAtMultiplesOfTheirInterval) {
  const ThreeBlocks run;
  const std::vector<Frame> frames = frames_of(run, 0.125, false);
  ASSERT_EQ(frames.size(), 9u);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const double t = 0.125 * static_cast<double>(k);
    EXPECT_EQ(frames[k].time, t);
    const Vec3 flown = t * Vec3(3, 1, 2) - 0.5 * t * t * Vec3(0, 0, 9.81);
    EXPECT_NEAR((frames[k].blocks[0].position - flown).norm(), 0, 1e-13);
    const Vec3 slid = Vec3(10, 0, 0) + t * Vec3(3, 1, 2) + 0.5 * t * t * Vec3(1, 0, 0);
    EXPECT_NEAR((frames[k].blocks[1].position - slid).norm(), 0, 1e-12);
    EXPECT_EQ(frames[k].blocks[2].position, Vec3(20, 0, 0));
  }
}

// A frame shows the same bits whatever other frames are cut, and whenever they are taken.
TEST(Frames, DoNotDependOnTheirInterval) {
  const ThreeBlocks run;
  const std::vector<Frame> coarse = frames_of(run, 0.25, false);
  const std::vector<Frame> fine = frames_of(run, 0.0625, false);
  const std::vector<Frame> often = frames_of(run, 0.0625, true);
  ASSERT_EQ(fine.size(), 17u);
  ASSERT_EQ(often.size(), fine.size());
  for (std::size_t k = 0; k < coarse.size(); ++k) EXPECT_TRUE(same_bits(coarse[k], fine[4 * k]));
  for (std::size_t k = 0; k < fine.size(); ++k) EXPECT_TRUE(same_bits(often[k], fine[k]));
}

TEST(Frames, KeepAngularMomentumInFlight) {
  const ThreeBlocks run;
  for (const Frame& frame : frames_of(run, 0.01, false)) {
    const talus::FrameBlock& block = frame.blocks[0];
    const Vec3 L = talus::angular_momentum(block.attitude, block.spin, run.scene.blocks.inertia[0]);
    EXPECT_NEAR((L - run.starts[0].angular_momentum).norm(), 0, 1e-9 * L.norm());
  }
}

}  // namespace
