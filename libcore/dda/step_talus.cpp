#include "dda/step_talus.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/past_ridge.hpp"
#include "contact/search.hpp"
#include "dda/displacement.hpp"
#include "dda/flight.hpp"
#include "dda/impact.hpp"
#include "dda/newton.hpp"
#include "dda/rotation.hpp"
#include "dda/step.hpp"
#include "dda/substep.hpp"

namespace talus {
namespace {

using std::size_t;

template <int Dof>
BlockSystem<Dof> make_system(const Scene& scene, int b, const BlockNumbers& c, const Substep& s,
                             const State& state) {
  const auto i = static_cast<size_t>(b);
  BlockSystem<Dof> system;
  const Vec3 v_free = s.R.transpose() * s.free.velocity;
  const Vec3 v_guess = s.R.transpose() * (s.start.velocity + s.h * state.acceleration[i]);
  const Vec3 spin_guess = s.spin_start + s.h * state.spin_rate[i];
  if constexpr (Dof == 6) {
    system.mass.setZero();
    system.mass.diagonal() << Vec3::Constant(c.mass), c.inertia;
    system.free_velocity << v_free, s.spin_free;
    system.velocity << v_guess, spin_guess;
  } else {
    const Blocks& blocks = scene.blocks;
    const double volume = blocks.volume[i];
    const Mat6 C = elastic_matrix(blocks.young[i], blocks.poisson[i]);
    Vec6 stress = C * state.strain[i];
    if (!blocks.initial_stress.empty()) stress += blocks.initial_stress[i];
    Vec12 momentum;
    system.mass = mass_matrix(c.mass / volume, volume, blocks.second_moment[i].asDiagonal());
    Vec12 v;
    v << v_free, s.spin_free, state.strain_rate[i];
    // the angular momentum is that of the turning and of the straining together
    v.segment<3>(3) -=
        c.per_inertia.cwiseProduct(system.mass.template block<3, 6>(3, 6) * v.tail<6>());
    momentum = system.mass * v;
    momentum.template tail<6>() -= s.h * volume * stress;
    for (const PointLoad& load : scene.loads)
      if (load.block == b)
        momentum.template tail<6>() += s.h * strain_load(load.point, s.R.transpose() * load.force);
    system.mass.template bottomRightCorner<6, 6>() += s.h * c.recovery_time * volume * C;
    system.free_velocity = system.mass.ldlt().solve(momentum);
    system.velocity = system.free_velocity;
    system.velocity.template head<6>() << v_guess, spin_guess;
  }
  system.tolerance = scene.settings.tolerance_factor * newton_tolerance(c, s);
  return system;
}

/// Motion at the end of the substep: the free one corrected by what the contacts changed, with the
/// acceleration constant over the substep, D = h (v + v') / 2 (theory 1.8, beta = 1/2).
template <int Dof>
struct Solved {
  Motion end;
  Eigen::Matrix<double, Dof, 1> change;  // of velocity by contact, body axes
  // Displacement of a body point by contact, body axes.
  [[nodiscard]] Vec3 moved(const Vec3& X, double h) const {
    return h / 2 * point_velocity<Dof>(change, X);
  }
};

template <int Dof>
Solved<Dof> solved_motion(const BlockNumbers& c, const Substep& s, const BlockSystem<Dof>& system) {
  Solved<Dof> out;
  out.change = system.velocity - system.free_velocity;
  if constexpr (Dof == 12) {  // where straining stops, what turned with it goes on turning
    out.change.template segment<3>(3) += c.per_inertia.cwiseProduct(
        system.mass.template block<3, 6>(3, 6) * out.change.template tail<6>());
    out.change.template tail<6>().setZero();
  }
  const Vec3 dv = s.R * out.change.template head<3>();
  const Vec3 dw = s.R * out.change.template segment<3>(3);
  out.end = s.free;
  out.end.velocity += dv;
  out.end.pose.position += s.h / 2 * dv;
  out.end.pose.attitude = (rotation_by(s.h / 2 * dw) * s.free.pose.attitude).normalized();
  out.end.angular_momentum +=
      s.R * out.change.template segment<3>(3).cwiseProduct(c.inertia).eval();
  return out;
}

// Time at which the first waiting contact is hit, if one is: 0 < time <= h; h + 1 when none is.
template <int Dof>
double first_hit(const BlockNumbers& c, const Substep& s, const Solved<Dof>& solved,
                 const Work& work) {
  double first = s.h + 1;
  for (const ContactRow& row : work.rows) {
    if (!row.waits_for_impact) continue;
    const double gap_end = work.contacts[static_cast<size_t>(row.contact)].gap +
                           row.normal.dot(solved.moved(row.point, s.h));
    if (gap_end > c.touch) continue;
    const double v = row.speed_start, g = row.gap_start + 0.5 * c.touch;
    const double a = 2 * (gap_end + 0.5 * c.touch - g - v * s.h) / (s.h * s.h);
    const double root = std::sqrt(std::max(0.0, v * v - 2 * a * g));
    first = std::min(first, gap_end > -c.touch ? s.h : std::min(s.h, 2 * g / (root - v)));
  }
  return first;
}

// What each contact keeps for the next step, and the work it did.
template <int Dof>
void remember(const BlockNumbers& c, const Substep& s, const Solved<Dof>& solved, State& state,
              Work& work, int b, StepReport& report) {
  const double relax = offset_relaxed(c.gravity, s.h), per_h = 1 / s.h;
  std::vector<ContactMemory>& memory = state.memory[static_cast<size_t>(b)];
  report.n_flips += count_flips(work.rows, memory);
  memory.clear();
  for (ContactRow& row : work.rows) {
    const Contact& contact = work.contacts[static_cast<size_t>(row.contact)];
    const Vec3 moved = row.free_move + solved.moved(row.point, s.h);
    const double overlap = -(row.gap_start + row.normal.dot(moved));
    note_overlap(report, overlap, c.thickness);
    if (row.waits_for_impact || row.state == ContactState::open) continue;
    const double p_n = row.normal.dot(row.impulse);
    const Vec3 p_t = row.impulse - p_n * row.normal;
    const double along = row.normal.dot(moved);
    state.ledger.contact -= p_n * along * per_h;
    state.ledger.friction -= p_t.dot(moved) * per_h;
    const double offset = std::max(0.0, row.offset - relax);
    const Vec3 shear = row.state == ContactState::slip
                           ? Vec3((-c.recovery_time / row.shear_damping) * p_t)
                           : Vec3(row.shear + moved - along * row.normal);
    memory.push_back(
        {.key = contact.key,
         .normal = contact.normal,
         .shear = s.R * shear,
         .offset = offset,
         .gap_end = row.gap_start + row.offset + along - (row.offset - offset),
         .normal_force = p_n * per_h,
         .stiffness = row.bond_area > 0 ? 0 : row.normal_damping * per_h / c.recovery_time,
         .bond_area = row.bond_area,
         .state = static_cast<std::uint8_t>(row.state)});
    ++report.n_closed;
    report.sum_penetration += std::max(overlap, 0.0);
  }
}

/// Outcome of one attempt at a substep.
enum class Attempt { done, shorter, impact, flight, left };

/// Everything that advances one block; a struct so that its parts share what they all need.
struct Advance {
  const Scene& scene;
  int b;
  State& state;
  Work& work;
  StepReport& report;
  BlockNumbers c;
  Contact foreseen = {};     // the one that an attempt found about to hit
  bool is_foreseen = false;  // not yet tried
  bool may_fly = true;       // off for the rest of a step in which a flight met the ground

