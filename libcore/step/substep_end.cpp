// End of a substep: energy of contacts, pushes on yielding bodies, loads, segments.
#include "step/substep_end.hpp"

#include <algorithm>

#include "scene/fence.hpp"
#include "scene/stems.hpp"
#include "scene/yielding.hpp"
#include "step/crushing.hpp"
#include "step/loads.hpp"
#include "step/soil.hpp"
#include "step/substep.hpp"

namespace talus {
namespace {

bool remembers_ground(const State& state, std::size_t b) {
  const std::vector<ContactMemory>& memory = state.memory[b];
  return std::any_of(memory.begin(), memory.end(), [](const ContactMemory& contact) {
    return contact.key.body_b == ground_name && contact.normal_force > 0;
  });
}

}  // namespace

Motion begin_drag(const Scene& scene, const State& state, std::size_t b, double h) {
  const Motion& motion = state.motion[b];
  if (!any_drags(scene)) return motion;
  return after_drag(scene, static_cast<int>(b), motion, first_half(motion, h),
                    remembers_ground(state, b), h / 2);
}

void end_block(const Scene& scene, int b, const BlockNumbers& c, const Substep& s,
               const Motion& end, bool on_ground, double t, State& state, StepReport& report) {
  const auto i = static_cast<std::size_t>(b);
  const Vec3 loads = book_loads(scene, b, s.start.pose, end.pose, state);
  const Vec3 by_base = s.free_acceleration - scene.gravity - loads / c.mass;
  if (!by_base.isZero(0))
    state.ledger.base += c.mass * by_base.dot(end.pose.position - s.start.pose.position);
  Motion& motion = state.motion[i];
  Motion after = end;
  if (any_drags(scene)) {
    const auto energy = [&](const Motion& m) { return kinetic_energy(scene, i, m); };
    after = after_drag(scene, b, end, second_half(motion, s.h, end), on_ground, s.h / 2);
    state.ledger.drag += energy(motion) - energy(s.start);
    state.ledger.drag += energy(end) - energy(after);
  }
  motion = after;
  state.local_time[i] = t;
  report.shortest_dt = report.shortest_dt > 0 ? std::min(report.shortest_dt, s.h) : s.h;
  ++report.substeps;
}

void book(const Scene& scene, const ContactEnd& contact, State& state) {
  const double loss = contact.loss();
  if (!contact.yields)
    (contact.is_hit && loss > 0 ? state.ledger.impact : state.ledger.contact) += loss;
  state.ledger.friction -= (contact.impulse - contact.p_n * contact.normal).dot(contact.path);
  if (state.load.empty()) return;
  add_load(scene, contact.a, contact.normal, contact.p_n, contact.impulse, state);
  add_load(scene, contact.b, contact.normal, contact.p_n, -contact.impulse, state);
}

void push(const Scene& scene, const State& state, const ContactEnd& contact, double h,
          double speed_start, bool is_limited, double gap_end, std::span<const Pose> poses,
          std::vector<YieldPush>& pushes) {
  const int fixed = contact.fixed;
  const Vec3 pushed_before =
      is_stem(scene, fixed)
          ? met_by_stem(scene, state, world_of(scene, contact.a), stem_of(scene, fixed)).shift
          : Vec3(poses[hull_of_fixed(scene, fixed)].position - scene.fixed.pose[fixed].position);
  YieldPush push;
  push.along = yield_direction(*giving_way(scene, fixed, contact.normal), contact.normal);
  push.block = contact.a;
  push.yielding = yielding_number(scene, fixed);
  push.work = contact.loss();
  push.power = -contact.p_n / h * speed_start;
  if (is_limited) push.shift = std::min(0.0, gap_end) * contact.normal.dot(push.along);
  push.to = push.shift + push.along.dot(pushed_before);
  add_push(push, pushes);
}

void note_touch(const Scene& scene, int a, int fixed, const Vec3& at, double t,
                const Motion& before, State& state) {
  const Motion& after = state.motion[static_cast<std::size_t>(a)];
  if (is_stem(scene, fixed))
    note_stem_touch(scene, a, fixed, at, t, before, after, state);
  else if (panel_number(scene, fixed) >= 0)
    note_hit(scene, a, fixed, at, t, before, after, state.fence);
}

void take_pushes(const Scene& scene, std::span<const YieldPush> pushes, double t, State& state) {
  note_work(scene, pushes, state.fence);
  note_stem_work(scene, pushes, state);
  push_bodies(scene, pushes, t, state);
}

}  // namespace talus
