#include "dda/step_talus.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/search.hpp"
#include "dda/displacement.hpp"
#include "dda/flight.hpp"
#include "dda/impact.hpp"
#include "dda/newton.hpp"
#include "dda/rotation.hpp"
#include "dda/step.hpp"

namespace talus {
namespace {

using std::size_t;

// k_n dt^2 / m of the stiffest contact that is computed with, m being the mass that the contact
// feels.
constexpr double stiffest = 400;
// Overlap is pressed out over this many time steps: no velocity is turned round on the way.
constexpr double recovery_steps = 3;
// A contact is touching when its gap is below this part of the block's radius.
constexpr double touch_ratio = 1e-8;
constexpr int most_events = 40;  // impacts of a block in a step before bouncing is given up
constexpr int most_tries = 24;   // substeps repeated to find an event or to converge

/// Constants of one block in one run.
struct BlockNumbers {
  double mass, radius;
  double stiffness;  // k_n of a contact that feels the whole mass
  double recovery_time, touch, resting_speed, gravity;
  Vec3 inertia;
};

BlockNumbers numbers_of(const Scene& scene, int b) {
  const auto i = static_cast<size_t>(b);
  const double g = scene.gravity.norm(), dt = scene.settings.dt;
  const double radius = scene.blocks.shapes.radius[i];
  return {scene.blocks.mass[i],
          radius,
          stiffest * scene.blocks.mass[i] / (dt * dt),
          recovery_steps * dt,
          touch_ratio * radius,
          std::max(2 * g * dt, 1e-6),
          g,
          scene.blocks.inertia[i]};
}

// Gap up to which a contact may come to press within a substep though the free motion keeps it
// open.
double search_margin(const BlockNumbers& c, double h) {
  return 4 * c.gravity * h * h + 1e-3 * c.radius;
}

/// A substep of `h`: where the block would be without contact, and how the solution changes that.
struct Substep {
  double h = 0;
  Vec3 free_acceleration;
  Motion start, free;  // free: at the end of the substep without contact
  Mat3 R;              // free attitude, body to local axes
  Vec3 spin_free;      // body axes
};

Vec3 load_torque(const Scene& scene, int b, const Quat& attitude) {
  Vec3 torque = Vec3::Zero();
  for (const PointLoad& load : scene.loads)
    if (load.block == b) torque += (attitude * load.point).cross(load.force);
  return torque;
}

Substep predict(const Scene& scene, int b, const BlockNumbers& c, const Motion& start, double t,
                double h) {
  Substep s;
  s.h = h;
  s.start = start;
  s.free_acceleration = free_acceleration(scene, b, t, t + h);
  s.free = fly(start, c.inertia, s.free_acceleration, h);
  if (!scene.loads.empty())
    s.free.angular_momentum += h * load_torque(scene, b, start.pose.attitude);
  s.R = s.free.pose.attitude.toRotationMatrix();
  s.spin_free = (s.R.transpose() * s.free.angular_momentum).cwiseQuotient(c.inertia);
  return s;
}

Mat3 stretch_of(const State& state, int b) {
  Mat3 U = Mat3::Identity();
  if (state.strain.empty()) return U;
  const Vec6& e = state.strain[static_cast<size_t>(b)];
  U += (Mat3() << e[0], e[5] / 2, e[4] / 2, e[5] / 2, e[1], e[3] / 2, e[4] / 2, e[3] / 2, e[2])
           .finished();
  return U;
}

// The row that a remembered contact continues: same features, nearest normal.
int row_of(const ContactMemory& memory, const Work& work) {
  int best = -1;
  double nearest = 0.5;  // never over more than 60 degrees
  for (size_t i = 0; i < work.rows.size(); ++i) {
    const Contact& contact = work.contacts[static_cast<size_t>(work.rows[i].contact)];
    if (!(contact.key == memory.key)) continue;
    const double cosine = contact.normal.dot(memory.normal);
    if (cosine > nearest) nearest = cosine, best = static_cast<int>(i);
  }
  return best;
}

// What the row inherits: the shear spring turned into the new tangent plane, and the overlap that
// presses nothing. Where the ground below changes plane the gap jumps; the jump does no work.
void inherit(const ContactMemory& memory, int index, const Substep& s, double touch,
             ContactRow& row) {
  row.memory = index;
  row.bond_area = memory.bond_area;
  row.offset = std::min(memory.offset, std::max(0.0, -row.gap_start));
  const double jump = memory.gap_end - (row.gap_start + row.offset);
  if (jump > touch) row.offset += std::min(jump, std::max(0.0, -row.gap_start - row.offset));
  const Vec3 shear = s.R.transpose() * memory.shear;
  const double length = shear.norm();
  const Vec3 tangent = shear - row.normal.dot(shear) * row.normal;
  const double tangent_length = tangent.norm();
  row.shear = tangent_length > 0 ? Vec3(tangent * (length / tangent_length)) : Vec3(Vec3::Zero());
}

// How fast the contact would close without contact forces: at the start of the substep, or on the
// mean over it where the spin turns the point round.
double approach(const ContactRow& row, const Substep& s) {
  return std::min(row.speed_start, row.normal.dot(s.R.transpose() * row.free_move) / s.h);
}

// Gap of a vertex to the ground below it when the substep begins. A vertex may stand behind the
// plane of the triangle that it will reach, a ridge away, and yet above the ground: it will hit on
// its way.
double clearance_at_start(const Scene& scene, const Contact& contact, const Substep& s) {
  if (contact.key.mode != ContactMode::vertex_face) return -1;
  const Trn& trn = scene.ground.trn;
  const Vec3 x = place(s.start.pose, contact.point_a);
  if (!contains(trn, x.x(), x.y())) return -1;
  const TrianglePlane plane = triangle_plane(trn, triangle_at(trn, x.x(), x.y()));
  const double gap = plane.normal.dot(x - plane.point);
  return gap > 0 ? gap : -1;  // also where the ground is unknown
}

void set_law(const Scene& scene, const BlockNumbers& c, const Substep& s, ContactRow& row) {
  const double x = row.gap_start + row.offset;
  const Mobility W = mobility(c.mass, c.inertia, row.point, row.normal);
  const double asked = scene.settings.normal_stiffness;
  const double k_n = std::min(asked > 0 ? asked : c.stiffness, c.stiffness / (c.mass * W.normal));
  const double k_s = std::min(scene.settings.shear_ratio * k_n, c.stiffness / (c.mass * W.tangent));
  row.normal_damping = k_n * s.h * c.recovery_time;
  row.shear_damping = k_s * s.h * c.recovery_time;
  row.shear_velocity = row.shear / c.recovery_time;
  row.bias = x < 0 ? x / c.recovery_time : x / s.h;
  row.waits_for_impact =
      row.memory < 0 && row.gap_start > c.touch && approach(row, s) < -c.resting_speed;
}

void make_rows(const Scene& scene, int b, const BlockNumbers& c, const Substep& s,
               const State& state, Work& work) {
  const Mat3 to_body = s.R.transpose();
  const Mat3 R_start = s.start.pose.attitude.toRotationMatrix();
  const Vec3 spin_start = (R_start.transpose() * s.start.angular_momentum).cwiseQuotient(c.inertia);
  work.rows.resize(work.contacts.size());
  for (size_t i = 0; i < work.contacts.size(); ++i) {
    const Contact& contact = work.contacts[i];
    const GroundClass& ground = scene.ground.classes[static_cast<size_t>(contact.ground_class)];
    ContactRow& row = work.rows[i] = ContactRow{};
    row.contact = static_cast<int>(i);
    row.normal = to_body * contact.normal;
    const Vec3& X = contact.point_a;
    const Vec3 lever_start = to_body * (R_start * X);
    row.point = (X + lever_start) / 2;
    row.drift = s.spin_free.cross(X - row.point);
    row.free_move = s.free.pose.position - s.start.pose.position + s.R * (X - lever_start);
    row.gap_start = contact.gap - contact.normal.dot(row.free_move);
    const Vec3 w = s.start.velocity + R_start * spin_start.cross(X);
    row.speed_start = contact.normal.dot(w);
    const Vec3 slip = w - row.speed_start * contact.normal;
    const double slip_speed = slip.norm();
    row.slip_start = slip_speed > 0 ? Vec3(to_body * (slip / slip_speed)) : Vec3(Vec3::Zero());
    row.shear.setZero();
    row.friction = ground.friction;
  }
  const std::vector<ContactMemory>& memory = state.memory[static_cast<size_t>(b)];
  for (size_t m = 0; m < memory.size(); ++m) {
    const int i = row_of(memory[m], work);
    if (i < 0) continue;
    ContactRow& row = work.rows[static_cast<size_t>(i)];
    // a plane that the contact only now runs into is met by an impact, not inherited
    if (row.gap_start > c.touch && approach(row, s) < -c.resting_speed) continue;
    inherit(memory[m], static_cast<int>(m), s, c.touch, row);
  }
  for (ContactRow& row : work.rows) {
    if (row.memory < 0) {
      const Contact& contact = work.contacts[static_cast<size_t>(row.contact)];
      if (row.gap_start <= c.touch && contact.gap < -c.touch && approach(row, s) < -c.resting_speed)
        row.gap_start = std::max(row.gap_start, clearance_at_start(scene, contact, s));
      row.offset = std::max(0.0, -row.gap_start);
    }
    set_law(scene, c, s, row);
    const GroundClass& ground = scene.ground.classes[static_cast<size_t>(
        work.contacts[static_cast<size_t>(row.contact)].ground_class)];
    row.cohesion_impulse = ground.cohesion * row.bond_area * s.h;
    row.tension_impulse = ground.tension * row.bond_area * s.h;
  }
}

// Residual at which the contact forces count as found, as a velocity: 1e-8 of what gravity does in
// the substep, or what the rounding of the coordinates makes of the stiffest contact.
double newton_tolerance(const BlockNumbers& c, const Substep& s) {
  const double rounding = std::numeric_limits<double>::epsilon() *
                          s.start.pose.position.cwiseAbs().maxCoeff() * c.stiffness * s.h / c.mass;
  return std::clamp(rounding, 1e-8 * c.gravity * s.h, 1e-6 * c.gravity * s.h) +
         1e-13 * s.start.velocity.norm();
}

template <int Dof>
BlockSystem<Dof> make_system(const Scene& scene, int b, const BlockNumbers& c, const Substep& s,
                             const State& state) {
  const auto i = static_cast<size_t>(b);
  BlockSystem<Dof> system;
  const Vec3 v_free = s.R.transpose() * s.free.velocity;
  const Vec3 v_start = s.R.transpose() * s.start.velocity;
  const Vec3 spin_start =
      (s.start.pose.attitude.conjugate() * s.start.angular_momentum).cwiseQuotient(c.inertia);
  if constexpr (Dof == 6) {
    system.mass.setZero();
    system.mass.diagonal() << Vec3::Constant(c.mass), c.inertia;
    system.free_velocity << v_free, s.spin_free;
    system.velocity << v_start + s.h * (s.R.transpose() * state.acceleration[i]),
        spin_start + s.h * state.spin_rate[i];
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
    momentum = system.mass * v;
    momentum.template tail<6>() -= s.h * volume * stress;
    for (const PointLoad& load : scene.loads)
      if (load.block == b)
        momentum.template tail<6>() += s.h * strain_load(load.point, s.R.transpose() * load.force);
    system.mass.template bottomRightCorner<6, 6>() += s.h * c.recovery_time * volume * C;
    system.free_velocity = system.mass.ldlt().solve(momentum);
    system.velocity = system.free_velocity;
    system.velocity.template head<6>() << v_start + s.h * (s.R.transpose() * state.acceleration[i]),
        spin_start + s.h * state.spin_rate[i];
  }
  system.tolerance = newton_tolerance(c, s);
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
  out.change = system.velocity;
  out.change.template head<3>() -= s.R.transpose() * s.free.velocity;
  out.change.template segment<3>(3) -= s.spin_free;
  if constexpr (Dof == 12) out.change.template tail<6>().setZero();
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
  const double relax = std::min(0.3, 0.25 * c.gravity * s.h) * s.h;
  work.memory_next.clear();
  for (ContactRow& row : work.rows) {
    if (row.waits_for_impact || row.state == ContactState::open) continue;
    const Contact& contact = work.contacts[static_cast<size_t>(row.contact)];
    const Vec3 moved = s.R.transpose() * row.free_move + solved.moved(row.point, s.h);
    const double p_n = row.normal.dot(row.impulse);
    const Vec3 p_t = row.impulse - p_n * row.normal;
    const double along = row.normal.dot(moved);
    state.ledger.contact -= p_n * along / s.h;
    state.ledger.friction -= p_t.dot(moved) / s.h;
    ContactMemory memory;
    memory.key = contact.key;
    memory.normal = contact.normal;
    memory.offset = std::max(0.0, row.offset - relax);
    memory.gap_end = row.gap_start + row.offset + along - (row.offset - memory.offset);
    memory.normal_force = p_n / s.h;
    memory.state = static_cast<std::uint8_t>(row.state);
    const bool slips = row.state == ContactState::slip;
    memory.bond_area = row.bond_area;
    const double k_t = row.shear_damping / (c.recovery_time * s.h);
    const Vec3 shear =
        slips ? Vec3(p_t / (-s.h * k_t)) : Vec3(row.shear + moved - along * row.normal);
    memory.shear = s.R * shear;
    work.memory_next.push_back(memory);
    ++report.n_closed;
    report.largest_penetration = std::max(report.largest_penetration, -(row.gap_start + along));
  }
  std::swap(state.memory[static_cast<size_t>(b)], work.memory_next);
}

void add_segment(int b, bool flight, double t, double h, const Motion& start, const Motion& end,
                 Work& work) {
  Segment segment;
  segment.block = b;
  segment.flight = flight;
  segment.t_start = t;
  segment.t_end = t + h;
  segment.start = start;
  segment.end = end;
  segment.acceleration = (end.velocity - start.velocity) / h;
  work.segments.push_back(segment);
}

bool left_ground(const Scene& scene, const Vec3& x) {
  return std::isnan(elevation_at(scene.ground.trn, x.x(), x.y()));
}

void stop_outside(const Scene& scene, int b, State& state, StepReport& report) {
  const auto i = static_cast<size_t>(b);
  Motion& m = state.motion[i];
  const Vec3 spin = angular_velocity(m.pose.attitude, m.angular_momentum, scene.blocks.inertia[i]);
  state.ledger.removed +=
      0.5 * scene.blocks.mass[i] * m.velocity.squaredNorm() + 0.5 * spin.dot(m.angular_momentum);
  m.velocity.setZero();
  m.angular_momentum.setZero();
  state.phase[i] = Phase::left_domain;
  state.memory[i].clear();
  ++state.counters.left_domain;
  report.flags = report.flags | StepFlag::left_domain;
}

void set_rates(const Scene& scene, int b, const Motion& start, const Motion& end, double h,
               State& state) {
  const auto i = static_cast<size_t>(b);
  const Vec3& inertia = scene.blocks.inertia[i];
  state.acceleration[i] = (end.velocity - start.velocity) / h;
  const Vec3 before =
      (start.pose.attitude.conjugate() * start.angular_momentum).cwiseQuotient(inertia);
  const Vec3 after = (end.pose.attitude.conjugate() * end.angular_momentum).cwiseQuotient(inertia);
  state.spin_rate[i] = (after - before) / h;
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

  [[nodiscard]] size_t i() const { return static_cast<size_t>(b); }
  Motion& motion() { return state.motion[i()]; }

  bool free_fall_only() const {
    return scene.settings.flight && scene.base.time.empty() && scene.loads.empty();
  }

  void finish(const Substep& s, const Motion& end, double t, double t_next) {
    add_segment(b, state.memory[i()].empty(), t, s.h, s.start, end, work);
    set_rates(scene, b, s.start, end, s.h, state);
    const Vec3 external = s.free_acceleration - scene.gravity;
    if (!external.isZero(0))
      state.ledger.base += c.mass * external.dot(end.pose.position - s.start.pose.position);
    motion() = end;
    state.local_time[i()] = t_next;
    report.shortest_dt = report.shortest_dt > 0 ? std::min(report.shortest_dt, s.h) : s.h;
    ++report.substeps;
  }

  void impact() {
    const ImpactResult hit = apply_impact(scene, b, 2 * c.touch, c.resting_speed, motion(), work);
    if (!hit.hit) return;
    state.ledger.impact += hit.dissipated;
    ++report.n_impacts;
    report.passes += hit.passes;
    if (!hit.converged) ++report.n_unconverged;
    state.acceleration[i()] = scene.gravity;
    state.spin_rate[i()].setZero();
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
      if (near.reach == Reach::above && free_fall_only() && begin_flight(t, h))
        return Attempt::flight;
      state.memory[i()].clear();
      relax_strain(h);
      finish(s, s.free, t, t + h);
      return Attempt::done;
    }
    make_rows(scene, b, c, s, state, work);
    for (const ContactRow& row : work.rows)
      if (row.memory < 0 && row.gap_start <= c.touch && row.gap_start > -1e4 * c.touch &&
          row.speed_start < -c.resting_speed)
        return Attempt::impact;
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
  void relax_strain(double) {
    if (state.strain.empty()) return;
    state.strain[i()].setZero();
    state.strain_rate[i()].setZero();
  }

  bool begin_flight(double t, double h) {
    constexpr double longest_turn = 60;  // [rad]: bounds what motion_at() costs
    const double longest = std::min(1e3, longest_turn / (spin_speed() + 1e-300));
    const double safe = free_time(scene.ground, c.radius, motion().pose.position, motion().velocity,
                                  scene.gravity, longest);
    if (!(safe > 2 * h)) return false;
    state.phase[i()] = Phase::flight;
    state.flight_end[i()] = t + safe;
    state.memory[i()].clear();
    relax_strain(h);
    return true;
  }

  // True when the flight ends within the step; the block is then at its end.
  bool end_flight(double t_end) {
    if (state.flight_end[i()] >= t_end) return false;
    const double t = state.local_time[i()], h = state.flight_end[i()] - t;
    const Motion end = fly(motion(), c.inertia, scene.gravity, h);
    add_segment(b, true, t, h, motion(), end, work);
    motion() = end;
    state.acceleration[i()] = scene.gravity;
    state.spin_rate[i()].setZero();
    state.local_time[i()] = state.flight_end[i()];
    state.phase[i()] = Phase::near_ground;
    return true;
  }

  double spin_speed() {
    const Vec3 body = motion().pose.attitude.conjugate() * motion().angular_momentum;
    return body.cwiseQuotient(c.inertia).norm();
  }

  // Near the ground a substep moves no point farther than half a cell and turns the block by at
  // most half a radian; a needle that rolls at more than 100 radians a step is not followed any
  // closer.
  double longest_substep() {
    const double spin = spin_speed();
    const double speed = motion().velocity.norm() + spin * c.radius;
    const double turn = std::max(0.5 / (spin + 1e-300), scene.settings.dt / 200);
    return std::min(0.5 * scene.ground.trn.cell_size / (speed + 1e-300), turn);
  }

  template <int Dof>
  void run(double t_end) {
    int events = 0;
    while (state.local_time[i()] < t_end) {
      if (state.phase[i()] == Phase::flight && !end_flight(t_end)) return;
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

// Static iteration: steps from rest, each ending at rest, until the block moves no more. friction <
// 0: that of the ground. False when it keeps moving or the forces do not converge.
bool settle(const Scene& scene, int b, double friction, bool from_touch, State& state, Work& work) {
  BlockNumbers c = numbers_of(scene, b);
  const double h = scene.settings.dt;
  c.recovery_time = h / 2;  // from rest, this lands in equilibrium at once as k grows
  Motion& motion = state.motion[static_cast<size_t>(b)];
  StepReport report;
  for (int pass = 0; pass < 40; ++pass) {
    const Substep s = predict(scene, b, c, motion, 0, h);
    (void)find_contacts(scene.ground, scene.blocks.shapes, b, s.free.pose, stretch_of(state, b),
                        search_margin(c, h), work.world_vertices, work.contacts);
    make_rows(scene, b, c, s, state, work);
    if (work.rows.empty()) return true;
    for (ContactRow& row : work.rows) {
      if (friction >= 0) row.friction = friction;
      if (from_touch && pass == 0) row.offset = 0, set_law(scene, c, s, row);
    }
    BlockSystem<6> system = make_system<6>(scene, b, c, s, state);
    if (!solve_contacts(system, std::span(work.rows), scene.settings.max_passes).converged)
      return false;
    const Solved<6> solved = solved_motion(c, s, system);
    remember(c, s, solved, state, work, b, report);
    const double moved = (solved.end.pose.position - motion.pose.position).norm() +
                         c.radius * solved.end.pose.attitude.angularDistance(motion.pose.attitude);
    motion.pose = solved.end.pose;
    if (moved < 1e-14 * c.radius + 1e-15 * motion.pose.position.norm()) return true;
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

void settle_block(const Scene& scene, int b, State& state, Work& work) {
  const auto i = static_cast<size_t>(b);
  const Motion rest = state.motion[i];
  const EnergyLedger ledger = state.ledger;
  constexpr double sticking = 57;  // tan(89 degrees)
  if (touches_at_rest(scene, b, rest, work)) {
    state.motion[i].velocity.setZero();
    bond_faces(scene, b, rest.pose, work, state.memory[i]);
    if (!settle(scene, b, sticking, true, state, work)) {  // it topples: from where it is
      state.motion[i].pose = rest.pose;
      state.memory[i].clear();
    } else if (!rest.velocity.isZero(0)) {  // it moves along the ground: only the overlap is kept
      for (ContactMemory& memory : state.memory[i]) memory.shear.setZero();
    } else {
      const Motion stuck = state.motion[i];
      const std::vector<ContactMemory> memory = state.memory[i];
      if (!settle(scene, b, -1, false, state, work)) {  // it slides: from where it stuck
        state.motion[i] = stuck;
        state.memory[i] = memory;
      }
    }
  }
  state.ledger = ledger;
  state.motion[i].velocity = rest.velocity;
}

}  // namespace talus
