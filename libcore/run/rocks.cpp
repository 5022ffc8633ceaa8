// Computes rocks that fall one by one, a few at a time, in threads.
#include "run/rocks.hpp"

#include <algorithm>
#include <memory>
#include <mutex>
#include <utility>

#include "run/batch_scene.hpp"
#include "scene/worlds.hpp"

namespace talus {
namespace {

using std::size_t;

constexpr int rocks_at_once = 1024;  // between two looks at the limits

/// Rocks [first, end), done.
struct Batch {
  int first = 0, end = 0;
  bool is_done = false;
  State state;
  RunFile file;
  double energy_start = 0;  ///< [J]
};

// A last rock goes with those before it: alone in its scene it would share a world (worlds.hpp).
std::vector<Batch> next_batches(int n_done, int n_rocks) {
  const int end = std::min(n_rocks, (n_done / rocks_at_once + 1) * rocks_at_once);
  std::vector<Batch> batches;
  for (int first = n_done; first < end; first = batches.back().end) {
    Batch& batch = batches.emplace_back();
    batch.first = first;
    batch.end = std::min(n_rocks, first + rocks_at_a_time);
    if (n_rocks - batch.end == 1) batch.end = n_rocks;
  }
  return batches;
}

/// Scenes that threads fill with the rocks of one batch after the other.
class ScenePool {
 public:
  explicit ScenePool(const Scene& scene) : scene_(scene) {}
  std::unique_ptr<Scene> take() {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) return std::make_unique<Scene>(without_rocks(scene_));
    std::unique_ptr<Scene> scene = std::move(free_.back());
    free_.pop_back();
    return scene;
  }
  void give_back(std::unique_ptr<Scene> scene) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(scene));
  }

 private:
  const Scene& scene_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Scene>> free_;
};

void add(const HealthRow& row, HealthRow& sum) {
  for (const auto count : {&HealthRow::substeps, &HealthRow::passes, &HealthRow::flips,
                           &HealthRow::impacts, &HealthRow::unconverged, &HealthRow::left_domain,
                           &HealthRow::fell_through, &HealthRow::not_finite})
    sum.*count += row.*count;
  for (size_t k = 0; k < sum.cuts.size(); ++k) sum.cuts[k] += row.cuts[k];
  for (const auto energy :
       {&HealthRow::translation, &HealthRow::rotation, &HealthRow::potential, &HealthRow::elastic,
        &HealthRow::friction, &HealthRow::impact, &HealthRow::contact, &HealthRow::base,
        &HealthRow::fence, &HealthRow::rolling, &HealthRow::drag, &HealthRow::breakage,
        &HealthRow::removed, &HealthRow::water})
    sum.*energy += row.*energy;
  sum.largest_error = std::max(sum.largest_error, row.largest_error);
  sum.largest_penetration = std::max(sum.largest_penetration, row.largest_penetration);
  if (row.shortest_dt > 0 && !(sum.shortest_dt > 0 && sum.shortest_dt < row.shortest_dt))
    sum.shortest_dt = row.shortest_dt;
}

void add_health(const std::vector<HealthRow>& rows, std::vector<HealthRow>& sum) {
  if (sum.empty()) {
    sum = rows;
    return;
  }
  TALUS_ASSERT(sum.size() == rows.size());
  for (size_t i = 0; i < rows.size(); ++i) add(rows[i], sum[i]);
}

void add(const RunCounters& counters, RunCounters& sum) {
  sum.steps = counters.steps;
  for (const auto count :
       {&RunCounters::substeps, &RunCounters::flight_skips, &RunCounters::impacts,
        &RunCounters::passes, &RunCounters::unconverged, &RunCounters::cut_back})
    sum.*count += counters.*count;
  sum.left_domain += counters.left_domain;
}

void take_earlier(NumericalFault other, int first, NumericalFault& fault) {
  if (other.block < 0 || (fault.block >= 0 && fault.time <= other.time)) return;
  other.block += first;
  fault = other;
}

void add(const NumericalFaults& numerical_faults, int first, NumericalFaults& sum) {
  for (const auto fault : {&NumericalFaults::unconverged, &NumericalFaults::not_finite,
                           &NumericalFaults::left_domain, &NumericalFaults::fell_through})
    take_earlier(numerical_faults.*fault, first, sum.*fault);
  if (numerical_faults.deepest.block < 0 || numerical_faults.deepest.depth <= sum.deepest.depth)
    return;
  sum.deepest = numerical_faults.deepest;
  sum.deepest.block += first;
}

template <class Hit>
void add_hits(const std::vector<Hit>& from, int first, int n_rocks, std::vector<Hit>& hits,
              HitChain& chain) {
  for (Hit hit : from) {
    hit.block += first;
    add_hit(hit, n_rocks, hits, chain);
  }
}

