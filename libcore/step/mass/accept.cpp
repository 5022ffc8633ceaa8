// Stages 4 and 5 of the mass step: forces from the impulses, and motion, memory, yielding bodies
// and energy at the end of the step.
#include <algorithm>
#include <cmath>

#include "base/make_room.hpp"
#include "motion/free_rotation.hpp"
#include "scene/stems.hpp"
#include "scene/yielding.hpp"
#include "solver/law_numbers.hpp"
#include "step/breakage.hpp"
#include "step/deep_blocks.hpp"
#include "step/island/stages.hpp"
#include "step/mass/stages.hpp"
#include "step/soil.hpp"
#include "step/substep.hpp"
#include "step/substep_end.hpp"

namespace talus {
namespace {

using std::size_t;

constexpr double bound_rounding = 1e-5;  // of single precision, where an impulse is at its bound

Vec3 of_floats(const float (&from)[3]) { return {from[0], from[1], from[2]}; }

/// A row of which an impulse is known, in doubles.
struct PressedRow {
  Vec3 normal, arm_a, arm_b, impulse;
  double p_n;

  explicit PressedRow(const MassRow& row)
      : normal(of_floats(row.normal)),
        arm_a(of_floats(row.arm_a)),
        arm_b(of_floats(row.arm_b)),
        impulse(of_floats(row.impulse)),
        p_n(normal.dot(impulse)) {}
  [[nodiscard]] Vec3 along_face() const { return impulse - p_n * normal; }
};

/// Input of both stages.
struct MassEnd {
  const Scene& scene;
  const IslandMembers& members;
  const FreeMotions& free;
  const MassScratch& w;

  // Velocity of the points of `row` relative to each other: `share` 0 without contact, 1 with; of
  // the centroids at the end of the step, of turning in its middle.
  [[nodiscard]] Vec3 velocity(const MassPair& pair, const PressedRow& row, double share) const {
    const auto at = [&](int k, const Vec3& arm) -> Vec3 {
      const MassMember& m = w.members[k];
      const MassChange& change = w.changes[k];
      return m.velocity_end + share * change.velocity + (m.spin + share * change.spin).cross(arm);
    };
    return pair.b < 0 ? at(pair.a, row.arm_a) : Vec3(at(pair.a, row.arm_a) - at(pair.b, row.arm_b));
  }
  // Path per time that the impulse works on: the mean of the velocities without and with contact,
  // less the effect of gravity on a change of velocity in the second half of the step.
  [[nodiscard]] Vec3 path(const MassPair& pair, const PressedRow& row) const {
    Vec3 path = velocity(pair, row, 0.5);
    path -= free.h / 2 * free.substeps[pair.a].free_acceleration;
    if (pair.b >= 0) path += free.h / 2 * free.substeps[pair.b].free_acceleration;
    return path;
  }
  // Gap at the end of the step.
  [[nodiscard]] double gap_end(const MassPair& pair, const PressedRow& row, double gap_free) const {
    const auto by = [&](int k, const Vec3& arm) {
      return row.normal.dot(w.changes[k].velocity + w.changes[k].spin.cross(arm));
    };
    const double along = by(pair.a, row.arm_a) - (pair.b < 0 ? 0 : by(pair.b, row.arm_b));
    return gap_free + free.h / 2 * along;
  }
  [[nodiscard]] bool is_limited(const MassRow& row, double p_n) const {
    return p_n >= (1 - bound_rounding) * static_cast<double>(row.limit);
  }
  [[nodiscard]] bool slips(const MassRow& row, const PressedRow& pressed) const {
    const double cap = static_cast<double>(row.friction) * pressed.p_n;
    return pressed.along_face().norm() >= (1 - bound_rounding) * cap;
  }

  [[nodiscard]] ContactEnd end_of(const MassContact& contact, const MassPair& pair,
                                  const PressedRow& row) const {
    return {contact.a, contact.b,       contact.fixed,  row.normal,    row.impulse,
            row.p_n,   path(pair, row), contact.is_hit, contact.yields};
  }

  // Estimated error of the step, over the displacement of the mass. A hit counts as if its time
  // were unknown: gravity acts before the rebound in part of the step alone.
  [[nodiscard]] double error_over_displacement(const State& state) const {
    const double h = free.h, by_hit = scene.gravity.norm() * h * h / 2;
    MeanError error;
    for (size_t k = 0; k < members.size(); ++k) {
      const MassChange& by = w.changes[k];
      const Substep& s = free.substeps[k];
      Vec6 change;
      change << by.velocity, by.spin;
      error.add(
          members.numbers[k],
          by.was_hit
              ? DisplacementError{by_hit, (s.free.pose.position - s.start.pose.position).norm()}
              : error_of_member(scene, state, members, free, k, change, h / 2 * by.velocity, h));
    }
    return error.over_displacement();
  }

