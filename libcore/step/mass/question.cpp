// Exact step or mass step, and with how many sweeps.
#include <algorithm>
#include <cmath>

#include "scene/bonds.hpp"
#include "solver/law_numbers.hpp"
#include "solver/mass_numbers.hpp"
#include "step/mass/stages.hpp"
#include "step/mass/step_mass.hpp"

namespace talus {
namespace {

using std::size_t;

constexpr double default_accuracy = Settings{}.accuracy, default_step = Settings{}.dt;

int faster_than(const IslandMembers& members, const State& state, double speed) {
  return static_cast<int>(std::count_if(members.moving.begin(), members.moving.end(), [&](int b) {
    return state.motion[static_cast<size_t>(b)].velocity.norm() > speed;
  }));
}

bool has_bonds(const IslandMembers& members, const State& state) {
  return std::any_of(state.bonds.begin(), state.bonds.end(),
                     [&](const BlockBond& bond) {
                       return bond.area > 0 && members.moves(bond.block_a) &&
                              members.moves(bond.block_b);
                     }) ||
         std::any_of(members.moving.begin(), members.moving.end(), [&](int b) {
           const std::vector<ContactMemory>& memory = state.memory[static_cast<size_t>(b)];
           return std::any_of(memory.begin(), memory.end(),
                              [](const ContactMemory& contact) { return contact.bond_area > 0; });
         });
}

// Steps that make up mass::calm_time.
int calm_steps(const Scene& scene) {
  return static_cast<int>(std::ceil(mass::calm_time / scene.settings.dt));
}

template <class Visit>
void for_each(const IslandMembers& members, State& state, const Visit& visit) {
  for (const int b : members.moving) visit(state.mass[static_cast<size_t>(b)]);
}

// Exact from now on, for this many steps at least. False.
bool leave(const IslandMembers& members, int barred, State& state) {
  if (state.mass.empty()) return false;
  for_each(members, state, [&](MassShare& share) {
    share = {};
    share.barred = barred;
  });
  return false;
}

void become_mass(const IslandMembers& members, const MassShare& share, State& state) {
  if (state.mass.empty()) state.mass.resize(state.motion.size());
  for_each(members, state, [&](MassShare& of_member) { of_member = share; });
}

}  // namespace

bool has_settled(const Scene& scene, double h, double change) {
  return change <= settled_change(scene, h);
}

bool is_any_in_mass(const IslandMembers& members, const State& state) {
  return !state.mass.empty() &&
         std::any_of(members.moving.begin(), members.moving.end(),
                     [&](int b) { return state.mass[static_cast<size_t>(b)].is_in_mass; });
}

bool may_be_mass(const Scene& scene, const IslandMembers& members, const State& state) {
  return scene.settings.masses && !(scene.settings.normal_stiffness > 0) &&
         static_cast<int>(members.moving.size()) >= mass::least_size && !has_bonds(members, state);
}

void bar_from_mass(const Scene& scene, const IslandMembers& members, State& state) {
  leave(members, calm_steps(scene), state);
}

bool moves_as_mass(const Scene& scene, const IslandMembers& members, State& state) {
  const double by_gravity = scene.gravity.norm() * scene.settings.dt;
  if (!may_be_mass(scene, members, state)) return leave(members, 0, state);
  MassShare all;  // of all members together
  int n_in_mass = 0;
  if (!state.mass.empty()) {
    all.calm = calm_steps(scene);
    all.steady = law::patience;
    for_each(members, state, [&](const MassShare& share) {
      if (!share.is_in_mass) return void(all.barred = std::max(all.barred, share.barred));
      ++n_in_mass;
      all.calm = std::min(all.calm, share.calm);
      all.unsettled = std::max(all.unsettled, share.unsettled);
      all.steady = std::min(all.steady, share.steady);
    });
  }
  if (2 * n_in_mass > static_cast<int>(members.moving.size())) {
    const int n_fast = faster_than(members, state, by_gravity),
              n_steps = static_cast<int>(state.stride);
    // contacts that grow soft sag at first: that makes them grow so more slowly, and no mass again
    if (n_fast <= static_cast<int>(law::few_blocks))
      all.calm += n_steps;
    else
      all.calm = 2 * n_fast > n_in_mass ? 0 : std::max(0, all.calm - n_steps);
    if (all.calm >= calm_steps(scene) || all.unsettled >= law::patience)
      return leave(members, calm_steps(scene), state);
  } else {
    if (all.barred > 0)
      return leave(members, std::max(0, all.barred - static_cast<int>(state.stride)), state);
    if (faster_than(members, state, law::slow * by_gravity) <= mass::most_moving)
      return leave(members, 0, state);
    all.calm = 0;
  }
  all.is_in_mass = true;
  become_mass(members, all, state);
  return true;
}

bool leaves_as_mass(const Scene& scene, const IslandMembers& members, const FreeMotions& free,
                    const MassScratch& w, State& state) {
  const double limit = law::slow * scene.gravity.norm() * free.h;
  int n_moving = 0;
  for (size_t k = 0; k < members.size(); ++k)
    n_moving += (free.substeps[k].free.velocity + w.changes[k].velocity).norm() > limit;
  if (n_moving <= mass::most_moving) return false;
  MassShare share;
  share.is_in_mass = true;
  become_mass(members, share, state);
  return true;
}

int mass_sweeps(double accuracy) {
  return std::max(1, static_cast<int>(std::lround(mass::sweeps * default_accuracy / accuracy)));
}

double mass_compliance(const Scene& scene, const MassShare& share) {
  const double in_island = 1 / law::recovery_steps;
  const double calm = static_cast<double>(share.calm) / calm_steps(scene);
  return mass::compliance * std::pow(in_island / mass::compliance, calm);
}

int next_stride(const Scene& scene, const State& state) {
  const double n_made = std::round(state.time / scene.settings.dt);  // long steps end on even ones
  if (state.mass.empty() || scene.settings.dt > default_step || shakes(scene.base) ||
      std::fmod(n_made, 2) != 0)
    return 1;
  int n_moving = 0, n_steady = 0;
  for (size_t b = 0; b < state.mass.size(); ++b) {
    if (does_not_move(phase_of(state, static_cast<int>(b)))) continue;
    ++n_moving;
    const MassShare& share = state.mass[b];
    if (!share.is_in_mass) continue;
    if (share.calm > 0 || share.steady < law::patience) return 1;
    ++n_steady;
  }
  return 2 * n_steady > n_moving ? 2 : 1;
}

void note_solution(const Scene& scene, const IslandMembers& members, double h, const MassScratch& w,
                   State& state, StepReport& report) {
  const bool is_settled = has_settled(scene, h, w.solved.change);
  // forces that change linearly err by h^3
  const double in_long_step = w.error * std::pow(2 * scene.settings.dt / h, 3);
  const bool is_steady = is_settled && in_long_step <= scene.settings.accuracy;
  for_each(members, state, [&](MassShare& share) {
    share.unsettled = is_settled ? 0 : share.unsettled + 1;
    share.steady = is_steady ? share.steady + 1 : 0;
  });
  if (is_settled) return;
  note_unconverged(members.moving.front(), report);
  report.flags = report.flags | StepFlag::unconverged;
}

}  // namespace talus
