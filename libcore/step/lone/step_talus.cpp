// Law talus for one block: substeps, impacts, flights, sliding on a plane, sleep.
#include "step/lone/step_talus.hpp"

#include <algorithm>
#include <cmath>

#include "contact/past_ridge.hpp"
#include "contact/search.hpp"
#include "solver/law_numbers.hpp"
#include "step/accuracy.hpp"
#include "step/breakage.hpp"
#include "step/deep_blocks.hpp"
#include "step/flight.hpp"
#include "step/impact.hpp"
#include "step/loads.hpp"
#include "step/lone/lone_soil.hpp"
#include "step/lone/lone_substep.hpp"
#include "step/substep_end.hpp"

namespace talus {
namespace {

using std::size_t;

// Time at which the first waiting contact is hit, if one is: 0 < time <= h; h + 1 when none is.
template <int Dof>
double first_hit(const BlockNumbers& c, const Substep& s, const Solved<Dof>& solved,
                 const Work& work) {
  double first = s.h + 1;
  for (const ContactRow& row : work.rows) {
    if (!row.waits) continue;
    const double gap_end =
        work.contacts[row.contact].gap + row.normal.dot(solved.moved(row.arm, s.h));
    first = std::min(first, time_to_touch(row.gap_start, row.speed_start, gap_end, c.touch, s.h));
  }
  return first;
}

// An error in the speed of a contact that is not looked into: this part of the block's speed, and
// of the change by gravity in the substep.
constexpr double of_speed = 2e-5, of_gravity = 1e-3;

/// Outcome of one attempt at a substep.
enum class Attempt { done, shorter, impact, flight, left };

/// Everything that advances one block; a struct so that its parts share common data.
struct Advance {
  const Scene& scene;
  int b;
  State& state;
  Work& work;
  StepReport& report;
  BlockNumbers c;
  Contact foreseen = {};      // the one that an attempt found about to hit
  bool is_foreseen = false;   // not yet tried
  bool may_fly = true;        // off for the rest of a step in which a flight met the ground
  bool was_fast = false;      // the last hit was not a slow one, which only ends a substep
  bool on_plane = false;      // it slides, and in the substep it cannot meet another plane
  bool breaks_bonds = false;  // of the current substep; the intact ones are in work.unbonded
  double last_h = 0;          // of the substep before [s]
  double longest_h = 0;       // the next one is not tried longer, because of its error [s]
  int most_tries =
      law::most_repetitions;  // of a substep; fewer once no forces were found in the step

  [[nodiscard]] size_t i() const { return static_cast<size_t>(b); }
  Motion& motion() { return state.motion[i()]; }

  bool gravity_only() const { return !shakes(scene.base) && !is_loaded(scene, b, state.pressure); }
  bool free_fall_only() const { return may_fly && gravity_only(); }

  void finish(const Substep& s, const Motion& end, double t, double t_next) {
    add_segment(b, state.memory[i()].empty(), t, s.h, s.start, end, work.segments);
    set_support(scene, b, (end.velocity - s.free.velocity) / s.h, state);
    end_block(scene, b, c, s, end, !state.memory[i()].empty(), t_next, state, report);
  }

  // True when the block is hit where it is. The gap of edges over a substep is not quite linear:
  // where the hit was foreseen, they may still be a little apart, or just not cross. Then the
  // contact that was foreseen is hit besides those that touch; without it nothing would be hit,
  // again and again.
  bool impact() {
    const Motion before = motion();
    work.soil.slide = slide_of(state, b, state.local_time[i()]);
    const HitSpeeds speeds{c.resting_speed, c.located_speed};
    ImpactResult hit = apply_impact(scene, b, 2 * c.touch, speeds, motion(), work);
    if (!hit.hit && is_foreseen) {
      work.contacts.push_back(foreseen);
      hit = apply_impact(scene, b, speeds, motion(), work);
    }
    is_foreseen = false;
    if (!hit.hit) return false;
    was_fast = hit.is_fast;
    state.ledger.impact += hit.dissipated - hit.by_rolling;
    state.ledger.rolling += hit.by_rolling;
    add_ground_hit_loss(scene, b, before, motion(), work.contacts, hit.dissipated - hit.by_rolling,
                        state);
    ++report.n_impacts;
    report.passes += hit.passes;
    if (!hit.converged) note_unconverged(b, report);
    forget_rates(scene, b, state);
    state.support[i()].setZero();
    return true;
  }