// Data of the rocks of a batch for reports and limits.
void add_state(Batch& batch, int n_rocks, State& state) {
  State& from = batch.state;
  const auto put = [&batch](auto& of_batch, auto& of_all) {
    std::move(of_batch.begin(), of_batch.end(), of_all.begin() + batch.first);
  };
  put(from.phase, state.phase);
  put(from.local_time, state.local_time);
  put(from.motion, state.motion);
  put(from.deep, state.deep);
  if (!from.yielding.worlds.empty()) {
    for (std::vector<MetBody>& world : from.yielding.worlds)
      for (MetBody& of : world)
        if (of.met.broken_by >= 0) of.met.broken_by += batch.first;
    put(from.yielding.worlds, state.yielding.worlds);
  }
  add_hits(from.fence.hits, batch.first, n_rocks, state.fence.hits, state.fence.chain);
  add_hits(from.stem_hits, batch.first, n_rocks, state.stem_hits, state.stem_chain);
  for (CrushedBlock crushed : from.crushed) {
    crushed.block += batch.first;
    state.crushed.push_back(crushed);
  }
  for (const auto energy :
       {&EnergyLedger::friction, &EnergyLedger::impact, &EnergyLedger::contact, &EnergyLedger::base,
        &EnergyLedger::fence, &EnergyLedger::rolling, &EnergyLedger::drag, &EnergyLedger::breakage,
        &EnergyLedger::removed, &EnergyLedger::water})
    state.ledger.*energy += from.ledger.*energy;
  add(from.counters, state.counters);
  add(from.numerical_faults, batch.first, state.numerical_faults);
  state.time = from.time;
}

template <class Row>
void add_rows(const std::vector<Row>& from, int first, std::vector<Row>& rows) {
  for (Row row : from) {
    row.block += first;
    rows.push_back(row);
  }
}

// Into the columns of its rocks; those that are not done are at their start.
void add_frames(const Batch& batch, Runner& runner) {
  RunFrames& frames = runner.file.frames;
  const RunFrames& from = batch.file.frames;
  if (frames.time.empty())
    for (const double time : from.time)
      append(frames, last_frame(runner.sampler, time), runner.options.strain);
  TALUS_ASSERT(frames.time.size() == from.time.size());
  const auto n = static_cast<size_t>(batch.end - batch.first);
  const auto put = [&](const auto& of_batch, auto& of_all, size_t columns) {
    if (of_all.empty()) return;
    for (size_t k = 0; k < from.time.size(); ++k)
      std::copy_n(of_batch.data() + k * n * columns, n * columns,
                  of_all.data() + columns * (k * static_cast<size_t>(n_blocks(runner.scene)) +
                                             static_cast<size_t>(batch.first)));
  };
  put(from.position, frames.position, 3);
  put(from.attitude, frames.attitude, 4);
  put(from.velocity, frames.velocity, 3);
  put(from.spin, frames.spin, 3);
  put(from.strain, frames.strain, 6);
}

// Rows that are more than memory should hold go to a file.
void keep_few_passages(Runner& runner) {
  std::vector<Passage>& rows = runner.file.passages;
  if (runner.options.folder.empty() || rows.size() <= runner.options.passages_in_memory) return;
  if (!runner.earlier) runner.earlier = std::make_shared<PassageRows>(runner.options.folder);
  runner.earlier->append(rows);
  rows.clear();
}

void add(Batch& batch, Runner& runner) {
  add_state(batch, n_blocks(runner.scene), runner.state);
  add_frames(batch, runner);
  add_rows(batch.file.passages, batch.first, runner.file.passages);
  keep_few_passages(runner);
  add_rows(batch.file.crossings, batch.first, runner.crossings.rows);
  add_rows(batch.file.object_hits, batch.first, runner.objects.rows);
  add_rows(batch.file.roof_hits, batch.first, runner.roofs.rows);
  add_health(batch.file.health, runner.file.health);
  runner.energy_start += batch.energy_start;
  runner.n_done = batch.end;
}

}  // namespace

bool fall_in_batches(const Scene& scene, const RunOptions& options) {
  return fall_a_few_at_a_time(scene, n_blocks(scene)) && !options.paper;
}

void advance_rocks(Runner& runner, const std::function<Runner(const Scene&)>& fall) {
  std::vector<Batch> batches = next_batches(runner.n_done, n_blocks(runner.scene));
  ScenePool pool(runner.scene);
  const auto compute = [&](std::uint32_t i) {
    if (runner.options.is_stopped && runner.options.is_stopped()) return;
    std::unique_ptr<Scene> scene = pool.take();
    take_rocks(runner.scene, runner.options.surfaces, batches[i].first, batches[i].end, *scene);
    Runner done = fall(*scene);
    batches[i].state = std::move(done.state);
    batches[i].file = std::move(done.file);
    batches[i].energy_start = done.energy_start;
    batches[i].is_done = true;
    pool.give_back(std::move(scene));
  };
  const auto n = static_cast<std::uint32_t>(batches.size());
  if (runner.options.workers != nullptr)
    runner.options.workers->run(n, compute);
  else
    for (std::uint32_t i = 0; i < n; ++i) compute(i);
  for (Batch& batch : batches) {
    if (!batch.is_done) break;
    add(batch, runner);
    batch = {};
  }
}

}  // namespace talus
