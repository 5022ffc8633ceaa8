// Stage 2 of an island's step, and the work before all islands: which blocks meet, and how long a
// substep may be.
#include <algorithm>
#include <cmath>

#include "motion/rotation.hpp"
#include "scene/stems.hpp"
#include "scene/yielding.hpp"
#include "solver/island_groups.hpp"
#include "solver/law_numbers.hpp"
#include "step/flight.hpp"
#include "step/island/stages.hpp"
#include "step/island/stems.hpp"
#include "step/island/step_island.hpp"
#include "step/mass/stages.hpp"
#include "step/rough_joints.hpp"
#include "step/substep.hpp"

namespace talus {
namespace {

using std::size_t;

using law::most_substeps, law::most_turn;

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
                       PairSearch& search) {
  const auto i = static_cast<size_t>(b);
  const Motion& m = state.motion[i];
  const double h = step_length(scene, state);
  const double t = state.phase[i] == Phase::flight ? state.time - state.local_time[i] : 0;
  const Vec3 at = m.pose.position + t * (m.velocity + t / 2 * scene.gravity);
  const double step = h * (m.velocity + t * scene.gravity).norm(),
               turn = h * m.angular_momentum.norm() / scene.blocks.inertia[i].minCoeff();
  const std::vector<double>& radius = scene.blocks.hulls.radius;
  const double reach = margin + step + (1 + turn) * radius[i];
  const auto is_near = [&](int body) {
    const auto f = static_cast<size_t>(body);
    const double apart = radius[f] + reach;
    return (search.poses[f].position - at).squaredNorm() <= apart * apart;
  };
  const Vec3 around = Vec3::Constant(reach);
  find_near(search.grid, {at - around, at + around}, search.near);
  search.n_fixed_near += static_cast<std::int64_t>(search.near.size() + search.shifted.size());
  return std::none_of(search.near.begin(), search.near.end(),
                      [&](int f) { return is_near(hull_of_fixed(scene, f)); }) &&
         std::none_of(search.shifted.begin(), search.shifted.end(), is_near) &&
         is_far_from_stems(scene, state, b, at, reach, search);
}

// Where the fixed bodies are that rocks which fall one by one have pushed, each its own.
class OwnShifts final : public ShiftedBodies {
 public:
  OwnShifts(const Scene& scene, const State& state) : scene_(scene), state_(state) {}
  [[nodiscard]] bool any() const {
    return !shares_world(scene_) && !scene_.fixed.yieldings.empty();
  }
  void of(int free, std::vector<ShiftedBody>& out) const override {
    const int world = world_of(scene_, free);
    for_each_shifted(scene_, state_, world, [&](int f) {
      out.push_back(
          {hull_of_fixed(scene_, f), scene_.fixed.pose[f], fixed_pose(scene_, state_, world, f)});
    });
  }