  // The contacts' forces. The turn that they add to the block is first taken to be that of the
  // guess, and they are computed again where it makes their points move otherwise. If no forces are
  // found, as in a jam, those for the turn before count, or for none.
  template <int Dof>
  NewtonResult solve(const Substep& s, BlockSystem<Dof>& system) {
    const std::span<ContactRow> rows(work.rows);
    const auto found_at = [&] { return solve_contacts(system, rows, scene.settings.max_passes); };
    if constexpr (Dof != 6) {
      return found_at();
    } else {
      constexpr int most_turns = 4;
      const double slow = of_speed * top_speed() + of_gravity * c.gravity * s.h;
      const BlockSystem<6> guess = system;
      Solved<6> followed = solved_motion(c, s, system);
      (void)follow_turn(c, s, followed, work.contacts, rows);
      NewtonResult result = found_at();
      if (!result.converged) {
        followed = {};
        (void)follow_turn(c, s, followed, work.contacts, rows);
        system = guess;
        const NewtonResult unturned = found_at();
        result = {unturned.converged, result.passes + unturned.passes};
      }
      for (int i = 0; i < most_turns && result.converged; ++i) {
        const Vec6 found = system.velocity;
        const Solved<6> next = solved_motion(c, s, system);
        if (follow_turn(c, s, next, work.contacts, rows) <= slow) break;
        const NewtonResult again = found_at();
        result.passes += again.passes;
        if (again.converged) {
          followed = next;
          continue;
        }
        (void)follow_turn(c, s, followed, work.contacts, rows);
        system.velocity = found;
        const NewtonResult before = found_at();
        return {before.converged, result.passes + before.passes};
      }
      return result;
    }
  }

  // A bond that a longer substep would have broken may hold over a shorter one.
  Attempt shorten(double to, double& h) {
    h = to;
    breaks_bonds = false;
    return Attempt::shorter;
  }

  // A substep in which nothing touches the block: it flies, perhaps on beyond it.
  Attempt go_free(const Substep& s, double t, double& h, bool last) {
    work.rows.clear();
    if (!last && changes_bearing() && is_rough(t, h)) return shorten(h / 2, h);
    const bool lifts_off = !state.memory[i()].empty();
    if (lifts_off && free_fall_only() && begin_flight(t, 2 * h)) return Attempt::flight;
    report.n_flips += static_cast<int>(state.memory[i()].size());
    state.memory[i()].clear();
    relax_strain();
    note_accuracy(0, h);
    finish(s, s.free, t, t + h);
    forget_rates(scene, b, state);
    return Attempt::done;
  }

  // Whether a new contact is hit where the substep begins; it is then the one that is foreseen.
  bool is_hit_at_start() {
    for (const ContactRow& row : work.rows) {
      if (row.memory >= 0 || row.gap_start > c.touch ||
          row.gap_start <= -law::deep_share * c.thickness || row.speed_start >= -c.located_speed)
        continue;
      foreseen = work.contacts[row.contact];
      is_foreseen = true;
      return true;
    }
    return false;
  }

