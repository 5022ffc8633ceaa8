// A run from its start, or from a checkpoint, to its end: steps, health and record.
#include "run/runner.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"
#include "record/deep_rows.hpp"
#include "record/pieces.hpp"
#include "record/tree_hits.hpp"
#include "run/rocks.hpp"
#include "scene/worlds.hpp"
#include "store/checkpoint.hpp"

namespace talus {
namespace {

Vec6 strain_of(const State& state, int b) {
  return state.strain.empty() ? Vec6(Vec6::Zero()) : state.strain[b];
}

void record(Runner& runner, const Segment& segment) {
  const auto b = static_cast<std::size_t>(segment.block);
  runner.motion.follow(segment, runner.scene.blocks.inertia[b]);
  if (runner.options.passages) record_passages(runner.passages, runner.scene, runner.motion);
  record_crossings(runner.crossings, runner.scene, segment);
  record_objects(runner.objects, runner.scene, runner.motion);
  record_roofs(runner.roofs, runner.scene, segment);
  record_frames(runner.sampler, runner.scene, runner.motion,
                strain_of(runner.state, segment.block));
}

// A piece begins where its parent ends; its travel counts from where the block was released.
void record_breaks(Runner& runner, std::size_t first) {
  const State& state = runner.state;
  for (std::size_t i = first; i < state.breaks.size(); ++i) {
    const Break& broken = state.breaks[i];
    for (const int piece : {broken.first_piece, broken.first_piece + 1}) {
      const Motion& motion = state.motion[static_cast<std::size_t>(piece)];
      record_start(runner.sampler, runner.scene, piece, motion, strain_of(state, piece));
      if (!runner.options.passages) continue;
      record_start(runner.passages, runner.scene, piece, motion, broken.time);
      const PassageTracker& from = runner.passages.trackers[static_cast<std::size_t>(broken.block)];
      PassageTracker& to = runner.passages.trackers[static_cast<std::size_t>(piece)];
      to.start_z = from.start_z;
      to.path = from.path;
    }
    record_start(runner.sampler, runner.scene, broken.block,
                 state.motion[static_cast<std::size_t>(broken.block)],
                 strain_of(state, broken.block));
  }
}

// Debris lies still from now on.
void record_crushed(Runner& runner, std::size_t first) {
  const State& state = runner.state;
  for (std::size_t i = first; i < state.crushed.size(); ++i) {
    const int b = state.crushed[i].block;
    record_start(runner.sampler, runner.scene, b, state.motion[static_cast<std::size_t>(b)],
                 strain_of(state, b));
  }
}

void take(Runner& runner, double time) {
  for (const Frame& frame : take_frames(runner.sampler, time))
    append(runner.file.frames, frame, runner.options.strain);
}

// All blocks are recorded up to here: a flight is handed over when it ends.
double recorded_until(const State& state) {
  double time = state.time;
  for (std::size_t b = 0; b < state.phase.size(); ++b)
    if (state.phase[b] == Phase::flight) time = std::min(time, state.local_time[b]);
  return time;
}

double mechanical(const Energies& e) {
  return e.translation + e.rotation + e.potential + e.elastic;
}

void add_to_interval(HealthRow& row, const StepReport& report) {
  ++row.steps;
  row.substeps += report.substeps;
  row.passes += report.passes;
  row.flips += report.n_flips;
  row.impacts += report.n_impacts;
  row.unconverged += report.n_unconverged;
  for (std::size_t k = 0; k < row.cuts.size(); ++k) row.cuts[k] += report.cuts[k];
  row.fell_through += has(report.flags, StepFlag::fell_through) ? 1 : 0;
  row.not_finite += has(report.flags, StepFlag::not_finite) ? 1 : 0;
  row.largest_error = std::max(row.largest_error, report.largest_error);
  row.largest_penetration = std::max(row.largest_penetration, report.largest_penetration);
  if (report.shortest_dt > 0 && (row.shortest_dt == 0 || report.shortest_dt < row.shortest_dt))
    row.shortest_dt = report.shortest_dt;
}

void close_interval(Runner& runner) {
  HealthRow& row = runner.interval;
  const State& state = runner.state;
  const Energies e = energies(runner.scene, state);
  row.time = state.time;
  row.left_domain = state.counters.left_domain;
  row.translation = e.translation;
  row.rotation = e.rotation;
  row.potential = e.potential;
  row.elastic = e.elastic;
  row.friction = state.ledger.friction;
  row.impact = state.ledger.impact;
  row.contact = state.ledger.contact;
  row.base = state.ledger.base;
  row.fence = state.ledger.fence;
  row.rolling = state.ledger.rolling;
  row.drag = state.ledger.drag;
  row.breakage = state.ledger.breakage;
  row.removed = state.ledger.removed;
  row.water = state.ledger.water;
  runner.file.health.push_back(row);
  HealthRow next;
  next.fell_through = row.fell_through;
  next.not_finite = row.not_finite;
  row = next;
}

double half_step(const Runner& runner) { return 0.5 * runner.scene.settings.dt; }

bool falls_in_batches(const Runner& runner) {
  return fall_in_batches(runner.scene, runner.options);
}

// Whether nothing moves any more, and nothing will.
bool rests(const Runner& runner) {
  const State& state = runner.state;
  return !runner.law && !shakes(runner.scene.base) && runner.scene.crush_load.empty() &&
         state.stride == 1 &&
         std::all_of(state.phase.begin(), state.phase.end(),
                     [](Phase phase) { return does_not_move(phase); }) &&
         std::none_of(state.deep.begin(), state.deep.end(),
                      [](const DeepBlock& deep) { return deep.is_deep; });
}

// A step where nothing moves.
StepReport rest(Runner& runner) {
  runner.work.segments.clear();
  runner.state.time += runner.scene.settings.dt;
  ++runner.state.counters.steps;
  return {};
}

// Rocks that fall one by one are done batch after batch.
void sort_by_time(RunFile& file) {
  std::stable_sort(file.fence_hits.begin(), file.fence_hits.end(),
                   [](const FenceHit& a, const FenceHit& b) { return a.time < b.time; });
  std::stable_sort(
      file.tree_hits.begin(), file.tree_hits.end(),
      [](const TreeHitRow& a, const TreeHitRow& b) { return a.hit.time < b.hit.time; });
  std::stable_sort(file.crushed.begin(), file.crushed.end(),
                   [](const CrushedBlock& a, const CrushedBlock& b) { return a.time < b.time; });
}

// Energy input to the blocks by falling and otherwise, up to a row [J].
double turned_over(const Runner& runner, const HealthRow& row) {
  double weight = 0, potential_start = 0;
  const Blocks& blocks = runner.scene.blocks;
  for (std::size_t b = 0; b < static_cast<std::size_t>(runner.n_done); ++b) {
    if (!is_released(runner.scene, b)) continue;
    weight += blocks.mass[b] * runner.scene.gravity.norm();
    potential_start -= blocks.mass[b] * runner.scene.gravity.dot(blocks.rest[b].position);
  }
  const double kinetic_start = std::max(0.0, runner.energy_start - potential_start);
  // so that neither rounding at rest nor overlaps at the start that are pressed out are a gain
  const std::vector<double>& radius = blocks.shapes.radius;
  const double least_fall = 0.1 * *std::min_element(radius.begin(), radius.end());
  return std::max(std::abs(potential_start - row.potential) + kinetic_start + std::abs(row.base) +
                      std::abs(row.water),
                  least_fall * weight);
}

// Energy from nowhere up to a row, as a share of the energy input to the blocks.
double energy_gain(const Runner& runner, const HealthRow& row) {
  const double now = row.translation + row.rotation + row.potential + row.elastic;
  // Energy lost in friction and impacts was put in before. The ledger of law paper leaves
  // out the damping of its integrator.
  double known = now - runner.energy_start - row.base - row.water;
  if (!runner.law) known += std::max(0.0, spent_energy(row));
  return known / turned_over(runner, row);
}

// The smallest restitution of anything that may meet.
double least_restitution(const Scene& scene) {
  double least = 1;
  const auto meet = [&least](const std::vector<GroundClass>& classes) {
    for (const GroundClass& c : classes)
      least = std::min(least, restitution_falls(c) ? 0 : c.restitution);
  };
  meet(scene.ground.classes);
  meet(scene.joints.of_block);
  if (n_blocks(scene) > 1 && scene.joints.of_block.empty())
    least = std::min(least, scene.joint.restitution);
  meet(scene.fixed.classes);
  return least;
}

// Energy gone up to a row that neither friction nor hits, fences nor the edge of the terrain took;
// with full restitution not hits either.
double energy_loss(const Runner& runner, const HealthRow& row, double restitution) {
  const double now = row.translation + row.rotation + row.potential + row.elastic;
  double lost = runner.energy_start + row.base + row.water - now - row.friction - row.fence -
                row.rolling - row.drag - row.breakage - row.removed;
  if (restitution < 1) lost -= row.impact;
  return lost / turned_over(runner, row);
}

double unconverged_share(const Runner& runner) {
  const RunCounters& counters = runner.state.counters;
  return static_cast<double>(counters.unconverged) /
         static_cast<double>(std::max<std::int64_t>(1, counters.steps));
}

// The worst value in the rows of health, and its time.
struct Worst {
  double value = 0, time = 0;

