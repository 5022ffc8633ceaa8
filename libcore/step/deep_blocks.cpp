// Finds blocks that are deep in the ground, a block or a fence at the end of a step.
#include "step/deep_blocks.hpp"

#include <algorithm>

#include "scene/yielding.hpp"
#include "solver/law_numbers.hpp"
#include "step/flight.hpp"
#include "step/substep.hpp"

namespace talus {
namespace {

using std::size_t;

struct Overlap {
  double depth = 0;  ///< [m]
  int partner = ground_name;
};

// Bodies of the listed pairs of parts of which one is a suspect.
template <class Visit>
void for_each_listed(const Scene& scene, const State& state, const DeepWork& w, Visit&& visit) {
  const auto is_suspect = [&](int body) {
    return body < n_blocks(scene) && w.is_suspect[body] != 0;
  };
  for (const PairWatch& pair : state.pairs.watch) {
    const int a = scene.blocks.hulls.body[pair.part_a], b = scene.blocks.hulls.body[pair.part_b];
    const bool is_there = !carries_nothing(phase_of(state, a)) &&
                          (is_fixed(scene, b) || !carries_nothing(phase_of(state, b)));
    if (is_there && (is_suspect(a) || is_suspect(b))) visit(pair, a, b);
  }
}

// Places the suspects and the bodies that they may overlap where they are at the end of the step.
void place_suspects(const Scene& scene, const State& state, DeepWork& w) {
  const auto n = static_cast<size_t>(n_blocks(scene));
  w.poses.resize(n);
  w.moving = w.is_suspect;
  for_each_listed(scene, state, w, [&](const PairWatch&, int a, int b) {
    w.moving[a] = 1;
    if (!is_fixed(scene, b)) w.moving[b] = 1;
  });
  for (size_t b = 0; b < n; ++b)
    if (w.moving[b] != 0)
      w.poses[b] = motion_at(scene, state, static_cast<int>(b), state.time).pose;
  w.stretch.clear();
  if (!state.strain.empty()) {
    w.stretch.assign(w.poses.size(), Mat3::Identity());
    for (size_t b = 0; b < n; ++b) w.stretch[b] = stretch_of(state, static_cast<int>(b));
  }
  place_hulls(scene.blocks.hulls, w.poses, w.stretch, w.moving, w.placed);
}

// Whether body b is an obstacle to block a, and if it is a fixed one, placed where a finds it.
bool is_placed_for(const Scene& scene, const State& state, int a, int b, DeepWork& w) {
  if (!is_fixed(scene, b)) return true;
  const int world = world_of(scene, a), body = fixed_of(scene, b);
  if (!stands(scene, state, world, body)) return false;
  place_body(scene.blocks.hulls, b, fixed_pose(scene, state, world, body), w.placed);
  return true;
}

// Which of the bodies of a pair is in the other: the thinner block.
int thinner_of(const Scene& scene, int a, int b) {
  if (is_fixed(scene, b)) return a;
  const std::vector<double>& thickness = scene.blocks.shapes.thickness;
  return thickness[b] < thickness[a] ? b : a;
}

// Overlaps that are neither deep nor more than `largest` [m] may be left out.
void measure_pairs(const Scene& scene, const State& state, double largest, DeepWork& w) {
  w.overlap_depth.assign(w.is_suspect.size(), 0);
  w.overlap_partner.assign(w.is_suspect.size(), ground_name);
  int last_a = -1, last_b = -1;
  for_each_listed(scene, state, w, [&](const PairWatch&, int a, int b) {
    const int thin = thinner_of(scene, a, b);
    const auto i = static_cast<size_t>(thin);
    if (w.is_suspect[i] == 0) return;
    if (a == last_a && b == last_b) return;  // another pair of parts of the same bodies
    last_a = a;
    last_b = b;
    if (!is_placed_for(scene, state, a, b, w)) return;
    const double deep = law::deep_share * scene.blocks.shapes.thickness[i];
    const double ignored = std::max(w.overlap_depth[i], std::min(largest, deep));
    const double depth = body_overlap(scene.blocks.hulls, w.placed, a, b, ignored, w.overlaps);
    if (depth <= w.overlap_depth[i]) return;
    w.overlap_depth[i] = depth;
    w.overlap_partner[i] = name_of_body(scene, thin == a ? b : a);
  });
}

Overlap overlap_of(const Scene& scene, int b, DeepWork& w) {
  const auto i = static_cast<size_t>(b);
  double in_ground = 0;
  if (scene.settings.trn_contacts)
    in_ground = depth_in_ground(scene.ground.trn, scene.blocks.hulls, w.placed, b, w.ground);
  if (in_ground >= w.overlap_depth[i]) return {in_ground, ground_name};
  return {w.overlap_depth[i], w.overlap_partner[i]};
}

void take(const Overlap& overlap, const Vec3& at, double time, DeepBlock& deep) {
  if (deep.steps == 0) deep.first_time = time;
  if (overlap.depth <= deep.depth) return;
  deep.depth = overlap.depth;
  deep.partner = overlap.partner;
  deep.time = time;
  deep.place = at;
}

// Faster than its fall so far, and one by its radius, can have made it. Base motion and loads give
// energy besides: nothing is said then.
bool is_too_fast(const Scene& scene, const State& state, size_t b) {
  if (shakes(scene.base) || !scene.loads.empty()) return false;
  const Motion motion = motion_at(scene, state, static_cast<int>(b), state.time);
  const Blocks& blocks = scene.blocks;
  const double fall = scene.gravity.dot(motion.pose.position - blocks.rest[b].position) +
                      scene.gravity.norm() * blocks.shapes.radius[b];
  return motion.velocity.squaredNorm() > 2 * fall + blocks.velocity[b].squaredNorm();
}

// The body that a block is in, by its overlap and not by its contact.
int partner_of(const Scene& scene, const State& state, int b, DeepWork& w) {
  w.is_suspect[static_cast<size_t>(b)] = 1;
  place_suspects(scene, state, w);
  measure_pairs(scene, state, 0, w);
  w.is_suspect[static_cast<size_t>(b)] = 0;
  return overlap_of(scene, b, w).partner;
}

void note_deepest(const Scene& scene, State& state, DeepWork& w, const StepReport& report) {
  NumericalFault& deepest = state.numerical_faults.deepest;
  if (report.deepest_block < 0 || report.largest_penetration <= deepest.depth) return;
  const int b = report.deepest_block;
  deepest = {b, partner_of(scene, state, b, w), report.largest_penetration, state.time,
             motion_at(scene, state, b, state.time).pose.position};
}

}  // namespace

DeepWork make_deep_work(const Scene& scene) {
  constexpr size_t expected_corners = 64;  // of a polygon that a body cuts out of the ground
  DeepWork w;
  const auto n = static_cast<size_t>(n_blocks(scene));
  w.is_suspect.resize(n);
  w.moving.assign(n, 1);
  w.overlap_depth.resize(n);
  w.overlap_partner.resize(n);
  w.poses.assign(scene.blocks.rest.begin(), scene.blocks.rest.end());
  w.poses.insert(w.poses.end(), scene.fixed.pose.begin(), scene.fixed.pose.end());
  if (scene.settings.strains) w.stretch.reserve(w.poses.size());
  place_hulls(scene.blocks.hulls, w.poses, {}, w.moving, w.placed);
  w.ground.polygon.reserve(expected_corners);
  w.ground.clipped.reserve(expected_corners);
  return w;
}

void note_deep_blocks(const Scene& scene, State& state, DeepWork& w, StepReport& report) {
  const bool any = std::find(w.is_suspect.begin(), w.is_suspect.end(), 1) != w.is_suspect.end();
  if (any) {
    place_suspects(scene, state, w);
    measure_pairs(scene, state, report.largest_penetration, w);
  }
  for (size_t b = 0; b < state.deep.size(); ++b) {
    DeepBlock& deep = state.deep[b];
    const Phase phase = state.phase[b];
    if (w.is_suspect[b] != 0 && takes_part(phase)) {
      const Overlap overlap = overlap_of(scene, static_cast<int>(b), w);
      if (overlap.depth > report.largest_penetration) {
        report.largest_penetration = overlap.depth;
        report.deepest_block = static_cast<int>(b);
      }
      deep.is_deep = overlap.depth > law::deep_share * scene.blocks.shapes.thickness[b];
      if (deep.is_deep) take(overlap, state.motion[b].pose.position, state.time, deep);
    } else if (phase != Phase::asleep) {  // asleep it stays as deep as it was
      deep.is_deep = false;
    }
    w.is_suspect[b] = 0;
    if (deep.is_deep) {
      ++deep.steps;
      report.flags = report.flags | StepFlag::deep;
    }
    if (deep.steps > 0 && takes_part(phase)) deep.is_too_fast |= is_too_fast(scene, state, b);
  }
  note_deepest(scene, state, w, report);
}

}  // namespace talus