  [[nodiscard]] size_t i() const { return static_cast<size_t>(b); }
  Motion& motion() { return state.motion[i()]; }

  bool free_fall_only() const { return may_fly && scene.base.time.empty() && scene.loads.empty(); }

  void finish(const Substep& s, const Motion& end, double t, double t_next) {
    add_segment(b, state.memory[i()].empty(), t, s.h, s.start, end, work);
    set_rates(b, c, s, end, state);
    set_support(scene, b, (end.velocity - s.free.velocity) / s.h, state);
    const Vec3 external = s.free_acceleration - scene.gravity;
    if (!external.isZero(0))
      state.ledger.base += c.mass * external.dot(end.pose.position - s.start.pose.position);
    motion() = end;
    state.local_time[i()] = t_next;
    report.shortest_dt = report.shortest_dt > 0 ? std::min(report.shortest_dt, s.h) : s.h;
    ++report.substeps;
  }

  // The gap of edges over a substep is not quite linear: where the hit was foreseen, they may still
  // be a little apart, or just not cross. Then the contact that was foreseen is hit besides those
  // that touch; without it nothing would be hit, again and again.
  void impact() {
    ImpactResult hit = apply_impact(scene, b, 2 * c.touch, c.resting_speed, motion(), work);
    if (!hit.hit && is_foreseen) {
      work.contacts.push_back(foreseen);
      hit = apply_impact(scene, b, c.resting_speed, motion(), work);
    }
    is_foreseen = false;
    if (!hit.hit) return;
    state.ledger.impact += hit.dissipated;
    ++report.n_impacts;
    report.passes += hit.passes;
    if (!hit.converged) ++report.n_unconverged;
    state.acceleration[i()] = scene.gravity;
    state.spin_rate[i()].setZero();
    state.support[i()].setZero();
  }

