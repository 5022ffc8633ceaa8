// tests/bench/bench_pairs.cpp
// Cost of contact detection between blocks: one pair apart, held, searched; and a whole step for
// the peers' scenes of 39, 390 and 3,900 blocks in place (blocks_*.obj in the folder named by the
// environment variable TALUS_PEERS_DIR, else ../shared/peers beside the working folder).
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <numeric>
#include <random>
#include <sstream>
#include <string>

#include "contact/block_pairs.hpp"
#include "geometry/polyhedron.hpp"

namespace {

using namespace talus;

struct Scene {
  Hulls hulls;
  std::vector<Pose> rest;
};

void add_block(Scene& scene, const Polyhedron& block) {
  Pose pose;
  pose.position = moments(block).centroid;
  add_hulls(scene.hulls, std::span(&block, 1), pose.position, Mat3::Identity());
  scene.rest.push_back(pose);
}

// Blocks of an OBJ file, one `o` each.
Scene read_blocks(const std::string& path) {
  Scene scene;
  std::ifstream file(path);
  std::vector<Vec3> vertices;
  Polyhedron block;
  std::map<int, int> local;
  const auto finish = [&] {
    if (n_faces(block) > 0) add_block(scene, block);
    block = {};
    local.clear();
  };
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "o") finish();
    if (key == "v") {
      Vec3 v;
      words >> v.x() >> v.y() >> v.z();
      vertices.push_back(v);
    }
    if (key != "f") continue;
    std::vector<int> loop;
    for (int i; words >> i;) {
      const auto [entry, is_new] = local.try_emplace(i, static_cast<int>(block.vertices.size()));
      if (is_new) block.vertices.push_back(vertices[i - 1]);
      loop.push_back(entry->second);
    }
    add_face(block, loop, 0);
  }
  finish();
  return scene;
}

std::string peers_folder() {
  const char* folder = std::getenv("TALUS_PEERS_DIR");
  return folder != nullptr ? folder : "../shared/peers";
}

// Motion of a step: all slide down the 40 degree slope at 5 m/s, and each jitters on its own.
struct Walk {
  std::vector<Pose> poses;
  std::vector<Vec3> step;
  std::vector<double> turn;
};

Walk start_walk(const Scene& scene, double dt, double jitter_m_s) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  Walk walk{scene.rest, {}, {}};
  for (const Pose& pose : scene.rest) {
    walk.step.push_back(dt * (Vec3(0, -3.83, -3.21) +
                              jitter_m_s * Vec3(normal(random), normal(random), normal(random))));
    walk.turn.push_back(0);
    static_cast<void>(pose);
  }
  return walk;
}

void walk_on(Walk& walk) {
  for (std::size_t b = 0; b < walk.poses.size(); ++b) walk.poses[b].position += walk.step[b];
}

void walk_back(const Scene& scene, Walk& walk) { walk.poses = scene.rest; }

// One step of placing and pair contacts. args: number of blocks, 1 = with caches.
void step_of_scene(benchmark::State& bench, bool use_cache, bool place) {
  const Scene scene =
      read_blocks(peers_folder() + "/blocks_" + std::to_string(bench.range(0)) + ".obj");
  if (scene.rest.empty()) {
    bench.SkipWithError("no blocks: set TALUS_PEERS_DIR");
    return;
  }
  const double dt = 1e-3;
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
    if (++count % 200 == 0) walk_back(scene, walk);
    walk_on(walk);
    if (!place) bench.PauseTiming();
    place_hulls(scene.hulls, walk.poses, {}, {}, placed);
    if (!place) bench.ResumeTiming();
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

void SceneStep(benchmark::State& bench) { step_of_scene(bench, true, true); }
void SceneStepNoCache(benchmark::State& bench) { step_of_scene(bench, false, true); }
BENCHMARK(SceneStep)->Arg(39)->Arg(390)->Arg(3900)->Unit(benchmark::kMicrosecond);
BENCHMARK(SceneStepNoCache)->Arg(39)->Arg(390)->Arg(3900)->Unit(benchmark::kMicrosecond);

void Place(benchmark::State& bench) {
  const Scene scene =
      read_blocks(peers_folder() + "/blocks_" + std::to_string(bench.range(0)) + ".obj");
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
  const Scene scene =
      read_blocks(peers_folder() + "/blocks_" + std::to_string(bench.range(0)) + ".obj");
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
Scene two_cubes(double gap) {
  Scene scene;
  add_block(scene, box(Vec3(-1, -1, -1), Vec3(1, 1, 1)));
  add_block(scene, box(Vec3(-1, -1, 1 + gap), Vec3(1, 1, 3 + gap)));
  scene.rest[1].attitude = Quat(Eigen::AngleAxisd(0.3, Vec3::UnitZ()));
  return scene;
}

// What is repeated for one pair: nothing but places, the features too, or the axis too.
enum class Repeat { places, features, axis };

void pair_cost(benchmark::State& bench, double gap, Repeat repeat) {
  const Scene scene = two_cubes(gap);
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
    if (choice.axis.kind == AxisKind::none) continue;
    if (repeat != Repeat::places || held.empty()) {
      held.clear();
      incident = incident_face(scene.hulls, placed, 1, -choice.normal);
      find_features(scene.hulls, placed, 0, 1, choice.axis, incident, false, clip, held);
    }
    add_manifold(scene.hulls, placed, 0, 1, choice.axis, incident,
                 axis_normal(scene.hulls, placed, 0, 1, choice.axis), 0, 0.01, held, manifolds,
                 points);
    benchmark::DoNotOptimize(points.data());
  }
  bench.counters["points"] = static_cast<double>(points.size());
}
void PairHeld(benchmark::State& bench) { pair_cost(bench, -1e-5, Repeat::places); }
void PairClipped(benchmark::State& bench) { pair_cost(bench, -1e-5, Repeat::features); }
void PairSearched(benchmark::State& bench) { pair_cost(bench, -1e-5, Repeat::axis); }
void PairSearchedApart(benchmark::State& bench) { pair_cost(bench, 0.1, Repeat::axis); }
BENCHMARK(PairHeld);
BENCHMARK(PairClipped);
BENCHMARK(PairSearched);
BENCHMARK(PairSearchedApart);

}  // namespace