  // Substep of h from t; h is shortened to the first impact or when the forces do not converge.
  template <int Dof>
  Attempt attempt(double t, double& h, bool last) {
    Substep s = predict(scene, b, c, begin_drag(scene, state, i(), h), t, h, state.pressure);
    if constexpr (Dof == 12) {
      s.is_straining = true;
      s.straining = strain_tensor(state.strain_rate[i()]);
    }
    const Mat3 stretch = stretch_of(state, b);
    const SearchResult near =
        find_contacts(scene.ground, scene.blocks.shapes, b, s.free.pose, stretch,
                      on_plane ? margin_on_plane(h) : search_margin(c, h), work.world_vertices,
                      work.contacts, &work.near_ground[i()]);
    if (near.reach == Reach::off_ground) return Attempt::left;
    if (work.contacts.empty()) return go_free(s, t, h, last);
    make_rows(scene, b, c, s, breaks_bonds ? work.unbonded : state.memory[i()], work);
    if (is_hit_at_start()) return Attempt::impact;
    if (!last && goes_through_ridge(s)) return shorten(h / 2, h);
    BlockSystem<Dof> system = make_system<Dof>(scene, b, c, s, state);
    begin_soil(scene, b, c, s, state, t, work);
    const NewtonResult newton =
        solve_on_soil(scene, b, s, state, t, system, work, [&] { return solve(s, system); });
    report.passes += newton.passes;
    if (!newton.converged) {
      if (!last) {
        ++state.counters.cut_back;
        return shorten(h / 2, h);
      }
      note_unconverged(b, report);
      report.flags = report.flags | StepFlag::unconverged;
      most_tries = law::most_halvings;
    }
    const Solved<Dof> solved = solved_motion(c, s, system);
    load_bonds(s, solved);
    if (!last && (changes_bearing() || !work.bond_faces.empty()) && is_rough(t, h))
      return shorten(h / 2, h);
    if (break_bonds()) return Attempt::shorter;
    const double hit = first_hit(c, s, solved, work);
    if (hit < s.h && !last) return shorten(hit, h);
    const double error = error_over_displacement(s, solved.end);
    if (const double shorter = accurate_substep(scene.settings, error, h); shorter < h && !last) {
      ++report.cuts[static_cast<size_t>(SubstepCut::inaccurate)];
      return shorten(longest_h = shorter, h);
    }
    note_accuracy(error, h);
    if (near.reach == Reach::below) report.flags = report.flags | StepFlag::fell_through;
    remember(c, s, solved, state, work, b, report);
    end_soil(scene, b, s, t, system, solved, work, state);
    if constexpr (Dof == 12) {
      state.strain[i()] += h / 2 * (state.strain_rate[i()] + system.velocity.template tail<6>());
      state.strain_rate[i()] = system.velocity.template tail<6>();
    }
    finish(s, solved.end, t, t + h);
    set_rates(scene, b, c, s, solved.end, state);
    return hit <= s.h ? Attempt::impact : Attempt::done;
  }

  // Estimated error of the substep, over the block's displacement: 0 where the previous contact
  // force is unknown.
  [[nodiscard]] double error_over_displacement(const Substep& s, const Motion& end) const {
    const Vec3& before = state.acceleration[i()];
    if (state.local_time[i()] == 0 || before == scene.gravity || !state.strain.empty()) return 0;
    const Vec3 spin_end =
        (end.pose.attitude.conjugate() * end.angular_momentum).cwiseProduct(c.inverse_inertia);
    const Vec3 mean = (end.velocity - s.start.velocity) / s.h;
    return share_of(error_of_displacement(c, mean - before,
                                          (spin_end - s.spin_start) / s.h - state.spin_rate[i()],
                                          end.pose.position - s.start.pose.position,
                                          s.h / 2 * (s.spin_start + spin_end), s.h, last_h),
                    c.thickness);
  }
  void note_accuracy(double error, double h) {
    report.largest_error = std::max(report.largest_error, error);
    last_h = h;
    longest_h = longest_after(scene.settings, error, h, longest_h);
  }

