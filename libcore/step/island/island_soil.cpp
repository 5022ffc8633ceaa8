// Couples, friction and drag of yielding ground over a substep of an island.
#include "step/island/island_soil.hpp"

#include <algorithm>

#include "step/substep.hpp"

namespace talus {
namespace {

using std::size_t;

template <class Is>
bool any_class(const std::vector<GroundClass>& classes, Is&& is) {
  return std::any_of(classes.begin(), classes.end(), is);
}

double across(const Vec3& normal, const Vec3& velocity) {
  return (velocity - normal.dot(velocity) * normal).norm();
}

// Motion of a member after its hits, without contact forces: at its last hit, or at the start.
Vec6 start_of(const FreeMotions& free, const SubstepHits& hits, const Island& island, size_t k) {
  if (hits.hit_members.contains(static_cast<int>(k))) return island.free_velocity[k];
  Vec6 v;
  v << free.substeps[k].start.velocity, free.turns[k].spin_start;
  return v;
}

// Mean speed of slip of a contact with the ground over the substep.
double mean_slip(const FreeMotions& free, const SubstepHits& hits, const IslandSystem& system,
                 size_t r) {
  const Island& island = system.island;
  const Vec3 normal = row_of(system, r).normal();
  const auto start = [&](size_t k) { return start_of(free, hits, island, k); };
  const auto end = [&](size_t k) -> const Vec6& { return island.velocity[k]; };
  return (across(normal, relative(system, r, start)) + across(normal, relative(system, r, end))) /
         2;
}

// Time in which contacts press member k.
double pressed_time(const FreeMotions& free, const SubstepHits& hits, size_t k) {
  return free.h - (hits.hit_members.contains(static_cast<int>(k)) ? hits.members[k].clock : 0);
}

// The contact of member k with the ground that presses most; the number of contacts: none.
size_t pressed_most(const IslandSystem& system, size_t k) {
  size_t found = system.contacts.size();
  double most = 0;
  for (const size_t r : contacts_of(system, static_cast<size_t>(system.ground_pair[k]))) {
    const double p_n = row_of(system, r).normal_impulse();
    if (!system.contacts[r].waits && p_n > most) most = p_n, found = r;
  }
  return found;
}

void slide_member(const Scene& scene, const IslandMembers& members, const FreeMotions& free,
                  const IslandSystem& system, const SubstepHits& hits, size_t k, State& state) {
  if (system.ground_pair[k] < 0) return;
  const size_t r = pressed_most(system, k);
  if (r == system.contacts.size()) return;
  const GroundClass& ground = class_of(scene, system.contacts[r]);
  const bool slips = row_of(system, r).state() == ContactState::slip;
  const double speed = slips ? mean_slip(free, hits, system, r) : 0;
  slide_on(scene, ground, members.blocks[k], speed, pressed_time(free, hits, k), free.t, free.h,
           state);
}

}  // namespace

bool is_pressed(const IslandSystem& system, size_t k) {
  const int pair = system.ground_pair[k];
  if (pair < 0) return false;
  for (const size_t r : contacts_of(system, static_cast<size_t>(pair)))
    if (!system.contacts[r].waits && row_of(system, r).state() != ContactState::open) return true;
  return false;
}

bool renew_friction(const Scene& scene, const State& state, const PairSearch& search,
                    const IslandMembers& members, const FreeMotions& free, const SubstepHits& hits,
                    IslandSystem& system) {
  bool any = false;
  const auto slips = [&](size_t r) {
    return !system.contacts[r].waits && row_of(system, r).state() == ContactState::slip;
  };
  const auto renew = [&](size_t r, double friction) {
    row_of(system, r).set_friction(friction);
    note_change(system, r);
    any = true;
  };
  if (any_class(scene.ground.classes, varies_friction))
    for (size_t k = 0; k < members.size(); ++k) {
      if (system.ground_pair[k] < 0) continue;
      for (const size_t r : contacts_of(system, static_cast<size_t>(system.ground_pair[k]))) {
        const GroundClass& ground = class_of(scene, system.contacts[r]);
        if (!slips(r) || !varies_friction(ground)) continue;
        double friction = 0;
        vary_friction(ground, slide_of(state, members.blocks[k], free.t),
                      mean_slip(free, hits, system, r), pressed_time(free, hits, k), friction);
        renew(r, friction);
      }
    }
  if (!weakens(scene.joint) && !any_class(scene.joints.of_block, weakens)) return any;
  for (size_t p = 0; p < system.island.pairs.size(); ++p) {
    if (system.pair_manifold[p] < 0 || system.island.pairs[p].b < 0) continue;
    const GroundClass faces = pair_class(scene, search.pairs.manifolds[system.pair_manifold[p]]);
    if (!weakens(faces)) continue;
    for (const size_t r : contacts_of(system, p))
      if (slips(r) && system.contacts[r].bond < 0)
        renew(r, friction_on(faces, mean_slip(free, hits, system, r), 0));
  }
  return any;
}

void end_soil(const Scene& scene, const IslandMembers& members, const FreeMotions& free,
              const IslandSystem& system, const SubstepHits& hits, State& state) {
  const Island& island = system.island;
  if (!island.angular.empty())
    for (size_t k = 0; k < members.size(); ++k) {
      const int pair = system.ground_pair[k];
      if (pair < 0 || island.pairs[pair].angular < 0) continue;
      // between the end without contact and the end, as for contacts (path_of_impulse())
      const Vec6 mean = (island.free_velocity[k] + island.velocity[k]) / 2;
      state.ledger.rolling -= island.angular[island.pairs[pair].angular].couple.dot(mean.tail<3>());
    }
  if (state.slid.empty()) return;
  for (size_t k = 0; k < members.size(); ++k)
    slide_member(scene, members, free, system, hits, k, state);
}

}  // namespace talus
