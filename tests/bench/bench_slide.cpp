// The peers' slide (scene F): 39 blocks on 2,240 triangles, friction 25 degrees, COR 0.7, 20 s; and
// many blocks, copies of theirs side by side on a plane of 40 degrees.
// TALUS_PEERS_DIR=... [TALUS_BENCH_THREADS=n] bench_slide; counters: mean position s (down the
// slope) and x, the largest penetration, steps accepted unconverged, and the error of the energy
// balance over the fall.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>

#include "base/workers.hpp"
#include "run/law.hpp"
#include "slide_scene.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;

Vec3 mean_position(const Scene& scene, const State& state) {
  Vec3 sum = Vec3::Zero();
  double mass = 0;
  for (int b = 0; b < n_blocks(scene); ++b) {
    const double m = scene.blocks.mass[static_cast<std::size_t>(b)];
    sum += m * motion_at(scene, state, b, state.time).pose.position;
    mass += m;
  }
  return sum / mass;
}

double mechanical_energy(const Scene& scene, const State& state) {
  const Energies e = energies(scene, state);
  return e.translation + e.rotation + e.potential;
}

// Memory of the process that is in use [kB].
double resident_kb() {
  long pages = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  return static_cast<double>(resident * sysconf(_SC_PAGESIZE)) / 1024;
}

// Arguments: blocks, time step [1e-4 s], seed, duration [0.1 s].
void slide_by(benchmark::State& run, RunLaw law, bool masses = Settings{}.masses) {
  if (bench::peers_folder().empty()) return run.SkipWithError("TALUS_PEERS_DIR is not set");
  Settings settings;
  settings.masses = masses;
  if (law) settings.normal_stiffness = 5e10;
  settings.dt = 1e-4 * static_cast<double>(run.range(1));
  const double duration = 0.1 * static_cast<double>(run.range(3));
  const double before_kb = resident_kb();  // means something for the first scene of a process
  const Scene scene = slide_scene(bench::read_peers_slide(run.range(0)), settings,
                                  static_cast<std::uint64_t>(run.range(2)));
  for (auto _ : run) {
    Workers workers(bench::n_threads());
    Work work = make_work(scene, workers.n_threads() > 1 ? &workers : nullptr);
    State state = start_by(law, scene, work);
    const double before = mechanical_energy(scene, state);
    double deepest = 0, depth = 0, closed = 0;
    while (state.time < duration - settings.dt / 2) {
      const StepReport report = step_by(law, scene, state, work);
      deepest = std::max(deepest, report.largest_penetration);
      depth += report.sum_penetration;
      closed += report.n_closed;
    }
    const Vec3 end = mean_position(scene, state);
    const double lost = before - mechanical_energy(scene, state);
    const EnergyLedger& l = state.ledger;
    run.counters["s"] = 320 - end.y();
    run.counters["x"] = end.x();
    run.counters["deepest_m"] = deepest;
    run.counters["mean_m"] = depth / closed;
    run.counters["closed"] = closed / static_cast<double>(state.counters.steps);
    run.counters["passes"] = static_cast<double>(state.counters.passes);
    run.counters["impacts"] = static_cast<double>(state.counters.impacts);
    run.counters["substeps"] = static_cast<double>(state.counters.substeps);
    run.counters["kb_a_block"] = (resident_kb() - before_kb) / n_blocks(scene);
    run.counters["asleep"] =
        static_cast<double>(std::count(state.phase.begin(), state.phase.end(), Phase::asleep));
    run.counters["unconverged"] = static_cast<double>(state.counters.unconverged);
    run.counters["balance"] = (lost - l.friction - l.impact - l.contact - l.removed) / lost;
  }
}
// Blocks of a slide `n_copies` times side by side, on a plane that they touch.
Scene many_blocks(const SlideData& data, std::int64_t n_copies) {
  const cases::SlopeFrame frame = cases::slope_frame(40, -90);  // down y, as the slide
  double left = std::numeric_limits<double>::infinity(), right = -left, lowest = left;
  Vec3 foot = Vec3::Zero();
  for (const Body& body : data.bodies)
    for (const Vec3& v : body.parts.front().vertices) {
      left = std::min(left, v.x());
      right = std::max(right, v.x());
      if (frame.normal.dot(v) >= lowest) continue;
      lowest = frame.normal.dot(v);
      foot = v;
    }
  const double width = right - left + 1;  // [m]
  std::vector<Body> bodies;
  for (std::int64_t k = 0; k < n_copies; ++k) {
    const double aside = (static_cast<double>(k) - static_cast<double>(n_copies / 2)) * width;
    for (const Body& body : data.bodies)
      bodies.push_back(cases::body_of(
          cases::moved(body.parts.front(), Mat3::Identity(), Vec3::Zero(), Vec3(aside, 0, 0))));
  }
  const double reach = 400 + static_cast<double>(n_copies) * width / 2;
  return cases::scene_of(cases::plane_trn(frame, 5, reach, foot - 1e-3 * frame.normal),
                         cases::ground_of(25, 0.7), bodies, {}, {2500, 5e10, 0.25});
}

