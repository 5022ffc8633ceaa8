#include "scene/yielding.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "scene/stems.hpp"
#include "solver/law_numbers.hpp"

namespace talus {
namespace {

using std::size_t;

bool has_axis(const Yielding& yielding) { return !yielding.axis.isZero(0); }

// The bodies with hulls that give way, then the stems.
int n_with_hulls(const Scene& scene) { return static_cast<int>(scene.fixed.yieldings.size()); }

const Yielding& yielding_of(const Scene& scene, int y) {
  const int n = n_with_hulls(scene);
  return y < n ? scene.fixed.yieldings[y] : scene.forest.yieldings[y - n];
}
const Yielded& met_by(const Scene& scene, const YieldingState& state, int y) {
  const int n = n_with_hulls(scene);
  return y < n ? state.met[y] : met_by_stem(state, y - n);
}
Yielded& met_by(const Scene& scene, YieldingState& state, int y) {
  const int n = n_with_hulls(scene);
  return y < n ? state.met[y] : meet_stem(state, y - n);
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

void wake_sleepers_at(int body, State& state) {
  const int name = name_of_fixed(body);
  for (size_t b = 0; b < state.memory.size(); ++b) {
    if (state.phase[b] != Phase::asleep) continue;
    const auto touches = [name](const ContactMemory& m) { return m.key.body_b == name; };
    if (std::any_of(state.memory[b].begin(), state.memory[b].end(), touches))
      wake(state, b, state.time);
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

void note_shifted(int body, const Yielded& met, std::vector<int>& shifted) {
  if (met.deflection == 0 && met.shift.isZero(0)) return;
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
  state.met.resize(scene.fixed.yieldings.size());
  return state;
}

int yielding_number(const Scene& scene, int body) {
  return is_stem(scene, body) ? n_with_hulls(scene) + stem_of(scene, body)
                              : scene.fixed.yielding[body];
}

bool stands(const Scene& scene, const State& state, int body) {
  const int y = yielding_number(scene, body);
  return y < 0 || met_by(scene, state.yielding, y).broken_by < 0;
}

Pose fixed_pose(const Scene& scene, const State& state, int body) {
  Pose pose = scene.fixed.pose[body];
  if (const int y = yielding_number(scene, body); y >= 0) {
    const Yielding& yielding = scene.fixed.yieldings[y];
    const Yielded& met = state.yielding.met[y];
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
    const double left = std::max(0.0, capacity - met_by(scene, yielding, push.yielding).work);
    if (work <= left + (1 - law::used_up) * capacity) continue;
    const double change = (work - power * h) / (h * h);  // work(t) = power t + change t^2
    const double root = std::sqrt(std::max(0.0, power * power + 4 * change * left));
    first = std::min(first, 2 * left / (power + root));
  }
  return first;
}

void push_bodies(const Scene& scene, std::span<const YieldPush> pushes, double time, State& state) {
  YieldingState& yielding = state.yielding;
  for (const YieldPush& push : pushes) {
    const Yielding& how = yielding_of(scene, push.yielding);
    Yielded& met = met_by(scene, yielding, push.yielding);
    met.work += push.work;
    state.ledger.fence += push.work;
    deflect(how, push, met);
    if (!is_stem(scene, how.body))
      note_shifted(how.body, met, yielding.shifted);
    else if (push.shift != 0)
      wake_sleepers_at(how.body, state);
  }
  for (const YieldPush& push : pushes) {
    const Yielding& how = yielding_of(scene, push.yielding);
    Yielded& met = met_by(scene, yielding, push.yielding);
    if (met.work < law::used_up * how.capacity || met.broken_by >= 0) continue;
    met.broken_at = time;
    met.broken_by = hardest_pusher(pushes, push.yielding);
    wake_sleepers_at(how.body, state);
  }
}

}  // namespace talus