  // Whether a vertex or an edge has gone through a ridge in a substep, so that the contacts at its
  // end say nothing of that. No use to ask where hardly anything moved.
  [[nodiscard]] bool goes_through_ridge(const Substep& s) {
    if (s.h * top_speed() < law::shallow * c.thickness) return false;
    for (const ContactRow& row : work.rows)
      if (came_through_ridge(scene, c, s, work.contacts[row.contact], row)) return true;
    return depth_past_ridge(scene.ground, scene.blocks.shapes, b, work.world_vertices,
                            work.contacts, law::sunk * c.thickness) > 0;
  }

  /// Support of a block by the ground: the number of contacts, up to three, and whether one of them
  /// holds it where it is.
  struct Bearing {
    int contacts = 0;
    bool holds = false;
    void add(ContactState contact) {
      contacts = std::min(3, contacts + (contact != ContactState::open ? 1 : 0));
      holds |= contact == ContactState::stick;
    }
    bool operator==(const Bearing&) const = default;
  };

  // Whether the support by the ground differs between the end and the start of the substep.
  [[nodiscard]] bool changes_bearing() const {
    Bearing start, end;
    for (const ContactMemory& memory : state.memory[i()])
      start.add(static_cast<ContactState>(memory.state));
    for (const ContactRow& row : work.rows)
      if (!row.waits) end.add(row.state);
    return start != end;
  }

  // Whether the ground's motion may be too rough to take its mean over the substep where the block
  // begins or ceases to move in it. Forces before that count in the mean without an effect: the
  // speed errs by up to an eighth of how far the acceleration ranges, times h.
  [[nodiscard]] bool is_rough(double t, double h) const {
    if (scene.base.time.empty()) return false;
    return h / 8 * range_of_base(scene.base, t, t + h) >
           scene.settings.accuracy * c.gravity * scene.settings.dt;
  }

  // The faces that are bonded to the ground, and their loads.
  template <int Dof>
  void load_bonds(const Substep& s, const Solved<Dof>& solved) {
    work.bond_faces.clear();
    for (const ContactRow& row : work.rows) {
      if (!(row.bond_area > 0)) continue;
      BondFace& face = face_of(-1, b, row.normal, work.bond_faces);
      face.corners.push_back(corner_of(row, class_of(scene, row), row.impulse, s.h));
      if (row.state != ContactState::open) continue;
      const double along = row.normal.dot(row.free_move + solved.moved(row.arm, s.h));
      face.opened |= row.gap_start + along > bonded_gap_ratio * c.radius;
    }
    std::erase_if(work.bond_faces, [](const BondFace& face) { return holds(face); });
  }

  // An overloaded bond is gone. The substep is then computed again without it; the state loses it
  // when that is accepted, since rows without a bond leave none.
  bool break_bonds() {
    if (work.bond_faces.empty()) return false;
    if (!breaks_bonds) work.unbonded = state.memory[i()];
    for (const ContactRow& row : work.rows)
      for (const BondFace& face : work.bond_faces)
        if (row.bond_area > 0 && is_same_face(face.normal, row.normal))
          work.unbonded[row.memory].bond_area = 0;
    return breaks_bonds = true;
  }

  // Off the ground nothing strains the block: quasi-static.
  void relax_strain() {
    if (state.strain.empty()) return;
    state.strain[i()].setZero();
    state.strain_rate[i()].setZero();
  }

  // Time in which the block moves on by an eighth of a cell, so that the convex feature there which
  // keeps it from flying may be another one.
  double time_for_another_view() {
    const double cell = scene.ground.trn.cell_size;
    return cell / 8 / (top_speed() + std::sqrt(c.gravity * cell) + 1e-300);
  }

