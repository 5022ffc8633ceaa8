// Start of a substep: numbers of a block, its free motion, the rows of its ground contacts.
#include "step/substep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "contact/entrance.hpp"
#include "contact/scales.hpp"
#include "motion/displacement.hpp"
#include "motion/rotation.hpp"
#include "solver/law_numbers.hpp"
#include "step/flight.hpp"
#include "step/loads.hpp"
#include "step/rough_joints.hpp"

namespace talus {
namespace {

using std::size_t;

using law::least_speed, law::shallow, law::most_of_thickness, law::rebound_matters,
    law::recovery_steps, law::same_law, law::stiffest_lone;

constexpr double no_limit = std::numeric_limits<double>::infinity();

// The row that a remembered contact continues: same features, nearest normal.
int row_of(const ContactMemory& memory, std::span<const Contact> contacts) {
  int best = -1;
  double nearest = 0.5;  // never over more than 60 degrees
  for (size_t i = 0; i < contacts.size(); ++i) {
    const Contact& contact = contacts[i];
    if (contact.key.feature_a != memory.key.feature_a || !(contact.key == memory.key)) continue;
    const double cosine = contact.normal.dot(memory.normal);
    if (cosine > nearest) nearest = cosine, best = static_cast<int>(i);
    if (cosine > 1 - last_figures) break;
  }
  return best;
}

// Where the stiffness of a contact has changed, its springs keep their forces. Overlap beyond that
// would throw the block; it presses nothing from now on, and again when the contact is as soft as
// before. A contact that becomes softer carries no more than it did, since the force that presses
// overlap out of a stiff one is mostly taken up by damping. In a jam, where nothing is left out
// that could keep the normal force, the friction that it allowed is not kept: it would throw the
// block.
void keep_force(const BlockNumbers& c, double k_n, ContactRow& row) {
  const double share = row.last_stiffness / k_n, offset = row.offset;
  const double pressed_in = std::max(0.0, -(row.gap_start + offset));
  const double carried = share > 1
                             ? std::clamp(row.last_force / k_n, pressed_in, share * pressed_in)
                             : share * pressed_in;
  row.offset = std::max(0.0, offset + pressed_in - carried);
  const bool is_jammed = share > 1 && row.last_force > law::heavy * c.mass * c.gravity;
  const double kept = pressed_in + offset - row.offset;
  row.shear *= is_jammed ? std::clamp(pressed_in > 0 ? kept / pressed_in : 1, 1.0, share) : share;
}

// Stiffness with which a contact carries its last force at an overlap of `sag` or less. It changes
// by leaps, so that keep_force() sees them, and seldom.
double stiffness_to_bear(const ContactRow& row, double sag) {
  const double needed = row.last_force / sag, last = row.last_stiffness;
  return last >= needed && last <= law::too_much * needed ? last : law::stiffens * needed;
}

// As soft as a contact may be under its last force: with `sag` of overlap, from `least` for a small
// force up to `stiffest`; beyond, where even that lets the overlap grow far.
double softest_by_load(const BlockNumbers& c, double sag, double least, double stiffest,
                       const ContactRow& row) {
  const double k = std::clamp(stiffness_to_bear(row, sag), std::min(least, stiffest), stiffest);
  const double far = std::max(law::sunk * c.thickness, law::soft_sag * sag);
  return row.last_force > far * stiffest ? std::max(k, stiffness_to_bear(row, far)) : k;
}

// Stiffness that the load asks for, from `soft` up to `most`; reached step by step beyond `ready`,
// left step by step by a contact that slips or opens, and at once where the forces were hard to
// find.
double stiffness_by_load(const BlockNumbers& c, double soft, double ready, double most,
                         const ContactRow& row) {
  const double last = row.last_stiffness;
  double k = std::min(stiffness_to_bear(row, c.sag), std::max(law::stiffens * last, ready));
  if (last > 0 && row.cooldown_steps > 0)
    k = std::min(k, row.cooldown_steps == law::longest_cooldown ? last / law::relief : last);
  const bool moves = row.slip_speed > c.slow || row.speed_start > c.slow;
  if (moves) k = std::min(k, last / law::largest_change);
  return std::clamp(k, soft, std::max(soft, most));
}

// How fast the contact would close without contact forces: at the start of the substep, or on the
// mean over it where the spin turns the point round.
double approach(const ContactRow& row, const Substep& s) {
  double mean = row.normal.dot(row.free_move) / s.h;
  if (s.is_straining) mean += row.normal.dot(s.straining * row.arm);
  return std::min(row.speed_start, mean);
}

/// Where a contact of a face or an edge was when the substep began: the block slides over a node or
/// a ridge that stays, so it is another point of the block there.
struct FeatureStart {
  Vec3 point = Vec3::Zero();   // of the block, body axes [m]
  Vec3 normal = Vec3::Zero();  // from the ground to the block, body axes
  double gap = 0;              // [m]
};

FeatureStart face_start(const Vec3& node, const Contact& contact, const Vec3& normal) {
  const double gap = normal.dot(contact.point_a - node);
  return {node + gap * normal, normal, gap};
}

// None where the edges were nearly 1 - last_figures, or did not cross between the ends of the
// block's.
std::optional<FeatureStart> edge_start(const Scene& scene, const Substep& s, const Contact& contact,
                                       const Vec3& normal_end) {
  const Trn& trn = scene.ground.trn;
  const int node = contact.key.feature_b / 4;
  const TrnEdge ridge = trn_edge(trn, node / trn.n_cols, node % trn.n_cols,
                                 static_cast<EdgeKind>(contact.key.feature_b % 4));
  const Vec3 from = node_point(trn, ridge.a.row, ridge.a.col);
  const Vec3 f = s.R_start.transpose() * (node_point(trn, ridge.b.row, ridge.b.col) - from),
             Q = s.R_start.transpose() * (from - s.start.pose.position);
  const Shapes& shapes = scene.blocks.shapes;
  const ShapeEdge& edge =
      edges_of(shapes, contact.block_a)[static_cast<size_t>(contact.key.feature_a)];
  const std::span<const Vec3> vertices = vertices_of(shapes, contact.block_a);
  const Vec3 &P = vertices[static_cast<size_t>(edge.a)],
             e = vertices[static_cast<size_t>(edge.b)] - P;
  const LinePair at = nearest_on_lines(P, e, Q, f);
  if (at.parallel || at.s < 0 || at.s > 1) return std::nullopt;
  Vec3 normal = e.cross(f).normalized();
  if (normal.dot(normal_end) < 0) normal = -normal;
  const Vec3 point = P + at.s * e;
  return FeatureStart{point, normal, normal.dot(point - (Q + at.t * f))};
}

// A contact of a face or an edge that continues acts, over the substep, half-way between its places
// on the block at the start and the end, and its gap is that between the features at either time.
// With the point of its end alone, a face that slides over a node at speed v would be
// supported v h / 2 away from its place.
void follow_features(const Scene& scene, const Substep& s, const Contact& contact,
                     const Mat3& to_body, ContactRow& row) {
  const Mat3 from_start = to_body * s.R_start;
  const Vec3 normal_end = s.R_start.transpose() * contact.normal;
  std::optional<FeatureStart> start;
  if (contact.key.mode == ContactMode::face_vertex)
    start = face_start(s.R_start.transpose() * (contact.point_b - s.start.pose.position), contact,
                       row.normal);
  else
    start = edge_start(scene, s, contact, normal_end);
  if (!start) return;
  const Vec3 lever = from_start * start->point, normal = from_start * start->normal;
  const Vec3 velocity = to_body * s.start.velocity + (from_start * s.spin_start).cross(lever);
  row.arm = (contact.point_a + lever) / 2;
  const Vec3 normal_free = row.normal;
  row.normal = (normal_free + normal).normalized();
  const Vec3 velocity_free = to_body * s.free.velocity + s.spin_free.cross(contact.point_a);
  row.tilt_speed = (normal_free - row.normal).dot(velocity_free);
  row.drift = s.spin_free.cross(contact.point_a - row.arm) + row.tilt_speed * row.normal;
  row.gap_start = start->gap;
  row.speed_start = normal.dot(velocity);
  row.free_move += (contact.gap - start->gap - row.normal.dot(row.free_move)) * row.normal;
}

// Gap of a vertex to the ground below it when the substep begins. A vertex may be behind the plane
// of the triangle that it will reach, a ridge away, and yet above the ground: it will hit on its
// path.
double clearance_at_start(const Scene& scene, const Contact& contact, const Substep& s) {
  if (contact.key.mode != ContactMode::vertex_face) return -1;
  const Trn& trn = scene.ground.trn;
  const Vec3 x = place(s.start.pose, contact.point_a);
  if (!contains(trn, x.x(), x.y())) return -1;
  const TrianglePlane plane = triangle_plane(trn, triangle_at(trn, x.x(), x.y()));
  const double gap = plane.normal.dot(x - plane.point);
  return gap > 0 ? gap : -1;  // also where the ground is unknown
}

}  // namespace

double resting_speed(const Settings& settings, double g) {
  const double by_gravity = g * settings.dt;
  return std::max({std::clamp(rebound_matters, by_gravity, law::rebounds_by_gravity * by_gravity),
                   least_speed * settings.tolerance_factor * by_gravity, 1e-6});
}

BlockNumbers numbers_of(const Scene& scene, int b) {
  const auto i = static_cast<size_t>(b);
  const double g = scene.gravity.norm(), dt = scene.settings.dt;
  const double radius = scene.blocks.shapes.radius[i];
  return {scene.blocks.mass[i],
          radius,
          scene.blocks.shapes.thickness[i],
          stiffest_lone * scene.blocks.mass[i] / (dt * dt),
          recovery_steps * dt,
          rounding * radius,
          resting_speed(scene.settings, g),
          resting_speed(scene.settings, g),
          g,
          scene.blocks.inertia[i],
          1 / scene.blocks.mass[i],
          scene.blocks.inertia[i].cwiseInverse()};
}

double search_margin(const BlockNumbers& c, double h) {
  return 4 * c.gravity * h * h + 1e-3 * c.radius;
}

Substep predict(const Scene& scene, int b, const BlockNumbers& c, const Motion& start, double t,
                double h, std::span<const double> pressure) {
  Substep s;
  s.h = h;
  s.start = start;
  s.free_acceleration = free_acceleration(scene, b, t, t + h, pressure);
  if (loads_on(scene, b).empty()) {
    s.free = fly(start, c.inertia, s.free_acceleration, h);
  } else {  // half of their torque's impulse before the flight, so that it turns the block too
    const Vec3 half = h / 2 * load_torque(scene, b, start.pose.attitude, pressure);
    Motion kicked = start;
    kicked.angular_momentum += half;
    s.free = fly(kicked, c.inertia, s.free_acceleration, h);
    s.free.angular_momentum += half;
  }
  s.R = s.free.pose.attitude.toRotationMatrix();
  s.R_start = start.pose.attitude.toRotationMatrix();
  s.spin_start = (s.R_start.transpose() * start.angular_momentum).cwiseProduct(c.inverse_inertia);
  s.spin_free = (s.R.transpose() * s.free.angular_momentum).cwiseProduct(c.inverse_inertia);
  return s;
}

bool came_through_ridge(const Scene& scene, const BlockNumbers& c, const Substep& s,
                        const Contact& contact, const ContactRow& row) {
  return row.memory < 0 && row.gap_start < -c.touch && contact.gap < -c.touch &&
         row.speed_start > c.resting_speed && clearance_at_start(scene, contact, s) > c.touch;
}

void forget_last_step(ContactRow& row) {
  row.shear.setZero();
  row.offset = row.last_stiffness = row.last_force = row.bond_area = 0;
  row.cohesion = row.tension = 0;
  row.normal_limit = no_normal_limit;
  row.memory = -1;
  row.stuck = false;
  row.tilt_speed = 0;
  row.cooldown_steps = 0;
  row.cap = 0;
  row.impulse.setZero();
  row.state = ContactState::open;
}

ContactRow& begin_row(const Scene& scene, int b, size_t i, const Mat3& to_row,
                      std::span<const Contact> contacts, std::span<ContactRow> rows) {
  const Contact& contact = contacts[i];
  const GroundClass& ground = scene.ground.classes[contact.ground_class];
  ContactRow& row = rows[i];
  forget_last_step(row);
  row.key = contact.key;
  row.a = b;
  row.ground_class = contact.ground_class;
  row.contact = static_cast<int>(i);
  const bool same_plane = i > 0 && contact.normal == contacts[i - 1].normal;
  row.normal = same_plane ? rows[i - 1].normal : Vec3(to_row * contact.normal);
  row.friction = ground.friction;
  row.restitution = ground.restitution;
  return row;
}

bool comes_back_fast(const ContactMemory& memory, double approach, double h,
                     const BlockNumbers& c) {
  return memory.normal_force == 0 && memory.bond_area == 0 &&
         -approach * h > law::sunk * c.thickness;
}

Mat3 stretch_of(const State& state, int b) {
  if (state.strain.empty()) return Mat3::Identity();
  return Mat3::Identity() + strain_tensor(state.strain[b]);
}

void inherit(const ContactMemory& memory, int index, bool same_features, const Mat3& to_row,
             const BlockNumbers& c, ContactRow& row) {
  row.memory = index;
  row.stuck = memory.state == static_cast<std::uint8_t>(ContactState::stick);
  row.last_stiffness = memory.stiffness;
  row.last_force = memory.normal_force;
  row.cooldown_steps = memory.cooldown_steps;
  row.bond_area = memory.bond_area;
  row.offset = std::min(memory.offset, std::max(0.0, -row.gap_start));
  const double jump = memory.gap_end - (row.gap_start + row.offset);
  if (jump > c.touch) {
    const bool by_turning =
        same_features || (to_row * memory.normal).dot(row.normal) > 1 - last_figures;
    const double limit =
        by_turning ? std::min(shallow * c.radius, most_of_thickness * c.thickness) : no_limit;
    row.offset += std::min(
        {jump, std::max(0.0, -row.gap_start - row.offset), std::max(0.0, limit - row.offset)});
  }
  const Vec3 shear = to_row * memory.shear;
  const Vec3 tangent = shear - row.normal.dot(shear) * row.normal;
  const double tangent_sq = tangent.squaredNorm();
  row.shear = tangent_sq > 0 ? Vec3(std::sqrt(shear.squaredNorm() / tangent_sq) * tangent)
                             : Vec3(Vec3::Zero());
}

void take_on_load(std::span<const ContactMemory> memory, int body_b, ContactRow& row) {
  double deepest = 0;
  for (const ContactMemory& c : memory) {
    if (c.key.body_b != body_b || -c.gap_end <= deepest || c.normal.dot(row.normal) <= 0.5)
      continue;
    deepest = -c.gap_end;
    row.last_stiffness = c.stiffness;
    row.last_force = c.normal_force;
    row.cooldown_steps = c.cooldown_steps;
  }
  row.offset = std::max(0.0, -row.gap_start - deepest);
}

void set_law(const Scene& scene, const BlockNumbers& c, double h, const Mobility& W,
             double approach, ContactRow& row) {
  const double asked = scene.settings.normal_stiffness;
  const double inverse_mass = c.stiffness * c.inverse_mass;
  const double stiffest = std::min(asked > 0 ? asked : c.stiffness, inverse_mass / W.normal);
  double k_n = stiffest;
  const bool was_hit = row.memory >= 0 && row.last_stiffness == 0;  // its load is unknown
  if (c.sag > 0 && row.bond_area == 0 && !was_hit) {
    const double per_mobility = c.inverse_mass / W.normal;
    const double at_once = scene.gravity.norm() * scene.settings.dt * scene.settings.dt;
    const double soft_sag = std::max(law::soft_sag * at_once, c.sag);
    const double soft =
        softest_by_load(c, soft_sag, c.least_stiffness * per_mobility, stiffest, row);
    k_n = stiffness_by_load(c, soft, stiffest, c.most_stiffness * per_mobility, row);
    if (asked > 0) k_n = std::min(k_n, asked);
  }
  const double k_s =
      std::min(scene.settings.shear_ratio * k_n, k_n / stiffest * inverse_mass / W.tangent);
  if (const double last = row.last_stiffness;
      last > 0 && (k_n > same_law * last || last > same_law * k_n))
    keep_force(c, k_n, row);
  const double x = row.gap_start + row.offset;
  row.normal_damping = k_n * h * c.recovery_time;
  row.shear_damping = k_s * h * c.recovery_time;
  const double per_recovery = 1 / c.recovery_time;
  row.shear_velocity = per_recovery * row.shear;
  row.bias = x < 0 ? x * per_recovery : x / h;
  row.waits = row.memory < 0 && row.gap_start > c.touch && approach < -c.located_speed;
}

void hold(const GroundClass& face, double recovery_time, ContactRow& row) {
  row.cohesion = no_normal_limit;
  row.tension = face.tension > 0 ? no_normal_limit : 0;
  row.bias = (row.gap_start + row.offset) / recovery_time;
}

BondCorner corner_of(const KeptContact& contact, const GroundClass& face, const Vec3& impulse,
                     double h) {
  BondCorner corner;
  corner.point = contact.arm;
  corner.force = impulse / h;
  corner.area = contact.bond_area;
  corner.cohesion = face.cohesion;
  corner.tension = face.tension;
  corner.friction = face.friction;
  return corner;
}

double located_speed(const Scene& scene, const BlockNumbers& c, double speed) {
  return std::min(c.resting_speed,
                  std::max(scene.settings.accuracy * speed, law::least_speed * c.resting_speed));
}

double time_to_touch(double gap, double speed, double gap_end, double touch, double h) {
  if (gap_end > touch) return h + 1;
  if (gap_end > -touch) return h;
  const double g = gap + 0.5 * touch;
  const double a = 2 * (gap_end + 0.5 * touch - g - speed * h) / (h * h);
  const double root = std::sqrt(std::max(0.0, speed * speed - 2 * a * g));
  return std::min(h, 2 * g / (root - speed));
}

void set_ground_law(const Scene& scene, const BlockNumbers& c, const Substep& s, ContactRow& row) {
  set_law(scene, c, s.h, mobility(c.inverse_mass, c.inverse_inertia, row.arm, row.normal),
          approach(row, s), row);
}

namespace {

// Friction of a vertex: the mean over its displacement, so that where the class of the ground
// changes within the substep is not rounded to its end.
double friction_on_path(const Scene& scene, const Substep& s, const Contact& contact) {
  const std::vector<GroundClass>& classes = scene.ground.classes;
  double sum = 0, left = 1;
  for_each_class_below(scene.ground, place(s.start.pose, contact.point_a),
                       place(s.free.pose, contact.point_a), [&](int ground, double share) {
                         sum += share * classes[static_cast<size_t>(ground)].friction;
                         left -= share;
                       });
  return sum + left * classes[static_cast<size_t>(contact.ground_class)].friction;
}

// Where the contacts are and how their points move without contact forces.
void set_motions(const Scene& scene, int b, const Substep& s, const Mat3& to_body,
                 std::span<const Contact> contacts, std::span<ContactRow> rows) {
  const Mat3 from_start = to_body * s.R_start;  // body axes at the start to those at the end
  const Vec3 moved = to_body * (s.free.pose.position - s.start.pose.position);
  const Vec3 velocity_start = to_body * s.start.velocity, spin_start = from_start * s.spin_start;
  for (size_t i = 0; i < contacts.size(); ++i) {
    const Contact& contact = contacts[i];
    ContactRow& row = begin_row(scene, b, i, to_body, contacts, rows);
    const Vec3& X = contact.point_a;
    const Vec3 lever_start = from_start * X;
    row.arm = (X + lever_start) / 2;
    row.arm_start = lever_start;
    row.drift = s.spin_free.cross(X - row.arm);
    row.free_move = moved + (X - lever_start);
    row.gap_start = contact.gap - row.normal.dot(row.free_move);
    set_start(velocity_start + spin_start.cross(lever_start), row);
    // not part of the slip: where a block all but sticks it would turn its direction round
    if (s.is_straining) row.speed_start += row.normal.dot(s.straining * X);
    if (!scene.ground.cell_class.empty() && contact.key.mode == ContactMode::vertex_face)
      row.friction = friction_on_path(scene, s, contact);
  }
}

// Data that the rows take over from the step before.
void inherit_all(const Scene& scene, const BlockNumbers& c, const Substep& s, const Mat3& to_body,
                 std::span<const ContactMemory> memory, std::span<const Contact> contacts,
                 std::span<ContactRow> rows) {
  for (size_t m = 0; m < memory.size(); ++m) {
    const int i = row_of(memory[m], contacts);
    if (i < 0) continue;
    ContactRow& row = rows[i];
    if (row.key.mode != ContactMode::vertex_face)
      follow_features(scene, s, contacts[i], to_body, row);
    // a plane that the contact only now runs into is met by an impact, not inherited
    const double speed = approach(row, s);
    if (speed < -c.resting_speed &&
        (row.gap_start > c.touch || comes_back_fast(memory[m], speed, s.h, c)))
      continue;
    const bool same_features = row.key.mode != ContactMode::vertex_face && row.key == memory[m].key;
    inherit(memory[m], static_cast<int>(m), same_features, to_body, c, row);
  }
}

}  // namespace

void make_rows(const Scene& scene, int b, const BlockNumbers& c, const Substep& s,
               std::span<const ContactMemory> memory, std::span<const Contact> contacts,
               std::span<ContactRow> rows) {
  const Mat3 to_body = s.R.transpose();
  set_motions(scene, b, s, to_body, contacts, rows);
  inherit_all(scene, c, s, to_body, memory, contacts, rows);
  set_rough_friction(scene, b, to_body, memory, rows);
  for (size_t i = 0; i < rows.size(); ++i) {
    ContactRow& row = rows[i];
    if (row.memory < 0) {
      if (row.gap_start <= c.touch && contacts[i].gap < -c.touch &&
          approach(row, s) < -c.resting_speed)
        row.gap_start = std::max(row.gap_start, clearance_at_start(scene, contacts[i], s));
      row.offset = std::max(0.0, -row.gap_start);
    }
    set_ground_law(scene, c, s, row);
    if (row.bond_area > 0) hold(scene.ground.classes[row.ground_class], c.recovery_time, row);
  }
}

int count_flips(std::span<const ContactRow> rows, const std::vector<ContactMemory>& before) {
  FlipCounter flips(before);
  for (const ContactRow& row : rows)
    flips.add(row.memory, row.waits ? ContactState::open : row.state);
  return flips.total();
}

// Residual at which the contact forces count as found, as a velocity: 1e-8 of the change by gravity
// in the substep, or the effect of rounded coordinates on the stiffest contact.
double newton_tolerance(const BlockNumbers& c, const Substep& s) {
  const double rounding = 8 * std::numeric_limits<double>::epsilon() *
                          s.start.pose.position.cwiseAbs().maxCoeff() * c.stiffness * s.h / c.mass;
  return std::clamp(rounding, 1e-8 * c.gravity * s.h, 1e-6 * c.gravity * s.h) +
         1e-13 * s.start.velocity.norm();
}

void add_segment(int b, bool flight, double t, double h, const Motion& start, const Motion& end,
                 std::vector<Segment>& segments) {
  Segment segment;
  segment.block = b;
  segment.flight = flight;
  segment.t_start = t;
  segment.t_end = t + h;
  segment.start = start;
  segment.end = end;
  segment.acceleration = (end.velocity - start.velocity) / h;
  segments.push_back(segment);
}

void end_flight(const Scene& scene, int b, double t, State& state, Work& work) {
  const auto i = static_cast<size_t>(b);
  const double h = t - state.local_time[i];
  if (h > 0) {
    const Motion end = fly(state.motion[i], scene.blocks.inertia[i], scene.gravity, h);
    add_segment(b, true, state.local_time[i], h, state.motion[i], end, work.segments);
    state.motion[i] = end;
  }
  forget_rates(scene, b, state);
  land(state, i, t);
}

void watch_rest(const Scene& scene, size_t b, State& state) {
  const Pose &now = state.motion[b].pose, &then = state.rest_pose[b];
  const double dt = scene.settings.dt;
  const double resolved = std::min(scene.gravity.norm() * dt * dt,
                                   law::rests_within * scene.blocks.shapes.thickness[b]);
  const double turn = 2 * (now.attitude.coeffs() - then.attitude.coeffs()).norm();
  const double path = (now.position - then.position).norm() + turn * scene.blocks.shapes.radius[b];
  state.rest_steps[b] += static_cast<int>(state.stride);
  if (path <= resolved) return;
  state.rest_pose[b] = now;
  state.rest_steps[b] = 0;
}

double kinetic_energy(const Scene& scene, size_t b, const Motion& m) {
  const Vec3 spin = angular_velocity(m.pose.attitude, m.angular_momentum, scene.blocks.inertia[b]);
  return 0.5 * scene.blocks.mass[b] * m.velocity.squaredNorm() + 0.5 * spin.dot(m.angular_momentum);
}

void fall_asleep(const Scene& scene, size_t b, State& state) {
  go_to_sleep(state, b);
  state.ledger.contact += kinetic_energy(scene, b, state.motion[b]);
  state.motion[b].velocity.setZero();
  state.motion[b].angular_momentum.setZero();
}

bool is_below_ground(const Scene& scene, int b, const Vec3& centroid) {
  const double radius = scene.blocks.shapes.radius[b];
  return centroid.z() + radius < elevation_at(scene.ground.trn, centroid.x(), centroid.y());
}

bool left_ground(const Scene& scene, const Vec3& x) {
  return std::isnan(elevation_at(scene.ground.trn, x.x(), x.y()));
}

void stop_outside(const Scene& scene, int b, State& state, StepReport& report) {
  const auto i = static_cast<size_t>(b);
  Motion& m = state.motion[i];
  state.ledger.removed += kinetic_energy(scene, i, m);
  m.velocity.setZero();
  m.angular_momentum.setZero();
  leave_domain(state, i);
  state.memory[i].clear();
  ++state.counters.left_domain;
  report.flags = report.flags | StepFlag::left_domain;
}

void set_rates(const Scene& scene, int b, const BlockNumbers& c, const Substep& s,
               const Motion& end, State& state) {
  const auto i = static_cast<size_t>(b);
  // a running mean: fluctuations at the solver's tolerance are not carried on; but it begins anew
  // where nothing pressed the block before
  const double share = state.acceleration[i] == scene.gravity ? 1 : 0.5;
  const double per_h = share / s.h;
  state.acceleration[i] =
      (1 - share) * state.acceleration[i] + per_h * (end.velocity - s.start.velocity);
  const Vec3 spin_end =
      (end.pose.attitude.conjugate() * end.angular_momentum).cwiseProduct(c.inverse_inertia);
  state.spin_rate[i] = (1 - share) * state.spin_rate[i] + per_h * (spin_end - s.spin_start);
}

void forget_rates(const Scene& scene, int b, State& state) {
  state.acceleration[b] = scene.gravity;
  state.spin_rate[b].setZero();
}

void set_support(const Scene& scene, int b, const Vec3& acceleration, State& state) {
  const double size = acceleration.norm(), g = scene.gravity.norm();
  state.support[b] = size > g ? Vec3(g / size * acceleration) : acceleration;
}

bool is_finite(const Motion& m) {
  return m.pose.position.allFinite() && m.pose.attitude.coeffs().allFinite() &&
         m.velocity.allFinite() && m.angular_momentum.allFinite();
}

void stop_at(const Motion& last_good, size_t b, State& state, StepReport& report) {
  state.motion[b] = {last_good.pose, Vec3::Zero(), Vec3::Zero()};
  stop_for_good(state, b);
  state.memory[b].clear();
  report.flags = report.flags | StepFlag::not_finite;
}

}  // namespace talus