  // Substep of h from t; h is shortened to the first impact or when the forces do not converge.
  template <int Dof>
  Attempt attempt(double t, double& h, bool last) {
    const Substep s = predict(scene, b, c, motion(), t, h);
    const Mat3 stretch = stretch_of(state, b);
    const SearchResult near =
        find_contacts(scene.ground, scene.blocks.shapes, b, s.free.pose, stretch,
                      search_margin(c, h), work.world_vertices, work.contacts);
    if (near.reach == Reach::off_ground) return Attempt::left;
    if (work.contacts.empty()) {
      if (free_fall_only() && begin_flight(t, h)) return Attempt::flight;
      report.n_flips += static_cast<int>(state.memory[i()].size());
      state.memory[i()].clear();
      relax_strain();
      finish(s, s.free, t, t + h);
      return Attempt::done;
    }
    make_rows(scene, b, c, s, state, work);
    for (const ContactRow& row : work.rows)
      if (row.memory < 0 && row.gap_start <= c.touch && row.gap_start > -deep_share * c.thickness &&
          row.speed_start < -c.resting_speed) {
        foreseen = work.contacts[static_cast<size_t>(row.contact)];
        is_foreseen = true;
        return Attempt::impact;
      }
    if (!last && goes_through_ridge(s)) {
      h /= 2;
      return Attempt::shorter;
    }
    BlockSystem<Dof> system = make_system<Dof>(scene, b, c, s, state);
    const NewtonResult newton =
        solve_contacts(system, std::span(work.rows), scene.settings.max_passes);
    report.passes += newton.passes;
    if (!newton.converged) {
      if (!last) {
        h /= 2;
        ++state.counters.cut_back;
        return Attempt::shorter;
      }
      ++report.n_unconverged;
      report.flags = report.flags | StepFlag::unconverged;
    }
    if (break_bonds()) return Attempt::shorter;
    const Solved<Dof> solved = solved_motion(c, s, system);
    const double hit = first_hit(c, s, solved, work);
    if (hit < s.h && !last) {
      h = hit;
      return Attempt::shorter;
    }
    if (near.reach == Reach::below) report.flags = report.flags | StepFlag::fell_through;
    remember(c, s, solved, state, work, b, report);
    if constexpr (Dof == 12) {
      state.strain[i()] += h / 2 * (state.strain_rate[i()] + system.velocity.template tail<6>());
      state.strain_rate[i()] = system.velocity.template tail<6>();
    }
    finish(s, solved.end, t, t + h);
    return hit <= s.h ? Attempt::impact : Attempt::done;
  }

  // Whether a vertex or an edge has gone through a ridge in a substep, so that the contacts at its
  // end say nothing of that. No use to ask where hardly anything moved.
  [[nodiscard]] bool goes_through_ridge(const Substep& s) {
    constexpr double deep = 0.03, short_way = 0.01;  // of the thickness
    if (s.h * top_speed() < short_way * c.thickness) return false;
    for (const ContactRow& row : work.rows)
      if (came_through_ridge(scene, c, s, work.contacts[static_cast<size_t>(row.contact)], row))
        return true;
    return depth_past_ridge(scene.ground, scene.blocks.shapes, b, work.world_vertices,
                            work.contacts, deep * c.thickness) > 0;
  }

  // A bond that opened is gone; bonds that slip are gone when no other holds the block any more, so
  // that a face fails at the sum of its strengths. The substep is then computed again without them.
  bool break_bonds() {
    bool holds = false, broken = false;
    for (const ContactRow& row : work.rows)
      holds |= row.bond_area > 0 && row.state == ContactState::stick;
    for (const ContactRow& row : work.rows) {
      const bool fails =
          row.state == ContactState::open || (row.state == ContactState::slip && !holds);
      if (row.bond_area == 0 || !fails) continue;
      state.memory[i()][static_cast<size_t>(row.memory)].bond_area = 0;
      broken = true;
    }
    return broken;
  }

  // Off the ground nothing strains the block: quasi-static.
  void relax_strain() {
    if (state.strain.empty()) return;
    state.strain[i()].setZero();
    state.strain_rate[i()].setZero();
  }