  // Flies on from t, where for longer than `shortest` nothing can be hit and no forest drags.
  bool begin_flight(double t, double shortest) {
    const double longest = std::min(1e3, law::longest_turn / (spin_speed() + 1e-300));
    // where strains let go the vertices move
    const bool is_rigid = state.strain.empty();
    FlyingBody body =
        flying_body(motion(), scene.blocks.inertia[i()], c.radius,
                    is_rigid ? vertices_of(scene.blocks.shapes, b) : std::span<const Vec3>());
    body.touch = 2 * c.touch;
    double safe = free_time(scene.ground, body, scene.gravity, longest);
    while (safe > shortest &&
           comes_over(scene.canopies, body.position, body.velocity, scene.gravity, safe))
      safe /= 2;
    if (!(safe > shortest)) {
      state.flight_end[i()] = t + time_for_another_view();
      return false;
    }
    take_off(state, i(), t + safe);
    report.n_flips += static_cast<int>(state.memory[i()].size());
    state.memory[i()].clear();
    state.support[i()].setZero();
    relax_strain();
    return true;
  }

  // With Settings::flight off the ground is searched though nothing can be hit: a flight that
  // touches it all the same ends where the step begins. So far below it as touching goes a vertex
  // may be that leaves it.
  bool touches_in_flight(double t_end) {
    const double h = t_end - state.time;
    const Pose pose = motion_at(scene, state, b, t_end).pose;
    (void)find_contacts(scene.ground, scene.blocks.shapes, b, pose, stretch_of(state, b),
                        search_margin(c, h), work.world_vertices, work.contacts);
    return std::any_of(work.contacts.begin(), work.contacts.end(),
                       [this](const Contact& contact) { return contact.gap < -2 * c.touch; });
  }

  // True when the flight ends within the step; the block is then at its end.
  bool flight_ends(double t_end) {
    const double t = std::max(state.time, state.local_time[i()]);
    if (state.flight_end[i()] < t_end) {
      end_flight(scene, b, state.flight_end[i()], state, work);
    } else if (!scene.settings.flight && touches_in_flight(t_end)) {
      end_flight(scene, b, t, state, work);
      may_fly = false;
    }
    return state.phase[i()] != Phase::flight;
  }

  double spin_speed() {
    const Vec3 body = motion().pose.attitude.conjugate() * motion().angular_momentum;
    return body.cwiseProduct(c.inverse_inertia).norm();
  }

  // No point of the block is faster [m/s].
  double top_speed() { return motion().velocity.norm() + spin_speed() * c.radius; }

  // A block that strains comes to rest by its strains, of which an impact knows nothing.
  void locate_hits() {
    c.located_speed = state.strain.empty() ? located_speed(scene, c, top_speed()) : c.resting_speed;
  }

  // Where gravity alone drives a block that slides, gravity and its support change its path by no
  // more than about half of this.
  double margin_on_plane(double h) const { return c.gravity * h * h + 1e-3 * c.radius; }

  // Whether all ground that the block may come over in the next `h` lies in the plane below it and
  // is of one kind.
  bool is_plane_ahead(double h) {
    const Trn& trn = scene.ground.trn;
    const Vec3 &from = motion().pose.position, to = from + h * motion().velocity;
    const double around = c.radius + margin_on_plane(h);
    const Vec3 low = from.cwiseMin(to), high = from.cwiseMax(to);
    if (!contains(trn, low.x() - around, low.y() - around) ||
        !contains(trn, high.x() + around, high.y() + around))
      return false;
    const CellRange cells = cells_near(trn, low, high, around);
    return is_plane(trn, cells, locate(trn, from.x(), from.y())) &&
           is_one_class(scene.ground, cells);
  }

  // Near the ground a substep moves no point farther than half a cell and turns the block by at
  // most half a radian, one that the ground supports by half of that, since forces that turn with a
  // block err by the square of its turn; a needle that rolls at more than 100 radians a step is not
  // followed any closer. A block that slides may go farther, up to `h`, where it meets no other
  // plane or ground.
  double longest_substep(double h) {
    const double spin = spin_speed() + 1e-300;
    const double by_turn =
        std::max((state.memory[i()].empty() ? 0.5 : 0.25) / spin, scene.settings.dt / 200);
    const double by_way = 0.5 * scene.ground.trn.cell_size / (top_speed() + 1e-300);
    on_plane = false;
    if (gravity_only() && !state.memory[i()].empty())
      for (double longer = std::min(h, law::slides_by_turn / spin); longer > by_way; longer /= 2)
        if ((on_plane = is_plane_ahead(longer))) return longer;
    return std::min(by_way, by_turn);
  }

