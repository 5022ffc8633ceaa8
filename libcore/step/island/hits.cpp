// Stage 6 of an island's step: the hits of its members in order of time. Contacts hit at the same
// time are solved together, only those that approach; contacts that close by this are hit at the
// same time again, until nothing approaches.
#include <algorithm>
#include <cmath>

#include "solver/law_numbers.hpp"
#include "step/island/impact_search.hpp"

namespace talus {
namespace {

using std::size_t;

using law::most_hits, law::most_pair_hits;

/// Finds the hits of a substep; a struct so that its parts share common data.
struct HitPhase {
  const ImpactSearch& looks;
  const IslandMembers& members;
  const FreeMotions& free;
  IslandSystem& system;
  SubstepHits& hits;
  double last_time = -1;
  int rounds = 0;
  size_t hit_since = 0;  // members that the rounds of this time hit

  // The pairs that may be hit by the motion with the supports of members.
  void look_first() const {
    size_t last = system.island.pairs.size();
    for (const size_t r : system.waiting) {
      const KeptContact& contact = system.contacts[r];
      const auto p = static_cast<size_t>(contact.pair);
      if (p == last) continue;
      const BodyPair& pair = system.island.pairs[p];
      const Vec3 normal = row_of(system, r).normal();
      double gap_end = contact.gap_free;
      const auto by_support = [&](int k) -> Vec3 {
        const FlyingMember& m = hits.members[k];
        return m.support_until * (free.h - m.support_until / 2) * m.support;
      };
      gap_end += normal.dot(by_support(pair.a));
      if (pair.b >= 0) gap_end -= normal.dot(by_support(pair.b));
      if (gap_end > contact.touch) continue;
      looks.look_ahead(p, 0, 0);
      last = p;
    }
  }

  // The lowest member of the group of member k.
  [[nodiscard]] int group_of(int k) const {
    while (hits.group[k] != k) k = hits.group[k];
    return k;
  }
  void join(int a, int b) const {
    a = group_of(a);
    b = group_of(b);
    hits.group[std::max(a, b)] = std::min(a, b);
  }

  // Bonds carry a hit on.
  void add_bonds(double time) const {
    for (size_t i = 0; i < hits.changed.size(); ++i) {
      const size_t k = hits.changed[i];
      for (int at = hits.pair_begin[k]; at < hits.pair_begin[k + 1]; ++at) {
        const int p = hits.pairs[at];
        const BodyPair& pair = system.island.pairs[p];
        const bool seen = std::any_of(hits.batch.begin(), hits.batch.end(),
                                      [&](const auto& c) { return c.pair == p && c.is_bond; });
        if (seen) continue;
        for (const size_t r : contacts_of(system, static_cast<size_t>(p))) {
          const KeptContact& contact = system.contacts[r];
          if (contact.bond_area == 0) continue;
          const PlacedMotion& a = looks.member_at(static_cast<size_t>(pair.a), time).placed;
          const PlacedMotion* b =
              pair.b < 0 ? nullptr : &looks.member_at(static_cast<size_t>(pair.b), time).placed;
          const RowMotion at_hit = row_motion(free, system, r, a, b);
          ImpactContact bond;
          bond.a = pair.a;
          bond.b = pair.b;
          bond.normal = row_of(system, r).normal();
          bond.point = (at_hit.point_a + at_hit.point_b) / 2;
          bond.is_bond = true;
          bond.key = contact.key;
          bond.pair = p;
          hits.batch.push_back(bond);
          note_member(pair.a);
          if (pair.b >= 0) note_member(pair.b), join(pair.a, pair.b);
        }
      }
    }
  }

  void note_member(int k) const {
    if (hits.group[k] >= 0) return;
    hits.group[k] = k;
    hits.changed.push_back(static_cast<size_t>(k));
  }

  // The row of a contact that touches: of the same features, else the first of its pair.
  [[nodiscard]] size_t row_of_touching(const ImpactContact& touching) const {
    const IndexRange rows = contacts_of(system, static_cast<size_t>(touching.pair));
    for (const size_t r : rows) {
      const ContactKey& key = system.contacts[r].key;
      if (key.mode == touching.key.mode && key.feature_a == touching.key.feature_a &&
          key.feature_b == touching.key.feature_b)
        return r;
    }
    return rows.first;
  }

  void note_hits(double time) {
    int last = -1;
    for (const ImpactContact& touching : hits.batch) {
      const size_t r = row_of_touching(touching);
      if (touching.is_bond) continue;
      if (touching.approach < -touching.resting_speed) ++hits.n_hits;
      note_hit(r, time, system, hits);
      if (touching.pair == last) continue;
      last = touching.pair;
      if (++hits.n_pair_hits[last] >= most_pair_hits) hits.is_closed[last] = 1;
    }
  }

