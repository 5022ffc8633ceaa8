// CPU time of recording: passages and frames of the segments of a rock that tumbles down a rough
// slope, without the steps that made them. Medians, as ratios:
// --benchmark_repetitions=9 --benchmark_report_aggregates_only=true.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "base/random.hpp"
#include "record/frames.hpp"
#include "record/passages.hpp"
#include "step/step.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

/// Motion that the solver hands to the recorder in a run of one rock.
struct Track {
  Scene scene;
  Motion start;
  std::vector<Segment> segments;
};

Track tumbling_rock() {
  const SlopeFrame frame = slope_frame(35, 37);
  Trn trn = plane_trn(frame, 5, 300);
  Random random(1, "rough ground");
  for (double& z : trn.elevation) z += random.uniform(-0.4, 0.4);
  GroundClass ground;
  ground.friction = std::tan(32 * 3.14159265358979 / 180);
  ground.restitution = 0.35;
  Body rock;
  rock.parts = {box_in(frame, Vec3(0, 0, 2), Vec3(-0.6, -0.5, -0.4), Vec3(0.6, 0.5, 0.4))};
  Track track{scene_of(std::move(trn), ground, {rock}, Settings{}), {}, {}};
  State state = start(track.scene);
  track.start = state.motion[0];
  Work work = make_work(track.scene);
  while (state.time < 12 && state.counters.left_domain == 0) {
    step(track.scene, state, work);
    track.segments.insert(track.segments.end(), work.segments.begin(), work.segments.end());
  }
  return track;
}

// Argument: 0 footprint, 1 centroid alone.
void passages_of_a_run(benchmark::State& bench) {
  const Track track = tumbling_rock();
  const PassageGrid grid = passage_grid(track.scene.ground.trn, std::nan(""));
  SegmentMotion motion;
  std::size_t n_rows = 0;
  for (auto _ : bench) {
    PassageRecorder recorder = start_passages(track.scene, grid, bench.range(0) == 1);
    record_start(recorder, track.scene, 0, track.start, 0);
    for (const Segment& segment : track.segments) {
      motion.follow(segment, track.scene.blocks.inertia[0]);
      record_passages(recorder, track.scene, motion);
    }
    flush_passages(recorder);
    n_rows = recorder.table.rows.size();
  }
  const auto n_segments = static_cast<double>(track.segments.size());
  bench.counters["segments"] = n_segments;
  bench.counters["passages"] = static_cast<double>(n_rows);
  bench.counters["time_a_segment"] = benchmark::Counter(
      n_segments, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(passages_of_a_run)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

// Argument: frames a second.
void frames_of_a_run(benchmark::State& bench) {
  const Track track = tumbling_rock();
  SegmentMotion motion;
  const double interval = 1.0 / static_cast<double>(bench.range(0));
  for (auto _ : bench) {
    FrameSampler sampler = start_frames(track.scene, interval);
    record_start(sampler, track.scene, 0, track.start, Vec6::Zero());
    for (const Segment& segment : track.segments) {
      motion.follow(segment, track.scene.blocks.inertia[0]);
      record_frames(sampler, track.scene, motion, Vec6::Zero());
    }
    benchmark::DoNotOptimize(take_frames(sampler, track.segments.back().t_end));
  }
}
BENCHMARK(frames_of_a_run)->Arg(1)->Arg(25)->Unit(benchmark::kMicrosecond);

}  // namespace
