#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "dda/advance_island.hpp"

namespace talus {
namespace {

using std::size_t;

constexpr double hit_stiffness = 30;          // D of a hit over the mass that it feels
constexpr double hit_at_start = 1e-6;         // of the substep: a lone block's hit is at its start
constexpr double hit_at_end = 1 - 1e-6;       // ... or at its end
constexpr int most_lone_hits = 100;           // of a block in a step, before they come together
constexpr double hit_share = 0.7;             // first guess of its impulse, of that of a lone hit
constexpr double hit_tolerance = 1e-2;        // of its rebound, of the speed that it came with
constexpr double small_hit_tolerance = 1e-9;  // the same in an island that is factored
constexpr int most_hit_rounds = 8;            // solutions until all hits are found and rebound
constexpr double island_tolerance = 1e-2;     // of contact forces, of what gravity does in the step
constexpr double motion_tolerance = 1e-3;  // ... but not above this part of the fastest speed ...
constexpr double rest_tolerance = 1e-6;    // ... nor below this, of what gravity does
constexpr double small_tolerance = 1e-8;   // the same in an island that is factored
constexpr double linear_tolerance = 3e-2;  // of conjugate gradients in a Newton step

// When a gap of `g` > 0 that closes at `v` and is `gap_end` <= 0 after `h` is zero, its speed taken
// as linear.
double time_of_hit(double g, double v, double gap_end, double h) {
  const double a = 2 * (gap_end - g - v * h) / (h * h);
  return std::min(h, 2 * g / (std::sqrt(std::max(0.0, v * v - 2 * a * g)) - v));
}

}  // namespace

// The contacts of a substep are those at its end. Where a member's corner crosses to a plane that
// it hits, what bore it until then is none of them: it goes on up to the hit. Without that the
// member falls, and the new plane takes up what the old one should have borne, as if all bends came
// half a step too soon. It ends where it would begin to drive the member.
void AdvanceIsland::bear_until_hit(double h) {
  w.support.assign(w.members.size(), {Vec6::Zero(), h});
  w.is_hit.assign(w.members.size(), 0);
  w.opened.assign(w.members.size(), 0);
  for (const IslandContact& contact : w.contacts) {
    if (!contact.waits || contact.b >= 0 || contact.gap_free > contact.touch) continue;
    double time = 0;
    if (contact.gap_start > 0)
      time = time_of_hit(contact.gap_start, contact.speed_start, contact.gap_free, h);
    const size_t k = place(contact.a);
    w.support[k].until = std::min(w.support[k].until, time);
    w.is_hit[k] = 1;
  }
  for (size_t k = 0; k < w.members.size(); ++k) {
    if (!w.is_hit[k]) w.support[k].until = 0;
    set_support_of(k);
  }
}

// Bears member k by the contacts that it lost.
void AdvanceIsland::set_support_of(size_t k) {
  Support& support = w.support[k];
  const LostContacts& lost = w.lost[k];
  if (support.until == 0 || lost.force == 0) return;
  w.island.free_velocity[k] -= support.until * support.acceleration;
  const Vec3 per_force = state.support[block(k)] / lost.all;
  support.acceleration << lost.force * per_force,
      w.turns[k].per_inertia * lost.arm.cross(w.numbers[k].mass * per_force);
  support.until = std::min(support.until, time_until_it_drives(k));
  w.island.free_velocity[k] += support.until * support.acceleration;
}

// Contacts with the ground that a hit opens pressed until then. True when there are any.
bool AdvanceIsland::bear_by_opened() {
  bool any = false;
  for (size_t r = 0; r < w.contacts.size(); ++r) {
    const IslandContact& contact = w.contacts[r];
    if (contact.b >= 0 || contact.fixed >= 0 || contact.bore <= 0) continue;
    const size_t k = place(contact.a);
    if (w.support[k].until == 0 || w.island.rows[r].state != ContactState::open) continue;
    w.lost[k].add(contact.bore, contact.arm);
    w.opened[k] = 1;
    any = true;
  }
  for (size_t k = 0; any && k < w.members.size(); ++k)
    if (w.opened[k]) set_support_of(k);
  return any;
}

// Power of what bears member k at the start of the substep, and how fast it rises [W, W/s].
std::pair<double, double> AdvanceIsland::support_power(size_t k) const {
  const Vec6& acceleration = w.support[k].acceleration;
  Vec6 velocity, change = acceleration;
  velocity << w.substeps[k].start.velocity, w.turns[k].spin_start;
  change.head<3>() += w.substeps[k].free_acceleration;
  const Vec6 force = w.island.mass[k] * acceleration;
  return {force.dot(velocity), force.dot(change)};
}

// Until when what bears member k takes energy from it.
double AdvanceIsland::time_until_it_drives(size_t k) const {
  const auto [power, rise] = support_power(k);
  if (power > 0) return 0;
  return rise > 0 ? -power / rise : std::numeric_limits<double>::infinity();
}

// Makes contact `r`, which waits, a hit: from its gaps at both ends of the step without it, and its
// speed at the end. Between them the speed is taken as linear; a block that another hit threw goes
// on as fast as it was thrown, so that the speed at the end bounds what this hit can return.
void AdvanceIsland::make_hit(size_t r, double gap_end, double speed_end, double h) {
  IslandContact& contact = w.contacts[r];
  IslandRow& row = w.island.rows[r];
  const double v = contact.speed_start, g = contact.gap_start;
  const double supported = row.normal.dot(relative(r, [&](size_t k) { return borne_path(k, h); }));
  const double a = 2 * (gap_end - supported - g - v * h) / (h * h);
  const double a_free = 2 * (contact.gap_free - g - v * h) / (h * h);
  if (g > 0) contact.hit_time = time_of_hit(g, v, gap_end, h);
  if (is_lone() && contact.hit_time > hit_at_end * h) contact.hit_time = h;
  const double rest = h - contact.hit_time, resting_speed = numbers(contact.a).resting_speed;
  const double borne = row.normal.dot(relative(r, [&](size_t k) -> Vec6 {
    return std::min(contact.hit_time, w.support[k].until) * w.support[k].acceleration;
  }));
  const double speed =
      std::max(g > 0 ? v + a * contact.hit_time + borne : contact.approach, speed_end);
  const double returned = speed < -resting_speed ? -contact.restitution * speed : 0;
  contact.hit_speed = std::min(speed, -resting_speed);
  contact.rebound = returned;
  contact.fall = std::min(0.0, a_free) * rest;
  contact.target = std::max(0.0, returned + contact.fall);
  contact.waits = false;
  contact.hit = true;
  const size_t ka = place(contact.a);
  Mobility W = mobility_at(ka, contact.arm, row.normal);
  if (contact.b >= 0) {
    const size_t kb = place(contact.b);
    const Vec3 arm_b = contact.arm + w.island.position[ka] - w.island.position[kb];
    const Mobility Wb = mobility_at(kb, arm_b, row.normal);
    W.normal += Wb.normal;
    W.tangent += Wb.tangent;
  }
  row.normal_damping = hit_stiffness / W.normal;
  row.shear_damping = hit_stiffness / W.tangent;
  row.shear_velocity.setZero();
  row.slip_start.setZero();  // friction against the end velocity never gains energy
  row.waits_for_impact = false;
  const double change_alone = std::max(0.0, contact.target - (v + a_free * h));
  row.state = ContactState::slip;
  row.impulse = change_alone / W.normal * hit_share * row.normal;
  row.bias = -contact.target - change_alone / hit_stiffness;
  note_change(r);
}

// Contacts that wait and are hit, by the free motion or by that with the impulses found so far:
// how many.
int AdvanceIsland::find_hits(double h, bool free) {
  int n = 0;
  for (size_t r = 0; r < w.contacts.size(); ++r) {
    const IslandContact& contact = w.contacts[r];
    if (!contact.waits) continue;
    const Vec3& normal = w.island.rows[r].normal;
    double gap_end = contact.gap_free, speed_end = -std::numeric_limits<double>::infinity();
    if (free) {
      gap_end += normal.dot(relative(r, [&](size_t k) { return borne_path(k, h); }));
    } else {
      gap_end += normal.dot(relative(r, [&](size_t k) { return displacement_by_contact(k, h); }));
      speed_end = normal.dot(relative(r, [&](size_t k) { return w.island.velocity[k]; }));
    }
    if (gap_end > contact.touch) continue;
    make_hit(r, gap_end, speed_end, h);
    ++n;
  }
  return n;
}

// The part of the last change of the impulses expected of the hits that was too much, negative: by
// which it was too little. Each round leaves about the same share of the error, so that two of them
// show where it goes (Anderson's acceleration over one round). 0 while the hits are not those of
// the round before.
double AdvanceIsland::overshoot_of_hits() const {
  const auto same = [](const ExpectedHit& a, const ExpectedHit& b) { return a.row == b.row; };
  if (!std::ranges::equal(w.hits, w.last_hits, same)) return 0;
  double along = 0, length_sq = 0;
  for (size_t i = 0; i < w.hits.size(); ++i) {
    const double per_damping = 1 / w.island.rows[w.hits[i].row].normal_damping;
    const double difference = w.hits[i].error - w.last_hits[i].error;
    along += per_damping * w.hits[i].error * difference;
    length_sq += per_damping * difference * difference;
  }
  return length_sq > 0 ? std::clamp(along / length_sq, -1.0, 0.5) : 0;
}

// Moves the targets of the hits by what finite stiffness left: the largest error, of the speed.
double AdvanceIsland::correct_hits() {
  double worst = 0;
  w.hits.swap(w.last_hits);
  w.hits.clear();
  for (size_t r = 0; r < w.contacts.size(); ++r) {
    const IslandContact& contact = w.contacts[r];
    const IslandRow& row = w.island.rows[r];
    const double p_n = row.normal.dot(row.impulse);
    if (!contact.hit || p_n <= 0) continue;
    const double expected = -row.normal_damping * (row.bias + contact.target);
    w.hits.push_back({r, p_n, p_n - expected});
    worst = std::max(worst, std::abs(p_n - expected) / row.normal_damping / -contact.hit_speed);
  }
  const double overshoot = overshoot_of_hits();
  for (size_t i = 0; i < w.hits.size(); ++i) {
    IslandRow& row = w.island.rows[w.hits[i].row];
    double expected = w.hits[i].impulse;
    if (overshoot != 0)
      expected = std::max(0.0, expected - overshoot * (expected - w.last_hits[i].impulse));
    row.bias = -w.contacts[w.hits[i].row].target - expected / row.normal_damping;
    note_change(w.hits[i].row);
  }
  return worst;
}

double AdvanceIsland::fastest() const {
  double speed = 0;
  for (size_t k = 0; k < w.members.size(); ++k)
    speed = std::max(speed, w.substeps[k].start.velocity.norm());
  return speed;
}

// Speed of the fastest hit.
double AdvanceIsland::fastest_hit() const {
  double fastest = 0;
  for (const IslandContact& contact : w.contacts)
    if (contact.hit) fastest = std::max(fastest, -contact.hit_speed);
  return fastest;
}

bool AdvanceIsland::solve_once(double h, bool continues) {
  IslandSettings settings;
  settings.continues = continues;
  const double by_gravity = scene.gravity.norm() * h;
  settings.tolerance = small_tolerance * by_gravity;
  settings.direct_bodies = small ? static_cast<int>(w.members.size()) : 0;
  if (!small) {
    const double by_motion = std::clamp(motion_tolerance * fastest(), rest_tolerance * by_gravity,
                                        island_tolerance * by_gravity);
    settings.tolerance = std::max(by_motion, hit_tolerance * fastest_hit());
    settings.linear_tolerance = linear_tolerance;
  }
  settings.tolerance *= scene.settings.tolerance_factor;
  const IslandResult solved = solve_island(w.island, settings, w.solver);
  for (BodyPair& pair : w.island.pairs) pair.changed = false;
  report.passes += solved.passes;
  return solved.converged;
}

// Where the substep of a lone block has to end, since it is hit on the way; h + 1: nowhere.
double AdvanceIsland::first_hit(double h) const {
  double first = h + 1;
  if (!is_lone() || lone_hits >= most_lone_hits) return first;
  for (const IslandContact& contact : w.contacts)
    if (contact.hit && contact.hit_time > hit_at_start * h && contact.hit_time < h)
      first = std::min(first, contact.hit_time);
  return first;
}

// Impulses of the substep, hits included; gives up where first_hit() says that it ends sooner.
bool AdvanceIsland::solve(double h) {
  bear_until_hit(h);
  n_hits = find_hits(h, true);
  if (first_hit(h) < h) return true;
  w.hits.clear();
  set_times(h);
  const double tolerance = small ? small_hit_tolerance : hit_tolerance;
  bool converged = solve_once(h, false);
  for (int round = 0; round < most_hit_rounds && converged; ++round) {
    if (round == 0 && bear_by_opened()) {
      converged = solve_once(h, true);
      if (!converged) break;
    }
    const int more = find_hits(h, false);
    n_hits += more;
    if (n_hits == 0 || first_hit(h) < h) return true;
    set_targets(h);
    const double error = correct_hits();
    if (more > 0) set_times(h);
    if (more == 0 && error <= tolerance) break;
    converged = solve_once(h, true);
  }
  if (converged && work_on_velocities() > -loss_in_turn()) {
    forgo_rebound();
    converged = solve_once(h, true);
    if (converged && correct_hits() > tolerance) converged = solve_once(h, true);
  }
  return converged;
}

bool AdvanceIsland::is_closed() const {
  return std::none_of(w.contacts.begin(), w.contacts.end(),
                      [](const IslandContact& contact) { return contact.b < 0; });
}

// When each member's velocity changes, on the mean over the expected impulses: a contact that
// presses all along acts in the middle of the substep, a hit at its time. Lever arms count from
// where the members are then, so that angular momentum is kept. An island that touches nothing
// else takes one time for all: different ones would move its centre of mass.
void AdvanceIsland::set_times(double h) {
  w.last_time.swap(w.time);
  w.last_time.resize(w.members.size());
  w.time.assign(w.members.size(), h / 2);
  const bool any_hit = std::any_of(w.contacts.begin(), w.contacts.end(),
                                   [](const IslandContact& contact) { return contact.hit; });
  if (any_hit) find_mean_times(h);
  for (size_t k = 0; k < w.members.size(); ++k)
    w.island.position[k] = w.substeps[k].free.pose.position -
                           (h - w.time[k]) * w.substeps[k].free.velocity +
                           borne_path(k, w.time[k]).head<3>();
  if (any_hit) shift_arms(h);
}

void AdvanceIsland::find_mean_times(double h) {
  w.weight.assign(w.members.size(), 0);
  w.time.assign(w.members.size(), 0);
  for (size_t r = 0; r < w.contacts.size(); ++r) {
    const IslandContact& contact = w.contacts[r];
    const double p = w.island.rows[r].impulse.norm();
    const double t = contact.hit ? contact.hit_time : h / 2;
    for (const int b : {contact.a, contact.b}) {
      if (b < 0) continue;
      w.weight[place(b)] += p;
      w.time[place(b)] += p * t;
    }
  }
  if (is_closed()) {
    const double weight = std::accumulate(w.weight.begin(), w.weight.end(), 0.0);
    const double time = std::accumulate(w.time.begin(), w.time.end(), 0.0);
    std::fill(w.weight.begin(), w.weight.end(), weight);
    std::fill(w.time.begin(), w.time.end(), time);
  }
  for (size_t k = 0; k < w.members.size(); ++k)
    w.time[k] = w.weight[k] > 0 ? w.time[k] / w.weight[k] : h / 2;
}

void AdvanceIsland::shift_arms(double h) {
  for (size_t r = 0; r < w.contacts.size(); ++r) {
    const IslandContact& contact = w.contacts[r];
    if (contact.b < 0) continue;
    const size_t ka = place(contact.a), kb = place(contact.b);
    w.island.rows[r].arm = contact.arm + ((w.time[kb] - h / 2) * w.substeps[kb].free.velocity -
                                          (w.time[ka] - h / 2) * w.substeps[ka].free.velocity) /
                                             2;
    if (w.time[ka] != w.last_time[ka] || w.time[kb] != w.last_time[kb]) note_change(r);
  }
}

void AdvanceIsland::set_displacements(double h) {
  w.displacement.resize(w.members.size());
  for (size_t k = 0; k < w.members.size(); ++k) {
    w.displacement[k] = displacement_by_contact(k, h);
  }
}

}  // namespace talus
