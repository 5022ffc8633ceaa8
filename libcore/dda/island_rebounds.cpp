// Blocks that press on each other hit and rebound several times in turn within a substep, and lose
// energy each time; here is what that leaves of the rebound of hits that are solved all at once
// (docs/design-notes.md, "Hits in turn").
#include <algorithm>
#include <cmath>
#include <limits>

#include "dda/advance_island.hpp"
#include "dda/impact.hpp"

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
  for (const Hit& hit : w.hits) {
    const IslandContact& contact = w.contacts[hit.contact];
    const RowIn<RowGroup> of = row(hit.contact);
    const Vec6 impulse = generalised<6>(of.arm(), of.impulse()) / hit.in_turn;
    const double p_n = of.normal_impulse() / hit.in_turn;
    const size_t ka = place(contact.a);
    w.hit_sums[ka].add(impulse, p_n, hit.time);
    if (contact.b < 0) continue;
    const size_t kb = place(contact.b);
    const Vec3 shift = w.island.position[ka] - w.island.position[kb];
    w.hit_sums[kb].add(-carried_to_b(impulse, shift), p_n, hit.time);
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
double AdvanceIsland::hits_in_turn(size_t p, double h) const {
  const BodyPair& pair = w.island.pairs[p];
  const auto ka = static_cast<size_t>(pair.a), kb = static_cast<size_t>(std::max(pair.b, 0));
  Vec6 impulse = Vec6::Zero();
  HitSum own;
  for (const size_t r : contacts_of(p)) {
    const RowIn<RowGroup> of = row(r);
    const Vec6 of_row = generalised<6>(of.arm(), of.impulse());
    impulse += of_row;
    const Hit* hit = hit_of(r);
    if (hit != nullptr)
      own.add(of_row / hit->in_turn, of.normal_impulse() / hit->in_turn, hit->time);
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
  for (const size_t r : contacts_of(p)) {
    const Hit* hit = hit_of(r);
    if (hit == nullptr) continue;
    const Vec3 normal = row(r).normal();
    const double p_n = row(r).normal_impulse();
    const auto along = [&](auto&& of) { return normal.dot(relative(r, of)); };
    const double free = along([&](size_t k) { return w.island.free_velocity[k]; });
    const double end = along([&](size_t k) { return w.island.velocity[k]; });
    const double apart = along([&](size_t k) { return k == ka ? apart_a : apart_b; });
    alone += p_n * along([&](size_t k) { return k == ka ? alone_a : alone_b; });
    found += p_n * (end - std::min(0.0, apart) - std::min(free, hit->speed + hit->fall));
  }
  return found > 0 ? std::max(1.0, alone / found) : std::numeric_limits<double>::infinity();
}

// Targets of the hits: where others press on a pair, it hits and rebounds several times in turn,
// each time with its restitution.
void AdvanceIsland::set_targets(double h) {
  see_speeds(h);
  sum_hits();
  for (const size_t pair : w.hit_pairs) {
    double times = 0;
    for (const size_t r : contacts_of(pair)) {
      Hit* hit = hit_of(r);
      if (hit == nullptr || hit->rebound == 0) continue;
      if (times == 0) times = hits_in_turn(pair, h);
      hit->in_turn = times;
      const double returned = hit->rebound * std::pow(w.contacts[r].restitution, times - 1);
      hit->target = std::max(0.0, returned + hit->fall);
    }
  }
}

// What the impulses of the hits take out at least: a hit alone that comes at speed u and returns
// e u takes out (1 - e) / 2 of its impulse times u, and so does each of several in turn.
double AdvanceIsland::loss_in_turn() const {
  double sum = 0;
  for (const Hit& hit : w.hits) {
    const double share = least_loss * (1 - w.contacts[hit.contact].restitution) / 2 - gain_rounding;
    sum -= share * hit.speed * row(hit.contact).normal_impulse();
  }
  return sum;
}

// Work of all contact impulses on the velocities: what the substep loses is its negative.
double AdvanceIsland::work_on_velocities() const {
  double sum = 0;
  for (size_t k = 0; k < w.members.size(); ++k)
    sum += times_mass(w.island.mass[k], change(k))
               .dot(w.island.velocity[k] + w.island.free_velocity[k]) /
           2;
  return sum;
}

// Takes the rebound from the hits. What they then need of their impulses is expected to be what
// stopped them.
void AdvanceIsland::forgo_rebound() {
  for (Hit& hit : w.hits) {
    const RowIn<RowGroup> of = row(hit.contact);
    const double stopped = hit.speed / (hit.speed - hit.target);
    of.set(&RowGroup::bias, -stopped * of.normal_impulse() / of.normal_damping());
    hit.target = 0;
    note_change(hit.contact);
  }
  w.expected.clear();
}

// Keeps the solution at hand, and goes back to it by `share` from the one found since.
void AdvanceIsland::keep_solution() {
  w.kept_velocity = w.island.velocity;
  w.kept_rows = w.island.rows;
}

void AdvanceIsland::blend_kept(double share) {
  for (size_t k = 0; k < w.members.size(); ++k)
    w.island.velocity[k] += share * (w.kept_velocity[k] - w.island.velocity[k]);
  for (size_t r = 0; r < w.contacts.size(); ++r) {
    const int number = w.contacts[r].row;
    const RowIn<RowGroup> now = row(r);
    const RowIn<RowGroup> kept(w.kept_rows[static_cast<size_t>(number / 2)], number % 2);
    now.set_vector(&RowGroup::impulse, now.impulse() + share * (kept.impulse() - now.impulse()));
    if (now.state() == ContactState::open) now.set_state(kept.state());
  }
}

// Where hits that are solved all at once lose less than they would in turn, or even gain, they get
// as much of their rebound as loses that. Between the solutions with it and without it impulses and
// velocities are blended: momentum, friction cones and contacts that do not approach are kept, and
// energy is quadratic in the share.
bool AdvanceIsland::lower_rebound(double h, double tolerance) {
  const double excess = work_on_velocities() + loss_in_turn();
  keep_solution();
  forgo_rebound();
  bool converged = solve_once(h, true);
  if (converged && correct_hits() > tolerance) converged = solve_once(h, true);
  double square = 0;
  for (size_t k = 0; k < w.members.size(); ++k) {
    const Vec6 gained = w.kept_velocity[k] - w.island.velocity[k];
    square += times_mass(w.island.mass[k], gained).dot(gained) / 2;
  }
  const double lacking = work_on_velocities() + loss_in_turn();
  if (square > 0) blend_kept(largest_share(square, excess - lacking - square, lacking));
  return converged;
}

}  // namespace talus
