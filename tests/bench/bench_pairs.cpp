// tests/bench/bench_pairs.cpp
// Cost of contact detection between blocks: one pair apart, held, searched; and a whole step for
// the peers' scenes of 39, 390 and 3,900 blocks in place (blocks_*.obj in the folder named by the
// environment variable TALUS_PEERS_DIR).
#include <benchmark/benchmark.h>

#include <random>
#include <span>
#include <vector>

#include "contact/block_pairs.hpp"
#include "geometry/polyhedron.hpp"
#include "slide_scene.hpp"

namespace {

using namespace talus;

struct PairScene {
  Hulls hulls;
  std::vector<Pose> rest;
};

void add_block(PairScene& scene, const Polyhedron& block) {
  Pose pose;
  pose.position = moments(block).centroid;
  add_hulls(scene.hulls, std::span(&block, 1), pose.position, Mat3::Identity());
  scene.rest.push_back(pose);
}

// The peers' N blocks; none where TALUS_PEERS_DIR is not set.
PairScene read_scene(std::int64_t n) {
  PairScene scene;
  if (bench::peers_folder().empty()) return scene;
  for (const Body& body : bench::read_peers_slide(n).bodies) add_block(scene, body.parts.front());
  return scene;
}

// All slide down the 40 degree slope at 5 m/s, and each goes to and fro about that at jitter_m_s.
struct Walk {
  std::vector<Pose> poses;
  std::vector<Vec3> jitter, step;
  std::vector<double> turn;
  Vec3 slide;
};

Walk start_walk(const PairScene& scene, double dt, double jitter_m_s) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  Walk walk{scene.rest, {}, {}, {}, dt * Vec3(0, -3.83, -3.21)};
  for (std::size_t b = 0; b < scene.rest.size(); ++b)
    walk.jitter.push_back(dt * jitter_m_s * Vec3(normal(random), normal(random), normal(random)));
  walk.step.assign(scene.rest.size(), walk.slide);
  walk.turn.assign(scene.rest.size(), 0);
  return walk;
}

void walk_on(Walk& walk, bool forth) {
  for (std::size_t b = 0; b < walk.poses.size(); ++b) {
    walk.step[b] = walk.slide + (forth ? 1 : -1) * walk.jitter[b];
    walk.poses[b].position += walk.step[b];
  }
}

// One step: placing and pair contacts.
void step_of_scene(benchmark::State& bench, bool use_cache, double dt) {
  const PairScene scene = read_scene(bench.range(0));
  if (scene.rest.empty()) {
    bench.SkipWithError("no blocks: set TALUS_PEERS_DIR");
    return;
  }
  Walk walk = start_walk(scene, dt, 0.02);
  PlacedHulls placed;
  PairState state;
  PairWork work;
  PairSettings settings;
  settings.margin = 1e-3;
  settings.use_cache = use_cache;
  place_hulls(scene.hulls, walk.poses, {}, {}, placed);
  find_pair_contacts(scene.hulls, placed, {walk.step, walk.turn, {}, {}}, settings, state, work);
  int count = 0, listed = 0, searched = 0, clipped = 0;
  for (auto _ : bench) {
    walk_on(walk, count++ / 200 % 2 == 0);
    place_hulls(scene.hulls, walk.poses, {}, {}, placed);
    const PairReport report = find_pair_contacts(
        scene.hulls, placed, {walk.step, walk.turn, {}, {}}, settings, state, work);
    listed += report.relisted ? 1 : 0;
    searched += report.n_searched;
    clipped += report.n_clipped;
  }
  bench.counters["pairs"] = static_cast<double>(state.pairs.size());
  bench.counters["manifolds"] = static_cast<double>(work.manifolds.size());
  bench.counters["points"] = static_cast<double>(work.points.size());
  bench.counters["searched"] = static_cast<double>(searched) / count;
  bench.counters["clipped"] = static_cast<double>(clipped) / count;
  bench.counters["relisted"] = static_cast<double>(listed) / count;
}

void SceneStep(benchmark::State& bench) { step_of_scene(bench, true, 1e-3); }
void SceneStepSmall(benchmark::State& bench) { step_of_scene(bench, true, 1e-4); }
void SceneStepNoCache(benchmark::State& bench) { step_of_scene(bench, false, 1e-3); }
BENCHMARK(SceneStep)->Arg(39)->Arg(390)->Arg(3900)->Unit(benchmark::kMicrosecond);
BENCHMARK(SceneStepSmall)->Arg(39)->Unit(benchmark::kMicrosecond);
BENCHMARK(SceneStepNoCache)->Arg(39)->Arg(390)->Arg(3900)->Unit(benchmark::kMicrosecond);