  bool begin_flight(double t, double h) {
    constexpr double longest_turn = 60;  // [rad]: bounds what motion_at() costs near the flip
    const double longest = std::min(1e3, longest_turn / (spin_speed() + 1e-300));
    const double safe = free_time(scene.ground, c.radius, motion().pose.position, motion().velocity,
                                  scene.gravity, longest);
    if (!(safe > 2 * h)) return false;
    state.phase[i()] = Phase::flight;
    state.flight_end[i()] = t + safe;
    report.n_flips += static_cast<int>(state.memory[i()].size());
    state.memory[i()].clear();
    state.support[i()].setZero();
    relax_strain();
    return true;
  }

  // With Settings::flight off the ground is searched though nothing can be hit: a flight that
  // touches it all the same ends where the step begins.
  bool touches_in_flight(double t_end) {
    const double h = t_end - state.time;
    const Pose pose = motion_at(scene, state, b, t_end).pose;
    (void)find_contacts(scene.ground, scene.blocks.shapes, b, pose, stretch_of(state, b),
                        search_margin(c, h), work.world_vertices, work.contacts);
    return std::any_of(work.contacts.begin(), work.contacts.end(),
                       [](const Contact& contact) { return contact.gap < 0; });
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
    return body.cwiseProduct(c.per_inertia).norm();
  }

  // No point of the block is faster [m/s].
  double top_speed() { return motion().velocity.norm() + spin_speed() * c.radius; }

  // Near the ground a substep moves no point farther than half a cell and turns the block by at
  // most half a radian; a needle that rolls at more than 100 radians a step is not followed any
  // closer.
  double longest_substep() {
    const double turn = std::max(0.5 / (spin_speed() + 1e-300), scene.settings.dt / 200);
    return std::min(0.5 * scene.ground.trn.cell_size / (top_speed() + 1e-300), turn);
  }

