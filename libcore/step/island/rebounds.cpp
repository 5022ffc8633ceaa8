// Stage 8 of an island's step. Blocks that press on each other hit and rebound several times in
// turn within a substep, and lose energy each time; here is what that leaves of the rebound of hits
// that are solved all at once (docs/theory.md; docs/design-notes.md, "Hits in turn").
#include <algorithm>
#include <cmath>
#include <limits>
#include <ranges>

#include "solver/contact_law.hpp"
#include "solver/law_numbers.hpp"
#include "step/impact.hpp"
#include "step/island/stages.hpp"

namespace talus {
namespace {

using std::size_t;

using law::hit_gain_rounding, law::least_loss, law::others_rounding;

// What the impulses `p` about member k's centroid alone do to its velocity.
Vec6 change_by(const IslandMembers& members, const FreeMotions& free, size_t k, const Vec6& p) {
  Vec6 v;
  v << p.head<3>() / members.numbers[k].mass, free.turns[k].per_inertia * p.tail<3>();
  return v;
}

// The hits of each member, of each only what it needs by itself, not what it passes on.
void sum_hits(const IslandMembers& members, const IslandSystem& system, const SubstepHits& hits,
              Rebounds& rebounds) {
  rebounds.hit_sums.assign(members.size(), {});
  for (const Hit& hit : hits.hits) {
    const KeptContact& contact = system.contacts[hit.contact];
    const RowIn<const RowGroup> lane = lane_of(system, hit.contact);
    const Vec6 impulse = generalised<6>(lane.arm(), lane.impulse()) / hit.in_turn;
    const double p_n = lane.normal_impulse() / hit.in_turn;
    const size_t ka = members.at(contact.a);
    rebounds.hit_sums[ka].add(impulse, p_n, hit.time);
    if (contact.b < 0) continue;
    const size_t kb = members.at(contact.b);
    const Vec3 shift = system.island.position[ka] - system.island.position[kb];
    rebounds.hit_sums[kb].add(-carried_to_b(impulse, shift), p_n, hit.time);
  }
}

// What hits with others do to member k's velocity, as far as its hits of a pair, `own`, do not
// follow on them in turn. They do when as much of the substep is left after the later of both as
// lay between them: so long the bodies take to meet again.
Vec6 change_apart(const IslandMembers& members, const FreeMotions& free, const Rebounds& rebounds,
                  size_t k, const HitSum& own) {
  const HitSum& all = rebounds.hit_sums[k];
  const double others = all.normal - own.normal;
  if (!(others > others_rounding * all.normal) || !(own.normal > 0)) return Vec6::Zero();
  const double time = own.moment / own.normal, other_time = (all.moment - own.moment) / others;
  const double between = std::abs(time - other_time);
  const double left = std::max(0.0, free.h - std::max(time, other_time));
  if (left >= between) return Vec6::Zero();
  return (1 - left / between) * change_by(members, free, k, all.impulse - own.impulse);
}

// How many times the impulses of a pair are those that would turn its hits round on its two bodies
// alone, >= 1: what else presses on the bodies has them hit each other so many times in turn.
double hits_in_turn(const IslandMembers& members, const FreeMotions& free,
                    const IslandSystem& system, const SubstepHits& hits, const Rebounds& rebounds,
                    size_t p) {
  const Island& island = system.island;
  const BodyPair& pair = island.pairs[p];
  const auto ka = static_cast<size_t>(pair.a), kb = static_cast<size_t>(std::max(pair.b, 0));
  Vec6 impulse = Vec6::Zero();
  HitSum own;
  for (const size_t r : contacts_of(system, p)) {
    const RowIn<const RowGroup> lane = lane_of(system, r);
    const Vec6 of_row = generalised<6>(lane.arm(), lane.impulse());
    impulse += of_row;
    const Hit* hit = hit_of(system, hits, r);
    if (hit != nullptr)
      own.add(of_row / hit->in_turn, lane.normal_impulse() / hit->in_turn, hit->time);
  }
  const Vec6 alone_a = change_by(members, free, ka, impulse),
             apart_a = change_apart(members, free, rebounds, ka, own);
  Vec6 alone_b = Vec6::Zero(), apart_b = Vec6::Zero();
  if (pair.b >= 0) {
    const Vec3 shift = island.position[ka] - island.position[kb];
    alone_b = change_by(members, free, kb, -carried_to_b(impulse, shift));
    own.impulse = -carried_to_b(own.impulse, shift);
    apart_b = change_apart(members, free, rebounds, kb, own);
  }
  double alone = 0, found = 0;
  for (const size_t r : contacts_of(system, p)) {
    const Hit* hit = hit_of(system, hits, r);
    if (hit == nullptr) continue;
    const Vec3 normal = lane_of(system, r).normal();
    const double p_n = lane_of(system, r).normal_impulse();
    const auto along = [&](auto&& of) { return normal.dot(relative(system, r, of)); };
    const double without = along([&](size_t k) { return island.free_velocity[k]; });
    const double end = along([&](size_t k) { return island.velocity[k]; });
    const double apart = along([&](size_t k) { return k == ka ? apart_a : apart_b; });
    alone += p_n * along([&](size_t k) { return k == ka ? alone_a : alone_b; });
    found += p_n * (end - std::min(0.0, apart) - std::min(without, hit->speed + hit->fall));
  }
  return found > 0 ? std::max(1.0, alone / found) : std::numeric_limits<double>::infinity();
}

// The part of the last change of the impulses expected of the hits that was too much, negative: by
// which it was too little. Each round leaves about the same share of the error, so that two of them
// show where it goes (Anderson's acceleration over one round). 0 while the hits are not those of
// the round before.
double overshoot_of_hits(const SubstepHits& hits, const IslandSystem& system,
                         const Rebounds& rebounds) {
  const std::vector<ExpectedHit>&now = rebounds.expected, &last = rebounds.last_expected;
  const auto same = [](const ExpectedHit& a, const ExpectedHit& b) { return a.hit == b.hit; };
  if (!std::ranges::equal(now, last, same)) return 0;
  double along = 0, length_sq = 0;
  for (size_t i = 0; i < now.size(); ++i) {
    const double per_damping = 1 / lane_of(system, hits.hits[now[i].hit].contact).normal_damping();
    const double difference = now[i].error - last[i].error;
    along += per_damping * now[i].error * difference;
    length_sq += per_damping * difference * difference;
  }
  return length_sq > 0 ? std::clamp(along / length_sq, -1.0, 0.5) : 0;
}

// What the impulses of the hits take out at least: a hit alone that comes at speed u and returns
// e u takes out (1 - e) / 2 of its impulse times u, and so does each of several in turn.
double loss_in_turn(const IslandSystem& system, const SubstepHits& hits) {
  double sum = 0;
  for (const Hit& hit : hits.hits) {
    const double share =
        least_loss * (1 - system.contacts[hit.contact].restitution) / 2 - hit_gain_rounding;
    sum -= share * hit.speed * lane_of(system, hit.contact).normal_impulse();
  }
  return sum;
}

// Work of all contact impulses on the velocities: what the substep loses is its negative.
double work_on_velocities(const IslandMembers& members, const Island& island) {
  double sum = 0;
  for (size_t k = 0; k < members.size(); ++k)
    sum += times_mass(island.mass[k], change(island, k))
               .dot(island.velocity[k] + island.free_velocity[k]) /
           2;
  return sum;
}

// What the hits lose too little [J].
double energy_excess(const IslandMembers& members, const IslandSystem& system,
                     const SubstepHits& hits) {
  return work_on_velocities(members, system.island) + loss_in_turn(system, hits);
}

// Members that a contact supported in the substep before, or supports until they are hit.
void see_borne(const IslandMembers& members, const IslandSystem& system, const SubstepHits& hits,
               std::vector<std::uint8_t>& is_borne) {
  is_borne.assign(members.size(), 0);
  for (size_t k = 0; k < members.size(); ++k) is_borne[k] = hits.support[k].until > 0;
  for (const KeptContact& contact : system.contacts) {
    if (contact.memory < 0 || contact.last_force <= 0) continue;
    is_borne[members.at(contact.a)] = 1;
    if (contact.b >= 0) is_borne[members.at(contact.b)] = 1;
  }
}

// Hits of members that fly freely until then: their speed as the solver sees it, with its lever
// arms and what pulls on the bodies until the end of the substep. Gaps over the substep tell it
// too, but for what turning adds; a rebound from one that comes out as the other loses energy, or
// gains some. Where something else bears a member, the free motion is not how it comes to its hit.
void see_speeds(const IslandMembers& members, const FreeMotions& free, const IslandSystem& system,
                SubstepHits& hits, Rebounds& rebounds) {
  see_borne(members, system, hits, rebounds.is_borne);
  const auto flies = [&](int b) { return b < 0 || rebounds.is_borne[members.at(b)] == 0; };
  for (Hit& hit : hits.hits) {
    const KeptContact& contact = system.contacts[hit.contact];
    if (!hit.is_free || !flies(contact.a) || !flies(contact.b)) continue;
    const Vec3 normal = lane_of(system, hit.contact).normal();
    Vec3 pull = free.substeps[members.at(contact.a)].free_acceleration;
    if (contact.b >= 0) pull -= free.substeps[members.at(contact.b)].free_acceleration;
    const Vec3 velocity = relative(system, hit.contact, [&](size_t k) -> const Vec6& {
      return system.island.free_velocity[k];
    });
    hit.fall = normal.dot(pull) * (free.h - hit.time);
    const double speed = normal.dot(velocity) - hit.fall;
    const double resting_speed = members.of(contact.a).resting_speed;
    hit.speed = std::min(speed, -resting_speed);
    hit.rebound = returned_speed(contact.restitution, speed, resting_speed);
    hit.target = std::max(0.0, hit.rebound + hit.fall);
  }
}

}  // namespace

// Where others press on a pair, it hits and rebounds several times in turn, each time with its
// restitution.
void set_targets(const IslandMembers& members, const FreeMotions& free, const IslandSystem& system,
                 SubstepHits& hits, Rebounds& rebounds) {
  see_speeds(members, free, system, hits, rebounds);
  sum_hits(members, system, hits, rebounds);
  for (const size_t pair : hits.hit_pairs) {
    double times = 0;
    for (const size_t r : contacts_of(system, pair)) {
      if (system.contacts[r].hit < 0) continue;
      Hit& hit = hits.hits[system.contacts[r].hit];
      if (hit.rebound == 0) continue;
      if (times == 0) times = hits_in_turn(members, free, system, hits, rebounds, pair);
      hit.in_turn = times;
      const double returned = hit.rebound * std::pow(system.contacts[r].restitution, times - 1);
      hit.target = std::max(0.0, returned + hit.fall);
    }
  }
}

double correct_hits(const SubstepHits& hits, IslandSystem& system, Rebounds& rebounds) {
  double worst = 0;
  std::vector<ExpectedHit>& expected_hits = rebounds.expected;
  expected_hits.swap(rebounds.last_expected);
  expected_hits.clear();
  for (size_t i = 0; i < hits.hits.size(); ++i) {
    const Hit& hit = hits.hits[i];
    const RowIn<RowGroup> lane = lane_of(system, hit.contact);
    const double p_n = lane.normal_impulse();
    if (p_n <= 0) continue;
    const double expected = -lane.normal_damping() * (lane.bias() + hit.target);
    expected_hits.push_back({i, p_n, p_n - expected});
    worst = std::max(worst, std::abs(p_n - expected) / lane.normal_damping() / -hit.speed);
  }
  const double overshoot = overshoot_of_hits(hits, system, rebounds);
  for (size_t i = 0; i < expected_hits.size(); ++i) {
    const Hit& hit = hits.hits[expected_hits[i].hit];
    const RowIn<RowGroup> lane = lane_of(system, hit.contact);
    double expected = expected_hits[i].impulse;
    if (overshoot != 0)
      expected =
          std::max(0.0, expected - overshoot * (expected - rebounds.last_expected[i].impulse));
    lane.set(&RowGroup::bias, -hit.target - expected / lane.normal_damping());
    note_change(system, hit.contact);
  }
  return worst;
}

bool gain_energy(const IslandMembers& members, const IslandSystem& system,
                 const SubstepHits& hits) {
  return energy_excess(members, system, hits) > 0;
}

// What the hits then need of their impulses is expected to be what stopped them.
double forgo_rebound(const IslandMembers& members, IslandSystem& system, SubstepHits& hits,
                     Rebounds& rebounds) {
  const double excess = energy_excess(members, system, hits);
  rebounds.full_velocity = system.island.velocity;
  rebounds.full_rows = system.island.rows;
  for (Hit& hit : hits.hits) {
    const RowIn<RowGroup> lane = lane_of(system, hit.contact);
    const double stopped = hit.speed / (hit.speed - hit.target);
    lane.set(&RowGroup::bias, -stopped * lane.normal_impulse() / lane.normal_damping());
    hit.target = 0;
    note_change(system, hit.contact);
  }
  rebounds.expected.clear();
  return excess;
}

// Between the solutions with the rebound and without it impulses and velocities are blended:
// momentum, friction cones and contacts that do not approach are kept, and energy is quadratic in
// the share.
void blend_rebound(const IslandMembers& members, double excess, const SubstepHits& hits,
                   const Rebounds& rebounds, IslandSystem& system) {
  Island& island = system.island;
  double square = 0;
  for (size_t k = 0; k < members.size(); ++k) {
    const Vec6 gained = rebounds.full_velocity[k] - island.velocity[k];
    square += times_mass(island.mass[k], gained).dot(gained) / 2;
  }
  if (square <= 0) return;
  const double lacking = energy_excess(members, system, hits);
  const double share = largest_share(square, excess - lacking - square, lacking);
  for (size_t k = 0; k < members.size(); ++k)
    island.velocity[k] += share * (rebounds.full_velocity[k] - island.velocity[k]);
  for (size_t r = 0; r < system.contacts.size(); ++r) {
    const int number = system.contacts[r].lane;
    const RowIn<RowGroup> now = lane_of(system, r);
    const RowIn<const RowGroup> full(rebounds.full_rows[number / 2], number % 2);
    now.set_vector(&RowGroup::impulse, now.impulse() + share * (full.impulse() - now.impulse()));
    if (now.state() == ContactState::open) now.set_state(full.state());
  }
}

}  // namespace talus