  void meet(double other, double at) {
    if (other > value) value = other, time = at;
  }
  [[nodiscard]] std::string where() const {
    return value > 0 ? "most at " + text(time, 4) + " s, all blocks together" : "";
  }
};

struct WorstOfRows {
  double penetration = 0;
  Worst gain, loss;
};

constexpr double almost_full = 0.9;  // restitution from which a loss is watched too

void meet(const Runner& runner, const HealthRow& row, WorstOfRows& worst) {
  const double restitution = least_restitution(runner.scene);
  worst.penetration = std::max(worst.penetration, row.largest_penetration);
  worst.gain.meet(energy_gain(runner, row), row.time);
  if (restitution >= almost_full) worst.loss.meet(energy_loss(runner, row, restitution), row.time);
}

HealthCheck check(std::string name, double value, double limit, bool ends_run, std::string where) {
  return {std::move(name), value, limit, value <= limit, ends_run, std::move(where)};
}

// How many rocks the rows are of; pieces of one rock are one.
int count_rocks(const Scene& scene, std::span<const DeepRow> rows, bool only_that_matter) {
  std::vector<int> rocks;
  for (const DeepRow& row : rows)
    if (!only_that_matter || n_that_matter({&row, 1}) > 0)
      rocks.push_back(world_of(scene, row.block));
  return count_different(rocks);
}

void add_deep_checks(const Runner& runner, std::vector<HealthCheck>& checks) {
  const std::vector<DeepRow> deep =
      by_weight(deep_rows(runner.scene, runner.state, runner.crossings.rows));
  const std::string words =
      deep.empty() ? "" : deep_words(deep[0], runner.file.lines, runner.file.info.origin);
  const int n = n_that_matter(deep);
  const double most = runner.options.limits.max_deep_share;
  const std::string words_of_some = n > 0 ? words : "";
  if (shares_world(runner.scene)) {
    checks.push_back(check("mass of blocks in by more than a tenth of their thickness, share",
                           mass_share(deep), most, false, words));
    checks.push_back(check("such blocks in the toe, at a fence, or faster than by their fall", n, 0,
                           false, words_of_some));
    return;
  }
  // Of rocks that fall one by one each is a sample: one of them affects its share of every result.
  double n_rocks = 0;
  for (std::size_t b = 0; b < runner.scene.blocks.mass.size(); ++b)
    n_rocks += is_released(runner.scene, b);
  checks.push_back(check("rocks in by more than a tenth of their thickness, share",
                         count_rocks(runner.scene, deep, false) / n_rocks, most, false, words));
  checks.push_back(check("such rocks in the toe, at a fence, or faster than by their fall, share",
                         count_rocks(runner.scene, deep, true) / n_rocks, most, false,
                         words_of_some));
}

void add_penetration_check(const Runner& runner, double penetration,
                           std::vector<HealthCheck>& checks) {
  const NumericalFault& deepest = runner.state.numerical_faults.deepest;
  checks.push_back(
      check("largest penetration, m", penetration, runner.options.limits.max_penetration, true,
            deepest.block < 0 ? ""
                              : deep_words(deepest_row(runner.scene, deepest), runner.file.lines,
                                           runner.file.info.origin)));
}

std::vector<HealthCheck> checks_of(const Runner& runner, const WorstOfRows& worst,
                                   const HealthRow& row) {
  const RunLimits& limits = runner.options.limits;
  const NumericalFaults& numerical_faults = runner.state.numerical_faults;
  const auto first = [&runner](const NumericalFault& fault) {
    return fault_words(runner.scene, fault, runner.file.info.origin);
  };
  std::vector<HealthCheck> checks = {
      check("steps with a block that is not finite", static_cast<double>(row.not_finite), 0, true,
            first(numerical_faults.not_finite)),
      check("steps with a block below the ground", static_cast<double>(row.fell_through), 0, true,
            first(numerical_faults.fell_through)),
      check("energy gained, share of the fall energy", worst.gain.value, limits.max_energy_gain,
            true, worst.gain.where())};
  if (least_restitution(runner.scene) >= almost_full && !runner.law)
    checks.push_back(check("energy lost but by friction and hits, share of the fall energy",
                           worst.loss.value, limits.max_energy_gain, false, worst.loss.where()));
  checks.push_back(check("steps accepted unconverged, share", unconverged_share(runner),
                         limits.max_unconverged_share, false, first(numerical_faults.unconverged)));
  checks.push_back(check("mass of blocks that left the terrain, share",
                         lost_share(runner.scene, runner.state), limits.max_lost_share, false,
                         first(numerical_faults.left_domain)));
  if (std::isnan(limits.max_penetration))
    add_deep_checks(runner, checks);
  else
    add_penetration_check(runner, worst.penetration, checks);
  return checks;
}

Runner make_runner(const Scene& scene, const RunOptions& options, std::vector<RecordLine> lines,
                   RunFile file) {
  const bool in_batches = fall_in_batches(scene, options);
  RoofRecorder roofs = start_roofs(scene, lines);
  Runner runner{scene,
                options,
                law_of(options.paper),
                {},
                in_batches ? Work{} : make_work(scene, options.workers),
                {},
                start_crossings(scene, std::move(lines)),
                start_objects(scene, file.objects),
                std::move(roofs),
                start_frames(scene, options.frame_interval),
                {},
                {},
                0,
                std::move(file),
                {},
                in_batches ? 0 : n_blocks(scene)};
  if (options.passages)
    runner.passages.grid = passage_grid(scene.ground.trn, options.passage_cell_size);
  if (options.passages && !in_batches)
    runner.passages = start_passages(scene, runner.passages.grid, options.passages_by_centroid);
  runner.file.grid = runner.passages.grid;
  runner.file.passages_by_centroid = options.passages_by_centroid;
  runner.file.lines = runner.crossings.lines;
  runner.file.info.duration = options.duration;
  // a lone block moves alone in any case: it belongs to the runs that it was asked for with
  runner.file.info.independent = runner.file.info.independent || !shares_world(scene);
  return runner;
}

}  // namespace

Runner begin_run(const Scene& scene, const RunOptions& options, std::vector<RecordLine> lines,
                 RunFile file) {
  Runner runner = make_runner(scene, options, std::move(lines), std::move(file));
  const bool in_batches = falls_in_batches(runner);
  runner.state = in_batches ? start_unsettled(scene) : start_by(runner.law, scene, runner.work);
  if (!in_batches) runner.energy_start = mechanical(energies(scene, runner.state));
  for (int b = 0; b < n_blocks(scene); ++b) {
    const Motion& motion = runner.state.motion[b];
    if (options.passages && !in_batches && is_released(scene, static_cast<std::size_t>(b)))
      record_start(runner.passages, scene, b, motion, 0);
    record_start(runner.sampler, scene, b, motion, strain_of(runner.state, b));
  }
  return runner;
}

Runner resume_run(const Scene& scene, const RunOptions& options, std::vector<RecordLine> lines,
                  RunFile file, const std::string& path) {
  Runner runner = make_runner(scene, options, std::move(lines), std::move(file));
  const int n_cells = std::max(1, runner.passages.grid.n_rows * runner.passages.grid.n_cols);
  Checkpoint checkpoint = unpack(runner.file.checkpoint, n_blocks(scene), n_cells, path);
  if (checkpoint.state.pressure.size() != scene.wet_faces.size())
    throw InputError({path, 0, "checkpoint"}, "belongs to another scene",
                     "start the run again without --resume");
  runner.state = std::move(checkpoint.state);
  if (runner.law) runner.law->state = std::move(checkpoint.paper);
  runner.sampler = std::move(checkpoint.sampler);
  runner.interval = checkpoint.interval;
  runner.energy_start = checkpoint.energy_start;
  runner.n_done = checkpoint.n_done;
  runner.passages.trackers = std::move(checkpoint.trackers);
  if (!falls_in_batches(runner))
    for (const Passage& row : runner.file.passages) runner.passages.table.raise(row);
  const std::size_t n_lines = runner.crossings.lines.size();
  for (const Crossing& row : runner.file.crossings) {
    runner.crossings.row_of[static_cast<std::size_t>(row.block) * n_lines +
                            static_cast<std::size_t>(row.line)] =
        static_cast<std::int32_t>(runner.crossings.rows.size());
    runner.crossings.rows.push_back(row);
  }
  restore(runner.objects, runner.file.object_hits);
  restore(runner.roofs, runner.file.roof_hits);
  return runner;
}

namespace {

// A run of a few of the rocks of another one, to its end.
Runner ended_run(const Scene& scene, const Runner& of_all) {
  RunOptions options = of_all.options;
  options.workers = nullptr;
  RunFile file;
  file.objects = of_all.file.objects;
  Runner runner = begin_run(scene, options, of_all.crossings.lines, std::move(file));
  while (!is_over(runner)) advance(runner);
  finish(runner);
  update_file(runner, false);
  return runner;
}

}  // namespace

bool advance(Runner& runner) {
  if (falls_in_batches(runner)) {
    advance_rocks(runner, [&](const Scene& scene) { return ended_run(scene, runner); });
    return true;
  }
  const std::size_t n_crushed = runner.state.crushed.size(), n_breaks = runner.state.breaks.size();
  const double interval_end =
      static_cast<double>(runner.file.health.size() + 1) * runner.options.frame_interval;
  const double ahead = std::min(interval_end, runner.options.duration) - runner.state.time;
  if (ahead < 3 * half_step(runner)) runner.state.stride = 1;  // a long step would go past the end
  const StepReport report =
      rests(runner) ? rest(runner) : step_by(runner.law, runner.scene, runner.state, runner.work);
  for (const Segment& segment : runner.work.segments) record(runner, segment);
  close_step(runner.roofs, runner.scene, runner.state);
  record_breaks(runner, n_breaks);
  record_crushed(runner, n_crushed);
  add_to_interval(runner.interval, report);
  const double next_frame =
      static_cast<double>(runner.sampler.n_closed) * runner.options.frame_interval;
  if (next_frame <= runner.state.time) take(runner, recorded_until(runner.state));
  const bool is_end = runner.state.time >= interval_end - half_step(runner);
  if (is_end) close_interval(runner);
  return is_end;
}

bool is_over(const Runner& runner) {
  if (falls_in_batches(runner)) return runner.n_done == n_blocks(runner.scene);
  return runner.state.time >= runner.options.duration - half_step(runner);
}

double done_share(const Runner& runner) {
  if (falls_in_batches(runner)) return static_cast<double>(runner.n_done) / n_blocks(runner.scene);
  return std::min(1.0, runner.state.time / runner.options.duration);
}

bool stands(const Runner& runner) {
  const Scene& scene = runner.scene;
  const State& state = runner.state;
  if (runner.law || falls_in_batches(runner)) return false;
  if (state.time < standing_after_s - half_step(runner)) return false;
  if (shakes(scene.base)) return false;
  for (int b = 0; b < n_blocks(scene); ++b) {
    const auto i = static_cast<std::size_t>(b);
    if (state.phase[i] == Phase::unborn) continue;  // the whole block represents its fragments
    if (state.phase[i] != Phase::near_ground && state.phase[i] != Phase::asleep) return false;
    const Motion& motion = state.motion[i];
    const Vec3 moved = motion.pose.position - scene.blocks.rest[i].position;
    if (moved.norm() > standing_within_m || motion.velocity.norm() > standing_speed_m_s)
      return false;
  }
  return true;
}

void finish(Runner& runner) {
  if (falls_in_batches(runner)) return;
  const State& state = runner.state;
  for (int b = 0; b < n_blocks(runner.scene); ++b) {
    const auto i = static_cast<std::size_t>(b);
    if (state.phase[i] != Phase::flight || state.local_time[i] >= state.time) continue;
    Segment segment;
    segment.block = b;
    segment.flight = true;
    segment.t_start = state.local_time[i];
    segment.t_end = state.time;
    segment.start = state.motion[i];
    segment.end = motion_at(runner.scene, state, b, state.time);
    segment.acceleration = runner.scene.gravity;
    record(runner, segment);
  }
  if (runner.interval.steps > 0) close_interval(runner);
  // the time is a sum of steps: a frame due at the very end may lie above it by rounding
  take(runner, state.time + 1e-3 * runner.scene.settings.dt);
  const RunFrames& frames = runner.file.frames;
  if (frames.time.empty() || frames.time.back() < state.time - 1e-3 * runner.scene.settings.dt)
    append(runner.file.frames, last_frame(runner.sampler, state.time), runner.options.strain);
}

void update_file(Runner& runner, bool with_checkpoint) {
  RunFile& file = runner.file;
  const bool in_batches = falls_in_batches(runner);
  if (runner.options.passages && !in_batches) {
    flush_passages(runner.passages);
    file.passages = sorted(runner.passages.table);
  }
  file.crossings = sorted(runner.crossings);
  file.object_hits = sorted(runner.objects);
  file.roof_hits = sorted(runner.roofs);
  file.fence_hits = runner.state.fence.hits;
  file.panels = panel_rows(runner.scene, runner.state);
  file.tree_hits = tree_hit_rows(runner.scene, runner.state);
  file.deep = deep_rows(runner.scene, runner.state, runner.crossings.rows);
  file.breaks = runner.state.breaks;
  file.crushed = runner.state.crushed;
  if (in_batches) sort_by_time(file);
  file.info.time = runner.state.time;
  file.phase = runner.state.phase;
  file.checkpoint.clear();
  if (with_checkpoint)
    file.checkpoint =
        pack({runner.state, runner.law ? runner.law->state : PaperState{}, runner.passages.trackers,
              runner.sampler, runner.interval, runner.energy_start, runner.n_done});
}

std::vector<HealthCheck> health_checks(const Runner& runner) {
  WorstOfRows worst;
  for (const HealthRow& row : runner.file.health) meet(runner, row, worst);
  const HealthRow last = runner.file.health.empty() ? HealthRow{} : runner.file.health.back();
  return checks_of(runner, worst, last);
}

double lost_share(const Scene& scene, const State& state) {
  double lost = 0, all = 0;
  for (int b = 0; b < n_blocks(scene); ++b) {
    if (!exists(state.phase[b])) continue;
    all += scene.blocks.mass[b];
    if (state.phase[b] == Phase::left_domain) lost += scene.blocks.mass[b];
  }
  return all > 0 ? lost / all : 0;
}

bool has_failed(const Runner& runner) {
  if (runner.file.health.empty()) return false;
  const HealthRow& row = runner.file.health.back();
  WorstOfRows worst;
  meet(runner, row, worst);
  const std::vector<HealthCheck> checks = checks_of(runner, worst, row);
  return std::any_of(checks.begin(), checks.end(),
                     [](const HealthCheck& check) { return !check.pass && check.ends_run; });
}

RunBlocks run_blocks(const Scene& scene, const BlockSet& set) {
  RunBlocks blocks;
  blocks.mass = scene.blocks.mass;
  blocks.volume = scene.blocks.volume;
  blocks.inertia = scene.blocks.inertia;
  blocks.rest = scene.blocks.rest;
  blocks.vertex_begin = set.block_vertex_begin;
  blocks.face_vertices = set.face_vertices;
  blocks.face_begin = set.face_begin;
  blocks.block_face_begin = set.block_face_begin;
  for (const Fragment& fragment : scene.fragments) {
    blocks.parent.push_back(fragment.parent);
    blocks.generation.push_back(fragment.generation);
    blocks.weight.push_back(fragment.volume_share);
  }
  if (blocks.weight.empty())
    blocks.weight = set.weight;
  else
    for (std::size_t b = 0; b < blocks.weight.size() && !set.weight.empty(); ++b) {
      std::size_t released = b;
      while (blocks.parent[released] >= 0)
        released = static_cast<std::size_t>(blocks.parent[released]);
      blocks.weight[b] *= set.weight[released];
    }
  for (std::size_t b = 0; b < blocks.rest.size(); ++b) {
    const Pose& rest = blocks.rest[b];
    for (int v = set.block_vertex_begin[b]; v < set.block_vertex_begin[b + 1]; ++v)
      blocks.vertices.push_back(rest.attitude.conjugate() * (set.vertices[v] - rest.position));
  }
  return blocks;
}

}  // namespace talus