  // Calls visit(row number, pair, row in doubles) for all rows that press.
  template <class Visit>
  void for_each_pressed(const Visit& visit) const {
    for (const MassPair& pair : w.system.pairs)
      for (int r = pair.row_begin; r < pair.row_end; ++r) {
        const PressedRow row(w.system.rows[r]);
        if (row.p_n > 0) visit(static_cast<size_t>(r), pair, row);
      }
  }
};

void sum_impulses(const MassEnd& end, std::vector<MassChange>& changes) {
  const MassScratch& w = end.w;
  end.for_each_pressed([&](size_t r, const MassPair& pair, const PressedRow& row) {
    MassChange& a = changes[pair.a];
    const MassContact& contact = w.contacts[r];
    a.impulse += row.impulse;
    a.couple += row.arm_a.cross(row.impulse);
    a.pressed = true;
    a.was_hit |= contact.is_hit;
    if (pair.b < 0) {
      a.on_ground |= contact.fixed < 0;
      if (!contact.yields && !contact.is_hit) a.by_ground += row.impulse;
      return;
    }
    MassChange& b = changes[pair.b];
    b.impulse -= row.impulse;
    b.couple -= row.arm_b.cross(row.impulse);
    b.pressed = true;
    b.was_hit |= contact.is_hit;
  });
  for (const MassTurn& turn : w.system.turns)
    changes[w.system.pairs[turn.pair].a].couple += turn.couple;
  for (const int b : end.members.moving) {
    const size_t k = end.members.at(b);
    changes[k].velocity = end.members.numbers[k].inverse_mass * changes[k].impulse;
    changes[k].spin = w.members[k].inverse_inertia * changes[k].couple;
  }
}

// Pushes of the blocks on yielding fixed bodies.
void find_pushes(const MassEnd& end, const State& state, const PairSearch& search,
                 std::vector<YieldPush>& pushes) {
  const Scene& scene = end.scene;
  pushes.clear();
  if (!anything_yields(scene)) return;
  end.for_each_pressed([&](size_t r, const MassPair& pair, const PressedRow& row) {
    const MassContact& contact = end.w.contacts[r];
    if (!contact.yields) return;
    push(scene, state, end.end_of(contact, pair, row), end.free.h, contact.speed_start,
         end.is_limited(end.w.system.rows[r], row.p_n) || is_stem(scene, contact.fixed),
         end.gap_end(pair, row, contact.gap_free), search.poses, pushes);
  });
}

/// Accepts a step; a struct so that its parts share common data.
struct MassAcceptance : MassEnd {
  State& state;
  std::vector<Segment>& segments;
  DeepWork& deep;
  StepReport& report;
  double planned;  // length of the step before the break of a yielding body cut it short [s]

  [[nodiscard]] double thickness_of(int b) const { return members.of(b).thickness; }

  void add_losses_of_hits() {
    add_hit_losses(
        [&](const auto& take) {
          for_each_pressed([&](size_t r, const MassPair& pair, const PressedRow& row) {
            const MassContact& contact = w.contacts[r];
            if (contact.is_hit) take(contact.a, contact.b, end_of(contact, pair, row).loss());
          });
        },
        state);
  }

  // The memory that the exact step would have of the contact, had it pressed so: it continues with
  // the same force, and the overlap that it does not need presses nothing. In a step that a break
  // cut short most of an impulse stops approaches, however short it is: over its own length it
  // would be a force of any size, with which the next step would begin.
  void remember(size_t r, const PressedRow& row, double gap_end) {
    const MassContact& contact = w.contacts[r];
    if (contact.is_hit) return;
    const double stiffness = static_cast<double>(w.system.rows[r].damping) /
                             (members.of(contact.a).recovery_time * planned);
    std::vector<ContactMemory>& memories = state.memory[contact.a];
    make_room(memories);
    ContactMemory& memory = memories.emplace_back();
    memory.key = contact.key;
    memory.normal = row.normal;
    memory.normal_force = row.p_n / planned;
    memory.stiffness = stiffness;
    memory.offset = std::max(0.0, -gap_end - memory.normal_force / stiffness);
    memory.gap_end = gap_end + memory.offset;
    memory.shear = row.along_face() / (-planned * scene.settings.shear_ratio * stiffness);
    const bool slip = slips(w.system.rows[r], row);
    memory.state = static_cast<std::uint8_t>(slip ? ContactState::slip : ContactState::stick);
  }

