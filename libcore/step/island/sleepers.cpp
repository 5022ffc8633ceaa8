// Which blocks of an island sleep. A sleeping block counts as fixed, for as long as its neighbours
// press it as they did when it fell asleep. A substep that needs it awake is made again.
#include <algorithm>
#include <utility>

#include "scene/sleep.hpp"
#include "solver/law_numbers.hpp"
#include "step/island/stages.hpp"
#include "step/island/step_island.hpp"
#include "step/mass/stages.hpp"
#include "step/substep.hpp"

namespace talus {
namespace {

using std::size_t;

bool sleeps(const State& state, int b) { return phase_of(state, b) == Phase::asleep; }

bool has_rested(const State& state, int b) {
  return state.rest_steps[b] >= law::steps_before_sleep;
}

Vec6 load_of(const Vec3& force, const Vec3& arm) {
  Vec6 load;
  load << force, arm.cross(force);
  return load;
}

// Whether a load accelerates points of block b, did nothing else hold it, by more than forces are
// found to.
bool moves_block(const Scene& scene, const State& state, int b, const Vec6& load) {
  const auto i = static_cast<size_t>(b);
  const Vec3 couple = state.motion[i].pose.attitude.conjugate() * load.tail<3>(),
             spin_rate = couple.cwiseQuotient(scene.blocks.inertia[i]);
  return load.head<3>().norm() / scene.blocks.mass[i] +
             scene.blocks.shapes.radius[i] * spin_rate.norm() >
         law::least_speed * scene.gravity.norm();
}

// Appends the load of a row, to the pair of the last one where that is the same.
void add_press(int a, int b, const Vec6& on_a, const Vec6& on_b, std::vector<PairPress>& presses) {
  if (presses.empty() || presses.back().a != a || presses.back().b != b)
    presses.push_back({a, b, Vec6::Zero(), Vec6::Zero()});
  presses.back().on_a += on_a;
  presses.back().on_b += on_b;
}

// Of the blocks that have stayed in place, those that fall asleep: something supports them, and the
// blocks that they press or are bonded to have stayed in place, too.
void find_sleepers(const State& state, std::span<const PairPress> presses, SleepScratch& scratch) {
  std::vector<int>&sleepers = scratch.sleepers, &pressed = scratch.pressed,
  &beside_motion = scratch.beside_motion;
  pressed.clear();
  beside_motion.clear();
  const auto see = [&](int b, int other) {
    pressed.push_back(b);
    if (!sleeps(state, other) && !has_rested(state, other)) beside_motion.push_back(b);
  };
  for (const PairPress& press : presses) {
    see(press.a, press.b);
    see(press.b, press.a);
  }
  std::sort(pressed.begin(), pressed.end());
  std::sort(beside_motion.begin(), beside_motion.end());
  const auto is_in = [](int b, const std::vector<int>& blocks) {
    return std::binary_search(blocks.begin(), blocks.end(), b);
  };
  std::erase_if(sleepers, [&](int b) {
    return is_in(b, beside_motion) || (state.memory[b].empty() && !is_in(b, pressed));
  });
  for (size_t before = 0; before != sleepers.size();) {
    before = sleepers.size();
    for (const BlockBond& bond : state.bonds)
      if (bond.area > 0 && is_in(bond.block_a, sleepers) != is_in(bond.block_b, sleepers))
        std::erase(sleepers, is_in(bond.block_a, sleepers) ? bond.block_a : bond.block_b);
  }
}

}  // namespace

bool asks_for_presses(const State& state, const IslandMembers& members) {
  return members.moving.size() < members.size() ||
         std::any_of(members.moving.begin(), members.moving.end(), [&](int b) {
           return state.rest_steps[b] + state.stride >= law::steps_before_sleep;
         });
}

void list_presses(const IslandMembers& members, double h, const IslandSystem& system,
                  std::vector<PairPress>& presses) {
  for (size_t p = 0; p < system.island.pairs.size(); ++p) {
    const BodyPair& pair = system.island.pairs[p];
    if (pair.b < 0) continue;
    for (const size_t r : contacts_of(system, p)) {
      const ConstIslandRow row = row_of(system, r);
      const Vec3 force = row.impulse() / h, arm = row.arm();
      if (force.isZero(0)) continue;
      add_press(members.blocks[pair.a], members.blocks[pair.b], load_of(force, arm),
                load_of(-force, arm + pair.shift), presses);
    }
  }
}

void list_presses(const IslandMembers& members, double h, const MassScratch& w,
                  std::vector<PairPress>& presses) {
  const auto vector = [](const float(&x)[3]) { return Vec3(x[0], x[1], x[2]); };
  for (const MassPair& pair : w.system.pairs) {
    if (pair.b < 0) continue;
    for (int r = pair.row_begin; r < pair.row_end; ++r) {
      const MassRow& row = w.system.rows[r];
      const Vec3 force = vector(row.impulse) / h;
      if (force.isZero(0)) continue;
      add_press(members.blocks[pair.a], members.blocks[pair.b], load_of(force, vector(row.arm_a)),
                load_of(-force, vector(row.arm_b)), presses);
    }
  }
}

void add_piles(const State& state, SleepScratch& wake) {
  if (wake.blocks.empty()) return;
  wake.touches.clear();
  for (int b = 0; b < std::ssize(state.memory); ++b)
    for (const ContactMemory& memory : state.memory[b]) {
      const int other = memory.key.body_b;
      if (other < 0 || !sleeps(state, b) || !sleeps(state, other)) continue;
      wake.touches.emplace_back(b, other);
      wake.touches.emplace_back(other, b);
    }
  std::sort(wake.touches.begin(), wake.touches.end());
  wake.is_known.assign(state.memory.size(), 0);
  for (const int b : wake.blocks) wake.is_known[b] = 1;
  for (size_t i = 0; i < wake.blocks.size(); ++i) {
    const int b = wake.blocks[i];
    for (auto at = std::lower_bound(wake.touches.begin(), wake.touches.end(), std::pair(b, 0));
         at != wake.touches.end() && at->first == b; ++at)
      if (std::exchange(wake.is_known[at->second], 1) == 0) wake.blocks.push_back(at->second);
  }
}

void find_woken(const Scene& scene, const State& state, const IslandMembers& members,
                SubstepEnd& end) {
  end.load_change.assign(members.size(), Vec6::Zero());  // by neighbours awake
  const auto add = [&](int b, int by, const Vec6& load) {
    if (sleeps(state, b) && !sleeps(state, by)) end.load_change[members.at(b)] += load;
  };
  for (const PairPress& press : end.presses) {
    add(press.a, press.b, press.on_a);
    add(press.b, press.a, press.on_b);
  }
  for (const int b : members.blocks) {
    if (!sleeps(state, b)) continue;
    for (const SleepLoad& then : carried_by(state, b)) add(b, then.by, -then.load);
    if (moves_block(scene, state, b, end.load_change[members.at(b)])) end.sleep.blocks.push_back(b);
  }
}

void wake_members(const Scene& scene, double t, SleepScratch& wake, State& state,
                  IslandMembers& members) {
  const int lead = members.moving.front();
  std::vector<int>& blocks = wake.woken;
  blocks.clear();
  for (const int b : wake.blocks)
    if (sleeps(state, b)) wake_bonded(b, t, state, blocks);
  if (!state.mass.empty())
    for (const int b : blocks) state.mass[b] = state.mass[lead];
  add_members(scene, state, blocks, members);
}

bool wake_before_step(const Scene& scene, State& state, PairSearch& search) {
  const std::vector<int>& island_of = search.groups.island_of;
  std::vector<int>& to_wake = search.sleep.blocks;
  to_wake.clear();
  const double slow =
      step_length(scene, state) * resting_speed(scene.settings, scene.gravity.norm());
  const auto may_hit = [&](int by, int b) {
    return !is_fixed(scene, b) && sleeps(state, b) && !sleeps(state, by) &&
           search.step[by].norm() + search.turn[by] > slow;
  };
  for (const PairManifold& m : search.pairs.manifolds) {
    if (may_hit(m.block_a, m.block_b)) to_wake.push_back(m.block_b);
    if (!is_fixed(scene, m.block_b) && may_hit(m.block_b, m.block_a)) to_wake.push_back(m.block_a);
  }
  add_piles(state, search.sleep);
  for (const SleepLoad& load : state.carried)
    if (!sleeps(state, load.by) && island_of[load.by] != island_of[load.block])
      to_wake.push_back(load.block);
  for (const int b : to_wake) {
    if (!sleeps(state, b)) continue;  // woken with another
    search.sleep.woken.clear();
    wake_bonded(b, state.time, state, search.sleep.woken);
    for (const int of : search.sleep.woken) search.awake[of] = 1;
  }
  return !to_wake.empty();
}

void forget_contacts(const IslandMembers& members, State& state) {
  for (const int b : members.blocks)
    std::erase_if(state.memory[b], [&](const ContactMemory& memory) {
      const int other = memory.key.body_b;
      return members.moves(b) || (other >= 0 && members.moves(other));
    });
}

void put_island_to_sleep(const Scene& scene, int k, State& state, Work& work) {
  SleepScratch& scratch = work.search.sleep;
  std::vector<int>& sleepers = scratch.sleepers;
  sleepers.clear();
  for (const int b : blocks_of(work.search.groups, k)) {
    if (does_not_move(phase_of(state, b))) continue;
    watch_rest(scene, static_cast<size_t>(b), state);
    if (has_rested(state, b)) sleepers.push_back(b);
  }
  if (sleepers.empty()) return;
  const std::vector<PairPress>& presses = work.island.end.presses;
  find_sleepers(state, presses, scratch);
  for (const int b : sleepers) {
    fall_asleep(scene, static_cast<size_t>(b), state);
    if (!state.mass.empty()) state.mass[b] = {};
    for (const PairPress& press : presses) {
      if (press.a == b) note_carried({b, press.b, press.on_a}, state);
      if (press.b == b) note_carried({b, press.a, press.on_b}, state);
    }
  }
}

}  // namespace talus
