#include <algorithm>
#include <cmath>

#include "dda/advance_island.hpp"
#include "dda/fence.hpp"
#include "dda/flight.hpp"
#include "dda/rotation.hpp"
#include "dda/step_island.hpp"

namespace talus {
namespace {

using std::size_t;

// k_n dt^2 / m of a contact in an island: bounds the condition of its matrix ...
constexpr double stiffest_in_island = 1;
// ... and where it is small enough to be factored, so that a tower hardly sags.
constexpr double stiffest_in_small_island = 30;
constexpr double bears_little = 3;  // stiffness of a contact that does: times that for its own mass
constexpr double most_sag = 2;      // under load, before it is stiffer: times that of a block alone
constexpr size_t small_island = 8;
constexpr size_t small_tree = 64;  // the same where blocks hang together without a ring: a column
constexpr double most_turn = 0.5;  // in a substep [rad]
// Relative to a neighbour in a substep, of the thickness: so far in may be what no axis foresaw.
constexpr double most_travel = 0.1;
constexpr double most_substeps = 64;  // for these reasons

Vec3 spin_of(const Motion& m, const Vec3& inertia) {
  return angular_velocity(m.pose.attitude, m.angular_momentum, inertia);
}

// So near do pairs come together in `h` besides their motion without contact [m].
double pair_margin(const Scene& scene, double h) {
  BlockNumbers largest;
  largest.gravity = scene.gravity.norm();
  for (const double radius : scene.blocks.shapes.radius)
    largest.radius = std::max(largest.radius, radius);
  return search_margin(largest, h);
}

// Whether block b touches no fixed body within the step, seen from balls around them: told without
// the attitude, which costs the most while a rock flies.
bool is_far_from_fixed(const Scene& scene, const State& state, int b, double margin,
                       const IslandStepWork& w) {
  const auto i = static_cast<size_t>(b);
  const Motion& m = state.motion[i];
  const double h = scene.settings.dt;
  const double t = state.phase[i] == Phase::flight ? state.time - state.local_time[i] : 0;
  const Vec3 at = m.pose.position + t * (m.velocity + t / 2 * scene.gravity);
  const double step = h * (m.velocity + t * scene.gravity).norm(),
               turn = h * m.angular_momentum.norm() / scene.blocks.inertia[i].minCoeff();
  const std::vector<double>& radius = scene.blocks.hulls.radius;
  const double reach = margin + step + (1 + turn) * radius[i];
  for (size_t f = static_cast<size_t>(n_blocks(scene)); f < radius.size(); ++f) {
    const double apart = radius[f] + reach;
    if ((w.poses[f].position - at).squaredNorm() <= apart * apart) return false;
  }
  return true;
}

// Contacts between the blocks marked in work.islands.moving, and of those with others, over `h`.
void find_pairs(const Scene& scene, double h, State& state, Work& work) {
  IslandStepWork& w = work.islands;
  const Blocks& blocks = scene.blocks;
  PairSettings settings;
  settings.margin = pair_margin(scene, h);
  settings.with_areas = !state.bonds.empty();
  settings.graze_m = scene.gravity.norm() * h * h / stiffest_in_island;
  place_hulls(blocks.hulls, w.poses, {}, w.moving, state.placed);
  (void)find_pair_contacts(blocks.hulls, state.placed, {w.step, w.turn, w.awake, w.fixed, w.group},
                           settings, state.pairs, w.pairs);
}

void set_motion_ahead(const Scene& scene, int b, const Motion& m, double h, IslandStepWork& w) {
  const auto i = static_cast<size_t>(b);
  w.poses[i] = m.pose;
  w.step[i] = h * m.velocity;
  w.rotation[i] = h * spin_of(m, scene.blocks.inertia[i]);
  w.turn[i] = scene.blocks.shapes.radius[i] * w.rotation[i].norm();
}

// Fixed bodies where they are now: they step nowhere and need no contacts of their own. Panels of
// fences that gave way have moved since they were placed last.
void place_fixed(const Scene& scene, const State& state, IslandStepWork& w) {
  const int n = n_blocks(scene), n_bodies = n + n_fixed(scene);
  if (n == n_bodies) return;
  w.fixed.assign(static_cast<size_t>(n_bodies), 0);
  w.group.clear();
  for (int b = n; b < n_bodies; ++b) {
    const auto i = static_cast<size_t>(b);
    w.poses[i] = fixed_pose(scene, state, b);
    w.step[i].setZero();
    w.rotation[i].setZero();
    w.turn[i] = 0;
    w.moving[i] = !state.placed.turned.empty() && state.placed.position[i] != w.poses[i].position;
    w.awake[i] = 0;
    w.fixed[i] = 1;
  }
  if (scene.settings.block_contacts) return;
  w.group.assign(static_cast<size_t>(n_bodies), 0);
  for (int b = n; b < n_bodies; ++b) w.group[static_cast<size_t>(b)] = 1;
}

// Pairs of blocks within reach; true when one of them was asleep and now is not.
bool join_pairs(const Scene& scene, State& state, IslandStepWork& w) {
  bool woken = false;
  w.joined.clear();
  w.joined_manifold.clear();
  for (size_t j = 0; j < w.pairs.manifolds.size(); ++j) {
    const PairManifold& m = w.pairs.manifolds[j];
    if (is_fixed(scene, m.block_b)) {
      if (!takes_part(state, m.block_a) || !stands(scene, state, m.block_b)) continue;
      w.joined.emplace_back(m.block_a, -1);
      w.joined_manifold.push_back(static_cast<int>(j));
      w.near_fixed[static_cast<size_t>(m.block_a)] = 1;
      continue;
    }
    if (!takes_part(state, m.block_a) || !takes_part(state, m.block_b)) continue;
    w.joined.emplace_back(m.block_a, m.block_b);
    w.joined_manifold.push_back(static_cast<int>(j));
    for (const int b : {m.block_a, m.block_b}) {
      const auto i = static_cast<size_t>(b);
      if (state.phase[i] != Phase::asleep) continue;
      wake(state, i, state.time);
      w.awake[i] = 1;
      woken = true;
    }
  }
  return woken;
}

}  // namespace

bool AdvanceIsland::in_island(const PairManifold& m) const {
  return w.place[static_cast<size_t>(m.block_a)] >= 0 &&
         (is_fixed(scene, m.block_b) ? stands(scene, state, m.block_b)
                                     : w.place[static_cast<size_t>(m.block_b)] >= 0);
}

void AdvanceIsland::see_size() {
  const auto n_pairs =
      std::count_if(w.island_manifolds.begin(), w.island_manifolds.end(), [this](int i) {
        const PairManifold& m = w.pairs.manifolds[static_cast<size_t>(i)];
        return !is_fixed(scene, m.block_b) && has_points(m);
      });
  const size_t n = w.members.size();
  small = n <= small_island || (n <= small_tree && static_cast<size_t>(n_pairs) < n);
}

// The pairs at the poses of now, for at most `h` ahead.
void AdvanceIsland::search_pairs(double h) {
  for (size_t k = 0; k < w.members.size(); ++k) {
    w.moving[block(k)] = 1;
    set_motion_ahead(scene, w.members[k], motion(k), h, w);
  }
  w.awake = w.moving;
  place_fixed(scene, state, w);
  find_pairs(scene, h, state, work);
  for (const int b : w.members) w.moving[static_cast<size_t>(b)] = 0;
  w.pairs_of_step = false;
  w.island_manifolds.clear();
  for (size_t m = 0; m < w.pairs.manifolds.size(); ++m)
    if (in_island(w.pairs.manifolds[m])) w.island_manifolds.push_back(static_cast<int>(m));
}

// The pairs that form_islands found, those of island `k`.
void AdvanceIsland::take_pairs(int k) {
  const auto at = static_cast<size_t>(k);
  w.island_manifolds.clear();
  for (int p = w.groups.pair_begin[at]; p < w.groups.pair_begin[at + 1]; ++p) {
    const int m = w.joined_manifold[static_cast<size_t>(w.groups.pairs[static_cast<size_t>(p)])];
    if (in_island(w.pairs.manifolds[static_cast<size_t>(m)])) w.island_manifolds.push_back(m);
  }
}

// A small block may bear a large one: its contacts are up to as stiff as the heaviest block that it
// touches asks for, those of a large island only as far as they bear as much. Stiff ones that do
// not press a small block with forces that are far beyond its weight as soon as they close, and
// solving an island with many of them takes tens of factorisations. In the first step nobody knows
// what they bear.
void AdvanceIsland::set_stiffness() {
  w.bearing.clear();
  for (const BlockNumbers& c : w.numbers) w.bearing.push_back(c.mass);
  for (const int i : w.island_manifolds) {
    const PairManifold& m = w.pairs.manifolds[static_cast<size_t>(i)];
    if (is_fixed(scene, m.block_b) || !has_points(m)) continue;
    double &a = w.bearing[place(m.block_a)], &b = w.bearing[place(m.block_b)];
    a = std::max(a, numbers(m.block_b).mass);
    b = std::max(b, numbers(m.block_a).mass);
  }
  const double per_mass = (small ? stiffest_in_small_island : stiffest_in_island) /
                          (scene.settings.dt * scene.settings.dt);
  const bool follows_load = !small && state.time > 0;
  for (size_t k = 0; k < w.members.size(); ++k) {
    BlockNumbers& c = w.numbers[k];
    c.stiffness = per_mass * w.bearing[k];
    c.least_stiffness = bears_little * per_mass * c.mass;
    c.sag = follows_load ? most_sag * scene.gravity.norm() / per_mass : 0;
  }
}

// Bounds how far a point of either part of a pair goes ahead as the other body sees it: of all
// points, and where that is more than `enough`, of those alone that may come to the other part.
double AdvanceIsland::travel_ahead(const PairManifold& m, double enough) const {
  const auto a = static_cast<size_t>(m.block_a), b = static_cast<size_t>(m.block_b);
  const Hulls& hulls = scene.blocks.hulls;
  const auto travel_at = [&](const Vec3& x) {
    return (w.step[a] - w.step[b] + w.rotation[a].cross(x - w.poses[a].position) -
            w.rotation[b].cross(x - w.poses[b].position))
        .norm();
  };
  const size_t smaller = hulls.radius[b] < hulls.radius[a] ? b : a;
  double travel = travel_at(w.poses[smaller].position) +
                  (w.rotation[a] - w.rotation[b]).norm() * hulls.radius[smaller];
  if (travel <= enough) return travel;
  const Box box_a = box_of_part(hulls, state.placed, m.part_a),
            box_b = box_of_part(hulls, state.placed, m.part_b);
  for (int pass = 0; pass < 2; ++pass) {  // what is known after the first makes the box smaller
    const Vec3 around = Vec3::Constant(travel);
    const Vec3 both_low = box_a.low.cwiseMax(box_b.low) - around,
               both_high = box_a.high.cwiseMin(box_b.high) + around;
    if ((both_low.array() > both_high.array()).any()) return 0;
    const Vec3 low = both_low.cwiseMax(box_a.low.cwiseMin(box_b.low)),
               high = both_high.cwiseMin(box_a.high.cwiseMax(box_b.high));
    double farthest = 0;  // in one of the corners, since the motion is linear in place
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 x((corner & 1) != 0 ? high.x() : low.x(), (corner & 2) != 0 ? high.y() : low.y(),
                   (corner & 4) != 0 ? high.z() : low.z());
      farthest = std::max(farthest, travel_at(x));
    }
    travel = std::min(travel, farthest);
  }
  return travel;
}