  void take_contacts() {
    forget_contacts(members, state);
    for_each_pressed([&](size_t r, const MassPair& pair, const PressedRow& row) {
      const MassContact& contact = w.contacts[r];
      const double gap = gap_end(pair, row, contact.gap_free);
      int thin = contact.a;
      if (contact.b >= 0 && thickness_of(contact.b) < thickness_of(thin)) thin = contact.b;
      note_overlap(thin, -gap, thickness_of(thin), deep, report);
      ++report.n_closed;
      report.sum_penetration += std::max(-gap, 0.0);
      book(scene, end_of(contact, pair, row), state);
      report.n_impacts += contact.is_hit;
      remember(r, row, gap);
    });
    if (!state.hit_loss.empty()) add_losses_of_hits();
    for (const MassTurn& turn : w.system.turns) {
      const MassChange& change = w.changes[w.system.pairs[turn.pair].a];
      state.ledger.rolling -= turn.couple.dot(turn.spin + change.spin / 2);
    }
  }

  // The distance that a member slides on ground whose friction follows it.
  void slide(size_t k) {
    if (w.ground_pair[k] < 0) return;
    const MassPair& pair = w.system.pairs[w.ground_pair[k]];
    int most = -1;
    double p_most = 0;
    for (int r = pair.row_begin; r < pair.row_end; ++r)
      if (const double p_n = PressedRow(w.system.rows[r]).p_n; p_n > p_most) most = r, p_most = p_n;
    if (most < 0) return;
    const MassContact& contact = w.contacts[most];
    const PressedRow row(w.system.rows[most]);
    const Vec3 end = velocity(pair, row, 1);
    const double at_end = (end - row.normal.dot(end) * row.normal).norm();
    const double speed = slips(w.system.rows[most], row)
                             ? (static_cast<double>(contact.slip_speed) + at_end) / 2
                             : 0;
    slide_on(scene, scene.ground.classes[contact.ground_class], members.blocks[k], speed, free.h,
             free.t, free.h, state);
  }

  [[nodiscard]] Motion end_of_member(size_t k) const {
    const Substep& s = free.substeps[k];
    const MassChange& change = w.changes[k];
    Motion out = s.free;
    if (!change.pressed) return out;
    const MassMember& m = w.members[k];
    out.velocity += change.velocity;
    out.pose.position += free.h / 2 * change.velocity;
    out.pose.attitude = free_rotation(m.attitude, m.momentum + change.couple,
                                      members.numbers[k].inertia, free.h / 2);
    out.angular_momentum += change.couple;
    return out;
  }

  void move(size_t k) {
    const Substep& s = free.substeps[k];
    const int b = members.blocks[k];
    const MassChange& change = w.changes[k];
    const Motion motion = end_of_member(k);
    add_segment(b, false, free.t, free.h, s.start, motion, segments);
    set_support(scene, b, change.by_ground / (members.numbers[k].mass * planned), state);
    if (change.pressed && !change.was_hit && planned == free.h)
      set_rates(scene, b, members.numbers[k], s, motion, state);
    else
      forget_rates(scene, b, state);
    end_block(scene, b, members.numbers[k], s, motion, change.on_ground, free.t + free.h, state,
              report);
    if (!is_finite(motion)) stop_at(s.start, members.block(k), state, report);
  }

  // First touches of panels and stems, and the motion of their blocks after it.
  void note_touched() {
    if (scene.fixed.panels.empty() && scene.forest.stems.empty()) return;
    for_each_pressed([&](size_t r, const MassPair&, const PressedRow& row) {
      const MassContact& contact = w.contacts[r];
      if (contact.fixed < 0) return;
      const size_t k = members.at(contact.a);
      note_touch(scene, contact.a, contact.fixed, w.members[k].middle + row.arm_a, free.t,
                 free.substeps[k].start, state);
    });
  }

  void run() {
    if (w.fell_through) report.flags = report.flags | StepFlag::fell_through;
    take_contacts();
    if (!state.slid.empty())
      for (size_t k = 0; k < members.size(); ++k) slide(k);
    for (const int b : members.moving) move(members.at(b));
    note_touched();
    take_pushes(scene, w.pushes, free.t + free.h, state);
  }
};

}  // namespace

void find_mass_changes(const Scene& scene, const State& state, const PairSearch& search,
                       const IslandMembers& members, const FreeMotions& free, MassScratch& w) {
  w.changes.assign(members.size(), MassChange{});
  const MassEnd end{scene, members, free, w};
  sum_impulses(end, w.changes);
  find_pushes(end, state, search, w.pushes);
  w.error = end.error_over_displacement(state);
}

void accept_mass(const Scene& scene, const IslandMembers& members, const FreeMotions& free,
                 const MassScratch& w, double planned, State& state, std::vector<Segment>& segments,
                 DeepWork& deep, StepReport& report) {
  MassAcceptance{{scene, members, free, w}, state, segments, deep, report, planned}.run();
}

}  // namespace talus