  // Whether the block may be off the ground: after a hit, or when nothing supported it in the last
  // step. Asked only now and then where it was not, since blocks that stay near rough ground ask in
  // vain.
  [[nodiscard]] bool may_take_off(double t, bool was_hit) const {
    const bool asks = t == state.time && t >= state.flight_end[i()] && state.memory[i()].empty();
    return (was_hit || asks) && free_fall_only();
  }

  // A block without support is not looked for on the ground before it may touch it: flights
  // follow on each other, each ending nearer to the hit where the block spins, until it touches.
  template <int Dof>
  void run(double t_end) {
    int events = 0, flights = 0;
    bool was_hit = false;
    const auto count_event = [&] {
      if (++events > law::most_hits) c.resting_speed *= 2;
    };
    last_h = t_end - state.time;
    longest_h = no_normal_limit;
    while (state.local_time[i()] < t_end) {
      bool flew = false;
      if (state.phase[i()] == Phase::flight) {
        if (!flight_ends(t_end)) return;
        flew = true;
      }
      const double t = state.local_time[i()];
      if ((flew || may_take_off(t, was_hit && was_fast)) && may_fly &&
          ++flights <= law::most_hits) {
        // without spin a flight ends where the block touches
        const bool touches = flew && motion().angular_momentum.isZero(0);
        const double at_once = c.touch / (top_speed() + c.gravity * scene.settings.dt + 1e-300);
        if (!touches && begin_flight(t, at_once)) continue;
        was_hit = flew && impact();
        if (was_hit) {
          count_event();
          continue;
        }
      }
      locate_hits();
      double h = std::min({t_end - t, longest_h, longest_substep(t_end - t)});
      Attempt outcome = Attempt::shorter;
      breaks_bonds = false;
      for (int tries = 1; outcome == Attempt::shorter; ++tries)
        outcome = attempt<Dof>(t, h, tries >= most_tries);
      if (t_end - state.local_time[i()] < 1e-9 * scene.settings.dt) state.local_time[i()] = t_end;
      if (outcome == Attempt::impact) count_event();
      was_hit = outcome == Attempt::impact && impact();
      if (outcome == Attempt::left || left_ground(scene, motion().pose.position)) {
        stop_outside(scene, b, state, report);
        state.local_time[i()] = t_end;
        return;
      }
    }
  }
};

// A block that has support and stays in place is left out until something wakes it.
void put_to_sleep(const Scene& scene, size_t b, State& state) {
  watch_rest(scene, b, state);
  if (state.rest_steps[b] >= law::steps_before_sleep && !state.memory[b].empty())
    fall_asleep(scene, b, state);
}

}  // namespace

void advance_lone(const Scene& scene, int b, double t_end, State& state, Work& work,
                  StepReport& report) {
  const auto i = static_cast<size_t>(b);
  if (!state.mass.empty()) state.mass[i] = {};
  // or it has made its step in the island that woke it
  if (does_not_move(state.phase[i]) || state.local_time[i] >= t_end) return;
  if (state.phase[i] == Phase::flight && state.flight_end[i] >= t_end && scene.settings.flight) {
    ++state.counters.flight_skips;
    return;
  }
  const Motion before = state.motion[i];
  Advance advance{scene, b, state, work, report, numbers_of(scene, b)};
  if (scene.settings.strains)
    advance.run<12>(t_end);
  else
    advance.run<6>(t_end);
  if (!is_finite(state.motion[i])) stop_at(before, i, state, report);
  if (may_sleep(scene) && !does_not_move(state.phase[i])) put_to_sleep(scene, i, state);
}

}  // namespace talus