// Arguments: blocks of a copy, copies, duration [0.1 s].
void SlideMany(benchmark::State& run) {
  if (bench::peers_folder().empty()) return run.SkipWithError("TALUS_PEERS_DIR is not set");
  const double duration = 0.1 * static_cast<double>(run.range(2));
  const Scene scene = many_blocks(bench::read_peers_slide(run.range(0)), run.range(1));
  Workers workers(bench::n_threads());
  for (auto _ : run) {
    State state = start(scene);
    Work work = make_work(scene, workers.n_threads() > 1 ? &workers : nullptr);
    double deepest = 0;
    while (state.time < duration - scene.settings.dt / 2)
      deepest = std::max(deepest, step(scene, state, work).largest_penetration);
    run.counters["blocks"] = n_blocks(scene);
    run.counters["deepest_m"] = deepest;
    run.counters["passes"] = static_cast<double>(state.counters.passes);
    run.counters["unconverged"] = static_cast<double>(state.counters.unconverged);
    run.counters["kb_a_block"] = resident_kb() / n_blocks(scene);
  }
}

void Slide(benchmark::State& run) { slide_by(run, {}); }
void SlideExact(benchmark::State& run) { slide_by(run, {}, false); }
void SlideMass(benchmark::State& run) { slide_by(run, {}, true); }
void SlidePaper(benchmark::State& run) { slide_by(run, PaperLaw{}); }

BENCHMARK(Slide)
    ->Name("Slide39")
    ->ArgsProduct({{39}, {1, 10, 50, 100, 200, 300}, {0, 1, 2, 3, 4, 5, 6, 7, 8}, {200}})
    ->Unit(benchmark::kSecond)
    ->Iterations(1);
BENCHMARK(Slide)
    ->Name("SlideDense")
    ->ArgsProduct({{39, 390, 3900}, {10, 50, 100, 200, 300}, {0}, {1, 5, 10, 30, 100}})
    ->Unit(benchmark::kSecond)
    ->Iterations(1);
// By the exact step alone, and where many blocks move by the mass step.
BENCHMARK(SlideExact)
    ->ArgsProduct({{39, 390, 3900}, {10, 50, 100}, {0, 1, 2}, {5, 10, 20, 100, 200}})
    ->Unit(benchmark::kSecond)
    ->Iterations(1);
BENCHMARK(SlideMass)
    ->ArgsProduct({{39, 390, 3900}, {10, 50, 100}, {0, 1, 2}, {5, 10, 20, 100, 200}})
    ->Unit(benchmark::kSecond)
    ->Iterations(1);
BENCHMARK(SlideMany)
    ->ArgsProduct({{390, 3900}, {1, 5, 25}, {1, 2, 5, 10, 50}})
    ->Unit(benchmark::kSecond)
    ->Iterations(1);
BENCHMARK(SlidePaper)
    ->Name("Slide39Paper")
    ->ArgsProduct({{39}, {1, 2, 5, 10, 50}, {0, 1, 2}, {5, 200}})
    ->Unit(benchmark::kSecond)
    ->Iterations(1);

}  // namespace