  [[nodiscard]] ImpactBody body_of(size_t k, const Motion& m) const {
    const BlockNumbers& c = members.numbers[k];
    const Mat3 R = m.pose.attitude.toRotationMatrix();
    ImpactBody body;
    body.inverse_mass = 1 / c.mass;
    body.inertia = R * c.inertia.asDiagonal() * R.transpose();
    body.inverse_inertia = R * c.inverse_inertia.asDiagonal() * R.transpose();
    if (c.stands) {
      body.inverse_mass *= share_of_standing_mass;
      body.inertia /= share_of_standing_mass;
      body.inverse_inertia =
          R * (share_of_standing_mass * c.inverse_inertia).asDiagonal() * R.transpose();
    }
    body.position = m.pose.position;
    body.velocity << m.velocity, body.inverse_inertia * m.angular_momentum;
    return body;
  }

  // Work of the support of member k until its first hit, where it has motion `before`.
  [[nodiscard]] double work_of_bearing(size_t k, double time, const Motion& before) const {
    const FlyingMember& flying = hits.members[k];
    Vec3 way = before.pose.position - flying.motion.pose.position;
    if (const double until = flying.support_until; until < time)
      way = until * (flying.motion.velocity +
                     until / 2 * (free.substeps[k].free_acceleration + flying.support));
    return members.numbers[k].mass * flying.support.dot(way);
  }

  // Member k is at its hit, and moves on from there.
  void throw_member(size_t k, double time, const Motion& before, const ImpactBody& after) const {
    FlyingMember& flying = hits.members[k];
    if (time > flying.clock) hits.paths.push_back({k, flying.clock, time, flying.motion, before});
    if (!flying.was_hit) hits.by_friction -= work_of_bearing(k, time, before);
    flying.motion.pose = before.pose;
    flying.motion.velocity = after.velocity.head<3>();
    flying.motion.angular_momentum =
        before.angular_momentum + after.inertia * (after.velocity.tail<3>() -
                                                   after.inverse_inertia * before.angular_momentum);
    flying.clock = time;
    flying.was_hit = true;
    ++flying.version;
    hits.hit_members.add(static_cast<int>(k));
  }

  // Loads of the solved contacts on blocks that may break or be crushed. All together
  // they took no more than `taken`.
  void note_impulses(int group, double taken) const {
    const auto speed_of = [&](const ImpactContact& c, int body) {
      const ImpactBody& of = hits.bodies[body];
      return c.normal.dot(of.velocity.head<3>() +
                          of.velocity.tail<3>().cross(c.point - of.position));
    };
    size_t i = 0;
    const size_t begin = hits.impulses.size();
    double sum = 0;
    for (const ImpactContact& touching : hits.batch) {
      if (group_of(touching.a) != group) continue;
      const ImpactContact& c = hits.contacts[i++];
      if (c.is_bond) continue;
      const double after = speed_of(c, c.a) - (c.b < 0 ? 0 : speed_of(c, c.b));
      ImpactContact out = c;
      out.a = members.blocks[touching.a];
      if (touching.b >= 0) out.b = members.blocks[touching.b];
      out.loss = -c.normal.dot(c.impulse) * (c.approach + after) / 2;
      sum += out.loss;
      hits.impulses.push_back(out);
    }
    if (sum <= taken) return;
    for (size_t k = begin; k < hits.impulses.size(); ++k) hits.impulses[k].loss *= taken / sum;
  }

