// One time step of all blocks: lone blocks, islands, masses, in order.
#include "step/step.hpp"

#include <algorithm>
#include <cmath>

#include "motion/displacement.hpp"
#include "motion/rotation.hpp"
#include "scene/yielding.hpp"
#include "solver/law_numbers.hpp"
#include "step/breakage.hpp"
#include "step/crushing.hpp"
#include "step/deep_blocks.hpp"
#include "step/flight.hpp"
#include "step/impact.hpp"
#include "step/island/step_island.hpp"
#include "step/island/untouched.hpp"
#include "step/loads.hpp"
#include "step/lone/step_talus.hpp"
#include "step/mass/step_mass.hpp"
#include "step/numerical_faults.hpp"
#include "step/settle.hpp"
#include "step/substep.hpp"

namespace talus {
namespace {

using std::size_t;

constexpr size_t expected_contacts = 16;  // of a block, before a buffer has to grow

// Whether block b shares its island with another block, or may touch a fixed body.
bool in_company(const State& state, const PairSearch& w, int b) {
  const auto i = static_cast<size_t>(b), k = static_cast<size_t>(w.groups.island_of[i]);
  return w.groups.block_begin[k + 1] - w.groups.block_begin[k] > 1 ||
         (w.near_fixed[i] != 0 && !does_not_move(state.phase[i]));
}

}  // namespace

State start_unsettled(const Scene& scene) {
  const auto n = static_cast<size_t>(n_blocks(scene));
  State state;
  static_cast<BlockLives&>(state) = start_lives(scene.blocks.rest);
  state.motion.resize(n);
  state.acceleration.assign(n, Vec3::Zero());
  state.spin_rate.assign(n, Vec3::Zero());
  state.support.assign(n, Vec3::Zero());
  state.memory.resize(n);
  state.deep.resize(n);
  const std::vector<GroundClass>& grounds = scene.ground.classes;
  if (std::any_of(grounds.begin(), grounds.end(), scars)) state.slid.resize(n);
  if (!scene.crush_load.empty()) state.load.resize(n);
  state.yielding = start_yielding(scene);
  state.bonds = start_bonds(scene);
  state.pressure.assign(scene.wet_faces.size(), 1);
  if (!scene.fragments.empty()) {
    state.hit_loss.assign(n, 0);
    state.n_hits.assign(n, 0);
  }
  if (scene.settings.strains) {
    state.strain.assign(n, Vec6::Zero());
    state.strain_rate.assign(n, Vec6::Zero());
  }
  for (size_t b = 0; b < n; ++b) {
    if (!is_released(scene, b)) keep_unborn(state, b);
    state.motion[b].pose = scene.blocks.rest[b];
    state.motion[b].velocity = scene.blocks.velocity[b];
    state.motion[b].angular_momentum = angular_momentum(
        scene.blocks.rest[b].attitude, scene.blocks.spin[b], scene.blocks.inertia[b]);
  }
  return state;
}

State start(const Scene& scene, Work& work) {
  State state = start_unsettled(scene);
  for (std::vector<ContactMemory>& memory : state.memory) memory.reserve(expected_contacts);
  if (!scene.settings.trn_contacts || !scene.settings.static_start) return state;
  for (int b = 0; b < n_blocks(scene); ++b) settle_block(scene, b, state, work);
  return state;
}

State start(const Scene& scene) {
  Work work = make_work(scene);
  return start(scene, work);
}

Work make_work(const Scene& scene, Workers* workers) {
  Work work;
  work.workers = work.search.workers = workers;
  work.island.solver.matrix.workers = work.island.hits.impact.workers = workers;
  size_t most_vertices = 0;
  for (int b = 0; b < n_blocks(scene); ++b)
    most_vertices = std::max(most_vertices, vertices_of(scene.blocks.shapes, b).size());
  work.world_vertices.reserve(most_vertices);
  work.near_ground.resize(n_blocks(scene));
  for (NearFeatures& near : work.near_ground) near.features.reserve(expected_contacts);
  work.deep = make_deep_work(scene);
  work.contacts.reserve(8 * (most_vertices + expected_contacts));
  work.rows.reserve(8 * (most_vertices + expected_contacts));
  work.unbonded.reserve(expected_contacts);
  reserve_impacts(work.contacts.capacity(), work.impact);
  work.segments.reserve(8 * static_cast<size_t>(n_blocks(scene)) + 64);
  return work;
}

namespace {

void advance_talus(const Scene& scene, State& state, Work& work, StepReport& report) {
  const double t_end = state.time + step_length(scene, state);
  const bool islands = (n_blocks(scene) > 1 && scene.settings.block_contacts) ||
                       n_fixed(scene) > 0 || !scene.forest.stems.empty();
  if (islands) {
    form_islands(scene, state, work);
    move_untouched(scene, t_end, state, work, report);
  }
  for (int b = 0; b < n_blocks(scene); ++b) {
    const auto i = static_cast<size_t>(b);
    if (islands && work.untouched.alone[i] != 0) continue;
    if (!islands || !in_company(state, work.search, b)) {
      advance_lone(scene, b, t_end, state, work, report);
      continue;
    }
    const int k = work.search.groups.island_of[i];
    if (work.search.groups.local_index[i] > 0) continue;
    advance_island(scene, k, t_end, state, work, report);
    if (may_sleep(scene)) put_island_to_sleep(scene, k, state, work);
  }
}

}  // namespace

void end_step(const Scene& scene, State& state, Work& work, StepReport& report) {
  state.time += step_length(scene, state);
  drain_faces(scene, state);
  break_blocks(scene, state, work);
  crush_blocks(scene, state);
  note_deep_blocks(scene, state, work.deep, report);
  note_numerical_faults(scene, report, state);
  ++state.counters.steps;
  state.counters.substeps += report.substeps;
  state.counters.impacts += report.n_impacts;
  state.counters.passes += report.passes;
  state.counters.unconverged += report.n_unconverged;
}

StepReport step(const Scene& scene, State& state, Work& work) {
  StepReport report;
  work.segments.clear();
  advance_talus(scene, state, work, report);
  end_step(scene, state, work, report);
  state.stride = next_stride(scene, state);
  return report;
}

Energies energies(const Scene& scene, const State& state) {
  Energies sum;
  for (int b = 0; b < n_blocks(scene); ++b) {
    const auto i = static_cast<size_t>(b);
    if (!exists(state.phase[i])) continue;
    Motion m = state.motion[i];  // a flight's spin energy does not change: no need to follow it
    const double flown = state.phase[i] == Phase::flight ? state.time - state.local_time[i] : 0;
    m.pose.position += flown * m.velocity + 0.5 * flown * flown * scene.gravity;
    m.velocity += flown * scene.gravity;
    const double mass = scene.blocks.mass[i];
    const Vec3 spin =
        angular_velocity(m.pose.attitude, m.angular_momentum, scene.blocks.inertia[i]);
    sum.translation += 0.5 * mass * m.velocity.squaredNorm();
    sum.rotation += 0.5 * spin.dot(m.angular_momentum);
    sum.potential -= mass * scene.gravity.dot(m.pose.position);
    if (!state.strain.empty())
      sum.elastic +=
          0.5 * scene.blocks.volume[i] *
          state.strain[i].dot(elastic_matrix(scene.blocks.young[i], scene.blocks.poisson[i]) *
                              state.strain[i]);
  }
  return sum;
}

}  // namespace talus