  template <int Dof>
  void run(double t_end) {
    int events = 0;
    while (state.local_time[i()] < t_end) {
      if (state.phase[i()] == Phase::flight && !flight_ends(t_end)) return;
      const double t = state.local_time[i()];
      double h = std::min(t_end - t, longest_substep());
      Attempt outcome = Attempt::shorter;
      for (int tries = 1; outcome == Attempt::shorter; ++tries)
        outcome = attempt<Dof>(t, h, tries >= most_tries);
      if (t_end - state.local_time[i()] < 1e-9 * scene.settings.dt) state.local_time[i()] = t_end;
      if (outcome == Attempt::impact) {
        if (++events > most_events) c.resting_speed *= 2;
        impact();
      }
      if (outcome == Attempt::left || left_ground(scene, motion().pose.position)) {
        stop_outside(scene, b, state, report);
        state.local_time[i()] = t_end;
        return;
      }
    }
  }
};

// Bonds of the faces that lie on the ground with all their corners when the run begins: each corner
// holds its share of the face's area (theory 1.7). Only where the ground has cohesion or tensile
// strength. `work.contacts` are those that touch.
void bond_faces(const Scene& scene, int b, const Pose& pose, const Work& work,
                std::vector<ContactMemory>& memory) {
  constexpr double parallel = 1 - 1e-6;
  const Shapes& shapes = scene.blocks.shapes;
  const auto touching = [&](int vertex, const Vec3& outward) -> const Contact* {
    for (const Contact& c : work.contacts)
      if (c.key.mode == ContactMode::vertex_face && c.key.feature_a == vertex &&
          c.normal.dot(outward) < -parallel)
        return &c;
    return nullptr;
  };
  const int first_part = shapes.part_begin[static_cast<size_t>(b)];
  const int last_part = shapes.part_begin[static_cast<size_t>(b) + 1];
  for (int f = shapes.face_begin[static_cast<size_t>(first_part)];
       f < shapes.face_begin[static_cast<size_t>(last_part)]; ++f) {
    const ShapeFace& face = shapes.faces[static_cast<size_t>(f)];
    const Vec3 outward = pose.attitude * face.normal;
    const int n = face.vertex_end - face.vertex_begin;
    int held = 0;
    for (int k = face.vertex_begin; k < face.vertex_end; ++k)
      held += touching(shapes.face_vertices[static_cast<size_t>(k)], outward) != nullptr;
    if (held < n) continue;
    for (int k = face.vertex_begin; k < face.vertex_end; ++k) {
      const Contact& c = *touching(shapes.face_vertices[static_cast<size_t>(k)], outward);
      const GroundClass& ground = scene.ground.classes[static_cast<size_t>(c.ground_class)];
      if (ground.cohesion == 0 && ground.tension == 0) continue;
      ContactMemory bond;
      bond.key = c.key;
      bond.normal = c.normal;
      bond.gap_end = c.gap;
      bond.bond_area = face.area / n;
      memory.push_back(bond);
    }
  }
}

// Whether the block touches the ground and moves neither into it nor off it.
bool touches_at_rest(const Scene& scene, int b, const Motion& motion, Work& work) {
  const BlockNumbers c = numbers_of(scene, b);
  (void)find_contacts(scene.ground, scene.blocks.shapes, b, motion.pose, Mat3::Identity(),
                      1e3 * c.touch, work.world_vertices, work.contacts);
  const double slow = 1e-6 * motion.velocity.norm();
  return !work.contacts.empty() &&
         std::all_of(work.contacts.begin(), work.contacts.end(), [&](const Contact& contact) {
           return std::abs(contact.normal.dot(motion.velocity)) <= slow;
         });
}

// Static iteration: steps from rest, each ending at rest, until the block moves by less than
// `still` of its radius. friction < 0: that of the ground. False when it keeps moving or the forces
// do not converge.
bool settle(const Scene& scene, int b, double friction, bool from_touch, double still, State& state,
            Work& work) {
  constexpr int most_passes = 40, first_passes = 5;  // those before the way settles down
  constexpr double accelerates = 0.9;                // of the pass before: it comes to no end
  BlockNumbers c = numbers_of(scene, b);
  const double h = scene.settings.dt;
  c.recovery_time = h / 2;  // from rest, this lands in equilibrium at once as k grows
  Motion& motion = state.motion[static_cast<size_t>(b)];
  StepReport report;
  double moved_before = 0;
  for (int pass = 0; pass < most_passes; ++pass) {
    const Substep s = predict(scene, b, c, motion, 0, h);
    (void)find_contacts(scene.ground, scene.blocks.shapes, b, s.free.pose, stretch_of(state, b),
                        search_margin(c, h), work.world_vertices, work.contacts);
    make_rows(scene, b, c, s, state, work);
    if (work.rows.empty()) return true;
    for (ContactRow& row : work.rows) {
      if (friction >= 0) row.friction = friction;
      if (from_touch && pass == 0) row.offset = 0, set_ground_law(scene, c, s, row);
    }
    BlockSystem<6> system = make_system<6>(scene, b, c, s, state);
    if (!solve_contacts(system, std::span(work.rows), scene.settings.max_passes).converged)
      return false;
    const Solved<6> solved = solved_motion(c, s, system);
    remember(c, s, solved, state, work, b, report);
    const double moved = (solved.end.pose.position - motion.pose.position).norm() +
                         c.radius * solved.end.pose.attitude.angularDistance(motion.pose.attitude);
    motion.pose = solved.end.pose;
    if (moved < still * c.radius + 1e-15 * motion.pose.position.norm()) return true;
    if (pass >= first_passes && moved > accelerates * moved_before) return false;
    moved_before = moved;
  }
  return false;
}

}  // namespace

void advance_block_talus(const Scene& scene, int b, double t_end, State& state, Work& work,
                         StepReport& report) {
  Advance advance{scene, b, state, work, report, numbers_of(scene, b)};
  if (scene.settings.strains)
    advance.run<12>(t_end);
  else
    advance.run<6>(t_end);
}

void bond_block(const Scene& scene, int b, State& state, Work& work) {
  const auto i = static_cast<size_t>(b);
  if (touches_at_rest(scene, b, state.motion[i], work))
    bond_faces(scene, b, state.motion[i].pose, work, state.memory[i]);
}

void settle_block(const Scene& scene, int b, State& state, Work& work) {
  const auto i = static_cast<size_t>(b);
  const Motion rest = state.motion[i];
  const EnergyLedger ledger = state.ledger;
  constexpr double sticking = 57;  // tan(89 degrees)
  constexpr double nearly_still = 1e-9, still = 1e-14;
  if (touches_at_rest(scene, b, rest, work)) {
    state.motion[i].velocity.setZero();
    bond_faces(scene, b, rest.pose, work, state.memory[i]);
    const bool sticks = settle(scene, b, sticking, true, nearly_still, state, work);
    if (!sticks) {  // it topples: from where it is
      state.motion[i].pose = rest.pose;
      state.memory[i].clear();
    } else if (!rest.velocity.isZero(0)) {  // it moves along the ground: only the overlap is kept
      for (ContactMemory& memory : state.memory[i]) memory.shear.setZero();
    } else {
      const Motion stuck = state.motion[i];
      const std::vector<ContactMemory> memory = state.memory[i];
      if (!settle(scene, b, -1, false, still, state, work)) {  // it slides: from where it stuck
        state.motion[i] = stuck;
        state.memory[i] = memory;
      }
    }
  }
  state.ledger = ledger;
  state.motion[i].velocity = rest.velocity;
}

}  // namespace talus
