// Yielding fixed bodies: place, resistance, pushes, breaking.
#include "scene/yielding.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "contact/scales.hpp"
#include "scene/sleep.hpp"
#include "scene/stems.hpp"
#include "solver/law_numbers.hpp"

namespace talus {
namespace {

using std::size_t;

bool has_axis(const Yielding& yielding) { return !yielding.axis.isZero(0); }

// The bodies with hulls that yield, then the stems.
int n_with_hulls(const Scene& scene) { return static_cast<int>(scene.fixed.yieldings.size()); }

const Yielding& yielding_of(const Scene& scene, int y) {
  const int n = n_with_hulls(scene);
  return y < n ? scene.fixed.yieldings[y] : scene.forest.yieldings[y - n];
}

int hardest_pusher(std::span<const YieldPush> pushes, int yielding) {
  const auto work_on = [yielding](const YieldPush& p) {
    return p.yielding == yielding ? p.work : -1;
  };
  return std::max_element(
             pushes.begin(), pushes.end(),
             [&](const YieldPush& a, const YieldPush& b) { return work_on(a) < work_on(b); })
      ->block;
}

void wake_sleepers_at(const Scene& scene, int body, int world, State& state) {
  const int name = name_of_fixed(body);
  // a rock that is alone in its world has the world's number
  const bool is_alone = !shares_world(scene) && scene.fragments.empty();
  const size_t first = is_alone ? static_cast<size_t>(world) : 0;
  const size_t end = is_alone ? first + 1 : state.memory.size();
  for (size_t b = first; b < end; ++b) {
    if (state.phase[b] != Phase::asleep || world_of(scene, static_cast<int>(b)) != world) continue;
    const auto touches = [name](const ContactMemory& m) { return m.key.body_b == name; };
    if (std::any_of(state.memory[b].begin(), state.memory[b].end(), touches))
      wake_bonded(static_cast<int>(b), state.time, state);
  }
}

// Bodies are pushed on to where the block that pushes farthest is, never back.
void deflect(const Yielding& yielding, const YieldPush& push, Yielded& met) {
  if (push.shift == 0) return;
  if (!has_axis(yielding)) {
    const double left = push.to - push.along.dot(met.shift);
    if (push.shift < 0 ? left < 0 : left > 0) met.shift += left * push.along;
    return;
  }
  met.deflection =
      push.shift < 0 ? std::min(met.deflection, push.to) : std::max(met.deflection, push.to);
}

// Where blocks share it, the search of pairs follows where a body is. Where each rock pushes its
// own, that follows how far all of them together pushed it: no rock's is farther.
void note_shifted(const Scene& scene, int body, const Yielded& before, const Yielded& met,
                  State& state) {
  if (!shares_world(scene)) {
    std::vector<double>& travel = state.pairs.travel;
    if (!travel.empty())
      travel[static_cast<size_t>(hull_of_fixed(scene, body))] +=
          std::abs(met.deflection - before.deflection) + (met.shift - before.shift).norm();
    return;
  }
  if (met.deflection == 0 && met.shift.isZero(0)) return;
  std::vector<int>& shifted = state.yielding.shifted;
  if (std::find(shifted.begin(), shifted.end(), body) == shifted.end()) shifted.push_back(body);
}

}  // namespace

int add_fixed_body(Scene& scene, const Polyhedron& body, int contact_class) {
  TALUS_ASSERT(n_bodies(scene.blocks.hulls) == n_blocks(scene) + n_fixed(scene));
  const Vec3 centroid = moments(body).centroid;
  add_hulls(scene.blocks.hulls, std::span(&body, 1), centroid, Mat3::Identity(), true);
  scene.fixed.pose.push_back({centroid, Quat::Identity()});
  scene.fixed.contact_class.push_back(contact_class);
  scene.fixed.yielding.push_back(-1);
  scene.fixed.panel.push_back(-1);
  return n_fixed(scene) - 1;
}

int let_yield(Scene& scene, int body, Yielding how) {
  const int number = static_cast<int>(scene.fixed.yieldings.size());
  how.body = body;
  scene.fixed.yielding[body] = number;
  scene.fixed.yieldings.push_back(how);
  return number;
}

YieldingState start_yielding(const Scene& scene) {
  YieldingState state;
  if (anything_yields(scene))
    state.worlds.resize(shares_world(scene) ? 1 : static_cast<size_t>(n_blocks(scene)));
  return state;
}

int yielding_number(const Scene& scene, int body) {
  return is_stem(scene, body) ? n_with_hulls(scene) + stem_of(scene, body)
                              : scene.fixed.yielding[body];
}

bool stands(const Scene& scene, const State& state, int world, int body) {
  const int y = yielding_number(scene, body);
  return y < 0 || met_by(state.yielding, world, y).broken_by < 0;
}

Pose fixed_pose(const Scene& scene, const State& state, int world, int body) {
  Pose pose = scene.fixed.pose[body];
  if (const int y = yielding_number(scene, body); y >= 0) {
    const Yielding& yielding = scene.fixed.yieldings[y];
    const Yielded& met = met_by(state.yielding, world, y);
    pose.position += has_axis(yielding) ? Vec3(met.deflection * yielding.axis) : met.shift;
  }
  return pose;
}

const GroundClass& fixed_class(const Scene& scene, int body) {
  if (is_stem(scene, body))
    return scene.forest.faces[scene.forest.stems[stem_of(scene, body)].section];
  const int contact_class = scene.fixed.contact_class[body];
  return scene.fixed.classes[contact_class];
}

const Yielding* giving_way(const Scene& scene, int body, const Vec3& normal) {
  const int y = yielding_number(scene, body);
  if (y < 0) return nullptr;
  const Yielding& yielding = yielding_of(scene, y);
  const bool is_across =
      !has_axis(yielding) || std::abs(normal.dot(yielding.axis)) > law::least_yield_cosine;
  return std::isfinite(yielding.force) && is_across ? &yielding : nullptr;
}

Vec3 yield_direction(const Yielding& yielding, const Vec3& normal) {
  return has_axis(yielding) ? yielding.axis : normal;
}

void add_push(const YieldPush& push, std::vector<YieldPush>& pushes) {
  for (YieldPush& known : pushes) {
    if (known.block != push.block || known.yielding != push.yielding) continue;
    known.work += push.work;
    known.power += push.power;
    if (std::abs(push.shift) > std::abs(known.shift)) {
      known.shift = push.shift;
      known.to = push.to;
      known.along = push.along;
    }
    return;
  }
  pushes.push_back(push);
}

double time_to_first_break(const Scene& scene, const YieldingState& yielding,
                           std::span<const YieldPush> pushes, double h) {
  double first = std::numeric_limits<double>::infinity();
  for (const YieldPush& push : pushes) {
    const double capacity = yielding_of(scene, push.yielding).capacity;
    double work = 0, power = 0;
    for (const YieldPush& other : pushes) {
      if (other.yielding != push.yielding) continue;
      work += other.work;
      power += other.power;
    }
    const Yielded& met = met_by(yielding, world_of(scene, push.block), push.yielding);
    const double left = std::max(0.0, capacity - met.work);
    if (work <= left + rounding * capacity) continue;
    const double change = (work - power * h) / (h * h);  // work(t) = power t + change t^2
    const double root = std::sqrt(std::max(0.0, power * power + 4 * change * left));
    first = std::min(first, 2 * left / (power + root));
  }
  return first;
}

void push_bodies(const Scene& scene, std::span<const YieldPush> pushes, double time, State& state) {
  for (const YieldPush& push : pushes) {
    const Yielding& how = yielding_of(scene, push.yielding);
    const int world = world_of(scene, push.block);
    Yielded& met = meet(state.yielding, world, push.yielding);
    const Yielded before = met;
    met.work += push.work;
    state.ledger.fence += push.work;
    deflect(how, push, met);
    if (!is_stem(scene, how.body))
      note_shifted(scene, how.body, before, met, state);
    else if (push.shift != 0)
      wake_sleepers_at(scene, how.body, world, state);
  }
  for (const YieldPush& push : pushes) {
    const Yielding& how = yielding_of(scene, push.yielding);
    const int world = world_of(scene, push.block);
    Yielded& met = meet(state.yielding, world, push.yielding);
    if (met.work < (1 - rounding) * how.capacity || met.broken_by >= 0) continue;
    met.broken_at = time;
    met.broken_by = hardest_pusher(pushes, push.yielding);
    wake_sleepers_at(scene, how.body, world, state);
  }
}

}  // namespace talus