// The longest substep over which the contacts found at its start still describe the motion.
double AdvanceIsland::longest_substep(double h) const {
  double part = 0;
  for (size_t k = 0; k < w.members.size(); ++k)
    part = std::max(part, w.turn[block(k)] / (most_turn * w.numbers[k].radius));
  for (const int i : w.island_manifolds) {
    const PairManifold& m = w.pairs.manifolds[static_cast<size_t>(i)];
    double thickness = numbers(m.block_a).thickness;
    if (!is_fixed(scene, m.block_b)) thickness = std::min(thickness, numbers(m.block_b).thickness);
    const double enough = most_travel * thickness;
    part = std::max(part, travel_ahead(m, enough) / enough);
  }
  const double shortest = std::min(h, scene.settings.dt / most_substeps);
  return part > 1 ? std::max(h / std::ceil(part), shortest) : h;
}

void form_islands(const Scene& scene, State& state, Work& work) {
  IslandStepWork& w = work.islands;
  const int n = n_blocks(scene);
  const auto size = static_cast<size_t>(n + n_fixed(scene));
  w.near_fixed.assign(static_cast<size_t>(n), scene.settings.trn_contacts ? 0 : 1);
  w.poses.resize(size);
  w.step.resize(size);
  w.rotation.resize(size);
  w.turn.resize(size);
  w.moving.assign(size, 1);
  w.awake.resize(size);
  place_fixed(scene, state, w);
  // the full plan and blocks that meet each other follow all of them
  const bool may_be_far = scene.settings.flight && scene.settings.trn_contacts &&
                          (n == 1 || !scene.settings.block_contacts);
  const bool none_placed = state.placed.turned.size() != size;
  const double margin = pair_margin(scene, scene.settings.dt);
  int n_near = 0;
  for (int b = 0; b < n; ++b) {
    const auto i = static_cast<size_t>(b);
    const bool moves = !does_not_move(state.phase[i]);
    const bool is_near = !may_be_far || (moves && !is_far_from_fixed(scene, state, b, margin, w));
    n_near += is_near;
    w.moving[i] = is_near || none_placed;
    w.awake[i] = is_near && moves;
    w.step[i].setZero();
    w.turn[i] = 0;
    if (w.moving[i] != 0)
      set_motion_ahead(scene, b, motion_at(scene, state, b, state.time), scene.settings.dt, w);
  }
  if (n_near == 0) {
    find_islands(n, {}, {}, w.groups);
    return;
  }
  do find_pairs(scene, scene.settings.dt, state, work);
  while (join_pairs(scene, state, w));
  find_islands(n, w.joined, {}, w.groups);
  w.moving.assign(size, 0);
  w.place.assign(size, -1);
  w.pairs_of_step = true;
  const auto end_flight_of = [&](int b) {
    if (b >= 0 && state.phase[static_cast<size_t>(b)] == Phase::flight)
      end_flight(scene, b, state.time, state, work);
  };
  for (const auto& [a, b] : w.joined) end_flight_of(a), end_flight_of(b);
}

void put_island_to_sleep(const Scene& scene, int k, State& state, const Work& work) {
  const IslandGroups& groups = work.islands.groups;
  const auto at = static_cast<size_t>(k);
  const std::span<const int> blocks(
      groups.blocks.data() + groups.block_begin[at],
      static_cast<size_t>(groups.block_begin[at + 1] - groups.block_begin[at]));
  int steps = steps_before_sleep;
  for (const int b : blocks) {
    if (!takes_part(state, b)) continue;
    watch_rest(scene, static_cast<size_t>(b), state);
    steps = std::min(steps, state.rest_steps[static_cast<size_t>(b)]);
  }
  if (steps < steps_before_sleep) return;
  for (const int b : blocks)
    if (takes_part(state, b)) fall_asleep(scene, static_cast<size_t>(b), state);
}

}  // namespace talus