void Place(benchmark::State& bench) {
  const PairScene scene = read_scene(bench.range(0));
  if (scene.rest.empty()) {
    bench.SkipWithError("no blocks: set TALUS_PEERS_DIR");
    return;
  }
  PlacedHulls placed;
  for (auto _ : bench) place_hulls(scene.hulls, scene.rest, {}, {}, placed);
}
BENCHMARK(Place)->Arg(39)->Arg(3900)->Unit(benchmark::kMicrosecond);

// The same scene at rest from the first step on: list and axes made from nothing.
void FirstStep(benchmark::State& bench) {
  const PairScene scene = read_scene(bench.range(0));
  if (scene.rest.empty()) {
    bench.SkipWithError("no blocks: set TALUS_PEERS_DIR");
    return;
  }
  PlacedHulls placed;
  PairWork work;
  PairSettings settings;
  settings.margin = 1e-3;
  place_hulls(scene.hulls, scene.rest, {}, {}, placed);
  for (auto _ : bench) {
    PairState state;
    benchmark::DoNotOptimize(find_pair_contacts(scene.hulls, placed, {}, settings, state, work));
  }
}
BENCHMARK(FirstStep)->Arg(39)->Arg(3900)->Unit(benchmark::kMicrosecond);

// Two cubes, one above the other and turned by 0.3 rad; `gap` between them.
PairScene two_cubes(double gap) {
  PairScene scene;
  add_block(scene, box(Vec3(-1, -1, -1), Vec3(1, 1, 1)));
  add_block(scene, box(Vec3(-1, -1, 1 + gap), Vec3(1, 1, 3 + gap)));
  scene.rest[1].attitude = Quat(Eigen::AngleAxisd(0.3, Vec3::UnitZ()));
  return scene;
}

// The part that is repeated for one pair: nothing but places, the features too, or the axis too.
enum class Repeat { places, features, axis };

void pair_cost(benchmark::State& bench, double gap, Repeat repeat) {
  const PairScene scene = two_cubes(gap);
  PlacedHulls placed;
  place_hulls(scene.hulls, scene.rest, {}, {}, placed);
  AxisScratch axis;
  ClipScratch clip;
  std::vector<PairManifold> manifolds;
  std::vector<PairPoint> points;
  std::vector<HeldPoint> held;
  AxisChoice choice = find_axis(scene.hulls, placed, 0, 1, 0.01, {}, axis);
  int incident = 0;
  for (auto _ : bench) {
    manifolds.clear();
    points.clear();
    if (repeat == Repeat::axis)
      choice = find_axis(scene.hulls, placed, 0, 1, 0.01, choice.axis, axis);
    if (!choice.touches) continue;
    if (repeat != Repeat::places || held.empty()) {
      held.clear();
      incident = incident_face(scene.hulls, placed, 1, -choice.normal);
      find_features(scene.hulls, placed, 0, 1, choice.axis, incident, false, clip, held);
    }
    add_manifold(scene.hulls, placed, 0, 1, choice.axis, incident,
                 axis_normal(scene.hulls, placed, 0, 1, choice.axis), 0, PointReach{0.01}, held,
                 manifolds, points);
    benchmark::DoNotOptimize(points.data());
  }
  bench.counters["points"] = static_cast<double>(points.size());
}
// Two balls of 60 random tangent planes, overlapping a little: faces, edges and vertices by the
// hundred, where a search over all of them is at its worst.
void BallsSearched(benchmark::State& bench) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  PairScene scene;
  for (const double x : {0.0, 1.98}) {
    Polyhedron ball = box(Vec3(-1, -1, -1), Vec3(1, 1, 1));
    for (int k = 0; k < 60; ++k)
      ball = clip_convex(
          ball, {Vec3(normal(random), normal(random), normal(random)).normalized(), 1}, 0, 1e-6);
    add_hulls(scene.hulls, std::span(&ball, 1), Vec3::Zero(), Mat3::Identity());
    scene.rest.push_back({Vec3(x, 0, 0), Quat::Identity()});
  }
  PlacedHulls placed;
  place_hulls(scene.hulls, scene.rest, {}, {}, placed);
  AxisScratch axis;
  for (auto _ : bench)
    benchmark::DoNotOptimize(find_axis(scene.hulls, placed, 0, 1, 0.01, {}, axis));
  bench.counters["faces"] = scene.hulls.n_faces[0];
  bench.counters["vertices"] = scene.hulls.vertex_begin[1];
}
BENCHMARK(BallsSearched);

void PairHeld(benchmark::State& bench) { pair_cost(bench, -1e-5, Repeat::places); }
void PairClipped(benchmark::State& bench) { pair_cost(bench, -1e-5, Repeat::features); }
void PairSearched(benchmark::State& bench) { pair_cost(bench, -1e-5, Repeat::axis); }
void PairSearchedApart(benchmark::State& bench) { pair_cost(bench, 0.1, Repeat::axis); }
BENCHMARK(PairHeld);
BENCHMARK(PairClipped);
BENCHMARK(PairSearched);
BENCHMARK(PairSearchedApart);

}  // namespace