  // Solves the contacts of the batch whose members are of `group`. `stops`: without rebound.
  void solve_group(int group, double time, bool stops) const {
    hits.bodies.clear();
    hits.contacts.clear();
    hits.before.clear();
    for (const size_t k : hits.changed) {
      if (group_of(static_cast<int>(k)) != group) continue;
      hits.local[k] = static_cast<int>(hits.bodies.size());
      hits.before.push_back(looks.member_at(k, time).motion);
      hits.bodies.push_back(body_of(k, hits.before.back()));
    }
    for (const ImpactContact& touching : hits.batch) {
      if (group_of(touching.a) != group) continue;
      ImpactContact contact = touching;
      contact.a = hits.local[contact.a];
      if (contact.b >= 0) contact.b = hits.local[contact.b];
      if (stops) contact.restitution = 0;
      hits.contacts.push_back(contact);
    }
    const Impact impact = solve_impact(hits.bodies, hits.contacts, hits.impact);
    hits.passes += impact.passes;
    if (!impact.converged && !(impact.dissipated >= 0)) {
      for (const ImpactContact& touching : hits.batch)
        if (group_of(touching.a) == group) hits.is_closed[touching.pair] = 1;
      return;
    }
    hits.converged = hits.converged && impact.converged;
    hits.dissipated += impact.dissipated - impact.by_friction - impact.by_rolling;
    hits.by_rolling += impact.by_rolling;
    hits.by_friction += impact.by_friction;
    size_t i = 0;
    for (const size_t k : hits.changed)
      if (group_of(static_cast<int>(k)) == group) {
        throw_member(k, time, hits.before[i], hits.bodies[i]);
        ++i;
      }
    if (!looks.state.load.empty() || !looks.state.hit_loss.empty())
      note_impulses(group, impact.dissipated - impact.by_friction - impact.by_rolling);
    if (!system.has_bonds) return;
    i = 0;
    for (const ImpactContact& touching : hits.batch) {
      if (group_of(touching.a) != group) continue;
      if (touching.is_bond)
        hits.bond_impulse[row_of_touching(touching)] += hits.contacts[i].impulse;
      ++i;
    }
  }

  // Hits the contacts that close at `time`.
  void hit(double time) {
    const bool is_same = time <= last_time + 1e-9 * free.h;
    rounds = is_same ? rounds + 1 : 0;
    if (!is_same) hit_since = 0;
    last_time = std::max(time, last_time);
    hits.changed.clear();
    for (const ImpactContact& touching : hits.batch) {
      note_member(touching.a);
      if (touching.b >= 0) note_member(touching.b), join(touching.a, touching.b);
    }
    if (system.has_bonds) add_bonds(time);
    hit_since = std::max(hit_since, hits.changed.size());
    const bool stops = rounds >= most_hits + 2 * static_cast<int>(hit_since);
    note_hits(time);
    if (stops)
      for (const ImpactContact& touching : hits.batch) hits.is_closed[touching.pair] = 1;
    std::sort(hits.changed.begin(), hits.changed.end());
    for (const size_t k : hits.changed)
      if (group_of(static_cast<int>(k)) == static_cast<int>(k))
        solve_group(static_cast<int>(k), time, stops);
    for (const size_t k : hits.changed) hits.group[k] = -1;
  }

  // New looks at all pairs of the members that were hit.
  void look_again(double time) const {
    for (const size_t k : hits.changed)
      for (int at = hits.pair_begin[k]; at < hits.pair_begin[k + 1]; ++at) {
        const auto p = static_cast<size_t>(hits.pairs[at]);
        const BodyPair& pair = system.island.pairs[p];
        const size_t other = static_cast<size_t>(pair.a) == k ? static_cast<size_t>(pair.b)
                                                              : static_cast<size_t>(pair.a);
        if (pair.b >= 0 && other < k && hits.hit_members.contains(static_cast<int>(other)) &&
            std::binary_search(hits.changed.begin(), hits.changed.end(), other))
          continue;  // with that one
        looks.look_ahead(p, time, time);
      }
  }

  void run() {
    looks.begin();
    hits.contacts_hit.clear();
    hits.paths.clear();
    hits.impulses.clear();
    hits.dissipated = hits.by_friction = hits.by_rolling = 0;
    hits.n_hits = hits.passes = 0;
    hits.converged = true;
    hits.hit_members.reset(members.size());
    hits.moved.reset(members.size());
    hits.group.assign(members.size(), -1);
    hits.local.assign(members.size(), -1);
    hits.bond_impulse.clear();
    if (system.has_bonds) hits.bond_impulse.assign(system.contacts.size(), Vec3::Zero());
    look_first();
    for (looks.take_due(hits.due); !hits.due.empty(); looks.take_due(hits.due)) {
      hits.batch.clear();
      const double time = hits.due.front().time;
      for (const ImpactCandidate& look : hits.due) looks.look_at(look);
      if (hits.batch.empty()) continue;
      hit(time);
      look_again(time);
    }
  }
};

}  // namespace

void find_hits(const Scene& scene, const State& state, const PairSearch& search,
               const IslandMembers& members, std::vector<NearFeatures>& near_ground,
               ContactMaking& making, FreeMotions& free, IslandSystem& system, SubstepHits& hits) {
  const ImpactSearch looks{scene, state, search, members, free, system, near_ground, making, hits};
  HitPhase{looks, members, free, system, hits}.run();
  take_hits(looks, free, system, hits);
}

}  // namespace talus