 private:
  const Scene& scene_;
  const State& state_;
};

// Contacts between the blocks marked in `search.moving`, and of those with unmarked ones, over `h`.
void search_marked(const Scene& scene, double h, State& state, PairSearch& search) {
  const Blocks& blocks = scene.blocks;
  PairSettings settings;
  settings.margin = pair_margin(scene, h);
  settings.with_areas = !state.bonds.empty() || has_rough_joints(scene);
  settings.workers = search.workers;
  settings.closing = mass_reach(scene, h) + scene.gravity.norm() * h * h;
  search.in_mass.clear();
  for (const MassShare& share : state.mass) search.in_mass.push_back(share.is_in_mass ? 1 : 0);
  settings.graze_m = scene.gravity.norm() * h * h;
  const std::span<const Pose> poses = search.poses;
  const bool none_placed = state.placed.turned.size() != poses.size();
  const OwnShifts own(scene, state);
  place_hulls(blocks.hulls, none_placed ? poses : poses.first(static_cast<size_t>(n_blocks(scene))),
              {}, search.moving, state.placed, search.workers);
  for (const int body : search.shifted) place_body(blocks.hulls, body, poses[body], state.placed);
  const PairReport found =
      find_pair_contacts(blocks.hulls, state.placed,
                         {search.step, search.turn, search.awake, n_fixed(scene), &search.grid,
                          search.shifted, scene.settings.block_contacts, own.any() ? &own : nullptr,
                          search.absent, search.in_mass, search.rotation},
                         settings, state.pairs, search.pairs);
  search.n_fixed_near += found.n_fixed_near;
  add_stem_pairs(scene, state, settings.margin, search);
}

void set_motion_ahead(const Scene& scene, int b, const Motion& m, double h, PairSearch& search) {
  const auto i = static_cast<size_t>(b);
  search.poses[i] = m.pose;
  search.step[i] = h * m.velocity;
  search.rotation[i] = h * spin_of(m, scene.blocks.inertia[i]);
  search.turn[i] = scene.blocks.shapes.radius[i] * search.rotation[i].norm();
}

// The fixed bodies in their first places: they do not move in a step.
void place_at_rest(const Scene& scene, PairSearch& search) {
  std::vector<Vec3> centre;
  for (int f = 0; f < n_fixed(scene); ++f) {
    const auto i = static_cast<size_t>(hull_of_fixed(scene, f));
    search.poses[i] = scene.fixed.pose[f];
    search.step[i].setZero();
    search.rotation[i].setZero();
    search.turn[i] = 0;
    centre.push_back(search.poses[i].position);
  }
  const std::span<const double> radius = scene.blocks.hulls.radius;
  search.grid = make_body_grid(centre, radius.last(centre.size()));
  search.shifted.clear();
}

// Fixed bodies where they are now in the shared world, or else in their first places. Those that
// were never pushed are not looked at.
void place_fixed(const Scene& scene, State& state, PairSearch& search) {
  if (n_fixed(scene) == 0) return;
  if (search.grid.n_bodies != n_fixed(scene)) place_at_rest(scene, search);
  if (!shares_world(scene)) return place_own_fixed(scene, -1, state, search);
  for (const int body : search.shifted)  // by this state or by one before it
    search.poses[body] = scene.fixed.pose[fixed_of(scene, body)];
  search.shifted.clear();
  for (const int f : state.yielding.shifted) {
    const int body = hull_of_fixed(scene, f);
    search.shifted.push_back(body);
    search.poses[body] = fixed_pose(scene, state, 0, f);
  }
}

// Whether the fixed body of a manifold exists for its block.
bool stands_for(const Scene& scene, const State& state, const PairManifold& m) {
  return stands(scene, state, world_of(scene, m.block_a), fixed_of(scene, m.block_b));
}

// Pairs of blocks within reach. Blocks asleep are in the island of awake ones near them; contacts
// between sleeping blocks join no islands.
void join_pairs(const Scene& scene, const State& state, PairSearch& search) {
  search.joined.clear();
  search.joined_manifold.clear();
  for (size_t j = 0; j < search.pairs.manifolds.size(); ++j) {
    const PairManifold& m = search.pairs.manifolds[j];
    if (is_fixed(scene, m.block_b)) {
      if (!takes_part(state, m.block_a) || !stands_for(scene, state, m)) continue;
      search.joined.emplace_back(m.block_a, -1);
      search.joined_manifold.push_back(static_cast<int>(j));
      search.near_fixed[m.block_a] = 1;
      continue;
    }
    if (!takes_part(state, m.block_a) || !takes_part(state, m.block_b)) continue;
    search.joined.emplace_back(m.block_a, m.block_b);
    search.joined_manifold.push_back(static_cast<int>(j));
  }
}

// Whether a manifold is between members of which one moves, or of one with a fixed body that
// exists.
bool in_island(const Scene& scene, const State& state, const IslandMembers& members,
               const PairManifold& m) {
  if (is_fixed(scene, m.block_b)) return members.moves(m.block_a) && stands_for(scene, state, m);
  return members.place[m.block_a] >= 0 && members.place[m.block_b] >= 0 &&
         (members.moves(m.block_a) || members.moves(m.block_b));
}

// Blocks asleep that members come within reach of are members.
void gather_sleepers(const Scene& scene, const State& state, const PairSearch& search,
                     IslandMembers& members) {
  std::vector<int> blocks;
  const auto add = [&](int b, int other) {
    if (phase_of(state, b) == Phase::asleep && members.place[b] < 0 && members.moves(other))
      blocks.push_back(b);
  };
  for (const PairManifold& m : search.pairs.manifolds) {
    if (is_fixed(scene, m.block_b)) continue;
    add(m.block_a, m.block_b);
    add(m.block_b, m.block_a);
  }
  if (!blocks.empty()) add_members(scene, state, blocks, members);
}

// Bounds how far a point of either part of a pair goes ahead as the other body sees it: of all
// points, and where that is more than `enough`, of those alone that may come to the other part.
double travel_ahead(const Hulls& hulls, const PlacedHulls& placed, const PairSearch& search,
                    const PairManifold& m, double enough) {
  const auto a = static_cast<size_t>(m.block_a), b = static_cast<size_t>(m.block_b);
  const auto travel_at = [&](const Vec3& x) {
    return (search.step[a] - search.step[b] +
            search.rotation[a].cross(x - search.poses[a].position) -
            search.rotation[b].cross(x - search.poses[b].position))
        .norm();
  };
  const size_t smaller = hulls.radius[b] < hulls.radius[a] ? b : a;
  double travel = travel_at(search.poses[smaller].position) +
                  (search.rotation[a] - search.rotation[b]).norm() * hulls.radius[smaller];
  if (travel <= enough) return travel;
  const Box box_a = box_of_part(hulls, placed, m.part_a),
            box_b = box_of_part(hulls, placed, m.part_b);
  for (int pass = 0; pass < 2; ++pass) {  // the data of the first pass make the box smaller
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

}  // namespace

void place_own_fixed(const Scene& scene, int b, State& state, PairSearch& search) {
  if (shares_world(scene) || scene.fixed.yieldings.empty()) return;
  const auto put = [&](int body, const Pose& pose) {
    search.poses[body] = pose;
    // before the first search nothing is placed, and nothing pushed
    if (state.placed.turned.size() == search.poses.size())
      place_body(scene.blocks.hulls, body, pose, state.placed);
  };
  for (const int body : search.shifted) put(body, scene.fixed.pose[fixed_of(scene, body)]);
  search.shifted.clear();
  if (b < 0) return;
  const int world = world_of(scene, b);
  for_each_shifted(scene, state, world, [&](int f) {
    search.shifted.push_back(hull_of_fixed(scene, f));
    put(search.shifted.back(), fixed_pose(scene, state, world, f));
  });
}

void take_pairs(const Scene& scene, const State& state, const PairSearch& search, int k,
                const IslandMembers& members, std::vector<int>& manifolds) {
  const auto at = static_cast<size_t>(k);
  manifolds.clear();
  for (int p = search.groups.pair_begin[at]; p < search.groups.pair_begin[at + 1]; ++p) {
    const int m = search.joined_manifold[search.groups.pairs[p]];
    if (in_island(scene, state, members, search.pairs.manifolds[m])) manifolds.push_back(m);
  }
}

void find_pairs(const Scene& scene, double h, State& state, PairSearch& search,
                IslandMembers& members, std::vector<int>& manifolds) {
  for (const int b : members.moving) {
    search.moving[b] = 1;
    set_motion_ahead(scene, b, state.motion[b], h, search);
  }
  search.awake = search.moving;
  place_fixed(scene, state, search);
  search_marked(scene, h, state, search);
  for (const int b : members.moving) search.moving[b] = 0;
  gather_sleepers(scene, state, search, members);
  place_own_fixed(scene, members.blocks[0], state, search);
  search.is_of_step = false;
  manifolds.clear();
  for (size_t m = 0; m < search.pairs.manifolds.size(); ++m)
    if (in_island(scene, state, members, search.pairs.manifolds[m]))
      manifolds.push_back(static_cast<int>(m));
}

double longest_substep(const Scene& scene, const State& state, const PairSearch& search,
                       const IslandMembers& members, std::span<const int> manifolds, double h) {
  double part = 0;
  for (size_t k = 0; k < members.size(); ++k)
    part = std::max(part, search.turn[members.block(k)] / (most_turn * members.numbers[k].radius));
  for (const int i : manifolds) {
    const PairManifold& m = search.pairs.manifolds[i];
    double thickness = members.of(m.block_a).thickness;
    if (is_fixed(scene, m.block_b) && is_stem(scene, fixed_of(scene, m.block_b))) {
      part = std::max(part, part_by_stem(scene, search, m, thickness));
      continue;
    }
    if (!is_fixed(scene, m.block_b))
      thickness = std::min(thickness, members.of(m.block_b).thickness);
    const double enough = law::deep_share * thickness;
    part =
        std::max(part, travel_ahead(scene.blocks.hulls, state.placed, search, m, enough) / enough);
  }
  const double shortest = std::min(h, scene.settings.dt / most_substeps);
  return part > 1 ? std::max(h / std::ceil(part), shortest) : h;
}

namespace {

// Blocks that touch nothing; none at all where nothing breaks or is crushed.
void list_absent(const State& state, std::vector<std::uint8_t>& absent) {
  absent.clear();
  if (state.hit_loss.empty() && state.crushed.empty()) return;
  for (const Phase phase : state.phase) absent.push_back(carries_nothing(phase) ? 1 : 0);
}

}  // namespace

void form_islands(const Scene& scene, State& state, Work& work) {
  PairSearch& search = work.search;
  const int n = n_blocks(scene);
  const auto size = static_cast<size_t>(n + n_fixed(scene));
  search.near_fixed.assign(n, scene.settings.trn_contacts ? 0 : 1);
  search.poses.resize(size);
  search.step.resize(size);
  search.rotation.resize(size);
  search.turn.resize(size);
  search.moving.assign(n, 1);
  search.awake.resize(n);
  list_absent(state, search.absent);
  place_fixed(scene, state, search);
  // the full plan and blocks that meet each other follow all of them
  const bool may_be_far = scene.settings.flight && scene.settings.trn_contacts &&
                          (n == 1 || !scene.settings.block_contacts);
  const bool none_placed = state.placed.turned.size() != size;
  const double h = step_length(scene, state), margin = pair_margin(scene, h);
  int n_near = 0;
  for (int b = 0; b < n; ++b) {
    const auto i = static_cast<size_t>(b);
    const bool moves = !does_not_move(state.phase[i]);
    if (may_be_far && moves) place_own_fixed(scene, b, state, search);
    const bool is_near =
        !may_be_far || (moves && !is_far_from_fixed(scene, state, b, margin, search));
    n_near += is_near;
    const bool is_there = search.absent.empty() || search.absent[i] == 0;
    search.moving[i] = (is_near && is_there) || none_placed;
    search.awake[i] = is_near && moves;
    search.step[i].setZero();
    search.turn[i] = 0;
    if (search.moving[i] != 0)
      set_motion_ahead(scene, b, motion_at(scene, state, b, state.time), h, search);
  }
  place_own_fixed(scene, -1, state, search);
  if (n_near == 0) {
    find_islands(n, {}, {}, search.groups);
    return;
  }
  do {
    search_marked(scene, h, state, search);
    join_pairs(scene, state, search);
    find_islands(n, search.joined, {}, search.groups);
  } while (wake_before_step(scene, state, search));
  search.moving.assign(n, 0);
  search.is_of_step = true;
}

}  // namespace talus
