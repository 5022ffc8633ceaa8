// Stage 6 of an island's step: which contacts are hit within the substep, when, and what bears the
// members until then.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "solver/contact_law.hpp"
#include "solver/law_numbers.hpp"
#include "step/island/stages.hpp"

namespace talus {
namespace {

using std::size_t;

using law::hit_at_end, law::hit_at_start, law::hit_share, law::hit_stiffness, law::most_lone_hits;

// When a gap of `g` > 0 that closes at `v` and is `gap_end` <= 0 after `h` is zero, its speed taken
// as linear.
double time_of_hit(double g, double v, double gap_end, double h) {
  const double a = 2 * (gap_end - g - v * h) / (h * h);
  return std::min(h, 2 * g / (std::sqrt(std::max(0.0, v * v - 2 * a * g)) - v));
}

// Until when what bears member k takes energy from it.
double time_until_it_drives(const FreeMotions& free, const Island& island, const SubstepHits& hits,
                            size_t k) {
  const auto [power, rise] = support_power(free, island, hits, k);
  if (power > 0) return 0;
  return rise > 0 ? -power / rise : std::numeric_limits<double>::infinity();
}

// Bears member k by the contacts that it lost.
void set_support_of(const State& state, const IslandMembers& members, const FreeMotions& free,
                    size_t k, IslandSystem& system, SubstepHits& hits) {
  Support& support = hits.support[k];
  const LostContacts& lost = system.lost[k];
  if (support.until == 0 || lost.force == 0) return;
  system.island.free_velocity[k] -= support.until * support.acceleration;
  const Vec3 per_force = state.support[members.block(k)] / lost.all;
  support.acceleration << lost.force * per_force,
      free.turns[k].per_inertia * lost.arm.cross(members.numbers[k].mass * per_force);
  support.until = std::min(support.until, time_until_it_drives(free, system.island, hits, k));
  system.island.free_velocity[k] += support.until * support.acceleration;
}

// The contacts of a substep are those at its end. Where a member's corner crosses to a plane that
// it hits, its support until then is none of them: that goes on up to the hit. Without that the
// member falls, and the new plane takes up what the old one should have borne, as if all bends came
// half a step too soon. It ends where it would begin to drive the member.
void bear_until_hit(const State& state, const IslandMembers& members, const FreeMotions& free,
                    IslandSystem& system, SubstepHits& hits) {
  const double h = free.h;
  hits.support.assign(members.size(), {});
  for (IndexSet* set : {&hits.hit_members, &hits.opened, &hits.moved}) set->reset(members.size());
  for (const size_t r : system.waiting) {
    const KeptContact& contact = system.contacts[r];
    if (contact.b >= 0 || contact.gap_free > contact.touch) continue;
    double time = 0;
    if (contact.gap_start > 0)
      time = time_of_hit(contact.gap_start, contact.speed_start, contact.gap_free, h);
    const size_t k = members.at(contact.a);
    if (!hits.hit_members.contains(static_cast<int>(k))) hits.support[k].until = h;
    hits.support[k].until = std::min(hits.support[k].until, time);
    hits.hit_members.add(static_cast<int>(k));
  }
  for (const int k : hits.hit_members.items)
    set_support_of(state, members, free, static_cast<size_t>(k), system, hits);
}

// `pair` has a hit, perhaps its first.
void note_hit_pair(const IslandSystem& system, size_t pair, SubstepHits& hits) {
  for (const size_t r : contacts_of(system, pair))
    if (system.contacts[r].hit >= 0) return;
  hits.hit_pairs.push_back(pair);
}

// Mobility of the points of a contact relative to each other.
Mobility relative_mobility(const IslandMembers& members, const FreeMotions& free,
                           const IslandSystem& system, const KeptContact& contact,
                           const Vec3& normal) {
  const size_t ka = members.at(contact.a);
  Mobility W = mobility_at(members, free, ka, contact.arm, normal);
  if (contact.b >= 0) {
    const size_t kb = members.at(contact.b);
    const Vec3 arm_b = contact.arm + system.island.position[ka] - system.island.position[kb];
    const Mobility Wb = mobility_at(members, free, kb, arm_b, normal);
    W.normal += Wb.normal;
    W.tangent += Wb.tangent;
  }
  return W;
}

// Makes contact `r`, which waits, a hit: from its gaps at both ends of the step without it, and its
// speed at the end. Between them the speed is taken as linear; a block that another hit threw goes
// on as fast as it was thrown, so that the speed at the end bounds what this hit can return.
void make_hit(const IslandMembers& members, const FreeMotions& free, size_t r, double gap_end,
              double speed_end, IslandSystem& system, SubstepHits& hits) {
  const double h = free.h;
  KeptContact& contact = system.contacts[r];
  const RowIn<RowGroup> lane = lane_of(system, r);
  const Vec3 normal = lane.normal();
  note_hit_pair(system, static_cast<size_t>(contact.pair), hits);
  contact.waits = false;
  contact.hit = static_cast<int>(hits.hits.size());
  Hit& hit = hits.hits.emplace_back();
  hit.contact = r;
  const double v = contact.speed_start, g = contact.gap_start;
  const double supported =
      normal.dot(relative(system, r, [&](size_t k) { return borne_path(hits, k, h); }));
  const double a = 2 * (gap_end - supported - g - v * h) / (h * h);
  const double a_free = 2 * (contact.gap_free - g - v * h) / (h * h);
  if (g > 0) hit.time = time_of_hit(g, v, gap_end, h);
  if (members.is_lone() && hit.time > hit_at_end * h) hit.time = h;
  const double rest = h - hit.time, resting_speed = members.of(contact.a).resting_speed;
  const double borne = normal.dot(relative(system, r, [&](size_t k) -> Vec6 {
    return std::min(hit.time, hits.support[k].until) * hits.support[k].acceleration;
  }));
  const double speed = std::max(g > 0 ? v + a * hit.time + borne : contact.approach, speed_end);
  const double returned = returned_speed(contact.restitution, speed, resting_speed);
  hit.speed = std::min(speed, -resting_speed);
  hit.rebound = returned;
  hit.fall = std::min(0.0, a_free) * rest;
  hit.target = std::max(0.0, returned + hit.fall);
  const Mobility W = relative_mobility(members, free, system, contact, normal);
  // no slip_start: friction against the end velocity never gains energy
  lane.set(&RowGroup::normal_damping, hit_stiffness / W.normal);
  lane.set(&RowGroup::shear_damping, hit_stiffness / W.tangent);
  const double change_alone = std::max(0.0, hit.target - (v + a_free * h));
  lane.set_state(ContactState::slip);
  lane.set_vector(&RowGroup::impulse, change_alone / W.normal * hit_share * normal);
  lane.set(&RowGroup::bias, -hit.target - change_alone / hit_stiffness);
  note_change(system, r);
}

// Contacts that wait and are hit, by the free motion or by that with the impulses found so far:
// how many.
int find_hits(const IslandMembers& members, const FreeMotions& free, bool by_free_motion,
              IslandSystem& system, SubstepHits& hits) {
  const double h = free.h;
  const Island& island = system.island;
  const auto moved = [&](int b) {
    return b >= 0 && hits.moved.contains(static_cast<int>(members.at(b)));
  };
  const auto is_hit = [&](size_t r) {
    const KeptContact& contact = system.contacts[r];
    if (!by_free_motion && !moved(contact.a) && !moved(contact.b)) return false;
    const Vec3 normal = lane_of(system, r).normal();
    double gap_end = contact.gap_free, speed_end = -std::numeric_limits<double>::infinity();
    if (by_free_motion) {
      gap_end += normal.dot(relative(system, r, [&](size_t k) { return borne_path(hits, k, h); }));
    } else {
      gap_end += normal.dot(relative(
          system, r, [&](size_t k) { return displacement_by_contact(island, hits, k, h); }));
      speed_end = normal.dot(relative(system, r, [&](size_t k) { return island.velocity[k]; }));
    }
    if (gap_end > contact.touch) return false;
    make_hit(members, free, r, gap_end, speed_end, system, hits);
    hits.hits.back().is_free = by_free_motion;
    return true;
  };
  const auto n = static_cast<int>(std::erase_if(system.waiting, is_hit));
  hits.moved.clear();
  return n;
}

// Whether the island touches nothing else.
bool is_closed(const Island& island) {
  return std::none_of(island.pairs.begin(), island.pairs.end(),
                      [](const BodyPair& pair) { return pair.b < 0; });
}

// Times of the members that are hit; of the others they stay as they are.
void find_mean_times(const IslandMembers& members, double h, const IslandSystem& system,
                     SubstepHits& hits) {
  const bool closed = is_closed(system.island);
  hits.is_timed.assign(members.size(), closed);
  hits.weight.assign(members.size(), 0);
  hits.delay.assign(members.size(), 0);
  for (const Hit& hit : hits.hits) {
    const double delay = lane_of(system, hit.contact).impulse().norm() * (hit.time - h / 2);
    for (const int b : {system.contacts[hit.contact].a, system.contacts[hit.contact].b}) {
      if (b < 0) continue;
      hits.is_timed[members.at(b)] = 1;
      hits.delay[members.at(b)] += delay;
    }
  }
  const auto is_timed = [&](int k) { return k >= 0 && hits.is_timed[k] != 0; };
  for (const BodyPair& pair : system.island.pairs) {
    if (!is_timed(pair.a) && !is_timed(pair.b)) continue;
    for (int r = pair.row_begin; r < pair.row_end; ++r) {
      const double p = row_of(system.island, r).impulse().norm();
      hits.weight[pair.a] += p;
      if (pair.b >= 0) hits.weight[pair.b] += p;
    }
  }
  if (closed) {
    const double weight = std::accumulate(hits.weight.begin(), hits.weight.end(), 0.0);
    const double delay = std::accumulate(hits.delay.begin(), hits.delay.end(), 0.0);
    std::fill(hits.weight.begin(), hits.weight.end(), weight);
    std::fill(hits.delay.begin(), hits.delay.end(), delay);
  }
  for (size_t k = 0; k < members.size(); ++k)
    if (hits.is_timed[k] != 0)
      hits.time[k] = hits.weight[k] > 0 ? h / 2 + hits.delay[k] / hits.weight[k] : h / 2;
}

// Lever arms between blocks of which one is shifted.
void shift_arms(const FreeMotions& free, const SubstepHits& hits, IslandSystem& system) {
  const double h = free.h;
  for (size_t p = 0; p < system.island.pairs.size(); ++p) {
    BodyPair& pair = system.island.pairs[p];
    if (pair.b < 0) continue;
    const auto ka = static_cast<size_t>(pair.a), kb = static_cast<size_t>(pair.b);
    if (hits.shifted[ka] == 0 && hits.shifted[kb] == 0) continue;
    pair.changed = true;
    const Vec3 shift = ((hits.time[kb] - h / 2) * free.substeps[kb].free.velocity -
                        (hits.time[ka] - h / 2) * free.substeps[ka].free.velocity) /
                       2;
    for (const size_t r : contacts_of(system, p))
      lane_of(system, r).set_vector(&RowGroup::arm, system.contacts[r].arm + shift);
  }
}

}  // namespace

std::pair<double, double> support_power(const FreeMotions& free, const Island& island,
                                        const SubstepHits& hits, size_t k) {
  const Vec6& acceleration = hits.support[k].acceleration;
  Vec6 velocity, change = acceleration;
  velocity << free.substeps[k].start.velocity, free.turns[k].spin_start;
  change.head<3>() += free.substeps[k].free_acceleration;
  const Vec6 force = island.mass[k] * acceleration;
  return {force.dot(velocity), force.dot(change)};
}

void find_first_hits(const State& state, const IslandMembers& members, const FreeMotions& free,
                     IslandSystem& system, SubstepHits& hits) {
  hits.hits.clear();
  hits.hit_pairs.clear();
  bear_until_hit(state, members, free, system, hits);
  (void)find_hits(members, free, true, system, hits);
}

int find_more_hits(const IslandMembers& members, const FreeMotions& free, IslandSystem& system,
                   SubstepHits& hits) {
  return find_hits(members, free, false, system, hits);
}

bool bear_by_opened(const State& state, const IslandMembers& members, const FreeMotions& free,
                    IslandSystem& system, SubstepHits& hits) {
  for (const int member : hits.hit_members.items) {
    const auto k = static_cast<size_t>(member);
    if (hits.support[k].until == 0 || system.ground_pair[k] < 0) continue;
    for (const size_t r : contacts_of(system, static_cast<size_t>(system.ground_pair[k]))) {
      const KeptContact& contact = system.contacts[r];
      const double previous_normal_force = contact.memory >= 0 ? contact.last_force : 0;
      if (previous_normal_force <= 0 || lane_of(system, r).state() != ContactState::open) continue;
      system.lost[k].add(previous_normal_force, contact.arm);
      hits.opened.add(member);
      note_change(system, r);  // the free motion of its body
    }
  }
  for (const int k : hits.opened.items)
    set_support_of(state, members, free, static_cast<size_t>(k), system, hits);
  return !hits.opened.items.empty();
}

// When each member's velocity changes, on the mean over the expected impulses: a contact that
// presses all along acts in the middle of the substep, a hit at its time. Lever arms count from
// where the members are then, so that angular momentum is kept. An island that touches nothing
// else takes one time for all its impulses: different ones would move its centre of mass.
void set_times(const FreeMotions& free, const IslandMembers& members, bool first,
               IslandSystem& system, SubstepHits& hits) {
  const double h = free.h;
  if (first) hits.time.assign(members.size(), h / 2);
  hits.last_time = hits.time;
  if (!hits.hits.empty()) find_mean_times(members, h, system, hits);
  bool any = false;
  hits.shifted.assign(members.size(), 0);
  for (size_t k = 0; k < members.size(); ++k) {
    hits.shifted[k] =
        hits.time[k] != hits.last_time[k] || hits.opened.contains(static_cast<int>(k));
    any |= hits.shifted[k] != 0;
    if (!first && hits.shifted[k] == 0) continue;
    system.island.position[k] = free.substeps[k].free.pose.position -
                                (h - hits.time[k]) * free.substeps[k].free.velocity +
                                borne_path(hits, k, hits.time[k]).head<3>();
  }
  if (any) shift_arms(free, hits, system);
}

double first_lone_hit(const IslandMembers& members, const SubstepTries& tries,
                      const SubstepHits& hits, double h) {
  double first = h + 1;
  if (!members.is_lone() || tries.lone_hits >= most_lone_hits) return first;
  for (const Hit& hit : hits.hits)
    if (hit.time > hit_at_start * h && hit.time < h) first = std::min(first, hit.time);
  return first;
}

}  // namespace talus
