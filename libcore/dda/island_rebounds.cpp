// Blocks that press on each other hit and rebound several times in turn within a substep, and lose
// energy each time; here is what that leaves of the rebound of hits that are solved all at once
// (docs/design-notes.md, "Hits in turn").
#include <algorithm>
#include <cmath>
#include <limits>

#include "dda/advance_island.hpp"

namespace talus {
namespace {

using std::size_t;

constexpr double gain_rounding = 1e-6;    // of the energy of hits: not a gain
constexpr double least_loss = 0.9;        // of what hits one after the other would lose
constexpr double others_rounding = 1e-9;  // of a member's hits: there are no others

}  // namespace

// What the impulses `p` about member k's centroid alone do to its velocity.
Vec6 AdvanceIsland::change_by(size_t k, const Vec6& p) const {
  Vec6 v;
  v << p.head<3>() / w.numbers[k].mass, w.turns[k].per_inertia * p.tail<3>();
  return v;
}

// The hits of each member, of each only what it needs by itself, not what it passes on.
void AdvanceIsland::sum_hits() {
  w.hit_sums.assign(w.members.size(), {});
  for (size_t r = 0; r < w.contacts.size(); ++r) {
    const IslandContact& contact = w.contacts[r];
    if (!contact.hit) continue;
    const IslandRow& row = w.island.rows[r];
    const Vec6 impulse = generalised<6>(row.arm, row.impulse) / contact.in_turn;
    const double p_n = row.normal.dot(row.impulse) / contact.in_turn;
    const size_t ka = place(contact.a);
    w.hit_sums[ka].add(impulse, p_n, contact.hit_time);
    if (contact.b < 0) continue;
    const size_t kb = place(contact.b);
    const Vec3 shift = w.island.position[ka] - w.island.position[kb];
    w.hit_sums[kb].add(-carried_to_b(impulse, shift), p_n, contact.hit_time);
  }
}

// What hits with others do to member k's velocity, as far as its hits of a pair, `own`, do not
// follow on them in turn. They do when as much of the substep is left after the later of both as
// lay between them: so long the bodies take to meet again.
Vec6 AdvanceIsland::change_apart(size_t k, const HitSum& own, double h) const {
  const HitSum& all = w.hit_sums[k];
  const double others = all.normal - own.normal;
  if (!(others > others_rounding * all.normal) || !(own.normal > 0)) return Vec6::Zero();
  const double time = own.moment / own.normal, other_time = (all.moment - own.moment) / others;
  const double between = std::abs(time - other_time);
  const double left = std::max(0.0, h - std::max(time, other_time));
  if (left >= between) return Vec6::Zero();
  return (1 - left / between) * change_by(k, all.impulse - own.impulse);
}

// How many times the impulses of a pair are those that would turn its hits round on its two bodies
// alone, >= 1: what else presses on the bodies has them hit each other so many times in turn.
double AdvanceIsland::hits_in_turn(const BodyPair& pair, double h) const {
  const auto ka = static_cast<size_t>(pair.a), kb = static_cast<size_t>(std::max(pair.b, 0));
  Vec6 impulse = Vec6::Zero();
  HitSum own;
  for (int i = pair.row_begin; i < pair.row_end; ++i) {
    const auto r = static_cast<size_t>(i);
    const IslandRow& row = w.island.rows[r];
    const Vec6 p = generalised<6>(row.arm, row.impulse);
    impulse += p;
    const IslandContact& contact = w.contacts[r];
    if (contact.hit)
      own.add(p / contact.in_turn, row.normal.dot(row.impulse) / contact.in_turn, contact.hit_time);
  }
  const Vec6 alone_a = change_by(ka, impulse), apart_a = change_apart(ka, own, h);
  Vec6 alone_b = Vec6::Zero(), apart_b = Vec6::Zero();
  if (pair.b >= 0) {
    const Vec3 shift = w.island.position[ka] - w.island.position[kb];
    alone_b = change_by(kb, -carried_to_b(impulse, shift));
    own.impulse = -carried_to_b(own.impulse, shift);
    apart_b = change_apart(kb, own, h);
  }
  double alone = 0, found = 0;
  for (int i = pair.row_begin; i < pair.row_end; ++i) {
    const auto r = static_cast<size_t>(i);
    const IslandContact& contact = w.contacts[r];
    if (!contact.hit) continue;
    const IslandRow& row = w.island.rows[r];
    const double p_n = row.normal.dot(row.impulse);
    const auto along = [&](auto&& of) { return row.normal.dot(relative(r, of)); };
    const double free = along([&](size_t k) { return w.island.free_velocity[k]; });
    const double end = along([&](size_t k) { return w.island.velocity[k]; });
    const double apart = along([&](size_t k) { return k == ka ? apart_a : apart_b; });
    alone += p_n * along([&](size_t k) { return k == ka ? alone_a : alone_b; });
    found += p_n * (end - std::min(0.0, apart) - std::min(free, contact.hit_speed + contact.fall));
  }
  return found > 0 ? std::max(1.0, alone / found) : std::numeric_limits<double>::infinity();
}

// Targets of the hits: where others press on a pair, it hits and rebounds several times in turn,
// each time with its restitution.
void AdvanceIsland::set_targets(double h) {
  sum_hits();
  for (const BodyPair& pair : w.island.pairs) {
    double times = 0;
    for (int i = pair.row_begin; i < pair.row_end; ++i) {
      IslandContact& contact = w.contacts[static_cast<size_t>(i)];
      if (!contact.hit || contact.rebound == 0) continue;
      if (times == 0) times = hits_in_turn(pair, h);
      contact.in_turn = times;
      const double returned = contact.rebound * std::pow(contact.restitution, times - 1);
      contact.target = std::max(0.0, returned + contact.fall);
    }
  }
}

// What the impulses of the hits take out at least: a hit alone that comes at speed u and returns
// e u takes out (1 - e) / 2 of its impulse times u, and so does each of several in turn.
double AdvanceIsland::loss_in_turn() const {
  double sum = 0;
  for (size_t r = 0; r < w.contacts.size(); ++r) {
    const IslandContact& contact = w.contacts[r];
    if (!contact.hit) continue;
    const double share = least_loss * (1 - contact.restitution) / 2 - gain_rounding;
    sum -= share * contact.hit_speed * w.island.rows[r].normal.dot(w.island.rows[r].impulse);
  }
  return sum;
}

// Work of all contact impulses on the velocities: what the substep loses is its negative.
double AdvanceIsland::work_on_velocities() const {
  double sum = 0;
  for (size_t r = 0; r < w.contacts.size(); ++r) {
    const Vec3& p = w.island.rows[r].impulse;
    if (p.isZero(0)) continue;
    sum += p.dot(relative(r, [&](size_t k) -> Vec6 {
      return (w.island.velocity[k] + w.island.free_velocity[k]) / 2;
    }));
  }
  return sum;
}

// Takes the rebound from the hits: all at once they lost less than they would in turn. What they
// then need of their impulses is expected to be what stopped them.
void AdvanceIsland::forgo_rebound() {
  for (size_t r = 0; r < w.contacts.size(); ++r) {
    IslandContact& contact = w.contacts[r];
    if (!contact.hit) continue;
    IslandRow& row = w.island.rows[r];
    const double stopped = contact.hit_speed / (contact.hit_speed - contact.target);
    row.bias = -stopped * row.normal.dot(row.impulse) / row.normal_damping;
    contact.target = 0;
    note_change(r);
  }
  w.hits.clear();
}

}  // namespace talus
